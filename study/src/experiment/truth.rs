//! [`Truth`]: what the arm really does at the lock, beside the impact torque that the paper predicts.

use std::ops::Range;

use nalgebra::SVector;

use super::{AnyArm, ExperimentError, ExperimentRunner, SearchMethod, list, rated_torque};
use crate::scenario::Experiment;
use crate::simulation::{
    Brake, Control, Ending, Feedback, Impact, Outcome, Resolution, Sample, Simulation,
};
use ulna::Trajectory;
use ulna::control::compensation::{Compensation, Controller};
use ulna::control::failure::{Failure, LockedJoints};

/// One experiment and one failure time, simulated with brakes that take time.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// [`Experiment::section`].
    pub section: String,
    /// When the brakes fall, s.
    pub failure_time: f64,
    /// The joints whose brakes fall, counted from 0.
    pub failed_joints: Vec<usize>,
    /// How long the brakes take in [`runs`](Self::runs), s.
    pub brake_time: f64,
    /// Without compensation, with ever shorter brakes.
    pub convergence: Vec<BrakeImpulse>,
    /// Without compensation and with those of three methods.
    pub runs: Vec<TruthRun>,
}

/// The impulse of brakes that take some time, beside that of the ideal lock.
#[derive(Clone, Debug, PartialEq)]
pub struct BrakeImpulse {
    /// From moving to locked, s.
    pub brake_time: f64,
    /// What the brakes gave, N·m·s (N·s); one entry for each failed joint.
    pub impulse: Vec<f64>,
    /// The ideal lock's; for a single joint k it is `−q̇_k / (M⁻¹)_kk`.
    pub ideal: Vec<f64>,
    /// The norm of their difference, relative to the ideal lock's.
    pub relative_difference: f64,
    /// The largest torque of a brake, N·m (N).
    pub peak_brake_torque: f64,
    /// What the balance of energy does not account for, relative.
    pub energy_error: f64,
    /// What the balance of momentum does not account for, relative.
    pub momentum_error: f64,
}

/// A simulated lock.
#[derive(Clone, Debug, PartialEq)]
pub struct TruthRun {
    /// `None` without compensation.
    pub method: Option<SearchMethod>,
    /// The step of each joint's torque as the paper predicts it, after minus before, N·m (N).
    pub predicted_step: Vec<f64>,
    /// The step as it is, from just before the lock to when the brakes have done their work.
    pub torque_step: Vec<f64>,
    /// The largest torque from the lock on, brake and motor together.
    pub peak_torque: Vec<f64>,
    /// What the balance of energy does not account for, relative.
    pub energy_error: f64,
    /// s.
    pub time: Vec<f64>,
    /// What each joint bears, motor and brake, N·m (N): a row for each time.
    pub torque: Vec<Vec<f64>>,
    /// What the paper has it bear: the healthy joints keep to their plan.
    pub predicted_torque: Vec<Vec<f64>>,
}

/// The brake times of [`Truth::convergence`], s.
const BRAKE_TIMES: [f64; 11] = [
    1.0, 3e-1, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5,
];
/// What is simulated around the lock, s.
const BEFORE: f64 = 0.25;
const AFTER: f64 = 0.75;
/// A lock takes some hundred steps; what needs many more gets nowhere.
const RESOLUTION: Resolution = Resolution {
    tolerance: 1e-10,
    sample_period: 0.01,
    steps: 10_000,
};
/// How fast departures from the plan die out, rad/s.
const FEEDBACK: f64 = 5.0;

