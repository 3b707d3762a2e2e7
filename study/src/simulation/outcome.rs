//! What comes of a run: the impact of its failure, the balances, how it ended.

use std::fmt;

use nalgebra::SVector;

use super::{LockImpulse, Work};
use ulna::Status;

/// What a failure did, beside what was predicted of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<const N: usize> {
    /// The ideal lock of the same joints in the same state.
    pub ideal: LockImpulse<N>,
    /// The brakes' impulses from the failure until the joints stood still, N·m·s (N·s).
    pub brake_impulse: SVector<f64, N>,
    /// The change of all rates in that time, rad/s (m/s).
    pub rate_jump: SVector<f64, N>,
    /// The change of the planned rates in that time, for the locked joints down to 0: the paper's assumption.
    pub planned_rate_jump: SVector<f64, N>,
    /// The change of what the joints transmit from just before the failure to just after the brakes' work was done and the controller knew,
    /// as a control cycle at either time makes them, N·m (N).
    pub torque_step: SVector<f64, N>,
    /// The same as the paper predicts it (Eq. 18), for the planned motion at the failure: after minus before, compensation included.
    pub predicted_step: SVector<f64, N>,
    /// The largest torques (without sign) that the joints transmit from the failure on, N·m (N): at any time, not at samples alone.
    pub peak_torque: SVector<f64, N>,
    /// The largest torques (without sign) of the brakes until the joints stand still, N·m (N); of no use for a brake that takes no time.
    pub peak_brake_torque: SVector<f64, N>,
}

/// How energy and momentum account for the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance<const N: usize> {
    /// The change of kinetic energy `½ q̇ᵀ (M + R) q̇`, J.
    pub kinetic: f64,
    /// The work that should account for it.
    pub work: Work,
    /// What it does not account for, relative to the largest of these energies.
    pub energy_error: f64,
    /// What the impulses do not account for of the change of `(M + R) q̇`, relative to the largest entry of both.
    pub momentum_error: f64,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At the end of its span.
    Complete,
    /// Where a wrench, a planned state or a torque was no finite number.
    NotFinite,
    /// Where the steps ran out: the feedback is far too stiff, for example, or a continuous control has no motion that obeys it.
    StepTooShort,
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Complete => "complete",
            Self::NotFinite => "a torque or a state is no finite number",
            Self::StepTooShort => "the steps of the integration ran out",
        })
    }
}

/// What comes of a run.
#[derive(Clone, Copy, Debug)]
pub struct Outcome<const N: usize> {
    /// How it ended; all the rest is about the time until then.
    pub ending: Ending,
    /// What the failure did; `None` if the run did not come to where its effects are known.
    pub impact: Option<Impact<N>>,
    /// The balances over the run.
    pub balance: Balance<N>,
    /// The controller's worst status in any sample.
    pub status: Status,
    /// Steps of the integration.
    pub steps: u32,
}
