#![cfg_attr(not(feature = "std"), no_std)]
#![doc = "Dynamics of robot arms: one trait, [`Arm`], with a generic and a generated implementation."]

pub use nalgebra;

pub mod arm;
pub mod generic;
pub mod model;
pub mod proof;
pub mod real;

pub use arm::Arm;
pub use generic::SerialChain;
#[cfg(feature = "table")]
pub use model::Model;
pub use model::{Angle, Joint, JointKind, Link, Placement, TaskRow, TaskRows};
pub use real::Real;
