//! The format of what a program describes ([`Model::new`](crate::Model::new)): that of a table, but for rotations, which are matrices.
//!
//! Nobody writes it by hand, and no reference prints it.

use super::{
    ALLOW, ANGLE_UNIT, BASE_XYZ, CONVENTION, GRAVITY, JOINTS, NAME, NOTHING, PAYLOAD, TASK,
    TOOL_XYZ,
};
use crate::toml_reader::{Key, Kind, Need, Section};

/// The keys before the first header.
pub(crate) static DESCRIPTION: Section = Section {
    header: "",
    meaning: "",
    example: "",
    keys: &[
        &NAME,
        &CONVENTION,
        &ANGLE_UNIT,
        &GRAVITY,
        &ALLOW,
        &TASK,
        &DESCRIBED_BASE,
        &DESCRIBED_TOOL,
        &PAYLOAD,
        &JOINTS,
    ],
};

pub(crate) static DESCRIBED_BASE: Key = described("base", &BASE_SECTION);
pub(crate) static DESCRIBED_TOOL: Key = described("tool", &TOOL_SECTION);
pub(crate) static ROTATION: Key = Key::required(
    "rotation",
    Kind::List(&Kind::Numbers(3), "three"),
    "The rows of a rotation matrix",
    "`rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]`",
)
.need(NOTHING);

static BASE_SECTION: Section = placement("[base]", &[&BASE_XYZ, &ROTATION]);
static TOOL_SECTION: Section = placement("[tool]", &[&TOOL_XYZ, &ROTATION]);

const fn described(name: &'static str, section: &'static Section) -> Key {
    Key::required(name, Kind::Table(section), "", "")
        .need(Need::Optional("the two frames are the same"))
}

const fn placement(header: &'static str, keys: &'static [&'static Key]) -> Section {
    Section {
        header,
        meaning: "",
        example: "",
        keys,
    }
}
