//! What is no error, but looks as if a number were in another unit, or an axis not meant.

use ulna_table::diagnostics::Diagnostic;

use crate::report::Report;
use crate::robot::{Inertial, LinkElement, Motion};
use crate::tree::Tree;

/// Longer than any link, m; in millimetres, half an inch.
const FAR: f64 = 20.0;
/// Heavier than any link, kg.
const HEAVY: f64 = 1000.0;
/// More than four turns, rad: limits beyond them are rare, and degrees.
const FAR_TURN: f64 = 25.5;
/// A little more than a turn, rad.
const TURN: f64 = 6.3;
/// How far an axis may be from length 1.
const LENGTH_TOLERANCE: f64 = 1e-3;

/// Warns of a joint's origin, axis and limits.
pub(crate) fn joint(tree: &Tree, joint: usize, report: &Report) {
    let element = tree.joint(joint);
    let name = &element.name;
    let distance = element.origin.frame.translation.amax();
    if distance >= FAR {
        let message = format!("the origin of joint `{name}` is {distance} m from its parent's");
        report.push(
            Diagnostic::warning(element.origin.span.clone(), message)
                .help("URDF has metres; these look like millimetres: divide by 1000"),
        );
    }
    if element.origin.rpy.iter().any(|angle| angle.abs() > TURN) {
        let message = format!("the origin of joint `{name}` is turned by more than a full turn");
        report.push(
            Diagnostic::warning(element.origin.span.clone(), message)
                .help("URDF has radians; these look like degrees: write 1.5707963267948966 for 90"),
        );
    }
    if !element.motion.moves() {
        return;
    }
    if (element.axis.length - 1.0).abs() > LENGTH_TOLERANCE {
        let message = format!(
            "the axis of joint `{name}` has the length {:.4}, not 1: only its direction counts",
            element.axis.length
        );
        report.push(
            Diagnostic::warning(element.axis.span.clone(), message)
                .help("some programs take the length as a gear ratio: write a vector of length 1"),
        );
    }
    let Some(limit) = element.limit.as_ref() else {
        return;
    };
    let ends = [&limit.lower, &limit.upper];
    let far = ends
        .into_iter()
        .flatten()
        .find(|end| end.value.abs() > FAR_TURN);
    if let Some(far) = far.filter(|_| element.motion == Motion::Revolute) {
        let message = format!("a limit of joint `{name}` is {} rad", far.value);
        report.push(
            Diagnostic::warning(far.span.clone(), message).help(
                "URDF has radians; this looks like degrees: write 3.141592653589793 for 180, or make the joint continuous",
            ),
        );
    }
}

/// Warns of a link's mass and centroid.
pub(crate) fn body(link: &LinkElement, inertial: &Inertial, report: &Report) {
    let (name, body) = (&link.name, &inertial.body);
    if body.mass > HEAVY {
        let message = format!("the link `{name}` has {} kg", body.mass);
        report.push(
            Diagnostic::warning(inertial.mass_span.clone(), message)
                .help("URDF has kilograms; this looks like grams: divide by 1000"),
        );
    }
    let distance = body.com.amax();
    if distance >= FAR {
        let message = format!("the centroid of link `{name}` is {distance} m from its frame");
        report.push(
            Diagnostic::warning(inertial.span.clone(), message)
                .help("URDF has metres; these look like millimetres: divide by 1000"),
        );
    }
}
