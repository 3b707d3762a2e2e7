//! The inside, for the tests of this crate and for measurements: it may change with any version.

pub use crate::accuracy::{Arguments, Scalar};
pub use crate::differentiate::reverse;
pub use crate::emit::{Summand, fused_summands};
pub use crate::formulate::chain::Chain;
pub use crate::formulate::kinematics::{Twist, jacobian_in_group, jacobian_in_world};
pub use crate::formulate::mass_matrix::mass_matrix;
pub use crate::formulate::regressor::Columns;
pub use crate::formulate::{Choices, formulate};
pub use crate::graph::{Expr, Graph};
pub use crate::schedule::schedule;
