//! The convex problems: Eq. 20's coefficients under all limits, and the best compensation there is.
//!
//! With x what is searched for, the impact is `Δτ̃ = step + R x`, the torques are `planned + T x`,
//! and the static tool force is off by `E x`. Where no limit binds, the least-squares problems are solved by a pseudoinverse,
//! which also picks the least x; otherwise by an interior-point method with a duality gap.

mod certificate;
mod conic;
mod constant;
mod fairness;
mod free_map;
mod least;
mod limits;
mod optimal;
mod problem;
mod projected;
mod pseudo_inverse;
mod robust;
mod scope;

use nalgebra::{DVector, SVector};

use super::{Operation, Solution};
pub use certificate::{Certificate, LowerAll, lower_every_joint};
use conic::Minimum;
pub use constant::{BestConstant, best_constant};
pub use fairness::{Acts, Fairness};
pub use optimal::{ForcePriority, FrontierPoint, Optimum, frontier, optimal};
pub use projected::{Objective, least_impact};
pub use robust::{Moment, RobustObjective, RobustOptions, RobustPlan, RobustSample, robust};
pub(super) use scope::ROUNDING;
pub use scope::Scope;
use ulna::control::compensation::Compensation;

/// The healthy joints' entries of `vector`.
fn healthy_part<const N: usize>(
    operation: &Operation<N>,
    vector: &SVector<f64, N>,
) -> DVector<f64> {
    DVector::from_iterator(
        N - operation.failure().joints.len(),
        operation.healthy().map(|joint| vector[joint]),
    )
}

impl Minimum {
    /// What it is worth as `compensation`.
    fn solution<const N: usize>(
        &self,
        operation: &Operation<N>,
        compensation: Compensation<N>,
        seconds: f64,
    ) -> Solution<N> {
        Solution {
            compensation,
            assessment: operation.assess(&compensation),
            status: self.status,
            gap: Some(self.gap),
            iterations: self.iterations,
            seconds,
        }
    }
}
