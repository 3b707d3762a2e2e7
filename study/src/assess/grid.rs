//! [`FailureGrid`]: every lock at every failure time, and the laws that meet them.

use std::fmt;

use nalgebra::SVector;

use super::case::AssessedCase;
use super::law::{AssessedLaw, Law, Plan, Tactic, Tuning};
use crate::experiment::{AnyArm, ExperimentError, KNOT_PERIOD, rated_torque_of};
use crate::scenario::{Experiment, PlannedMotion, Scenario};
use crate::search::{
    CoefficientLaw, Field, ForcePriority, Moment, Objective, Operation, OperationOptions,
    RobustObjective, RobustOptions, SearchError, best_constant, cancel_per_joint, least_impact,
    optimal, robust,
};
use ulna::Trajectory;
use ulna::control::compensation::{self, Compensation, FreeTorque, OnLine, Projector, TaskPose};
use ulna::control::failure::{Failure, LockedJoints};

/// The motion of a scenario's first experiment, with every joint (and every pair) locking at every failure time.
#[derive(Clone)]
pub struct FailureGrid<'a, const N: usize> {
    arm: &'a AnyArm<N>,
    scenario: &'a Scenario,
    experiment: &'a Experiment,
    motion: PlannedMotion<N>,
    rated_torque: SVector<f64, N>,
    /// Single joints first.
    locks: Vec<LockedJoints<N>>,
    times: Vec<f64>,
}

impl<const N: usize> fmt::Debug for FailureGrid<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FailureGrid")
            .field("scenario", self.scenario)
            .finish_non_exhaustive()
    }
}

impl<'a, const N: usize> FailureGrid<'a, N> {
    /// The largest time between two samples of a motion, s, where the grid is coarser.
    const SAMPLE_PERIOD: f64 = 0.125;
    /// What the mean ratio counts beside the worst for [`Law::Robust`]: a hundredth leaves the worst what it is, to three digits.
    const MEAN: f64 = 0.01;
    /// Steps below this part of the largest of the grid need not become less for [`Law::Robust`].
    const NO_STEP: f64 = 1e-6;

    /// The grid of `scenario`, as its `[assess]` says.
    ///
    /// # Errors
    /// When `arm` is not the scenario's, or cannot execute its motion.
    pub fn new(arm: &'a AnyArm<N>, scenario: &'a Scenario) -> Result<Self, ExperimentError> {
        let settings = scenario.assess();
        let motion = scenario.motion().plan(arm, KNOT_PERIOD)?;
        let experiment = scenario
            .experiments()
            .first()
            .ok_or(ExperimentError::NoExperiment)?;
        let rated = match settings.rated_torque() {
            Some(rated) => rated,
            None => experiment.rated_torque(),
        };
        let count = settings.failure_times();
        let spacing = scenario.motion().duration() / (count + 1) as f64;
        let singles = (0..N).filter_map(|joint| LockedJoints::new(&[joint]));
        let mut locks: Vec<_> = singles.collect();
        // Something must be left to move.
        if settings.locks_at_once() > 1 && N > 2 {
            let pairs = (0..N).flat_map(|a| (a + 1..N).map(move |b| [a, b]));
            locks.extend(pairs.filter_map(|pair| LockedJoints::new(&pair)));
        }
        Ok(Self {
            arm,
            scenario,
            experiment,
            motion,
            rated_torque: rated_torque_of(rated)?,
            locks,
            times: (1..=count).map(|i| spacing * i as f64).collect(),
        })
    }

    /// The failure times, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Which joints lock: each by itself, then the pairs.
    pub fn locks(&self) -> &[LockedJoints<N>] {
        &self.locks
    }

    /// What locks in failure number `failure`, and when, s: times change fastest.
    pub fn failure(&self, failure: usize) -> (LockedJoints<N>, f64) {
        let (lock, time) = self.place(failure);
        (self.locks[lock], self.times[time])
    }

