//! [`Rollout`]: a whole motion under the controller, cycle by cycle.

use nalgebra::SVector;

use super::{AnyArm, list};
use crate::scenario::{PlannedMotion, ToolForce};
use ulna::Trajectory;
use ulna::control::compensation::{Controller, Cycle, Status};
use ulna::control::failure::{Failure, LockedJoints};

/// What a rollout was like.
#[derive(Clone, Debug, PartialEq)]
pub struct Rollout {
    /// The worst status of a cycle.
    pub status: Status,
    /// The largest |τ_i| over all cycles, brakes excepted, N·m (N).
    pub max_torque: Vec<f64>,
    /// The largest norm of h (Eq. 13) over all cycles, N (with the moments' N·m, if the task has any).
    pub max_force_error: f64,
    /// Some of the cycles, among them the last before the lock and the first after it.
    pub series: Series,
}

/// Quantities over time: one row for each time, in it one entry for each joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// s. Of the lock there are two rows, one after the other: t_f with all joints moving,
    /// and t_f + Δt (Eq. 18; often t_f again) with the failed ones locked.
    pub time: Vec<f64>,
    /// Torque without compensation, N·m (N).
    pub planned: Vec<Vec<f64>>,
    /// Torque with compensation, N·m (N).
    pub torque: Vec<Vec<f64>>,
    /// What the tool is to exert, `[f; n]`, N and N·m.
    pub force: Vec<[f64; 6]>,
    /// What it exerts beyond that, at rest: h of Eq. 13, N and N·m.
    pub force_error: Vec<[f64; 6]>,
}

impl Rollout {
    /// About so many cycles are kept in the series.
    const SERIES: f64 = 400.0;

    /// Executes `motion` with `failure` in it, one call of `controller` every `cycle` s, the tool exerting `force`.
    /// From t_f for `step_time` s, the Δt of Eq. 18, no torque is asked for.
    pub fn execute<const N: usize>(
        controller: &Controller<'_, AnyArm<N>, N>,
        motion: &PlannedMotion<N>,
        force: &ToolForce,
        failure: &Failure<N>,
        step_time: f64,
        cycle: f64,
    ) -> Self {
        let after = failure.time + step_time;
        let last = (motion.duration() / cycle).floor() as u64;
        let every = ((last as f64 / Self::SERIES) as u64).max(1);
        let mut record = Record::new();
        let mut locked = LockedJoints::NONE;
        for i in 0..=last {
            let time = cycle * i as f64;
            if time >= failure.time && locked.is_empty() {
                // The lock falls between two cycles, or on one: both of its sides are executed.
                for (time, side) in [(failure.time, LockedJoints::NONE), (after, failure.joints)] {
                    locked = side;
                    record.run(controller, motion, force, failure, (time, side), true);
                }
            }
            if !locked.is_empty() && time <= after {
                continue;
            }
            let kept = i % every == 0 || i == last;
            record.run(controller, motion, force, failure, (time, locked), kept);
        }
        Self {
            status: record.status,
            max_torque: list(&record.max_torque),
            max_force_error: record.max_force_error,
            series: record.series,
        }
    }
}

struct Record<const N: usize> {
    status: Status,
    max_torque: SVector<f64, N>,
    max_force_error: f64,
    series: Series,
}

impl<const N: usize> Record<N> {
    fn new() -> Self {
        Self {
            status: Status::Nominal,
            max_torque: SVector::zeros(),
            max_force_error: 0.0,
            series: Series::default(),
        }
    }

    fn run(
        &mut self,
        controller: &Controller<'_, AnyArm<N>, N>,
        motion: &PlannedMotion<N>,
        force: &ToolForce,
        failure: &Failure<N>,
        (time, locked): (f64, LockedJoints<N>),
        kept: bool,
    ) {
        let (state, wrench) = if locked.is_empty() {
            (motion.state(time), force.at(time))
        } else {
            (failure.state(motion, time), force.after_lock(time))
        };
        let cycle: Cycle<N> = controller.cycle(&state, &wrench, locked);
        self.status = self.status.max(cycle.status);
        self.max_torque = self.max_torque.sup(&locked.without(&cycle.torque).abs());
        self.max_force_error = self.max_force_error.max(cycle.force_error.norm());
        if kept {
            self.series.time.push(time);
            self.series.planned.push(list(&cycle.planned));
            self.series.torque.push(list(&cycle.torque));
            self.series.force.push(wrench.into());
            self.series.force_error.push(cycle.force_error.into());
        }
    }
}
