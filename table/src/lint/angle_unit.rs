//! Angles and limits that look like the other unit.
//!
//! A rounded quarter turn in a table of degrees is told by [`Angles`](crate::model), where it is read.

use std::f64::consts::{PI, TAU};

use super::subject::Subject;
use crate::diagnostics::Diagnostic;
use crate::table::AngleUnit;
use crate::toml_reader::Located;
use ulna::{Joint, JointKind};

const IN_RADIANS: &str = "if angles are in rad, write `angle_unit = \"rad\"`";
const IN_DEGREES: &str = "if angles are in deg, write `angle_unit = \"deg\"`";
/// A limit of position, rad: three turns either way are more than cables allow, and 20 degrees less than any joint needs.
const FARTHEST: f64 = 20.0;

pub(super) fn find(arm: &Subject<'_>) -> Vec<Diagnostic> {
    let found = match arm.places.angle_unit.1 {
        Some(AngleUnit::Degrees) => fractions_of_pi(arm).or_else(|| narrow_limits(arm)),
        Some(AngleUnit::Radians) => wide_limits(arm),
        None => None,
    };
    found.into_iter().collect()
}

/// In degrees: no angle beyond a turn in radians, and one that is a fraction of pi.
fn fractions_of_pi(arm: &Subject<'_>) -> Option<Diagnostic> {
    let mut angles = arm.places.angles.iter().filter(|angle| angle.value != 0.0);
    if !angles.clone().all(|angle| angle.value.abs() <= TAU + 1e-3) {
        return None;
    }
    let fraction = angles.find(|angle| is_fraction_of_pi(angle.value))?;
    let message = format!(
        "no angle is beyond 6.3 degrees, and {} is a fraction of pi",
        fraction.name
    );
    let degrees = fraction.value.to_degrees();
    let label = format!("{degrees:.1} degrees if in radians");
    Some(
        Diagnostic::warning(fraction.span.clone(), message)
            .label(label)
            .help(IN_RADIANS),
    )
}

/// Whether a number is a multiple of pi / 12 to three decimals. One of pi / 2 must be so to all digits: a rounded one is told where it is read.
fn is_fraction_of_pi(value: f64) -> bool {
    let twelfths = (value * 12.0 / PI).round();
    let off = (value - twelfths * PI / 12.0).abs();
    let rounding = if twelfths % 6.0 == 0.0 { 1e-15 } else { 5.1e-4 };
    twelfths != 0.0 && off <= rounding
}

/// In degrees: two limits or more, and none beyond a turn in radians.
fn narrow_limits(arm: &Subject<'_>) -> Option<Diagnostic> {
    let limits: Vec<_> = limits(arm).filter(|limit| limit.value != 0.0).collect();
    let (first, others) = limits.split_first()?;
    if others.is_empty() || limits.iter().any(|limit| limit.value.abs() > TAU + 1e-3) {
        return None;
    }
    let message = "no joint's limit is beyond 6.3 degrees";
    let degrees = first.value.to_degrees();
    let label = format!("{degrees:.1} degrees if in radians");
    Some(
        Diagnostic::warning(first.span.clone(), message)
            .label(label)
            .help(IN_RADIANS),
    )
}

/// In radians: a limit beyond three turns.
fn wide_limits(arm: &Subject<'_>) -> Option<Diagnostic> {
    let limit = limits(arm).find(|limit| limit.value.abs() > FARTHEST)?;
    let message = format!(
        "{} is {:.0} turns away",
        limit.name,
        limit.value.abs() / TAU
    );
    let warning = Diagnostic::warning(limit.span.clone(), message);
    Some(warning.label("in radians").help(IN_DEGREES))
}

/// Every limit of a joint that turns.
fn limits<'s>(arm: &'s Subject<'_>) -> impl Iterator<Item = &'s Located<f64>> {
    let turns = |joint: &Joint| joint.kind == JointKind::Revolute;
    let joints = arm.model.joints().iter().zip(&arm.places.joints);
    let turning = joints.filter(move |(joint, _)| turns(joint));
    turning.flat_map(|(_, places)| &places.limits)
}
