//! A robot arm's table in, a validated [`Model`] out; or every error at once, each with its place and what to write instead.
//!
//! ```
//! use ulna::{Arm, SerialChain, nalgebra::Vector1};
//! use ulna_table::Model;
//!
//! let table = r#"
//! name = "pendulum"
//! convention = "modified"
//! angle_unit = "deg"
//! gravity = [0.0, -9.81, 0.0]
//! [task]
//! rows = ["y"]
//! [[joint]]
//! theta = 0.0
//! d = 0.0
//! a = 0.0
//! alpha = 0.0
//! [joint.link]
//! mass = 1.0
//! com = [0.5, 0.0, 0.0]
//! inertia = { xx = 0.001, yy = 0.083, zz = 0.083 }
//! "#;
//! let model = Model::parse(table, "pendulum.toml")?; // or Model::load("arms/pendulum.toml")
//! let arm = SerialChain::<1>::try_from(&model)?;
//! assert_eq!(arm.gravity_torque(&Vector1::new(0.0))[0], 0.5 * 9.81);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where to go
//!
//! - [`Model::load`] reads a file, [`Model::parse`] a text, [`Model::lint`] warns besides; [`Model::new`] takes a [`Description`] from a program.
//! - [`Lint`]: what is warned of, each switched off by its name in a table's `allow`.
//! - [`Model::pose`] and [`Model::reach`]: what can be held against a data sheet, for any number of joints.
//! - [`reference()`]: the format, every key with its bounds, as `ulna help table` prints it.
//! - [`TableErrors`]: prints as a text for people; [`diagnostics`] has the errors one by one.
//! - A [`Model`] becomes a [`SerialChain`](ulna::SerialChain) by `try_from`, or code by the crate `ulna-codegen`.
//!
//! There are no features.

mod chain;
pub mod diagnostics;
mod format;
mod lint;
mod model;
mod pose;
mod reach;
mod table;
#[doc(hidden)]
pub mod toml_reader;

pub use chain::JointCountError;
pub use diagnostics::TableErrors;
pub use format::reference;
#[doc(hidden)]
pub use format::{ANGLE_UNIT, RATED_TORQUE};
pub use lint::Lint;
pub use model::{Description, ImpossibleInertia, Model, TableText, impossible_inertia, name_for};
#[doc(hidden)]
pub use model::{is_keyword, joint_name, shortest};
pub use pose::Pose;
pub use table::{AngleUnit, Convention};
