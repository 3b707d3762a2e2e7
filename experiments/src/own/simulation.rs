//! [`Simulated`]: what an arm really does while joints are braked and locked.

use nalgebra::{SVector, Vector6};
use ulna::Status;
use ulna_study::experiment::{AnyArm, ExperimentError};
use ulna_study::simulation::{
    Brake, BrakeProfile, Control, Ending, Feedback, Impact, Outcome, Resolution, Sample, Simulation,
};

use super::control::controller;
use super::plan::planned;
use crate::lists::{list, vector_or};
use crate::{Law, Locking, Plan, StateList};

/// How the controller follows the plan, and how joints are stopped.
#[derive(Clone, Debug, PartialEq)]
pub struct Servo {
    /// How fast departures from the plan die out, critically damped, rad/s; 0 is no feedback.
    pub gain: f64,
    /// The control cycle, s; `None` for a controller that acts at all times.
    pub cycle: Option<f64>,
    /// From moving to locked, s.
    pub brake_time: f64,
    /// How the rate falls in that time.
    pub brake_profile: BrakeProfile,
    /// From the lock until the controller knows, s.
    pub detection: f64,
    /// Rotors as the joints feel them, kg·m² (kg), where the arm's table does not have them; `None` for none.
    pub reflected_inertia: Option<Vec<f64>>,
}

/// What is simulated, and how finely.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// Where it begins, in the planned state, s.
    pub start: f64,
    /// Where it ends, s.
    pub end: f64,
    /// Tolerance, samples and the most steps.
    pub resolution: Resolution,
}

/// An arm at one time of a run: [`Sample`], whatever the number of joints.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedSample {
    /// s.
    pub time: f64,
    /// How the arm moves.
    pub state: StateList,
    /// How the paper assumes that it moves: as planned, but the locked joints at rest.
    pub planned: StateList,
    /// The motors' torques, N·m (N).
    pub motor: Vec<f64>,
    /// The brakes', N·m (N).
    pub brake: Vec<f64>,
    /// What each joint transmits to the structure, N·m (N).
    pub joint_torque: Vec<f64>,
}

/// What a lock did: [`Impact`], whatever the number of joints.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedImpact {
    /// The brakes' impulses, N·m·s (N·s).
    pub brake_impulse: Vec<f64>,
    /// Those of a lock in no time.
    pub ideal_brake_impulse: Vec<f64>,
    /// The step of what each joint transmits, after minus before, N·m (N).
    pub torque_step: Vec<f64>,
    /// The same as the paper predicts it (Eq. 18).
    pub predicted_step: Vec<f64>,
    /// The largest torques that the joints transmit from the lock on, N·m (N).
    pub peak_torque: Vec<f64>,
}

/// A simulated motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulated {
    /// In order of time; where something jumps there are two, before and after.
    pub samples: Vec<SimulatedSample>,
    /// How the run ended; all the rest is about the time until then.
    pub ending: Ending,
    /// What the lock did; `None` if there was none, or if the run did not come to where its effects are known.
    pub impact: Option<SimulatedImpact>,
    /// What the balance of energy does not account for, relative.
    pub energy_error: f64,
    /// What the balance of momentum does not account for, relative.
    pub momentum_error: f64,
    /// The controller's worst status.
    pub status: Status,
    /// Steps of the integration.
    pub steps: u32,
}

impl<const N: usize> From<&Sample<N>> for SimulatedSample {
    fn from(sample: &Sample<N>) -> Self {
        Self {
            time: sample.time,
            state: StateList::of(&sample.state),
            planned: StateList::of(&sample.planned),
            motor: list(&sample.motor),
            brake: list(&sample.brake),
            joint_torque: list(&sample.joint_torque()),
        }
    }
}

impl<const N: usize> From<&Impact<N>> for SimulatedImpact {
    fn from(impact: &Impact<N>) -> Self {
        Self {
            brake_impulse: list(&impact.brake_impulse),
            ideal_brake_impulse: list(&impact.ideal.brake),
            torque_step: list(&impact.torque_step),
            predicted_step: list(&impact.predicted_step),
            peak_torque: list(&impact.peak_torque),
        }
    }
}

pub(crate) fn simulate<const N: usize>(
    arm: &AnyArm<N>,
    plan: &dyn Plan,
    locking: &Locking,
    law: &Law,
    servo: &Servo,
    span: &Span,
) -> Result<Simulated, ExperimentError> {
    let force = |time| locking.force.at(time);
    let wrench: &dyn Fn(f64) -> Vector6<f64> = &force;
    let no_limit = [f64::INFINITY; N];
    let rated = locking.rated_torque.as_deref().unwrap_or(&no_limit);
    let simulation = Simulation {
        plant: arm,
        controller: controller(arm, law, Some(rated), locking.projector)?,
        trajectory: planned::<N>(plan)?,
        wrench,
        feedback: Feedback::critical(servo.gain),
        control: servo.cycle.map_or(Control::Continuous, Control::Every),
        brake: Brake {
            failure: locking.failure()?,
            duration: servo.brake_time,
            profile: servo.brake_profile,
            detection: servo.detection,
        },
        reflected_inertia: vector_or(servo.reflected_inertia.as_deref(), SVector::zeros())?,
    };
    let mut samples = Vec::new();
    let Outcome {
        ending,
        impact,
        balance,
        status,
        steps,
    } = simulation.run(span.start..span.end, &span.resolution, |sample| {
        samples.push(SimulatedSample::from(sample));
    })?;
    Ok(Simulated {
        samples,
        ending,
        impact: impact.as_ref().map(SimulatedImpact::from),
        energy_error: balance.energy_error,
        momentum_error: balance.momentum_error,
        status,
        steps,
    })
}
