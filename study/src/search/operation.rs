//! [`Operation`]: a planned motion with a failure in it, at every sample time, and what a compensation does to it.

use nalgebra::{SVector, Vector6};

use super::convex::ROUNDING;
use super::{Field, OperationOptions, Scope, SearchError, WorseJoint, worse_joints};
use ulna::Arm;
use ulna::control::compensation::{Compensation, FreeTorque, Law, Limits, TaskPose};
use ulna::control::failure::{Failure, LockedJoints};
use ulna::control::trajectory::Trajectory;

/// One time of an operation.
#[derive(Clone, Copy, Debug)]
pub struct OperatingPoint<const N: usize> {
    /// When, s.
    pub time: f64,
    /// The joints that are locked by then.
    pub locked: LockedJoints<N>,
    /// `ID + Jᵀ F_e` of the motion with the locked joints at rest, N·m (N).
    pub planned: SVector<f64, N>,
    /// What a compensation is made of there.
    pub pose: TaskPose<N>,
}

impl<const N: usize> OperatingPoint<N> {
    /// U of a free torque here, `P z + Jᵀ f`, N·m (N), with the projector of the pose.
    pub fn compensation(&self, free: &FreeTorque<N>) -> SVector<f64, N> {
        self.pose.project(&free.torque) + self.pose.static_torque(&free.wrench)
    }
}

/// A planned motion under a tool wrench, with joints that lock on the way: the whole of what a search looks at.
#[derive(Clone, Debug)]
pub struct Operation<const N: usize> {
    failure: Failure<N>,
    rated_torque: SVector<f64, N>,
    effort: f64,
    /// In time order: healthy up to t_f, locked from t_f + Δt on.
    samples: Vec<OperatingPoint<N>>,
    /// The index of the first sample after the lock.
    lock: usize,
}

/// What a compensation does to an operation, all cuts at rated torques included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assessment<const N: usize> {
    /// Δτ̃ of Eq. 18, after minus before, N·m (N). A locked joint's step goes into its brake.
    pub impact: SVector<f64, N>,
    /// The norm of the impact over the joints that are not locked, N·m.
    pub healthy_impact: f64,
    /// h of Eq. 13 just before the lock, N and N·m.
    pub force_error_before: Vector6<f64>,
    /// h of Eq. 13 just after it.
    pub force_error_after: Vector6<f64>,
    /// The largest norm of h over the whole operation.
    pub max_force_error: f64,
    /// The largest |τ_i| over the whole operation, brakes excepted, N·m (N).
    pub peak_torque: SVector<f64, N>,
    /// The largest |U_i| over the whole operation, N·m (N).
    pub peak_compensation: SVector<f64, N>,
    /// The least `τ_rated − |τ_i|` over the whole operation, brakes excepted, N·m (N); infinite without limits.
    pub least_margin: f64,
    /// The largest |dU_i/dt| between two samples, the lock's own step excepted, N·m/s (N/s).
    pub fastest_change: f64,
}

impl<const N: usize> Assessment<N> {
    /// The larger norm of h just before and just after the lock.
    pub fn force_error(&self) -> f64 {
        self.force_error_before
            .norm()
            .max(self.force_error_after.norm())
    }
}

impl<const N: usize> Operation<N> {
    /// Looks at the motion of `arm` along `trajectory`, whose tool is to exert `wrench(t)` (`[f; n]`, world axes), after the lock
    /// less [`wrench_step`](OperationOptions::wrench_step), with `failure` in it.
    /// The healthy joints keep to their plan.
    pub fn new(
        arm: &(impl Arm<N> + ?Sized),
        trajectory: &impl Trajectory<N>,
        wrench: impl Fn(f64) -> Vector6<f64>,
        failure: &Failure<N>,
        options: &OperationOptions<N>,
    ) -> Result<Self, SearchError> {
        Self::sampled(arm, trajectory, &wrench, failure, options)
    }

