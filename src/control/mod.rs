//! Planned motions, joints that lock on the way, and the controllers that suppress what a lock does (Eq. 1–20).

pub mod compensation;
pub mod failure;
pub mod null_space;
pub mod suppression;
pub mod trajectory;
