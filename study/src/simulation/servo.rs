//! What holds the joints to the planned motion: the gains of computed torque, and when it acts.

/// The gains of computed torque: `q̈ = q̈_planned + rate (q̇_planned − q̇) + position (q_planned − q)`
/// (Siciliano et al., *Robotics*, 8.5.2, Eq. 8.57).
///
/// Gains of 0 leave the planned motion's torque alone, at the measured state.
/// Feedback takes the motion that a compensation causes for a disturbance, and works against it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Feedback {
    /// 1/s².
    pub position: f64,
    /// 1/s.
    pub rate: f64,
}

impl Feedback {
    /// No feedback.
    pub const NONE: Self = Self {
        position: 0.0,
        rate: 0.0,
    };

    /// Departures die out with critical damping at `frequency`, rad/s.
    pub fn critical(frequency: f64) -> Self {
        Self {
            position: frequency * frequency,
            rate: 2.0 * frequency,
        }
    }
}

/// When a controller acts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Control {
    /// At all times: the limit of ever shorter control cycles.
    ///
    /// A cycle whose torque jumps with the state, as it does where the arm goes in and out of
    /// [`Status::Overloaded`](ulna::Status::Overloaded), may have no motion in this limit; the run then ends with [`Ending::StepTooShort`](super::Ending::StepTooShort).
    #[default]
    Continuous,
    /// Every so many s, one cycle at the failure itself; in between the motors hold their torques.
    Every(f64),
}
