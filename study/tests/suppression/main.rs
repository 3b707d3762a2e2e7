//! Planned motions, the impact torque of locked joints, and the controller that suppresses it.

mod arms;
mod compensation;
mod failure;
mod limits;
mod on_line;
mod optimal;
mod search;
mod singular;
mod suppression_loop;
mod trajectory;
