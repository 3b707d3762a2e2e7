//! What a simulated lock depends on besides the arm, as text: servo, rotors, brake.

use ulna_study::Scenario;
use ulna_study::experiment::{Rotors, SimulatedLock, Sweep};

/// Servo, rotors and brake of a simulated lock.
pub(crate) struct Setting {
    gain: f64,
    rotors: Rotors,
    brake_time: f64,
    detection: f64,
    lead: f64,
}

/// Rotors, brake and lead of a scenario, such as "no rotors, brake 0.1 s, compensation for 0.25 s before".
pub(crate) fn besides_servo(scenario: &Scenario) -> String {
    format!(
        "{}, brake {} s, compensation for {} s before",
        titled_rotors(&Rotors::of(&scenario.motors().reflected_inertia())),
        scenario.brake().duration(),
        scenario.servo().lead()
    )
}

impl Setting {
    pub(crate) fn of(simulated: &SimulatedLock) -> Self {
        Self {
            gain: simulated.gain,
            rotors: Rotors::of(&simulated.reflected_inertia),
            brake_time: simulated.brake_time,
            detection: simulated.detection,
            lead: simulated.lead,
        }
    }

    /// The scenario's own, of a sweep.
    pub(crate) fn own(sweep: &Sweep) -> Self {
        Self {
            gain: sweep.own_gain,
            rotors: sweep.own_rotors.clone(),
            brake_time: sweep.brake_time,
            detection: sweep.detection,
            lead: sweep.lead,
        }
    }

    /// Such as "servo of 5 rad/s, no rotors".
    pub(crate) fn drives(&self) -> String {
        format!("{}, {}", self.servo(), with_rotors(&self.rotors))
    }

    /// The same without the rotors' numbers, where the joints have different ones.
    pub(crate) fn drives_shortly(&self) -> String {
        format!("{}, {}", self.servo(), titled_rotors(&self.rotors))
    }

    fn servo(&self) -> String {
        if self.gain == 0.0 {
            "no feedback".to_owned()
        } else {
            format!("servo of {} rad/s", self.gain)
        }
    }

    /// Such as "servo of 5 rad/s, no rotors, brake 0.1 s".
    pub(crate) fn with_brake(&self) -> String {
        format!("{}, brake {} s", self.drives(), self.brake_time)
    }

    /// The same as a sentence's part, with what the controller knows and how long its compensation has acted.
    pub(crate) fn in_words(&self) -> String {
        let known = if self.detection == 0.0 {
            "known to the controller at once".to_owned()
        } else {
            format!("known to the controller after {} s", self.detection)
        };
        let article = if self.gain == 0.0 { "" } else { "a " };
        format!(
            "{article}{}, a brake that takes {} s, {known}, and a compensation that has acted for {} s",
            self.drives(),
            self.brake_time,
            self.lead
        )
    }
}

/// Such as "rotors of 1e5 kg·m²", as the joints feel them.
pub(crate) fn with_rotors(rotors: &Rotors) -> String {
    match rotors {
        Rotors::Common(0.0) => "no rotors".to_owned(),
        rotors => format!("rotors of {} kg·m²", inertia(rotors)),
    }
}

/// The same for a title, which has no room for a list.
pub(crate) fn titled_rotors(rotors: &Rotors) -> String {
    match rotors {
        Rotors::Own(_) => "own rotors".to_owned(),
        rotors => with_rotors(rotors),
    }
}

/// The inertia alone, kg·m² (kg); for different ones a list.
pub(crate) fn inertia(rotors: &Rotors) -> String {
    match rotors {
        Rotors::Common(inertia) => number(*inertia),
        Rotors::Own(own) => own
            .iter()
            .map(|inertia| number(*inertia))
            .collect::<Vec<_>>()
            .join(", "),
    }
}

/// A short name for a column or a tick.
pub(crate) fn short(rotors: &Rotors) -> String {
    match rotors {
        Rotors::Common(inertia) => number(*inertia),
        Rotors::Own(_) => "own".to_owned(),
    }
}

/// Without superfluous digits; a very small or a large one by its power of ten.
fn number(value: f64) -> String {
    if value == 0.0 || (1e-2..1e4).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// The same text in ASCII, for a console.
pub(crate) fn ascii(text: &str) -> String {
    text.replace("kg·m²", "kg m^2")
}