    /// The lock and the time of failure number `failure`.
    pub(super) fn place(&self, failure: usize) -> (usize, usize) {
        (failure / self.times.len(), failure % self.times.len())
    }

    pub(super) fn arm(&self) -> &'a AnyArm<N> {
        self.arm
    }

    pub(super) fn scenario(&self) -> &'a Scenario {
        self.scenario
    }

    pub(super) fn experiment(&self) -> &'a Experiment {
        self.experiment
    }

    pub(super) fn motion(&self) -> &PlannedMotion<N> {
        &self.motion
    }

    /// How many failures there are.
    pub fn len(&self) -> usize {
        self.times.len() * self.locks.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The torque limits that are kept, N·m (N); infinite where there is none.
    pub fn rated_torque(&self) -> &SVector<f64, N> {
        &self.rated_torque
    }

    /// The lock that laws with coefficients are tuned for: the scenario's joints, at the one of its times that is nearest to the middle
    /// of the motion.
    pub fn tuning(&self) -> Tuning {
        let middle = 0.5 * self.scenario.motion().duration();
        let times = self.scenario.failure_times().iter().copied();
        let nearest = times.min_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs()));
        Tuning {
            joints: self.scenario.failed_joints().to_vec(),
            time: nearest.unwrap_or(middle),
        }
    }

    /// The motion with `joints` locking at `time`, sampled as the grid's failures are.
    ///
    /// # Errors
    /// When a torque is no finite number.
    pub fn operation(
        &self,
        joints: LockedJoints<N>,
        time: f64,
        field: Field,
    ) -> Result<Operation<N>, SearchError> {
        self.sampled(joints, time, field, self.sample_period())
    }

    /// The laws that the scenario chooses, tuned and planned.
    ///
    /// A law that the rated torques leave no place for is left out; [`AssessedLaw::note`] of the others says how their searches ended.
    ///
    /// # Errors
    /// When the motion under the tool force cannot be looked at.
    pub fn laws(&self) -> Result<Vec<AssessedLaw<N>>, ExperimentError> {
        let plain = |law, tactic| AssessedLaw {
            law,
            tuned: None,
            force_budget: None,
            tactic,
            note: String::new(),
        };
        let chosen = self.scenario.assess().laws();
        let mut laws = vec![plain(Law::None, Tactic::Constant(Compensation::none()))];
        laws.extend(self.tuned()?);
        // All locks at all times, if a law is made for them.
        let planned = [Law::ConstantPerJoint, Law::ConstantProjected, Law::Robust];
        let moments = if planned.iter().any(|law| chosen.contains(*law)) {
            self.moments()?
        } else {
            Vec::new()
        };
        for (law, coefficients) in [
            (Law::ConstantPerJoint, CoefficientLaw::PerJoint),
            (Law::ConstantProjected, CoefficientLaw::Projected),
        ] {
            if chosen.contains(law)
                && let Ok(best) = best_constant(&moments, coefficients)
            {
                let tactic = Tactic::Constant(coefficients.with(best.coefficients));
                laws.push(AssessedLaw {
                    note: format!("gap {:.1e} N m, {:.2} s", best.gap, best.seconds),
                    ..plain(law, tactic)
                });
            }
        }
        for (law, plan) in [
            (Law::AfterOnly, Plan::nothing(self.scenario.assess().ramp())),
            (Law::OnLine, self.on_line()),
        ] {
            // The budget is the recourse's.
            let budgets = self.scenario.assess().force_budgets().iter();
            laws.extend(budgets.map(|budget| AssessedLaw {
                force_budget: Some(*budget),
                ..plain(
                    law,
                    Tactic::Planned(Plan {
                        force_budget: *budget,
                        ..plan.clone()
                    }),
                )
            }));
        }
        if chosen.contains(Law::Robust) {
            laws.extend(self.robust(&moments, &plain));
        }
        laws.push(plain(Law::Limit, Tactic::Known));
        laws.retain(|law| chosen.contains(law.law));
        Ok(laws)
    }

    /// What each of `laws` makes of a failure; `None` where the limits leave a law nothing.
    ///
    /// # Errors
    /// When the motion under the tool force cannot be looked at.
    pub fn cases(
        &self,
        laws: &[AssessedLaw<N>],
        failure: usize,
    ) -> Result<Vec<Option<AssessedCase>>, ExperimentError> {
        let (joints, time) = self.failure(failure);
        let operation = self.operation(joints, time, Field::DynamicManipulability)?;
        let cases = laws.iter().map(|law| {
            Ok(match &law.tactic {
                Tactic::Constant(compensation) => {
                    let assessment = operation.assess(compensation);
                    Some(AssessedCase::new(&operation, &assessment))
                }
                Tactic::Kinematic(compensation) => {
                    let field = Field::KinematicManipulability;
                    let assessment =
                        operation.assess_along(self.arm, &self.motion, field, compensation);
                    Some(AssessedCase::new(&operation, &assessment))
                }
                Tactic::Planned(plan) => Some(planned(&operation, plan, self.place(failure))),
                Tactic::Known => optimal(&operation, ForcePriority::Exact)
                    .ok()
                    .map(|found| AssessedCase::new(&operation, &found.assessment)),
            })
        });
        cases.collect()
    }

    /// Every lock at every time, for what is planned for all of them.
    fn moments(&self) -> Result<Vec<Moment<N>>, SearchError> {
        let moment = |time: &f64| {
            let mut before = None;
            let mut after = Vec::with_capacity(N);
            for joints in &self.locks {
                let coarse = self.scenario.motion().duration();
                let operation =
                    self.sampled(*joints, *time, Field::DynamicManipulability, coarse)?;
                before = Some(*operation.before());
                after.push(*operation.after());
            }
            Ok(before.map(|before| Moment { before, after }))
        };
        let moments = self.times.iter().map(moment);
        let moments: Result<Vec<_>, SearchError> = moments.collect();
        Ok(moments?.into_iter().flatten().collect())
    }

    /// The laws with coefficients for one lock.
    fn tuned(&self) -> Result<Vec<AssessedLaw<N>>, ExperimentError> {
        let tuning = self.tuning();
        let Some(joints) = LockedJoints::new(&tuning.joints) else {
            return Ok(Vec::new());
        };
        let operation = self.operation(joints, tuning.time, Field::DynamicManipulability)?;
        let kinematic = self.operation(joints, tuning.time, Field::KinematicManipulability)?;
        let found = [
            (Law::PerJoint, cancel_per_joint(&operation)),
            (
                Law::Projected,
                least_impact(&operation, Objective::LeastSquares),
            ),
            (Law::Kinematic, cancel_per_joint(&kinematic)),
        ];
        let laws = found.into_iter().filter_map(|(law, found)| {
            let found = found.ok()?;
            Some(AssessedLaw {
                law,
                tuned: Some(tuning.clone()),
                force_budget: None,
                tactic: match law {
                    Law::Kinematic => Tactic::Kinematic(found.compensation),
                    _ => Tactic::Constant(found.compensation),
                },
                note: String::new(),
            })
        });
        Ok(laws.collect())
    }

    /// What the on-line law does along the motion, as long as nothing has locked.
    fn on_line(&self) -> Plan<N> {
        let law = OnLine::equal();
        let period = self.sample_period();
        let count = (self.scenario.motion().duration() / period).round() as u32;
        let none = LockedJoints::NONE;
        let samples = (0..=count).map(|i| {
            let state = self.motion.state(period * f64::from(i));
            let pose = TaskPose::new(self.arm, &state.q, none, Projector::Static);
            FreeTorque {
                torque: law.compensation(self.arm, &state, &pose, none),
                ..FreeTorque::none()
            }
        });
        Plan {
            period,
            samples: samples.collect(),
            recourses: Vec::new(),
            force_budget: law.force_budget,
            ramp: self.scenario.assess().ramp(),
        }
    }

    /// One law for each force budget, side by side.
    fn robust(
        &self,
        moments: &[Moment<N>],
        plain: &dyn Fn(Law, Tactic<N>) -> AssessedLaw<N>,
    ) -> Vec<AssessedLaw<N>> {
        let settings = self.scenario.assess();
        let options = self.robust_options(moments);
        let options = settings.force_budgets().iter().map(|budget| RobustOptions {
            force_budget: *budget,
            ..options.clone()
        });
        let options: Vec<_> = options.collect();
        let found: Vec<_> = std::thread::scope(|scope| {
            let solve = |options| scope.spawn(move || robust(moments, options));
            let threads: Vec<_> = options.iter().map(solve).collect();
            threads
                .into_iter()
                .map(std::thread::ScopedJoinHandle::join)
                .collect()
        });
        let found = options.iter().zip(found);
        let laws = found.filter_map(|(options, found)| {
            let found = found.ok()?.ok()?;
            let note = format!(
                "{}, {} variables, {} iterations, gap {:.1e} of {:.4}, {:.2} s",
                found.status.words(),
                found.variables,
                found.iterations,
                found.gap,
                found.objective,
                found.seconds
            );
            let samples = found.samples.iter().map(|sample| sample.before);
            let plan = Plan {
                period: self.spacing(),
                samples: std::iter::once(FreeTorque::none()).chain(samples).collect(),
                recourses: found
                    .samples
                    .iter()
                    .map(|sample| sample.after.clone())
                    .collect(),
                force_budget: options.force_budget,
                ramp: settings.ramp(),
            };
            Some(AssessedLaw {
                force_budget: Some(options.force_budget),
                note,
                ..plain(Law::Robust, Tactic::Planned(plan))
            })
        });
        laws.collect()
    }

    /// All but the budget.
    fn robust_options(&self, moments: &[Moment<N>]) -> RobustOptions<N> {
        let steps = moments.iter().flat_map(|moment| {
            let step = |after| moment.step(after).norm();
            moment.after.iter().map(step)
        });
        let largest = steps.fold(0.0, f64::max);
        RobustOptions {
            objective: RobustObjective::WorstRatio {
                floor: (Self::NO_STEP * largest).max(f64::MIN_POSITIVE),
            },
            rate: SVector::repeat(self.scenario.assess().rate_limit()),
            start: Some(0.0),
            rated_torque: self.rated_torque,
            mean: Self::MEAN,
            ..RobustOptions::default()
        }
    }

    fn spacing(&self) -> f64 {
        self.scenario.motion().duration() / (self.times.len() + 1) as f64
    }

    /// A whole part of the grid's spacing, so that plans are looked at where they were made.
    fn sample_period(&self) -> f64 {
        let spacing = self.spacing();
        spacing / (spacing / Self::SAMPLE_PERIOD).ceil().max(1.0)
    }

    fn sampled(
        &self,
        joints: LockedJoints<N>,
        time: f64,
        field: Field,
        sample_period: f64,
    ) -> Result<Operation<N>, SearchError> {
        let options = OperationOptions {
            sample_period,
            step_time: self.experiment.step_time(),
            wrench_step: self.experiment.force().lock_step,
            rated_torque: self.rated_torque,
            field,
            ..OperationOptions::default()
        };
        let force = |time| self.experiment.force().at(time);
        let failure = Failure { joints, time };
        Operation::new(self.arm, &self.motion, force, &failure, &options)
    }
}

/// A plan until the lock; then what brings the healthy torques nearest to what they were, fading out.
fn planned<const N: usize>(
    operation: &Operation<N>,
    plan: &Plan<N>,
    place: (usize, usize),
) -> AssessedCase {
    let recourse = plan.recourse(operation, place);
    let assessment = operation.assess_torque(compensation::Law::Optimal, |point| {
        if point.locked.is_empty() {
            plan.before(point)
        } else {
            point.compensation(&recourse) * plan.fade(point.time - operation.failure().time)
        }
    });
    AssessedCase::new(operation, &assessment)
}
