//! Planned motions, the impact torque of locked joints, and the controller that suppresses it.

mod arms;
mod compensation;
mod failure;
mod search;
mod trajectory;
