//! [`OperationOptions`]: how an operation is looked at, and what every search in it weighs.

use nalgebra::{SVector, Vector6};

use super::Field;
use ulna::control::compensation::Projector;

/// How an operation is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OperationOptions<const N: usize> {
    /// The largest time between two samples, s.
    pub sample_period: f64,
    /// Δt of Eq. 18, s: from the last torque before the lock, at t_f, to the first after it. 0 is the limit of ever shorter ones.
    pub step_time: f64,
    /// `ΔF_e` and `ΔN_e` of Eq. 8, `[f; n]`, N and N·m: what the lock takes from the tool's wrench, before minus after.
    pub wrench_step: Vector6<f64>,
    /// The projector of every law.
    pub projector: Projector,
    /// What stands in the place of ∇w_D in Eq. 16 and 20.
    pub field: Field,
    /// Rated torques, N·m (N); infinite where there is no limit.
    pub rated_torque: SVector<f64, N>,
    /// e, the weight of effort in every search: a newton metre of compensation at the lock weighs as e newton metres of impact,
    /// so that of compensations that are nearly as good the cheapest is found.
    ///
    /// Least norms become least `‖Δτ̃‖² + e² (‖U‖² + ‖U'‖²)`, with U just before and U' just after the lock; other objectives alike.
    /// Under Eq. 16 a joint is left alone whose compensation is not worth it ([`cancel_per_joint`](super::cancel_per_joint)).
    /// At least 0; with 0 impact alone counts.
    pub effort: f64,
}

/// The default of [`OperationOptions::effort`]: a compensation is not worth it that takes less than a thousandth of itself from the impact.
///
/// Measured on the paper-like motion, one of joints 1 to 6 locking at 1, 2 to 19 s, without rated torques and with those of Section 5.3:
/// no norm that Eq. 20 or the optimum leaves grows by more than 1.5·10⁻⁶ of itself, while the torques of Eq. 20 fall to down to a tenth
/// (its coefficients share a direction, and many leave the same). Eq. 16 no longer spends 7·10⁵ N·m on a joint (joint 1 locking at 18 s).
/// At 0.01 norms grow by up to 0.6 %.
pub const EFFORT: f64 = 1e-3;

impl<const N: usize> Default for OperationOptions<N> {
    /// Samples every 50 ms, a lock in no time that leaves the wrench as it is, the static projector, ∇w_D, no limits, a small weight of effort.
    fn default() -> Self {
        Self {
            sample_period: 0.05,
            step_time: 0.0,
            wrench_step: Vector6::zeros(),
            projector: Projector::Static,
            field: Field::default(),
            rated_torque: SVector::repeat(f64::INFINITY),
            effort: EFFORT,
        }
    }
}
