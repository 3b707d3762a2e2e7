//! Planned motions, joints that lock on the way, and the controller that suppresses what a lock does (Eq. 1–20).

pub mod compensation;
pub mod failure;
pub mod null_space;
pub mod trajectory;
