//! `[motion]`.

use super::{List, Number, list, number};
use crate::scenario::format::motion as format;
use ulna_table::toml_reader::{Fields, Value};

/// `[motion]`
pub(in crate::scenario) struct MotionTable {
    pub(in crate::scenario) angles: Option<Angles>,
    pub(in crate::scenario) start: List,
    pub(in crate::scenario) path: Option<PathTable>,
    pub(in crate::scenario) duration: Number,
    pub(in crate::scenario) blend: Number,
    pub(in crate::scenario) profile: Option<ProfileWord>,
    pub(in crate::scenario) jerk_time: Number,
    pub(in crate::scenario) max_velocity: List,
    pub(in crate::scenario) max_acceleration: List,
    pub(in crate::scenario) max_jerk: List,
}

/// What the numbers of a position are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::scenario) enum Angles {
    /// The quantity that moves in the joint's DH row: θ + q, or d + q.
    Dh,
    /// q itself.
    Q,
}

/// How the speed rises in a blend.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub(in crate::scenario) enum ProfileWord {
    #[default]
    Trapezoid,
    Quintic,
    SCurve,
}

/// Where the motion leads.
pub(in crate::scenario) enum PathTable {
    /// `goal`
    Joint(List),
    /// `displacement`
    Tool(List),
}

/// What moves in a straight line.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::scenario) enum MotionKind {
    Joint,
    Tool,
}

pub(super) fn read_motion(motion: &mut Fields<'_>) -> MotionTable {
    let kind = motion.value(&format::KIND).and_then(Value::choice);
    MotionTable {
        angles: motion
            .value(&format::ANGLES)
            .and_then(Value::choice)
            .map(|angles| angles.value),
        start: list(motion.value(&format::START)),
        path: match kind.map(|kind| kind.value) {
            Some(kind) => {
                let goal = motion.value_if(&format::GOAL, kind == MotionKind::Joint);
                let displacement = motion.value_if(&format::DISPLACEMENT, kind == MotionKind::Tool);
                Some(match kind {
                    MotionKind::Joint => PathTable::Joint(list(goal)),
                    MotionKind::Tool => PathTable::Tool(list(displacement)),
                })
            }
            None => {
                // Either key may be meant: none is unknown.
                motion.permit(&format::GOAL);
                motion.permit(&format::DISPLACEMENT);
                None
            }
        },
        duration: number(motion.value(&format::DURATION)),
        blend: number(motion.value(&format::BLEND)),
        profile: motion
            .value(&format::PROFILE)
            .and_then(Value::choice)
            .map(|profile| profile.value),
        jerk_time: number(motion.value(&format::JERK_TIME)),
        max_velocity: list(motion.value(&format::MAX_VELOCITY)),
        max_acceleration: list(motion.value(&format::MAX_ACCELERATION)),
        max_jerk: list(motion.value(&format::MAX_JERK)),
    }
}
