//! [`GroundTruth`]: what the structure feels of the same failures when the lock is simulated as it is.

use nalgebra::{SVector, Vector6};

use super::grid::FailureGrid;
use super::law::{AssessedLaw, Law, Tactic};
use super::summary::median;
use crate::experiment::{COARSE, ExperimentError, Sweep, for_each_joint};
use crate::scenario::ServoSettings;
use crate::search::{Field, ForcePriority, Operation, optimal};
use crate::simulation::{Brake, Control, Ending, Feedback, Simulation};
use ulna::Trajectory;
use ulna::control::compensation::{Compensation, Controller, FreeTorque};

/// All laws at one gain of the servo, over some of the failures of single joints.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundTruth {
    /// The servo's gain, rad/s.
    pub gain: f64,
    /// One for each law.
    pub laws: Vec<FeltLaw>,
}

/// The torque step that the healthy joints really transmit under a law, relative to that without compensation.
#[derive(Clone, Debug, PartialEq)]
pub struct FeltLaw {
    /// Which.
    pub law: Law,
    /// How far it may bend the static tool force, N, if it has a budget.
    pub force_budget: Option<f64>,
    /// How many simulations came to their end.
    pub count: usize,
    /// How many did not: the compensation flings the arm off.
    pub unfinished: usize,
    /// The median ratio.
    pub median_ratio: f64,
    /// The largest.
    pub worst_ratio: f64,
    /// The share of failures with a larger step than without the law.
    pub share_worse: f64,
}

impl GroundTruth {
    /// At so many of the failure times at most.
    const TIMES: usize = 7;

    /// Of what [`FailureGrid::felt`] has for each failure: the first law is none.
    pub fn new<const N: usize>(
        laws: &[AssessedLaw<N>],
        gain: f64,
        felt: &[Vec<Option<f64>>],
    ) -> Self {
        let of = |index: usize| {
            let mut ratios = Vec::new();
            let mut unfinished = 0;
            for steps in felt {
                let before = steps.first().copied().flatten();
                match (before, steps.get(index).copied().flatten()) {
                    (Some(before), Some(after)) if before > 0.0 => ratios.push(after / before),
                    (Some(_), None) => unfinished += 1,
                    _ => {}
                }
            }
            (ratios, unfinished)
        };
        let laws = laws.iter().enumerate().map(|(index, law)| {
            let (mut ratios, unfinished) = of(index);
            ratios.sort_by(f64::total_cmp);
            let worse = ratios.iter().filter(|ratio| **ratio > 1.0 + 1e-6).count();
            FeltLaw {
                law: law.law,
                force_budget: law.force_budget,
                count: ratios.len(),
                unfinished,
                median_ratio: median(&ratios),
                worst_ratio: ratios.last().copied().unwrap_or(1.0),
                share_worse: worse as f64 / ratios.len().max(1) as f64,
            }
        });
        Self {
            gain,
            laws: laws.collect(),
        }
    }
}

