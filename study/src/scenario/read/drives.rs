//! `[servo]` and `[motors]`; all their keys are optional.

use super::{Number, Numbers, number};
use crate::scenario::format::{motors, servo};
use ulna_table::toml_reader::{Fields, Located, Value};

/// `[servo]`
#[derive(Default)]
pub(in crate::scenario) struct ServoTable {
    pub(in crate::scenario) gain: Number,
    pub(in crate::scenario) detection: Number,
    pub(in crate::scenario) lead: Number,
    pub(in crate::scenario) projector: Option<ProjectorWord>,
}

/// `projector`
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::scenario) enum ProjectorWord {
    Static,
    DynamicallyConsistent,
}

/// `[motors]`
#[derive(Default)]
pub(in crate::scenario) struct MotorsTable {
    pub(in crate::scenario) rotor_inertia: Option<CommonOrEach>,
    pub(in crate::scenario) ratio: Option<CommonOrEach>,
}

/// A number for all joints, or one for each.
pub(in crate::scenario) enum CommonOrEach {
    Common(Located<f64>),
    Each(Located<Numbers>),
}

pub(super) fn read_servo(fields: &mut Fields<'_>) -> ServoTable {
    ServoTable {
        gain: number(fields.value(&servo::GAIN)),
        detection: number(fields.value(&servo::DETECTION)),
        lead: number(fields.value(&servo::LEAD)),
        projector: fields
            .value(&servo::PROJECTOR)
            .and_then(Value::choice)
            .map(|projector| projector.value),
    }
}

pub(super) fn read_motors(fields: &mut Fields<'_>) -> MotorsTable {
    MotorsTable {
        rotor_inertia: fields
            .value(&motors::ROTOR_INERTIA)
            .and_then(common_or_each),
        ratio: fields.value(&motors::RATIO).and_then(common_or_each),
    }
}

fn common_or_each(value: Value<'_>) -> Option<CommonOrEach> {
    if value.is_array() {
        value.list_of_numbers().map(CommonOrEach::Each)
    } else {
        value.number().map(CommonOrEach::Common)
    }
}
