#![cfg_attr(not(feature = "std"), no_std)]
#![doc = "Dynamics of robot arms: one trait, [`Arm`], with a generic and a generated implementation."]

pub use nalgebra;

pub mod arm;
pub mod batch;
pub mod bounds;
pub mod compensation;
#[cfg(feature = "table")]
pub mod diagnostics;
#[cfg(all(feature = "table", feature = "optimal"))]
pub mod experiment;
pub mod failure;
pub mod generic;
pub mod model;
pub mod null_space;
pub mod proof;
#[doc(hidden)]
pub mod random;
pub mod real;
#[cfg(feature = "table")]
pub mod scenario;
#[cfg(feature = "std")]
pub mod search;
pub mod simd;
pub mod simulation;
pub mod singular;
#[cfg(feature = "table")]
mod table;
#[cfg(feature = "table")]
mod toml_reader;
#[cfg(feature = "std")]
pub mod tool_path;
pub mod trajectory;
pub mod trigonometry;
pub mod unrolled;

pub use arm::Arm;
pub use batch::{ArmBatch, LengthMismatch};
pub use compensation::{Compensation, Controller, Cycle, Law, Projector, Status};
#[cfg(feature = "table")]
pub use diagnostics::TableErrors;
pub use failure::{Failure, LockedJoints};
pub use generic::SerialChain;
#[cfg(feature = "table")]
pub use model::Model;
pub use model::{Angle, Joint, JointKind, Link, Placement, TaskRow, TaskRows};
pub use real::Real;
#[cfg(feature = "table")]
pub use scenario::Scenario;
pub use trajectory::{JointLimits, JointState, Trajectory, Trapezoid};
pub use unrolled::Unrolled;

/// The README's examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