impl<const N: usize> ExperimentRunner<'_, N> {
    /// One experiment with the brakes falling at `failure_time`.
    ///
    /// # Errors
    /// As [`study`](Self::study), and when a simulation cannot be run to its end.
    pub fn truth(
        &self,
        experiment: &Experiment,
        failure_time: f64,
    ) -> Result<Truth, ExperimentError> {
        let operation = self.operation(experiment, failure_time)?;
        let failure = *operation.failure();
        let brake = Brake {
            profile: self.scenario.brake().profile(),
            ..Brake::new(failure, self.scenario.brake().duration())
        };
        let mut runs = vec![self.run_truth(experiment, None, Compensation::none(), brake)?];
        for method in [
            SearchMethod::PerJoint,
            SearchMethod::Projected,
            SearchMethod::Optimal,
        ] {
            if let Ok(found) = self.search(&operation, method) {
                runs.push(self.run_truth(experiment, Some(method), found.compensation, brake)?);
            }
        }
        let convergence = BRAKE_TIMES.iter().filter_map(|duration| {
            let brake = Brake {
                duration: *duration,
                ..brake
            };
            // A brake that is not done when the motion ends says nothing about a lock in it.
            let fits = failure_time + duration <= self.motion().duration();
            fits.then(|| self.brake_impulse(experiment, brake))
        });
        Ok(Truth {
            section: experiment.section().to_owned(),
            failure_time,
            failed_joints: failure.joints.iter().collect(),
            brake_time: brake.duration,
            convergence: convergence.collect::<Result<_, _>>()?,
            runs,
        })
    }

    fn run_truth(
        &self,
        experiment: &Experiment,
        method: Option<SearchMethod>,
        compensation: Compensation<N>,
        brake: Brake<N>,
    ) -> Result<TruthRun, ExperimentError> {
        let failure = brake.failure;
        let start = (failure.time - BEFORE).max(0.0);
        let end = failure.time + AFTER + brake.duration;
        let mut run = TruthRun {
            method,
            predicted_step: Vec::new(),
            torque_step: Vec::new(),
            peak_torque: Vec::new(),
            energy_error: 0.0,
            time: Vec::new(),
            torque: Vec::new(),
            predicted_torque: Vec::new(),
        };
        let controller = self.controller(experiment, compensation)?;
        let (impact, outcome) =
            self.simulate(experiment, compensation, brake, start..end, &mut |sample| {
                run.time.push(sample.time);
                run.torque.push(list(&sample.joint_torque()));
                let wrench = experiment.force().at(sample.time);
                // At the lock there are two samples: only in the second the brakes act.
                let free =
                    sample.elapsed < 0.0 || (sample.elapsed == 0.0 && sample.brake.amax() == 0.0);
                let locked = if free {
                    LockedJoints::NONE
                } else {
                    failure.joints
                };
                let predicted = controller.cycle(&sample.planned, &wrench, locked);
                run.predicted_torque.push(list(&predicted.torque));
            })?;
        run.predicted_step = list(&impact.predicted_step);
        run.torque_step = list(&impact.torque_step);
        run.peak_torque = list(&impact.peak_torque);
        run.energy_error = outcome.balance.energy_error;
        Ok(run)
    }

    fn brake_impulse(
        &self,
        experiment: &Experiment,
        brake: Brake<N>,
    ) -> Result<BrakeImpulse, ExperimentError> {
        let Failure { joints, time } = brake.failure;
        let mut peak_brake_torque = 0.0_f64;
        // From the planned state on, so that the ideal lock is the same for all.
        let span = time..time + brake.duration * 1.01;
        let (impact, outcome) = self.simulate(
            experiment,
            Compensation::none(),
            brake,
            span,
            &mut |sample| {
                if sample.elapsed <= brake.duration {
                    peak_brake_torque = peak_brake_torque.max(sample.brake.amax());
                }
            },
        )?;
        let difference = impact.brake_impulse - impact.ideal.brake;
        let ideal = impact.ideal.brake;
        let failed = |vector: &SVector<f64, N>| joints.iter().map(|joint| vector[joint]).collect();
        Ok(BrakeImpulse {
            brake_time: brake.duration,
            impulse: failed(&impact.brake_impulse),
            ideal: failed(&ideal),
            relative_difference: if ideal.norm() > 0.0 {
                difference.norm() / ideal.norm()
            } else {
                difference.norm()
            },
            peak_brake_torque,
            energy_error: outcome.balance.energy_error,
            momentum_error: outcome.balance.momentum_error,
        })
    }

    fn controller(
        &self,
        experiment: &Experiment,
        compensation: Compensation<N>,
    ) -> Result<Controller<'_, AnyArm<N>, N>, ExperimentError> {
        let rated = rated_torque(experiment)?;
        Ok(Controller::new(self.arm, compensation).with_rated_torque(rated))
    }

    fn simulate(
        &self,
        experiment: &Experiment,
        compensation: Compensation<N>,
        brake: Brake<N>,
        span: Range<f64>,
        observe: &mut dyn FnMut(&Sample<N>),
    ) -> Result<(Impact<N>, Outcome<N>), ExperimentError> {
        let simulation = Simulation {
            plant: self.arm,
            controller: self.controller(experiment, compensation)?,
            trajectory: self.motion(),
            wrench: |time| experiment.force().at(time),
            feedback: Feedback::critical(FEEDBACK),
            control: Control::Every(self.scenario.cycle()),
            brake,
        };
        let outcome = simulation.run(span, &RESOLUTION, observe)?;
        match (outcome.ending, outcome.impact) {
            (Ending::Complete, Some(impact)) => Ok((impact, outcome)),
            (ending, _) => Err(ExperimentError::Unfinished {
                time: brake.failure.time,
                ending,
            }),
        }
    }
}
