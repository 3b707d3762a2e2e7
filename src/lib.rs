#![cfg_attr(not(feature = "std"), no_std)]
#![doc = "Dynamics of robot arms: one trait, [`Arm`], with a generic and a generated implementation."]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "ulna needs square roots and sines: write `features = [\"libm\"]` beside `default-features = false`, \
     or leave the default feature `std` on"
);

pub use nalgebra;

pub mod arm;
pub mod control;
pub mod generic;
#[doc(hidden)]
pub mod internal;
mod kernels;
pub mod proof;

pub use arm::methods::{Argument, Method};
pub use arm::{Angle, Arm, Joint, JointKind, Link, Placement, TaskRow, TaskRows};
pub use control::compensation::{Compensation, Controller, Cycle, Law, Projector, Status};
pub use control::failure::{Failure, LockedJoints};
pub use control::trajectory::{JointLimits, JointState, Trajectory, Trapezoid};
pub use generic::SerialChain;
pub use kernels::Unrolled;
pub use kernels::batch::{ArmBatch, LengthMismatch};
pub use kernels::real::Real;
pub use kernels::simd::Instructions;
