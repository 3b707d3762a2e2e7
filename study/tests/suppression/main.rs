//! Planned motions, the impact torque of locked joints, and the controller that suppresses it.

mod arms;
mod certificate;
mod compensation;
mod failure;
mod fairness;
mod field;
mod limits;
mod on_line;
mod optimal;
mod profiles;
mod robust;
mod search;
mod singular;
mod step;
mod suppression_loop;
mod tool_profiles;
mod trajectory;
