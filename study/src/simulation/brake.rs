//! Brakes: how a joint is stopped in a finite time, and the impulse of stopping it in none.

use nalgebra::{Cholesky, SMatrix, SVector};

use ulna::Arm;
use ulna::control::failure::{Failure, LockedJoints};

/// How the rate of a braked joint falls to 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BrakeProfile {
    /// With constant deceleration: the rate falls as `1 − s`.
    #[default]
    Constant,
    /// With a deceleration that grows from 0 and falls back to it: the rate falls as `1 − 3s² + 2s³`.
    Smooth,
}

impl BrakeProfile {
    /// The share of the rate that is left after the share `s`, 0 to 1, of the brake's time.
    pub fn rate(self, s: f64) -> f64 {
        match self {
            Self::Constant => 1.0 - s,
            Self::Smooth => 1.0 - s * s * (3.0 - 2.0 * s),
        }
    }

    /// The derivative of [`rate`](Self::rate) by `s`.
    pub fn slope(self, s: f64) -> f64 {
        match self {
            Self::Constant => -1.0,
            Self::Smooth => -6.0 * s * (1.0 - s),
        }
    }
}

/// Joints whose brakes fall: stopped over a finite time, locked from then on.
///
/// A brake takes its joint to rest along the profile whatever that takes: its torque is the constraint's, not a given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brake<const N: usize> {
    /// Which joints, and when their brakes begin to act.
    pub failure: Failure<N>,
    /// From moving to locked, s. 0 is the ideal lock: an impulse, see [`ideal_lock`].
    pub duration: f64,
    /// How the rate falls in that time.
    pub profile: BrakeProfile,
    /// From the failure until the controller counts the joints as locked, s. Their motors go on until its next cycle switches them off.
    pub detection: f64,
}

impl<const N: usize> Brake<N> {
    /// No brake falls.
    pub fn none() -> Self {
        Self::new(
            Failure {
                joints: LockedJoints::NONE,
                time: 0.0,
            },
            0.0,
        )
    }

    /// A brake of constant deceleration, known to the controller at once.
    pub fn new(failure: Failure<N>, duration: f64) -> Self {
        Self {
            failure,
            duration,
            profile: BrakeProfile::Constant,
            detection: 0.0,
        }
    }
}

/// What it takes to stop joints in no time, in N·m·s (N·s), and what it does to the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LockImpulse<const N: usize> {
    /// The impulse of each locked joint's brake; 0 for the others.
    /// For one joint k it is `−q̇_k / ((M + R)⁻¹)_kk`.
    pub brake: SVector<f64, N>,
    /// The jump of all rates, rad/s (m/s): `(M + R)⁻¹` times the brakes' impulses.
    pub rate_jump: SVector<f64, N>,
    /// The impulses that all joints would transmit so that the healthy ones keep their rates, as the paper assumes:
    /// M times the jump of the locked joints' rates alone. Rotors, on their side of the joint, play no part.
    /// By the time that the stop takes, it is the mean torque of the acceleration `−q̇_k/T`, which Eq. 1 leaves out: it has `−q̈_k` alone.
    pub if_rates_are_kept: SVector<f64, N>,
}

/// The ideal lock of `locked` joints in `q`, which moves with `qd`: the limit of ever shorter brakes.
///
/// No finite torque counts in no time, so that `(M + R) Δq̇ = p` with p = 0 at the healthy joints and `Δq̇ = −q̇` at the locked ones
/// (Featherstone, *Rigid Body Dynamics Algorithms*, 11.7: impulsive dynamics).
/// R is the `reflected_inertia` of the rotors, on the diagonal.
/// `None` if rounding leaves M without a Cholesky factor, as only absurd arguments can.
pub fn ideal_lock<const N: usize>(
    arm: &(impl Arm<N> + ?Sized),
    q: &SVector<f64, N>,
    qd: &SVector<f64, N>,
    locked: LockedJoints<N>,
    reflected_inertia: &SVector<f64, N>,
) -> Option<LockImpulse<N>> {
    let structure = arm.mass_matrix(q);
    let mass_matrix = structure + SMatrix::from_diagonal(reflected_inertia);
    let stop = locked.without(qd) - qd;
    let if_rates_are_kept = structure * stop;
    let healthy = Cholesky::new(locked.reduce_mass_matrix(&mass_matrix))?;
    let rate_jump = stop - healthy.solve(&locked.without(&if_rates_are_kept));
    let impulse = mass_matrix * rate_jump;
    Some(LockImpulse {
        brake: impulse - locked.without(&impulse),
        rate_jump,
        if_rates_are_kept,
    })
}
