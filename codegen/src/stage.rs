//! [`Stage`]: what the generator is at, for whoever waits for it.

use std::fmt;

use ulna::Method;

/// What the generator is about to do. An arm of 30 joints takes it some ten seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// It looks for the base parameters, and tries out formulas.
    Choosing,
    /// It writes a method's formulas down, and measures how exact they are.
    Formulating(Method),
    /// It prints a method's code.
    Printing(Method),
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Choosing => f.write_str("choosing among formulas"),
            Self::Formulating(method) => write!(f, "formulating {method}"),
            Self::Printing(method) => write!(f, "printing {method}"),
        }
    }
}
