//! [`COptions`]: what C is written.

use ulna::Method;

use super::casadi;

/// What C is written of an arm: in double precision, in functions of at most [`COptions::FUNCTION_LENGTH`] statements, unless it is told otherwise.
///
/// ```
/// use ulna_codegen::{COptions, Precision};
/// let options = COptions::new().precision(Precision::Float).function_length(200);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct COptions {
    pub(super) precision: Precision,
    pub(super) function_length: usize,
    pub(super) abi: Option<Abi>,
}

/// The scalar of the C code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// `double`.
    #[default]
    Double,
    /// `float`.
    Float,
}

/// A binary interface that is offered besides the functions of the methods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Abi {
    /// That of `casadi.external`: `NAME_casadi_inverse_dynamics`, `NAME_casadi_forward_dynamics` and their Jacobians. In double precision alone,
    /// which is CasADi's; of the methods that it is made of none may be left out.
    Casadi,
}

impl Abi {
    /// The methods that it is made of; an arm with a payload takes one more.
    pub fn methods(self, has_payload: bool) -> Vec<Method> {
        match self {
            Self::Casadi => casadi::needed(has_payload),
        }
    }
}

impl Default for COptions {
    fn default() -> Self {
        Self::new()
    }
}

impl COptions {
    /// Statements in a function, at most, unless another number is asked for.
    pub const FUNCTION_LENGTH: usize = 2000;

    /// The fewest statements that a function may be asked to have at most.
    pub const SHORTEST: usize = 20;

    /// Double precision, functions of at most [`COptions::FUNCTION_LENGTH`] statements, no further interface.
    pub const fn new() -> Self {
        Self {
            precision: Precision::Double,
            function_length: Self::FUNCTION_LENGTH,
            abi: None,
        }
    }

    /// In that precision.
    #[must_use]
    pub const fn precision(self, precision: Precision) -> Self {
        Self { precision, ..self }
    }

    /// In functions of at most `statements` statements each, [`COptions::SHORTEST`] if that is more; what is longer becomes several that
    /// hand on what they share. The function that calls them has one statement for each besides.
    #[must_use]
    pub const fn function_length(self, statements: usize) -> Self {
        let function_length = if statements < Self::SHORTEST {
            Self::SHORTEST
        } else {
            statements
        };
        Self {
            function_length,
            ..self
        }
    }

    /// With that interface besides.
    #[must_use]
    pub const fn abi(self, abi: Abi) -> Self {
        Self {
            abi: Some(abi),
            ..self
        }
    }
}