    /// [`new`](Self::new), the wrench behind a pointer, so that it is compiled once whatever it is.
    fn sampled(
        arm: &(impl Arm<N> + ?Sized),
        trajectory: &impl Trajectory<N>,
        wrench: &dyn Fn(f64) -> Vector6<f64>,
        failure: &Failure<N>,
        options: &OperationOptions<N>,
    ) -> Result<Self, SearchError> {
        let (duration, after) = (trajectory.duration(), failure.time + options.step_time);
        let samples = duration / options.sample_period;
        if !(samples > 0.0 && samples <= 1e6) {
            return Err(SearchError::Argument {
                name: "sample period",
                range: "above 0 s and at least a millionth of the motion",
                value: options.sample_period,
            });
        }
        if !(options.step_time >= 0.0 && options.step_time.is_finite()) {
            return Err(SearchError::Argument {
                name: "step time",
                range: "a time of at least 0 s",
                value: options.step_time,
            });
        }
        if !(options.effort >= 0.0 && options.effort.is_finite()) {
            return Err(SearchError::Argument {
                name: "weight of effort",
                range: "a finite number of at least 0",
                value: options.effort,
            });
        }
        if !(failure.time >= 0.0 && after <= duration) {
            return Err(SearchError::FailureTime {
                time: failure.time,
                duration,
            });
        }
        let sample = |time: f64, locked: LockedJoints<N>| {
            let (state, wrench) = if locked.is_empty() {
                (trajectory.state(time), wrench(time))
            } else {
                let wrench = wrench(time) - options.wrench_step;
                (failure.state(trajectory, time), wrench)
            };
            let pose = options.field.pose(arm, &state.q, locked, options.projector);
            let planned = arm.inverse_dynamics(&state.q, &state.qd, &state.qdd)
                + pose.jacobian.tr_mul(&wrench);
            if !planned.iter().all(|torque| torque.is_finite()) {
                return Err(SearchError::NotFinite { time });
            }
            Ok(OperatingPoint {
                time,
                locked,
                planned,
                pose,
            })
        };
        // Poses are large: each is moved once.
        let healthy = times(0.0, failure.time, options.sample_period);
        let locked = times(after, duration, options.sample_period);
        let mut samples = Vec::with_capacity(healthy.len() + locked.len());
        for time in healthy {
            samples.push(sample(time, LockedJoints::NONE)?);
        }
        let lock = samples.len();
        for time in locked {
            samples.push(sample(time, failure.joints)?);
        }
        Ok(Self {
            failure: *failure,
            rated_torque: options.rated_torque.map(|rated| rated.max(0.0)),
            effort: options.effort,
            samples,
            lock,
        })
    }

    /// The same operation with other rated torques, N·m (N). One that is negative or no number counts as 0.
    #[must_use]
    pub fn with_rated_torque(mut self, rated_torque: SVector<f64, N>) -> Self {
        self.rated_torque = rated_torque.map(|rated| rated.max(0.0));
        self
    }

    /// The same operation with another field, of the arm and the motion that it was made of.
    #[must_use]
    pub fn with_field(
        &self,
        arm: &(impl Arm<N> + ?Sized),
        trajectory: &impl Trajectory<N>,
        field: Field,
    ) -> Self {
        let mut operation = self.clone();
        for sample in &mut operation.samples {
            sample.pose = self.pose_along(sample, arm, trajectory, field);
        }
        operation
    }

    /// What `compensation` does along another field: [`with_field`](Self::with_field) assessed, without keeping it.
    pub fn assess_along(
        &self,
        arm: &(impl Arm<N> + ?Sized),
        trajectory: &impl Trajectory<N>,
        field: Field,
        compensation: &Compensation<N>,
    ) -> Assessment<N> {
        self.assess_torque(compensation.law(), |sample| {
            let pose = self.pose_along(sample, arm, trajectory, field);
            pose.compensation(compensation)
        })
    }

    fn pose_along(
        &self,
        sample: &OperatingPoint<N>,
        arm: &(impl Arm<N> + ?Sized),
        trajectory: &impl Trajectory<N>,
        field: Field,
    ) -> TaskPose<N> {
        let state = if sample.locked.is_empty() {
            trajectory.state(sample.time)
        } else {
            self.failure.state(trajectory, sample.time)
        };
        let mut pose = sample.pose;
        pose.gradient = sample.locked.without(&field.at(arm, &state.q));
        pose
    }

    /// The operation at the lock alone, [`before`](Self::before) and [`after`](Self::after): all that an impact depends on.
    ///
    /// What it says of the rest of the motion, as margins and largest force errors, is of the lock too.
    #[must_use]
    pub fn at_lock(&self) -> Self {
        Self {
            samples: vec![*self.before(), *self.after()],
            lock: 1,
            ..*self
        }
    }

    /// The failure.
    pub fn failure(&self) -> &Failure<N> {
        &self.failure
    }

    /// The rated torques, N·m (N).
    pub fn rated_torque(&self) -> &SVector<f64, N> {
        &self.rated_torque
    }

    /// e of [`OperationOptions::effort`].
    pub fn effort(&self) -> f64 {
        self.effort
    }

    /// Every sample, in time order.
    pub fn samples(&self) -> &[OperatingPoint<N>] {
        &self.samples
    }

    /// The index of the first sample after the lock.
    pub(super) fn lock(&self) -> usize {
        self.lock
    }

    /// t_f, all joints still moving.
    pub fn before(&self) -> &OperatingPoint<N> {
        &self.samples[self.lock - 1]
    }

    /// t_f + Δt, the failed joints locked.
    pub fn after(&self) -> &OperatingPoint<N> {
        &self.samples[self.lock]
    }

    /// The torque step without compensation, after minus before, N·m (N): −Δτ of the impact torque (Eq. 12) with `ΔF_e`,
    /// plus what the locked arm's plan and its wrench change in Δt.
    pub fn step(&self) -> SVector<f64, N> {
        self.after().planned - self.before().planned
    }

