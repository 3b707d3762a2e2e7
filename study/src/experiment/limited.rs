//! [`LimitedSuppression`]: what rated torques cost the suppression, Table 3 of the paper.

use nalgebra::SVector;

use super::bound::{bounds, wanted};
use super::{CoefficientBound, ExperimentError, ExperimentRunner};
use crate::scenario::{Experiment, ToolForce};
use crate::search::{Operation, cancel_per_joint};
use ulna::control::compensation::Compensation;

/// One experiment with rated torques and one failure time, under Eq. 16 at its exact coefficients, with the limits and without.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitedSuppression {
    /// [`Experiment::section`].
    pub section: String,
    /// s.
    pub failure_time: f64,
    /// Base first.
    pub joints: Vec<LimitedJoint>,
}

/// A joint in [`LimitedSuppression`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitedJoint {
    /// τ^r, N·m (N); infinite if there is none.
    pub rated_torque: f64,
    /// τ^e = τ^r − |τ^v|, what the inertia leaves of it for tool force and compensation, on the mean over the motion, N·m (N).
    pub mean_room: f64,
    /// |Δτ̃_i| without compensation, N·m (N).
    pub impact_before: f64,
    /// |Δτ̃_i| with compensation that no rated torque limits.
    pub impact_free: f64,
    /// |Δτ̃_i| with compensation within the rated torque.
    pub impact_limited: f64,
    /// The largest |U_i| over the motion where no rated torque limits it, N·m (N).
    pub compensation_free: f64,
    /// The largest |U_i| over the motion within the rated torque.
    pub compensation_limited: f64,
    /// What cuts its coefficient; `None` where nothing does.
    pub bound: Option<CoefficientBound>,
}

impl LimitedJoint {
    /// How much of the impact a free compensation takes away, %; 0 where there is none.
    pub fn free_percent(&self) -> f64 {
        lost(self.impact_before, self.impact_free)
    }

    /// How much of it the limited compensation takes away, %.
    pub fn limited_percent(&self) -> f64 {
        lost(self.impact_before, self.impact_limited)
    }

    /// By how much the limit lowers the largest compensation, %.
    pub fn compensation_decrease_percent(&self) -> f64 {
        lost(self.compensation_free, self.compensation_limited)
    }
}

/// 100 (1 − left/all); 0 of nothing.
fn lost(all: f64, left: f64) -> f64 {
    if all > 0.0 {
        100.0 * (1.0 - left / all)
    } else {
        0.0
    }
}

impl<const N: usize> ExperimentRunner<'_, N> {
    /// What the rated torques of `experiment` cost with the failure at `failure_time`; `None` if it has none, or if no
    /// coefficient keeps them.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn limited(
        &self,
        experiment: &Experiment,
        failure_time: f64,
    ) -> Result<Option<LimitedSuppression>, ExperimentError> {
        if experiment.rated_torque().is_none() {
            return Ok(None);
        }
        let operation = self.operation(experiment, failure_time)?;
        let Ok(found) = cancel_per_joint(&operation) else {
            return Ok(None);
        };
        let rated = *operation.rated_torque();
        let step = operation.step();
        let bounds = bounds(&operation);
        let mean_room = rated - mean_driving_torque(&operation, experiment.force());
        let free = Compensation::PerJoint(wanted(&operation));
        let free = operation
            .with_rated_torque(SVector::repeat(f64::INFINITY))
            .assess(&free);
        let limited = found.assessment;
        let joints = (0..N).map(|joint| LimitedJoint {
            rated_torque: rated[joint],
            mean_room: mean_room[joint],
            impact_before: step[joint].abs(),
            impact_free: free.impact[joint].abs(),
            impact_limited: limited.impact[joint].abs(),
            compensation_free: free.peak_compensation[joint],
            compensation_limited: limited.peak_compensation[joint],
            bound: bounds[joint],
        });
        Ok(Some(LimitedSuppression {
            section: experiment.section().to_owned(),
            failure_time,
            joints: joints.collect(),
        }))
    }
}

/// The mean of |τ^v| over time: what the motion takes without any tool force, N·m (N).
fn mean_driving_torque<const N: usize>(
    operation: &Operation<N>,
    force: &ToolForce,
) -> SVector<f64, N> {
    let driving = operation.samples().iter().map(|sample| {
        let wrench = if sample.locked.is_empty() {
            force.at(sample.time)
        } else {
            force.after_lock(sample.time)
        };
        let torque = sample.planned - sample.pose.jacobian.tr_mul(&wrench);
        (sample.time, torque.abs())
    });
    let driving: Vec<_> = driving.collect();
    let mut sum = SVector::zeros();
    let mut time = 0.0;
    for pair in driving.windows(2) {
        let length = pair[1].0 - pair[0].0;
        sum += (pair[0].1 + pair[1].1) * (0.5 * length);
        time += length;
    }
    sum / time
}
