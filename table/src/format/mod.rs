//! The format of an arm's table: every key with its kind, its bounds and its meaning.

mod bounds;
mod described;
mod drive;
mod joint;
mod words;

pub use bounds::RATED_TORQUE;
pub(crate) use described::{DESCRIBED_BASE, DESCRIBED_TOOL, DESCRIPTION, ROTATION};
pub(crate) use drive::{
    COULOMB, FRICTION, LIMITS, LOWER, MOTOR, RATIO, ROTOR, SMOOTHING, UPPER, VELOCITY, VISCOUS,
};
pub(crate) use joint::{
    A, ACCEPT_INERTIA, ALPHA, COM, D, DEFAULT_KIND, INERTIA, JOINT, JOINT_NAME, KIND, LINK, MASS,
    RATED, THETA, XX, XY, XZ, YY, YZ, ZZ,
};

use crate::lint::Lint;
use crate::table::{AngleUnit, ArmTable, Convention, RowSet};
use crate::toml_reader::{Choice, Key, Kind, Limit, Need, Section, reference as printed};
use bounds::{BASE_LENGTH, GRAVITY as GRAVITY_BOUND, LENGTH};
use ulna::TaskRow;

const INTRODUCTION: &str = "
# The table of an arm

A TOML file with everything that is known of a robot arm: its Denavit-Hartenberg rows, its links' masses and inertias.
SI units throughout; angles in the unit that `angle_unit` names. A number is finite, an integer or a decimal fraction.
`ulna check FILE` says what is in a table, or everything that is wrong with it.
";

/// The reference of the format, Markdown.
pub fn reference() -> String {
    printed(INTRODUCTION, &TABLE)
}

/// The keys before the first header.
pub(crate) static TABLE: Section = Section {
    header: "",
    meaning: "What concerns the whole arm, and what stands under the headers below",
    example: "name = \"my_arm\"\nconvention = \"modified\"\nangle_unit = \"deg\"\ngravity = [0.0, 0.0, -9.81]\nallow = []\n",
    keys: &[
        &NAME,
        &CONVENTION,
        &ANGLE_UNIT,
        &GRAVITY,
        &ALLOW,
        &TASK,
        &BASE,
        &TOOL,
        &PAYLOAD,
        &JOINTS,
    ],
};

pub(crate) static NAME: Key = Key::required(
    "name",
    Kind::Text,
    "Names the file, the module and the type of generated code",
    "`name = \"my_arm\"`",
)
.limits(&[Limit::Said(|| {
    "snake_case, at most 64 characters, no keyword of Rust".to_owned()
})]);
pub(crate) static CONVENTION: Key = Key::required(
    "convention",
    Kind::Words(Convention::listed),
    "Which of the two Denavit-Hartenberg conventions the rows follow; it is never guessed",
    "`convention = \"modified\"` or `convention = \"standard\"`",
);
/// Also of a scenario.
pub static ANGLE_UNIT: Key = Key::required(
    "angle_unit",
    Kind::Words(AngleUnit::listed),
    "The unit of every angle in the file",
    "`angle_unit = \"deg\"` or `angle_unit = \"rad\"`",
);
pub(crate) static GRAVITY: Key = Key::required(
    "gravity",
    Kind::Numbers(3),
    "Gravity along the world's x, y and z",
    "`gravity = [0.0, 0.0, -9.81]`",
)
.limits(&[Limit::Within(&GRAVITY_BOUND)])
.need(Need::Default(|| "[0.0, 0.0, 0.0]".to_owned()));
pub(crate) static ALLOW: Key = Key::required(
    "allow",
    Kind::List(&Kind::Words(Lint::listed), ""),
    "Warnings that are switched off, by the names that they give; what is warned of and why",
    "`allow = []`, or the names of warnings between the brackets",
)
.need(Need::Optional("every warning is given"));
pub(crate) static TASK: Key = Key::required(
    "task",
    Kind::Table(&TASK_SECTION),
    "What the tool is for",
    "`[task]` and below it `rows = \"position\"`",
);
pub(crate) static BASE: Key = placed("base", &BASE_SECTION, "Where the arm stands");
pub(crate) static TOOL: Key = placed("tool", &TOOL_SECTION, "Where the tool point is");
pub(crate) static PAYLOAD: Key = Key::required(
    "payload",
    Kind::Table(&PAYLOAD_SECTION),
    "Whether the tool holds bodies that are known only when the arm moves",
    "`runtime = true` below a line `[payload]`",
)
.need(Need::Optional("the arm's type has no payload"));
pub(crate) static JOINTS: Key = Key::required(
    "joint",
    Kind::Tables(&JOINT),
    "The joints, base first",
    "`[[joint]]` once for each joint, base first",
)
.limits(&[Limit::Said(|| format!("1 to {}", ArmTable::MAX_JOINTS))]);