    /// The joints that the failure leaves, counted from 0.
    pub fn healthy(&self) -> impl Iterator<Item = usize> {
        self.failure.joints.healthy()
    }

    /// The healthy joints that are worse off with a compensation of this assessment than without any.
    pub fn worse_joints(&self, assessment: &Assessment<N>) -> Vec<WorseJoint> {
        let locked: Vec<usize> = self.failure.joints.iter().collect();
        let (step, impact) = (self.step(), assessment.impact);
        worse_joints(step.as_slice(), impact.as_slice(), &locked)
    }

    /// The joint of `scope` with the largest |Δτ̃_i| / |step_i|, counted from 0, and that ratio; `None` if no joint has a step without compensation.
    pub fn worst_joint(&self, assessment: &Assessment<N>, scope: Scope) -> Option<(usize, f64)> {
        let step = self.step();
        let planned = [self.before(), self.after()].map(|sample| sample.planned.amax());
        let rounding = ROUNDING * planned[0].max(planned[1]);
        let joints = (0..N).filter(|joint| {
            let counts = scope == Scope::All || !self.failure.joints.contains(*joint);
            counts && step[*joint].abs() > rounding
        });
        let ratios = joints.map(|joint| (joint, (assessment.impact[joint] / step[joint]).abs()));
        ratios.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The ratio of [`worst_joint`](Self::worst_joint); 0 if there is none.
    pub fn worst_ratio(&self, assessment: &Assessment<N>, scope: Scope) -> f64 {
        self.worst_joint(assessment, scope)
            .map_or(0.0, |(_, ratio)| ratio)
    }

    /// What `compensation` does to the operation, cut at rated torques as a control cycle cuts it.
    pub fn assess(&self, compensation: &Compensation<N>) -> Assessment<N> {
        self.assess_torque(compensation.law(), |sample| {
            sample.pose.compensation(compensation)
        })
    }

    /// What the compensation `wanted` does at each sample, N·m (N), cut as a control cycle cuts that of `law`.
    pub fn assess_torque(
        &self,
        law: Law,
        wanted: impl Fn(&OperatingPoint<N>) -> SVector<f64, N>,
    ) -> Assessment<N> {
        self.assess_wanted(law, &wanted)
    }

    /// [`assess_torque`](Self::assess_torque), what is wanted behind a pointer, so that it is compiled once whatever it is.
    fn assess_wanted(
        &self,
        law: Law,
        wanted: &dyn Fn(&OperatingPoint<N>) -> SVector<f64, N>,
    ) -> Assessment<N> {
        let mut least_margin = f64::INFINITY;
        let mut fastest_change = 0.0_f64;
        let mut last: Option<(&OperatingPoint<N>, SVector<f64, N>)> = None;
        let mut torques = Vec::with_capacity(self.samples.len());
        let mut max_force_error = 0.0_f64;
        let mut peak_torque = SVector::<f64, N>::zeros();
        let mut peak_compensation = SVector::<f64, N>::zeros();
        for sample in &self.samples {
            let limits = Limits {
                rated_torque: self.rated_torque,
                locked: sample.locked,
            };
            let (torque, _) = limits.cut(&sample.planned, &wanted(sample), law);
            let acting = torque - sample.planned;
            for joint in sample.locked.healthy() {
                least_margin = least_margin.min(self.rated_torque[joint] - torque[joint].abs());
            }
            // The lock itself is no change in time.
            if let Some((last, before)) = last
                && last.locked == sample.locked
                && sample.time > last.time
            {
                let change = (acting - before).amax() / (sample.time - last.time);
                fastest_change = fastest_change.max(change);
            }
            last = Some((sample, acting));
            let force_error = sample.pose.null_space.static_wrench(&acting).norm();
            max_force_error = max_force_error.max(force_error);
            peak_torque = peak_torque.sup(&sample.locked.without(&torque).abs());
            peak_compensation = peak_compensation.sup(&acting.abs());
            torques.push(torque);
        }
        let (before, after) = (torques[self.lock - 1], torques[self.lock]);
        let impact = after - before;
        let force_error = |sample: &OperatingPoint<N>, torque: SVector<f64, N>| {
            sample
                .pose
                .null_space
                .static_wrench(&(torque - sample.planned))
        };
        Assessment {
            impact,
            healthy_impact: self.failure.joints.without(&impact).norm(),
            force_error_before: force_error(self.before(), before),
            force_error_after: force_error(self.after(), after),
            max_force_error,
            peak_torque,
            peak_compensation,
            least_margin,
            fastest_change,
        }
    }
}

/// From `start` to `end`, both included, at most `period` apart.
fn times(start: f64, end: f64, period: f64) -> impl ExactSizeIterator<Item = f64> {
    let steps = ((end - start) / period).ceil() as usize;
    (0..steps + 1).map(move |i| {
        if i == steps {
            end
        } else {
            start + (end - start) * i as f64 / steps as f64
        }
    })
}
