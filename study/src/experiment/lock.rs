//! [`Lock`]: a simulated lock, as the scenario has it or with another servo and other rotors.

use std::ops::Range;

use nalgebra::{SVector, Vector6};

use super::{
    AnyArm, ExperimentError, ExperimentRunner, SearchMethod, for_each_joint, rated_torque,
};
use crate::scenario::Experiment;
use crate::search::Operation;
use crate::simulation::{
    Brake, Control, Ending, Feedback, Impact, Outcome, Resolution, Sample, Simulation,
};
use ulna::control::compensation::{Compensation, Controller};

/// The methods that a simulated lock is tried with, besides none.
pub(super) const METHODS: [SearchMethod; 3] = [
    SearchMethod::PerJoint,
    SearchMethod::Projected,
    SearchMethod::Optimal,
];
/// Where series and balances are looked at.
pub(super) const FINE: Resolution = Resolution {
    tolerance: 1e-10,
    sample_period: 0.01,
    samples_at_least: 16,
    steps: STEPS,
};
/// Where nobody looks at samples: neither steps nor peaks nor balances need them.
pub(super) const UNSEEN: Resolution = Resolution {
    sample_period: 10.0,
    samples_at_least: 1,
    ..FINE
};
/// Where six digits of steps and peaks are all that counts.
pub(crate) const COARSE: Resolution = Resolution {
    tolerance: 1e-8,
    ..UNSEEN
};
/// A lock takes some hundred steps and a few for each control cycle; what needs many more gets nowhere.
const STEPS: u32 = 4_000;
/// See [`STEPS`].
const STEPS_PER_CYCLE: f64 = 8.0;

/// A lock to simulate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lock<const N: usize> {
    pub(super) brake: Brake<N>,
    /// What is simulated before the failure, s.
    pub(super) lead: f64,
    /// [`ServoSettings::gain`](crate::scenario::ServoSettings::gain), rad/s.
    pub(super) gain: f64,
    /// [`Simulation::reflected_inertia`].
    pub(super) reflected_inertia: SVector<f64, N>,
}

impl<const N: usize> Lock<N> {
    /// From the failure until the joints stand and the controller knows, s.
    pub(super) fn settled(&self) -> f64 {
        self.brake.duration.max(self.brake.detection)
    }

    /// From before the failure until just after what has settled.
    pub(super) fn span(&self) -> Range<f64> {
        let time = self.brake.failure.time;
        (time - self.lead)..time + self.settled() * 1.01
    }
}

impl<const N: usize> ExperimentRunner<'_, N> {
    /// The lock as the scenario has it.
    pub(super) fn lock(&self, failure_time: f64) -> Result<Lock<N>, ExperimentError> {
        let (brake, servo) = (self.scenario.brake(), self.scenario.servo());
        let rotors = self.scenario.motors().reflected_inertia();
        Ok(Lock {
            brake: Brake {
                profile: brake.profile(),
                detection: servo.detection(),
                ..Brake::new(self.failure(failure_time), brake.duration())
            },
            // The motion begins at 0.
            lead: servo.lead().min(failure_time),
            gain: servo.gain(),
            reflected_inertia: for_each_joint(&rotors)?,
        })
    }

    /// No compensation, and those of [`METHODS`] that there are.
    pub(super) fn compensations(
        &self,
        operation: &Operation<N>,
    ) -> Vec<(Option<SearchMethod>, Compensation<N>)> {
        let found = METHODS.into_iter().filter_map(|method| {
            let found = self.search(operation, method).ok()?;
            Some((Some(method), found.compensation))
        });
        std::iter::once((None, Compensation::none()))
            .chain(found)
            .collect()
    }

    pub(super) fn controller(
        &self,
        experiment: &Experiment,
        compensation: Compensation<N>,
    ) -> Result<Controller<'_, AnyArm<N>, N>, ExperimentError> {
        let rated = rated_torque(experiment)?;
        let controller = Controller::new(self.arm, compensation).with_rated_torque(rated);
        Ok(controller.with_projector(self.scenario.servo().projector()))
    }

    pub(super) fn simulate(
        &self,
        experiment: &Experiment,
        compensation: Compensation<N>,
        lock: &Lock<N>,
        (span, resolution): (Range<f64>, Resolution),
        observe: &mut dyn FnMut(&Sample<N>),
    ) -> Result<(Impact<N>, Outcome<N>), ExperimentError> {
        let force = |time| experiment.force().at(time);
        // Behind a pointer, so that runs are compiled once.
        let wrench: &dyn Fn(f64) -> Vector6<f64> = &force;
        let simulation = Simulation {
            plant: self.arm,
            controller: self.controller(experiment, compensation)?,
            trajectory: self.motion(),
            wrench,
            feedback: Feedback::critical(lock.gain),
            control: Control::Every(self.scenario.cycle()),
            brake: lock.brake,
            reflected_inertia: lock.reflected_inertia,
        };
        let cycles = (span.end - span.start) / self.scenario.cycle();
        let resolution = Resolution {
            steps: STEPS + (STEPS_PER_CYCLE * cycles) as u32,
            ..resolution
        };
        let outcome = simulation.run(span, &resolution, observe)?;
        match (outcome.ending, outcome.impact) {
            (Ending::Complete, Some(impact)) => Ok((impact, outcome)),
            (ending, _) => Err(ExperimentError::Unfinished {
                time: lock.brake.failure.time,
                ending,
            }),
        }
    }
}
