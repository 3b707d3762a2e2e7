//! What can go wrong: while machine code is made, and when it is called.

use std::io;

use ulna::Method;
use ulna_table::JointCountError;

/// Why there is no machine code. The interpreter and the textbook need none.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The code generator does not know this machine.
    #[error("no machine code can be made on this machine: {0}")]
    Host(String),
    /// A program that the code generator refuses.
    #[error("`{method}` cannot be turned into machine code: {reason}")]
    Program {
        /// The method whose program it is.
        method: Method,
        /// What is wrong with it.
        reason: String,
    },
    /// The system gives no memory that code may be run in.
    #[error("no memory for machine code: {0}")]
    Memory(#[from] io::Error),
    /// The arm has another number of joints than the type.
    #[error(transparent)]
    Joints(#[from] JointCountError),
}

/// Why a call was refused. Nothing was written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CallError {
    /// The method was not among those that were compiled.
    #[error("`{0}` is not compiled for this arm")]
    NotCompiled(Method),
    /// Another number of arguments.
    #[error("`{method}` takes {expected} arguments, not {given}")]
    Arguments {
        /// The method.
        method: Method,
        /// How many it takes.
        expected: usize,
        /// How many were given.
        given: usize,
    },
    /// A slice of another length than the arm has numbers for.
    #[error("`{slice}` has {length} numbers, where {expected} are needed")]
    Length {
        /// The slice: an argument's name, or `result`.
        slice: &'static str,
        /// Its length.
        length: usize,
        /// What it must be.
        expected: usize,
    },
}