static TASK_SECTION: Section = Section {
    header: "[task]",
    meaning: "Once",
    example: "[task]\nrows = [\"y\"]\n",
    keys: &[&ROWS],
};
pub(crate) static ROWS: Key = Key::required(
    "rows",
    Kind::OneOf(&[
        Kind::Words(RowSet::listed),
        Kind::List(&Kind::Words(TaskRow::listed), ""),
    ]),
    "The rows of the Jacobian in w_D: linear velocities of the tool point along the world's axes, and angular ones about them",
    "`rows = \"position\"`, `rows = \"pose\"` or a list such as `rows = [\"x\", \"y\"]`",
)
.limits(&[Limit::Said(|| {
    "each row at most once, at least one, and no more than the arm has joints".to_owned()
})]);

static BASE_SECTION: Section = Section {
    header: "[base]",
    meaning: "At most once: the base's frame in the world, `world_from_base`",
    example: "[base]\nxyz = [0.0, 0.0, 0.0]\nrpy = [0.0, 0.0, 0.0]\n",
    keys: &[&BASE_XYZ, &RPY],
};
static TOOL_SECTION: Section = Section {
    header: "[tool]",
    meaning: "At most once: the tool point's frame in that of the last joint, `frame_N_from_tool`",
    example: "[tool]\nxyz = [0.5, 0.0, 0.0]\nrpy = [0.0, 0.0, 0.0]\n",
    keys: &[&TOOL_XYZ, &RPY],
};
static PAYLOAD_SECTION: Section = Section {
    header: "[payload]",
    meaning: "At most once: what is fixed to the tool beside the links of the table",
    example: "[payload]\nruntime = false\n",
    keys: &[&RUNTIME],
};
pub(crate) static RUNTIME: Key = Key::required(
    "runtime",
    Kind::Flag,
    "With `true` the arm's type holds a payload (mass, centroid, inertia in the tool's frame) that may change between two calls, \
     and every dynamic method counts it",
    "`runtime = true`",
)
.need(Need::Default(|| "false".to_owned()));
pub(crate) static BASE_XYZ: Key = xyz(&[Limit::Within(&BASE_LENGTH)]);
pub(crate) static TOOL_XYZ: Key = xyz(&[Limit::Within(&LENGTH)]);
pub(crate) static RPY: Key = Key::required(
    "rpy",
    Kind::Numbers(3),
    "Roll, pitch, yaw: turns about the fixed x, then y, then z, R = Rz(yaw) Ry(pitch) Rx(roll)",
    "`rpy = [0.0, 0.0, 0.0]`",
)
.limits(&[ANGLE])
.need(NOTHING);

/// An angle's bound depends on its unit.
const ANGLE: Limit = Limit::Said(|| "in `angle_unit`, at most a full turn either way".to_owned());
const NOTHING: Need = Need::Default(|| "[0.0, 0.0, 0.0]".to_owned());

const fn xyz(limits: &'static [Limit]) -> Key {
    Key::required(
        "xyz",
        Kind::Numbers(3),
        "The frame's origin",
        "`xyz = [0.0, 0.0, 0.0]`",
    )
    .limits(limits)
    .need(NOTHING)
}

const fn placed(name: &'static str, section: &'static Section, meaning: &'static str) -> Key {
    Key::required(
        name,
        Kind::Table(section),
        meaning,
        "`xyz = [0.0, 0.0, 0.0]` below a line `[base]` or `[tool]`",
    )
    .need(Need::Optional("the two frames are the same"))
}
