//! Gravity that is missing, points up, or is of another unit.

use nalgebra::Vector3;

use super::short;
use super::subject::Subject;
use crate::diagnostics::Diagnostic;

/// From the Moon's with a margin (1.62, Titan's 1.35) to Jupiter's (24.8), m/s^2.
const USUAL: std::ops::RangeInclusive<f64> = 1.3..=26.0;

pub(super) fn missing(arm: &Subject<'_>) -> Vec<Diagnostic> {
    if arm.places.gravity.is_some() {
        return Vec::new();
    }
    let help =
        "write `gravity = [0.0, 0.0, -9.81]`, or `gravity = [0.0, 0.0, 0.0]` for an arm in space";
    let message = "no gravity is given: it is zero, and no joint holds anything";
    let warning = Diagnostic::warning(arm.places.start.clone(), message);
    vec![warning.label("`gravity` is missing here").help(help)]
}

pub(super) fn upward(arm: &Subject<'_>) -> Vec<Diagnostic> {
    let gravity = Vector3::from(arm.model.gravity());
    let up = arm.model.base().isometry().rotation * Vector3::z();
    // A base that is turned over may stand in a world whose z points down.
    let upward = gravity.z > 0.8 * gravity.norm() && up.z > 0.5;
    let Some(place) = arm.places.gravity.as_ref().filter(|_| upward) else {
        return Vec::new();
    };
    let help = "write how things fall, `gravity = [0.0, 0.0, -9.81]`; an arm that hangs has its base turned over, by `rpy` below `[base]`";
    let warning = Diagnostic::warning(place.clone(), "gravity points up, along the world's +z");
    let label = format!("things would rise with {} m/s^2", short(gravity.norm()));
    vec![warning.label(label).help(help)]
}

pub(super) fn odd(arm: &Subject<'_>) -> Vec<Diagnostic> {
    let size = Vector3::from(arm.model.gravity()).norm();
    let odd = size != 0.0 && !USUAL.contains(&size);
    let Some(place) = arm.places.gravity.as_ref().filter(|_| odd) else {
        return Vec::new();
    };
    let help = match size {
        0.9..=1.1 => {
            "gravity is in m/s^2, not in g: write for example `gravity = [0.0, 0.0, -9.81]`"
        }
        32.0..=32.3 => {
            "gravity is in m/s^2, not in ft/s^2: write for example `gravity = [0.0, 0.0, -9.81]`"
        }
        _ => "gravity is in m/s^2: write for example `gravity = [0.0, 0.0, -9.81]`",
    };
    let message = format!("gravity of {} m/s^2 is that of no planet", short(size));
    let warning = Diagnostic::warning(place.clone(), message);
    vec![
        warning
            .label("the Moon has 1.62, the Earth 9.81, Jupiter 24.8")
            .help(help),
    ]
}
