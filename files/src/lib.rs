//! Files of the program `ulna`: written whole or not at all, by one run at a time.
//!
//! Errors are sentences for whoever named the file: what could not be done, with its path, and what to do about it.

mod lock;
pub mod rows;
mod target;
mod whole;

pub use lock::Lock;
pub use target::{refuse_special, target};
pub use whole::{Files, Growing, Staged, check_folder, write_new, write_whole};
