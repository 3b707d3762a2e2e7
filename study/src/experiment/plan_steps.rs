//! [`PlanSteps`]: the steps that the planned torque makes by itself, beside those of a lock, for every profile of the same motion.

use nalgebra::{SVector, Vector6};

use super::{AnyArm, ExperimentError, ExperimentRunner, KNOT_PERIOD, list};
use crate::scenario::{Experiment, PlannedMotion};
use ulna::control::failure::{Failure, LockedJoints};
use ulna::{JointState, ProfileShape, Trajectory};

/// A motion with each profile in turn.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanSteps {
    /// [`Experiment::section`].
    pub section: String,
    /// The joints that lock, counted from 0.
    pub failed_joints: Vec<usize>,
    /// The scenario's own profile first, then those of another kind, in the same time with the same blend.
    pub profiles: Vec<ProfileSteps>,
}

/// A motion with one profile.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileSteps {
    /// How the speed rises in a blend.
    pub shape: ProfileShape,
    /// What the torques do; `Err` if the motion cannot be executed with it.
    pub torques: Result<PlannedTorques, ExperimentError>,
}

/// The steps of `ID + Jᵀ F_e` along a planned motion, without compensation.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedTorques {
    /// At the ends of the profile's phases, the motion's start and end among them; nothing locks.
    pub phase_ends: Vec<TorqueStep>,
    /// The largest |dτ_i/dt| between them, N·m/s (N/s), joint by joint.
    pub steepest: Vec<f64>,
    /// The largest norm of dτ/dt between them.
    pub steepest_norm: f64,
    /// When, s.
    pub steepest_time: f64,
    /// Eq. 18 at each failure time of the scenario.
    pub locks: Vec<TorqueStep>,
}

/// A step of the torques, after minus before.
#[derive(Clone, Debug, PartialEq)]
pub struct TorqueStep {
    /// s.
    pub time: f64,
    /// N·m (N), joint by joint.
    pub step: Vec<f64>,
}

impl TorqueStep {
    /// The norm over all joints, a locked one among them.
    pub fn norm(&self) -> f64 {
        self.step.iter().map(|step| step * step).sum::<f64>().sqrt()
    }
}

impl PlannedTorques {
    /// The largest step that the plan makes by itself.
    pub fn largest_of_plan(&self) -> Option<&TorqueStep> {
        largest(&self.phase_ends)
    }

    /// The largest step of a lock.
    pub fn largest_of_locks(&self) -> Option<&TorqueStep> {
        largest(&self.locks)
    }
}

fn largest(steps: &[TorqueStep]) -> Option<&TorqueStep> {
    steps.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()))
}

/// At so many times of a motion dτ/dt is looked at, and at the ends of its phases.
const SAMPLES: f64 = 1000.0;
/// Half the length of the differences, as a share of the motion.
const HALF_DIFFERENCE: f64 = 1e-5;

impl<const N: usize> ExperimentRunner<'_, N> {
    /// The steps of the planned torque under the force of `experiment`, with the scenario's profile and with the others.
    pub fn plan_steps(&self, experiment: &Experiment) -> PlanSteps {
        let motion = self.scenario.motion();
        let own = motion.profile().shape();
        let others = [
            ProfileShape::Trapezoid,
            ProfileShape::Quintic,
            ProfileShape::s_curve(motion.blend()),
        ];
        let kind = core::mem::discriminant::<ProfileShape>;
        let others = others.into_iter().filter(|shape| kind(shape) != kind(&own));
        let profiles = [own].into_iter().chain(others).map(|shape| ProfileSteps {
            shape,
            torques: self.planned_torques(experiment, shape),
        });
        PlanSteps {
            section: experiment.section().to_owned(),
            failed_joints: self.scenario.failed_joints().to_vec(),
            profiles: profiles.collect(),
        }
    }

    fn planned_torques(
        &self,
        experiment: &Experiment,
        shape: ProfileShape,
    ) -> Result<PlannedTorques, ExperimentError> {
        let motion = self.scenario.motion().clone().with_shape(shape);
        let motion = motion.map_err(crate::scenario::PlanError::from)?;
        let plan = Plan {
            arm: self.arm,
            motion: motion.plan(self.arm, KNOT_PERIOD)?,
            experiment,
        };
        let locks = self.scenario.failure_times().iter().map(|time| TorqueStep {
            time: *time,
            step: list(&plan.step_of_lock(self.failed_joints(), *time)),
        });
        let ends: Vec<f64> = plan.motion.profile().phase_ends().collect();
        let mut torques = PlannedTorques {
            phase_ends: ends.iter().map(|end| plan.step_at(*end)).collect(),
            steepest: Vec::new(),
            steepest_norm: 0.0,
            steepest_time: 0.0,
            locks: locks.collect(),
        };
        let mut steepest = SVector::<f64, N>::zeros();
        for phase in ends.windows(2) {
            for (time, rate) in plan.rates(phase[0], phase[1]) {
                steepest = steepest.sup(&rate.abs());
                if rate.norm() > torques.steepest_norm {
                    (torques.steepest_norm, torques.steepest_time) = (rate.norm(), time);
                }
            }
        }
        torques.steepest = list(&steepest);
        Ok(torques)
    }
}

struct Plan<'a, const N: usize> {
    arm: &'a AnyArm<N>,
    motion: PlannedMotion<N>,
    experiment: &'a Experiment,
}

impl<const N: usize> Plan<'_, N> {
    fn torque(&self, state: &JointState<N>, wrench: &Vector6<f64>) -> SVector<f64, N> {
        self.arm.inverse_dynamics(&state.q, &state.qd, &state.qdd)
            + self.arm.geometric_jacobian(&state.q).tr_mul(wrench)
    }

    fn before(&self, time: f64) -> SVector<f64, N> {
        self.torque(
            &self.motion.state_before(time),
            &self.experiment.force().at(time),
        )
    }

    fn after(&self, time: f64) -> SVector<f64, N> {
        self.torque(&self.motion.state(time), &self.experiment.force().at(time))
    }

    fn step_at(&self, time: f64) -> TorqueStep {
        TorqueStep {
            time,
            step: list(&(self.after(time) - self.before(time))),
        }
    }

    /// Eq. 18 without compensation.
    fn step_of_lock(&self, joints: LockedJoints<N>, time: f64) -> SVector<f64, N> {
        let after = time + self.experiment.step_time();
        let locked = Failure { joints, time }.state(&self.motion, after);
        let wrench = self.experiment.force().after_lock(after);
        self.torque(&locked, &wrench) - self.after(time)
    }

    /// dτ/dt at times from `start` to `end`, between which the motion is smooth: by central differences, on one side at the ends.
    fn rates(&self, start: f64, end: f64) -> impl Iterator<Item = (f64, SVector<f64, N>)> {
        let duration = self.motion.duration();
        let cells = (SAMPLES * (end - start) / duration).ceil().max(1.0);
        (0..=cells as u32).map(move |i| {
            let time = start + (end - start) * (f64::from(i) / cells);
            let (from, to) = (
                (time - HALF_DIFFERENCE * duration).max(start),
                (time + HALF_DIFFERENCE * duration).min(end),
            );
            (time, (self.before(to) - self.after(from)) / (to - from))
        })
    }
}
