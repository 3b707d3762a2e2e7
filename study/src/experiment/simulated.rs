//! [`SimulatedLock`]: what the arm really does at the lock, beside the impact torque that the paper predicts.

use nalgebra::SVector;

use super::lock::{FINE, Lock, UNSEEN};
use super::{ExperimentError, ExperimentRunner, SearchMethod, list};
use crate::scenario::Experiment;
use crate::simulation::{Brake, Ending, ideal_lock, tool_acceleration};
use ulna::Trajectory;
use ulna::control::compensation::{Compensation, Projector};
use ulna::control::failure::{Failure, LockedJoints};

/// One experiment and one failure time, simulated with brakes that take time.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedLock {
    /// [`Experiment::section`].
    pub section: String,
    /// When the brakes fall, s.
    pub failure_time: f64,
    /// The joints whose brakes fall, counted from 0.
    pub failed_joints: Vec<usize>,
    /// How long the brakes take in [`runs`](Self::runs), s.
    pub brake_time: f64,
    /// From the failure until the controller knows, s.
    pub detection: f64,
    /// The servo's gain, rad/s ([`ServoSettings::gain`](crate::scenario::ServoSettings::gain)).
    pub gain: f64,
    /// The rotors as the joints feel them, kg·m² (kg); one entry for each joint.
    pub reflected_inertia: Vec<f64>,
    /// The projector of the compensations.
    pub projector: Projector,
    /// So long the compensation has acted before the lock, s.
    pub lead: f64,
    /// The mean torque, N·m (N), by which each joint's differs while the brake acts, to first order and if the healthy joints keep their rates:
    /// that of the acceleration `−q̇_k/T` ([`LockImpulse::if_rates_are_kept`](crate::simulation::LockImpulse::if_rates_are_kept)` / T`),
    /// which the predicted step does not contain. At the planned state; after the brake it is gone.
    pub braking_step: Vec<f64>,
    /// Without compensation, with ever shorter brakes.
    pub convergence: Vec<BrakeImpulse>,
    /// Without compensation and with those of three methods.
    pub runs: Vec<SimulatedRun>,
    /// The methods whose compensation moves the arm so violently that the simulation did not come to its end, and how that ended:
    /// they are not among the runs.
    pub unfinished: Vec<(SearchMethod, Ending)>,
}

/// The impulse of brakes that take some time, beside that of the ideal lock.
#[derive(Clone, Debug, PartialEq)]
pub struct BrakeImpulse {
    /// From moving to locked, s.
    pub brake_time: f64,
    /// What the brakes gave, N·m·s (N·s); one entry for each failed joint.
    pub impulse: Vec<f64>,
    /// The ideal lock's; for a single joint k it is `−q̇_k / ((M + R)⁻¹)_kk`, R the rotors.
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
pub struct SimulatedRun {
    /// `None` without compensation.
    pub method: Option<SearchMethod>,
    /// The step of each joint's torque as the paper predicts it, after minus before, N·m (N).
    pub predicted_step: Vec<f64>,
    /// The step of what each joint transmits as it is, from just before the lock to when the brakes have done their work and the controller knows,
    /// as a control cycle at either time makes it ([`Impact::torque_step`](crate::simulation::Impact::torque_step)).
    pub torque_step: Vec<f64>,
    /// The largest torque that each joint transmits from the lock on, N·m (N).
    pub peak_torque: Vec<f64>,
    /// The acceleration that the compensation gives the tool, m/s² (with the rotations' rad/s², if the task has any):
    /// the larger norm of just before and just after the lock, in the planned state ([`tool_acceleration`]).
    pub tool_acceleration: f64,
    /// What the balance of energy does not account for, relative.
    pub energy_error: f64,
    /// s.
    pub time: Vec<f64>,
    /// What each joint transmits, N·m (N): a row for each time.
    pub torque: Vec<Vec<f64>>,
    /// What the paper has it bear: the healthy joints keep to their plan.
    pub predicted_torque: Vec<Vec<f64>>,
}

/// The brake times of [`SimulatedLock::convergence`], s.
const BRAKE_TIMES: [f64; 11] = [
    1.0, 3e-1, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5,
];
/// What is simulated after the brake, s.
const AFTER: f64 = 0.75;

impl<const N: usize> ExperimentRunner<'_, N> {
    /// One experiment with the brakes falling at `failure_time`, the servo and the rotors those of the scenario.
    ///
    /// # Errors
    /// As [`study`](Self::study), and when the simulation without compensation cannot be run to its end.
    pub fn simulated_lock(
        &self,
        experiment: &Experiment,
        failure_time: f64,
    ) -> Result<SimulatedLock, ExperimentError> {
        let operation = self.operation(experiment, failure_time)?;
        let lock = self.lock(failure_time)?;
        let (mut runs, mut unfinished) = (Vec::new(), Vec::new());
        for (method, compensation) in self.compensations(&operation) {
            let run = self.run_simulation(experiment, method, compensation, &lock);
            match (run, method) {
                (Err(ExperimentError::Unfinished { ending, .. }), Some(method)) => {
                    unfinished.push((method, ending));
                }
                (run, _) => runs.push(run?),
            }
        }
        let convergence = BRAKE_TIMES.iter().filter_map(|duration| {
            let brake = Brake {
                duration: *duration,
                ..lock.brake
            };
            // A brake that is not done when the motion ends says nothing about a lock in it.
            let fits = failure_time + duration <= self.motion().duration();
            fits.then(|| self.brake_impulse(experiment, &Lock { brake, ..lock }))
        });
        Ok(SimulatedLock {
            section: experiment.section().to_owned(),
            failure_time,
            failed_joints: lock.brake.failure.joints.iter().collect(),
            brake_time: lock.brake.duration,
            detection: lock.brake.detection,
            gain: lock.gain,
            reflected_inertia: list(&lock.reflected_inertia),
            projector: self.scenario.servo().projector(),
            lead: lock.lead,
            braking_step: list(&self.braking_step(&lock)),
            convergence: convergence.collect::<Result<_, _>>()?,
            runs,
            unfinished,
        })
    }

