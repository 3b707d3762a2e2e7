//! What drives the joints: the servo and the motors of a scenario.

use ulna::control::compensation::Projector;

/// How the controller follows the plan, what it knows, and the projector of its compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoSettings {
    pub(super) gain: f64,
    pub(super) detection: f64,
    pub(super) lead: f64,
    pub(super) projector: Projector,
}

impl ServoSettings {
    /// How fast departures from the plan die out, critically damped, rad/s, where the lock is simulated; 0 is no feedback
    /// ([`Feedback::critical`](crate::simulation::Feedback::critical)).
    pub fn gain(&self) -> f64 {
        self.gain
    }

    /// From the failure until the controller knows of it, s, where the lock is simulated
    /// ([`Brake::detection`](crate::simulation::Brake::detection)).
    pub fn detection(&self) -> f64 {
        self.detection
    }

    /// How long before the failure its simulation begins, s, in the planned state: so long the compensation acts, and moves the arm.
    pub fn lead(&self) -> f64 {
        self.lead
    }

    /// The projector P of every law, in searches and controllers alike.
    pub fn projector(&self) -> Projector {
        self.projector
    }

    /// Whether the loop is stable by itself when the motors hold their torques for `cycle` s.
    ///
    /// Under computed torque every joint is a double integrator with gains ω² and 2ω. Sampled with a hold of T its characteristic
    /// polynomial is `z² + (ω²T²/2 + 2ωT − 2) z + ω²T²/2 − 2ωT + 1`, and Jury's conditions come to ωT < 1.
    pub fn is_stable(gain: f64, cycle: f64) -> bool {
        gain * cycle < 1.0
    }
}

/// The motors behind their gears. Lists have one entry for each joint.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorSettings {
    pub(super) rotor_inertia: Vec<f64>,
    pub(super) ratio: Vec<f64>,
}

impl MotorSettings {
    /// The inertia of each rotor about its axis, kg·m².
    pub fn rotor_inertia(&self) -> &[f64] {
        &self.rotor_inertia
    }

    /// How far each rotor turns for its joint: the gear's ratio (rad/m if prismatic).
    pub fn ratio(&self) -> &[f64] {
        &self.ratio
    }

    /// The rotors as the joints feel them, `inertia · ratio²`, kg·m² (kg if prismatic).
    pub fn reflected_inertia(&self) -> Vec<f64> {
        let rotors = self.rotor_inertia.iter().zip(&self.ratio);
        rotors
            .map(|(inertia, ratio)| inertia * ratio * ratio)
            .collect()
    }
}
