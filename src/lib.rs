//! Dynamics of a robot arm, generated from its table or computed by the textbook, and a controller for arms whose joints lock.
//!
//! ```
//! use ulna::{Angle, Arm, Friction, Joint, JointKind, Limits, Link, Motor, Placement, SerialChain, TaskRow, TaskRows};
//! use ulna::nalgebra::Vector2;
//!
//! // An arm as data, for the textbook. `ulna-codegen` and `ulna-macros` make a type with the same methods of a table.
//! let joint = |a: f64| Joint {
//!     kind: JointKind::Revolute,
//!     alpha: Angle::default(),
//!     a,
//!     theta: Angle::default(),
//!     d: 0.0,
//!     rated_torque: None,
//!     limits: Limits::NONE,
//!     motor: Motor::NONE,
//!     friction: Friction::NONE,
//!     link: Link {
//!         mass: 1.0,
//!         com: [0.5, 0.0, 0.0],
//!         inertia: [[0.001, 0.0, 0.0], [0.0, 0.083, 0.0], [0.0, 0.0, 0.083]],
//!     },
//! };
//! let arm = SerialChain {
//!     joints: [joint(0.0), joint(1.0)],
//!     base: Placement::IDENTITY,
//!     tool: Placement { translation: [1.0, 0.0, 0.0], ..Placement::IDENTITY },
//!     gravity: [0.0, -9.81, 0.0],
//!     task: TaskRows::new(&[TaskRow::X, TaskRow::Y]),
//! };
//! let q = Vector2::new(0.3, -0.7);
//! let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
//! assert!(w > 0.0 && gradient.norm() > 0.0);
//! ```
//!
//! # Where to go
//!
//! - [`Arm`]: what every arm offers; [`ArmBatch`] for many states at once; [`Unrolled`] for kernels on a scalar of your own.
//! - Code for your arm: the crate `ulna-codegen` for a build script, `ulna-macros` for the macro `arm!`, the program `ulna`
//!   for a file to check in. What they write needs this crate and nothing else.
//! - [`SerialChain`]: the same by textbook formulas, for any arm at run time; `ulna-table` reads it from a table.
//! - [`proof`]: one arm compared with another, and what rounding explains.
//! - [`control`]: planned motions, joints that lock, and what suppresses the impact of it: the [`Controller`], which has no memory,
//!   for a search; the [`SuppressionLoop`], which has, for a real loop.
//!
//! # Features
//!
//! | feature | |
//! |---|---|
//! | `std` (default) | elementary functions from the standard library; fused multiply-adds and wide registers found at run time |
//! | `libm` | elementary functions without it: `default-features = false, features = ["libm"]` |
//!
//! Without the standard library there is no allocator either; nothing here needs one.
#![cfg_attr(not(feature = "std"), no_std)]

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

pub use arm::method_set::MethodSet;
pub use arm::methods::{Argument, Method};
pub use arm::{
    Angle, Arm, Friction, Joint, JointKind, Limits, Link, Motor, Parameter, Payload, PayloadError,
    Placement, TaskRow, TaskRows,
};
pub use control::compensation::{
    Compensation, Controller, Cycle, Law, OnLine, Projector, Status, Weighting,
};
pub use control::failure::{Failure, LockedJoints};
pub use control::suppression::{LoopCycle, Recourse, Schedule, SuppressionLaw, SuppressionLoop};
pub use control::trajectory::{
    JointLimits, JointState, PointToPoint, PositionLimits, Profile, ProfileShape, Trajectory,
};
pub use generic::SerialChain;
pub use kernels::Unrolled;
pub use kernels::batch::{ArmBatch, LengthMismatch};
pub use kernels::real::Real;
pub use kernels::simd::Instructions;
