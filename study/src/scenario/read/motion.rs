//! `[motion]`.

use super::{List, Number, list, number};
use ulna_table::toml_reader::Fields;

/// `[motion]`
pub(in crate::scenario) struct MotionTable {
    pub(in crate::scenario) angles: Option<Angles>,
    pub(in crate::scenario) start: List,
    pub(in crate::scenario) path: Option<PathTable>,
    pub(in crate::scenario) duration: Number,
    pub(in crate::scenario) blend: Number,
    pub(in crate::scenario) max_velocity: List,
    pub(in crate::scenario) max_acceleration: List,
}

/// What the numbers of a position are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::scenario) enum Angles {
    /// The quantity that moves in the joint's DH row: θ + q, or d + q.
    Dh,
    /// q itself.
    Q,
}

/// Where the motion leads.
pub(in crate::scenario) enum PathTable {
    /// `goal`
    Joint(List),
    /// `displacement`
    Tool(List),
}

#[derive(Clone, Copy)]
enum MotionKind {
    Joint,
    Tool,
}

pub(super) fn read_motion(motion: &mut Fields<'_>) -> MotionTable {
    let kinds = [("joint", MotionKind::Joint), ("tool", MotionKind::Tool)];
    let kind = motion
        .required("kind", "kind = \"joint\"` or `kind = \"tool\"")
        .and_then(|kind| kind.choice(&kinds));
    let angles = [("dh", Angles::Dh), ("q", Angles::Q)];
    MotionTable {
        angles: motion
            .required("angles", "angles = \"dh\"` or `angles = \"q\"")
            .and_then(|value| value.choice(&angles))
            .map(|angles| angles.value),
        start: list(motion.required(
            "start",
            "start = [0.0, 0.5]` with a number for each joint, `[0.0, 0.5]",
        )),
        path: match kind.map(|kind| kind.value) {
            Some(MotionKind::Joint) => Some(PathTable::Joint(list(
                motion.required("goal", "goal = [1.0, 0.5]"),
            ))),
            Some(MotionKind::Tool) => Some(PathTable::Tool(list(motion.required(
                "displacement",
                "displacement = [0.0, 0.0, 0.5, 0.0, 0.0, 0.0]",
            )))),
            None => {
                // Either key may be meant: none is unknown.
                motion.optional("goal", "goal = [1.0, 0.5]");
                motion.optional(
                    "displacement",
                    "displacement = [0.0, 0.0, 0.5, 0.0, 0.0, 0.0]",
                );
                None
            }
        },
        duration: number(motion.required("duration", "duration = 20.0")),
        blend: number(motion.required("blend", "blend = 4.0")),
        max_velocity: list(motion.optional("max_velocity", "max_velocity = [0.5, 0.5]")),
        max_acceleration: list(
            motion.optional("max_acceleration", "max_acceleration = [0.1, 0.1]"),
        ),
    }
}
