//! What a joint of the chain says of its limits, its effort and its friction.

use ulna::{Friction, Limits};
use ulna_table::RATED_TORQUE;
use ulna_table::diagnostics::Diagnostic;

use crate::note::NoteKind;
use crate::report::Report;
use crate::robot::{JointElement, LimitElement, Motion, Number};

/// A joint's limits, rated torque and friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drive {
    pub(crate) limits: Limits,
    pub(crate) rated_torque: Option<f64>,
    pub(crate) friction: Friction,
}

/// Beyond it a limit of a coordinate or a rate is a way of writing that there is none; no table holds it.
const NO_LIMIT: f64 = 1e5;
/// The least speed that is one.
const LEAST_SPEED: f64 = 1e-6;

/// The joint's drive. `None` if something has been reported.
pub(crate) fn drive(joint: &JointElement, report: &mut Report) -> Option<Drive> {
    let friction = Friction {
        viscous: value(joint.damping.as_ref()),
        coulomb: value(joint.friction.as_ref()),
        ..Friction::NONE
    };
    let Some(limit) = &joint.limit else {
        if joint.motion != Motion::Continuous {
            let message = format!(
                "joint `{}` has no <limit>: its limits and its effort are unknown",
                joint.name
            );
            report.note_at(&joint.span, NoteKind::LeftOut, message);
        }
        return Some(Drive {
            limits: Limits::NONE,
            rated_torque: None,
            friction,
        });
    };
    let (lower, upper) = positions(joint, limit, report)?;
    Some(Drive {
        limits: Limits {
            lower,
            upper,
            velocity: velocity(joint, limit, report),
        },
        rated_torque: rated_torque(joint, limit, report),
        friction,
    })
}

fn value(number: Option<&Number>) -> f64 {
    number.map_or(0.0, |number| number.value)
}

/// The least and the largest coordinate. What is not written is 0.
fn positions(
    joint: &JointElement,
    limit: &LimitElement,
    report: &mut Report,
) -> Option<(f64, f64)> {
    let none = (Limits::NONE.lower, Limits::NONE.upper);
    let (lower, upper) = (value(limit.lower.as_ref()), value(limit.upper.as_ref()));
    let name = &joint.name;
    if joint.motion == Motion::Continuous {
        if lower != 0.0 || upper != 0.0 {
            let message = format!(
                "joint `{name}` is continuous: its limits {lower} and {upper} do not count"
            );
            report.note_at(&limit.span, NoteKind::LeftOut, message);
        }
        return Some(none);
    }
    if lower > upper {
        let place = limit.upper.as_ref().or(limit.lower.as_ref());
        let span = place.map_or(&limit.span, |number| &number.span);
        report.push(
            Diagnostic::error(
                span.clone(),
                format!("the limits of joint `{name}` are {lower} to {upper}"),
            )
            .label("`upper` must be above `lower`")
            .help("write the smaller number as `lower`, the larger one as `upper`; what is left out is 0"),
        );
        return None;
    }
    if lower == upper {
        report.push(
            Diagnostic::warning(
                limit.span.clone(),
                format!("joint `{name}` cannot move: `lower` and `upper` are both {lower}"),
            )
            .help("its limits are left out; a joint that is to stay where it is should be fixed in the URDF"),
        );
        return Some(none);
    }
    let kept = |number: f64, without: f64| {
        if number.abs() > NO_LIMIT {
            without
        } else {
            number
        }
    };
    Some((kept(lower, none.0), kept(upper, none.1)))
}

fn velocity(joint: &JointElement, limit: &LimitElement, report: &mut Report) -> f64 {
    let Some(number) = &limit.velocity else {
        return Limits::NONE.velocity;
    };
    if (LEAST_SPEED..=NO_LIMIT).contains(&number.value) {
        return number.value;
    }
    left_out(joint, "velocity", number, report);
    Limits::NONE.velocity
}

fn rated_torque(joint: &JointElement, limit: &LimitElement, report: &mut Report) -> Option<f64> {
    let number = limit.effort.as_ref()?;
    if RATED_TORQUE.range.contains(&number.value) {
        return Some(number.value);
    }
    left_out(joint, "effort", number, report);
    None
}

fn left_out(joint: &JointElement, what: &str, number: &Number, report: &mut Report) {
    let means = if number.value == 0.0 {
        "mostly stands for one that is unknown"
    } else {
        "is none that a joint has"
    };
    let message = format!(
        "the {what} of joint `{}` is left out: {} {means}",
        joint.name, number.value
    );
    report.note_at(&number.span, NoteKind::LeftOut, message);
}
