//! A joint's limits, motor and friction.

use super::angle::Angles;
use crate::diagnostics::{Diagnostic, Sink};
use crate::format;
use crate::table::{AngleUnit, FrictionTable, JointTable, LimitsTable, MotorTable};
use crate::toml_reader::{Key, Located};
use ulna::{Friction, JointKind, Limits, Motor};

/// What a joint's row says of its drive. `None` only if something has been reported.
pub(super) fn drive(
    row: &JointTable,
    angles: Option<Angles>,
    sink: &Sink,
) -> Option<(Limits, Motor, Friction)> {
    let limits = match &row.limits {
        Some(table) => limits(table, row.kind, angles, sink),
        None => Some(Limits::NONE),
    };
    let motor = match &row.motor {
        Some(table) => motor(table, sink),
        None => Some(Motor::NONE),
    };
    let friction = match &row.friction {
        Some(table) => friction(table, sink),
        None => Some(Friction::NONE),
    };
    Some((limits?, motor?, friction?))
}

/// Coordinates that are limits may be many turns.
fn limits(
    table: &LimitsTable,
    kind: JointKind,
    angles: Option<Angles>,
    sink: &Sink,
) -> Option<Limits> {
    let none = Limits::NONE;
    let lower = optional(table.lower.as_ref(), &format::LOWER, none.lower, sink);
    let upper = optional(table.upper.as_ref(), &format::UPPER, none.upper, sink);
    let velocity = optional(
        table.velocity.as_ref(),
        &format::VELOCITY,
        none.velocity,
        sink,
    );
    if let (Some(lower), Some(upper), Some(written)) = (lower, upper, &table.upper)
        && lower >= upper
    {
        let message = format!("{} must be above `lower`", written.name);
        sink.push(
            Diagnostic::error(written.span.clone(), message)
                .label(format!("`lower` is {lower:?}"))
                .help("write the smaller number as `lower`, the larger one as `upper`"),
        );
        return None;
    }
    let unit = match kind {
        JointKind::Prismatic => AngleUnit::Radians,
        JointKind::Revolute => angles?.unit,
    };
    let in_si = |value: f64| match unit {
        AngleUnit::Degrees => value.to_radians(),
        AngleUnit::Radians => value,
    };
    Some(Limits {
        lower: in_si(lower?),
        upper: in_si(upper?),
        velocity: in_si(velocity?),
    })
}

fn motor(table: &MotorTable, sink: &Sink) -> Option<Motor> {
    let inertia = table.inertia.as_ref();
    let inertia = inertia.and_then(|inertia| format::ROTOR.admit(inertia, sink));
    let ratio = optional(
        table.ratio.as_ref(),
        &format::RATIO,
        Motor::NONE.ratio,
        sink,
    );
    Some(Motor {
        inertia: inertia?,
        ratio: ratio?,
    })
}

fn friction(table: &FrictionTable, sink: &Sink) -> Option<Friction> {
    let none = Friction::NONE;
    let read =
        |number: &Option<Located<f64>>, key, default| optional(number.as_ref(), key, default, sink);
    let viscous = read(&table.viscous, &format::VISCOUS, none.viscous);
    let coulomb = read(&table.coulomb, &format::COULOMB, none.coulomb);
    let smoothing = read(&table.smoothing, &format::SMOOTHING, none.smoothing);
    Some(Friction {
        viscous: viscous?,
        coulomb: coulomb?,
        smoothing: smoothing?,
    })
}

/// The number, if it is admitted; what counts without it.
fn optional(number: Option<&Located<f64>>, key: &Key, without: f64, sink: &Sink) -> Option<f64> {
    number.map_or(Some(without), |number| key.admit(number, sink))
}
