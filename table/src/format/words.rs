//! The words of an arm's table.

use crate::table::{AngleUnit, Convention, RowSet};
use crate::toml_reader::{Choice, Word};
use ulna::{JointKind, TaskRow};

impl Choice for Convention {
    const WORDS: &'static [Word<Self>] = &[
        Word::new(
            "modified",
            Self::Modified,
            "Craig's, T_i = Rx(alpha) Tx(a) Rz(theta) Tz(d): a row holds a_{i-1} and alpha_{i-1}, the joint's axis is z of frame i",
        ),
        Word::new(
            "standard",
            Self::Standard,
            "Denavit and Hartenberg's, T_i = Rz(theta) Tz(d) Tx(a) Rx(alpha): a row holds a_i and alpha_i, the joint's axis is z of frame i-1",
        ),
    ];
}

impl Choice for AngleUnit {
    const WORDS: &'static [Word<Self>] = &[
        Word::new("deg", Self::Degrees, ""),
        Word::new("rad", Self::Radians, ""),
    ];
}

impl Choice for JointKind {
    const WORDS: &'static [Word<Self>] = &[
        Word::new(
            "revolute",
            Self::Revolute,
            "turns: q is added to theta, rad",
        ),
        Word::new("prismatic", Self::Prismatic, "slides: q is added to d, m"),
    ];
}

impl Choice for RowSet {
    const WORDS: &'static [Word<Self>] = &[
        Word::new("position", Self(&POSITION), "x, y and z"),
        Word::new("pose", Self(&TaskRow::ALL), "all six"),
    ];
}

const POSITION: [TaskRow; 3] = [TaskRow::X, TaskRow::Y, TaskRow::Z];

impl Choice for TaskRow {
    const WORDS: &'static [Word<Self>] = &[
        row(Self::X),
        row(Self::Y),
        row(Self::Z),
        row(Self::Rx),
        row(Self::Ry),
        row(Self::Rz),
    ];
}

const fn row(row: TaskRow) -> Word<TaskRow> {
    Word::new(row.name(), row, "")
}
