//! A robot arm's table as machine code in memory: the speed of generated code, without a compiler.
//!
//! - [`AnyJit`]: the number of joints known at run time; a method by its name, slices in, slices out.
//! - [`Jit`]: the same as an [`ulna::Arm`] of `N` joints.
//!
//! There are no features.

mod any;
mod arm;
mod code;
mod error;
mod host;
mod kernel;
mod shape;
mod translate;

pub use any::AnyJit;
pub use arm::Jit;
pub use error::{CallError, Error};
