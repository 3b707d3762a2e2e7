//! A robot arm's table in, a validated [`Model`] out; or every error at once, each with its place and what to write instead.

mod chain;
pub mod diagnostics;
mod format;
mod model;
mod table;
#[doc(hidden)]
pub mod toml_reader;

pub use chain::JointCountError;
pub use diagnostics::TableErrors;
pub use format::reference;
#[doc(hidden)]
pub use format::{ANGLE_UNIT, RATED_TORQUE};
pub use model::{Description, Model};
#[doc(hidden)]
pub use table::AngleUnit;
pub use table::Convention;