    fn braking_step(&self, lock: &Lock<N>) -> SVector<f64, N> {
        let Failure { joints, time } = lock.brake.failure;
        let planned = self.motion().state(time);
        let rotors = &lock.reflected_inertia;
        ideal_lock(self.arm, &planned.q, &planned.qd, joints, rotors)
            .map_or_else(SVector::zeros, |impulse| {
                impulse.if_rates_are_kept / lock.brake.duration
            })
    }

    fn run_simulation(
        &self,
        experiment: &Experiment,
        method: Option<SearchMethod>,
        compensation: Compensation<N>,
        lock: &Lock<N>,
    ) -> Result<SimulatedRun, ExperimentError> {
        let failure = lock.brake.failure;
        let start = lock.span().start;
        let end = failure.time + AFTER + lock.settled();
        let mut run = SimulatedRun {
            method,
            predicted_step: Vec::new(),
            torque_step: Vec::new(),
            peak_torque: Vec::new(),
            tool_acceleration: self.moved_tool(experiment, compensation, lock)?,
            energy_error: 0.0,
            time: Vec::new(),
            torque: Vec::new(),
            predicted_torque: Vec::new(),
        };
        let controller = self.controller(experiment, compensation)?;
        let (impact, outcome) = self.simulate(
            experiment,
            compensation,
            lock,
            (start..end, FINE),
            &mut |sample| {
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
            },
        )?;
        run.predicted_step = list(&impact.predicted_step);
        run.torque_step = list(&impact.torque_step);
        run.peak_torque = list(&impact.peak_torque);
        run.energy_error = outcome.balance.energy_error;
        Ok(run)
    }

    /// [`SimulatedRun::tool_acceleration`].
    fn moved_tool(
        &self,
        experiment: &Experiment,
        compensation: Compensation<N>,
        lock: &Lock<N>,
    ) -> Result<f64, ExperimentError> {
        let Failure { joints, time } = lock.brake.failure;
        let (planned, wrench) = (self.motion().state(time), experiment.force().at(time));
        let controller = self.controller(experiment, compensation)?;
        let sides = [LockedJoints::NONE, joints].map(|locked| {
            let added = controller.cycle(&planned, &wrench, locked).compensation;
            let rotors = &lock.reflected_inertia;
            tool_acceleration(self.arm, &planned.q, &added, locked, rotors)
                .map_or(0.0, |acceleration| acceleration.norm())
        });
        Ok(sides[0].max(sides[1]))
    }

    fn brake_impulse(
        &self,
        experiment: &Experiment,
        lock: &Lock<N>,
    ) -> Result<BrakeImpulse, ExperimentError> {
        let joints = lock.brake.failure.joints;
        // From the planned state on, so that the ideal lock is the same for all.
        let span = lock.brake.failure.time..lock.span().end;
        let none = Compensation::none();
        let (impact, outcome) =
            self.simulate(experiment, none, lock, (span, UNSEEN), &mut |_| ())?;
        let difference = impact.brake_impulse - impact.ideal.brake;
        let ideal = impact.ideal.brake;
        let failed = |vector: &SVector<f64, N>| joints.iter().map(|joint| vector[joint]).collect();
        Ok(BrakeImpulse {
            brake_time: lock.brake.duration,
            impulse: failed(&impact.brake_impulse),
            ideal: failed(&ideal),
            relative_difference: if ideal.norm() > 0.0 {
                difference.norm() / ideal.norm()
            } else {
                difference.norm()
            },
            peak_brake_torque: impact.peak_brake_torque.amax(),
            energy_error: outcome.balance.energy_error,
            momentum_error: outcome.balance.momentum_error,
        })
    }
}