impl<const N: usize> FailureGrid<'_, N> {
    /// The gains that locks are simulated with, rad/s: those of [`Sweep`] that are stable with the scenario's cycle.
    pub fn gains(&self) -> Vec<f64> {
        let cycle = self.scenario().cycle();
        let gains = Sweep::GAINS.into_iter();
        gains
            .filter(|gain| ServoSettings::is_stable(*gain, cycle))
            .collect()
    }

    /// The failures that are simulated: of single joints that move, at a few times.
    pub fn simulated(&self) -> Vec<usize> {
        let count = self.times().len();
        let every = count.div_ceil(GroundTruth::TIMES).max(1);
        let singles = self.locks().iter().filter(|lock| lock.len() == 1).count();
        let failures = (0..singles).flat_map(|lock| {
            let times = (every / 2..count).step_by(every);
            times.map(move |time| lock * count + time)
        });
        failures.filter(|failure| self.moves(*failure)).collect()
    }

    /// Whether any of the joints of a failure moves when they lock.
    fn moves(&self, failure: usize) -> bool {
        let (joints, time) = self.failure(failure);
        let rates = self.motion().state(time).qd;
        joints.iter().any(|joint| rates[joint].abs() > 1e-9)
    }

    /// The norm of the step that the healthy joints transmit at a failure under each of `laws`, N·m (N), simulated with the scenario's
    /// brakes and rotors and a servo of `gain`, rad/s; `None` where a simulation does not come to its end.
    ///
    /// # Errors
    /// When the motion under the tool force cannot be looked at.
    pub fn felt(
        &self,
        laws: &[AssessedLaw<N>],
        failure: usize,
        gain: f64,
    ) -> Result<Vec<Option<f64>>, ExperimentError> {
        let (joints, time) = self.failure(failure);
        let operation = self.operation(joints, time, Field::DynamicManipulability)?;
        let felt = laws.iter().map(|law| {
            let Some(compensation) = self.around(law, &operation, self.place(failure)) else {
                return Ok(None);
            };
            self.simulate(&operation, compensation, gain)
        });
        felt.collect()
    }

    /// What a law does around a lock, its parameters held as they are then.
    fn around(
        &self,
        law: &AssessedLaw<N>,
        operation: &Operation<N>,
        place: (usize, usize),
    ) -> Option<Compensation<N>> {
        match &law.tactic {
            Tactic::Constant(compensation) => Some(*compensation),
            Tactic::Kinematic(compensation) => {
                let field = Field::KinematicManipulability;
                let lock = operation.at_lock();
                let kinematic = lock.with_field(self.arm(), self.motion(), field);
                let [before, after] = [kinematic.before(), kinematic.after()].map(|point| {
                    let u = point.pose.compensation(compensation);
                    // All of U: what P leaves of it, and what it does to the tool force.
                    FreeTorque {
                        torque: u,
                        wrench: point.pose.null_space.static_wrench(&u),
                    }
                });
                Some(Compensation::Optimal { before, after })
            }
            Tactic::Planned(plan) => Some(Compensation::Optimal {
                before: plan.at(operation.failure().time),
                after: plan.recourse(operation, place),
            }),
            Tactic::Known => optimal(operation, ForcePriority::Exact)
                .ok()
                .map(|found| found.compensation),
        }
    }

    fn simulate(
        &self,
        operation: &Operation<N>,
        compensation: Compensation<N>,
        gain: f64,
    ) -> Result<Option<f64>, ExperimentError> {
        let (brake, servo) = (self.scenario().brake(), self.scenario().servo());
        let failure = *operation.failure();
        let rotors = self.scenario().motors().reflected_inertia();
        let force = |time| self.experiment().force().at(time);
        // Behind a pointer, so that runs are compiled once.
        let wrench: &dyn Fn(f64) -> Vector6<f64> = &force;
        let simulation = Simulation {
            plant: self.arm(),
            controller: Controller::new(self.arm(), compensation)
                .with_rated_torque(*self.rated_torque())
                .with_projector(servo.projector()),
            trajectory: self.motion(),
            wrench,
            feedback: Feedback::critical(gain),
            control: Control::Every(self.scenario().cycle()),
            brake: Brake {
                profile: brake.profile(),
                detection: servo.detection(),
                ..Brake::new(failure, brake.duration())
            },
            reflected_inertia: for_each_joint(&rotors)?,
        };
        let settled = brake.duration().max(servo.detection());
        let start = (failure.time - servo.lead()).max(0.0);
        let outcome = simulation.run(start..failure.time + 1.01 * settled, &COARSE, |_| ())?;
        Ok(match (outcome.ending, outcome.impact) {
            (Ending::Complete, Some(impact)) => {
                let step: SVector<f64, N> = failure.joints.without(&impact.torque_step);
                Some(step.norm()).filter(|step| step.is_finite())
            }
            _ => None,
        })
    }
}
