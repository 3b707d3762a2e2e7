//! Planned motions, the impact torque of locked joints, and the controller that suppresses it.

mod arms;
mod compensation;
mod failure;
mod limits;
mod optimal;
mod profiles;
mod search;
mod singular;
mod step;
mod tool_profiles;
mod trajectory;
