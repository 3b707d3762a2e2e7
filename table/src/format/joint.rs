//! `[[joint]]` and what is below it.

use super::bounds;
use super::{ANGLE, FRICTION, LIMITS, MOTOR};
use crate::model::JOINT_NAME_RULE;
use crate::toml_reader::{Choice, Key, Kind, Limit, Need, Section};
use ulna::JointKind;

pub(crate) static JOINT: Section = Section {
    header: "[[joint]]",
    meaning: "Once for each joint, base first: its Denavit-Hartenberg row, at q = 0",
    example: "[[joint]]\nname = \"shoulder\"\nkind = \"revolute\"\ntheta = 0.0\nd = 0.2\na = 0.0\nalpha = 0.0\nrated_torque = 100.0\n\
              limits = { lower = -170.0, upper = 170.0, velocity = 90.0 }\n\
              motor = { inertia = 1e-4, ratio = 100.0 }\n\
              friction = { viscous = 0.5, coulomb = 2.0, smoothing = 1e-3 }\n",
    keys: &[
        &JOINT_NAME,
        &KIND,
        &THETA,
        &D,
        &A,
        &ALPHA,
        &RATED,
        &LIMITS,
        &MOTOR,
        &FRICTION,
        &LINK,
    ],
};

pub(crate) static JOINT_NAME: Key = Key::required(
    "name",
    Kind::Text,
    "What messages and other programs call the joint; no two joints have the same",
    "`name = \"shoulder\"`",
)
.limits(&[Limit::Said(|| JOINT_NAME_RULE.to_owned())])
.need(Need::Optional("it is called by its number"));

/// How a joint moves that does not say.
pub(crate) const DEFAULT_KIND: JointKind = JointKind::Revolute;
pub(crate) static KIND: Key = Key::required(
    "kind",
    Kind::Words(JointKind::listed),
    "How the joint moves",
    "`kind = \"revolute\"`",
)
.need(Need::Default(|| DEFAULT_KIND.quoted()));
pub(crate) static THETA: Key = Key::required(
    "theta",
    Kind::Number,
    "Turn about the joint's z",
    "`theta = 0.0`",
)
.limits(&[ANGLE]);
pub(crate) static D: Key =
    Key::required("d", Kind::Number, "Shift along the joint's z", "`d = 0.0`").limits(LENGTH);
pub(crate) static A: Key = Key::required(
    "a",
    Kind::Number,
    "Shift along x: a_{i-1} in modified form, a_i in standard form",
    "`a = 0.0`",
)
.limits(LENGTH);
pub(crate) static ALPHA: Key = Key::required(
    "alpha",
    Kind::Number,
    "Turn about x: alpha_{i-1} in modified form, alpha_i in standard form",
    "`alpha = 0.0`",
)
.limits(&[ANGLE]);
pub(crate) static RATED: Key = Key::required(
    "rated_torque",
    Kind::Number,
    "The most that the joint's motor gives, either way",
    "`rated_torque = 100.0`",
)
.limits(&[Limit::Within(&bounds::RATED_TORQUE)])
.need(Need::Optional("there is no limit"));
pub(crate) static LINK: Key = Key::required(
    "link",
    Kind::Table(&LINK_SECTION),
    "What the joint moves",
    "`[joint.link]` with mass, com and inertia below it",
);

static LINK_SECTION: Section = Section {
    header: "[joint.link]",
    meaning: "Once below each `[[joint]]`: the rigid body that moves with it",
    example: "[joint.link]\nmass = 2.5\ncom = [0.0, 0.0, 0.1]\ninertia = { xx = 0.02, yy = 0.02, zz = 0.01, xy = 0.0, xz = 0.0, yz = 0.0 }\naccept_inertia = false\n",
    keys: &[&MASS, &COM, &INERTIA, &ACCEPT_INERTIA],
};
pub(crate) static MASS: Key = Key::required(
    "mass",
    Kind::Number,
    "Of the link with all that is fixed to it",
    "`mass = 1.0`",
)
.limits(&[Limit::Within(&bounds::MASS)]);
pub(crate) static COM: Key = Key::required(
    "com",
    Kind::Numbers(3),
    "The centroid, in the frame of this row",
    "`com = [0.0, 0.0, 0.0]`",
)
.limits(LENGTH);
pub(crate) static INERTIA: Key = Key::required(
    "inertia",
    Kind::Table(&INERTIA_SECTION),
    "The inertia tensor about the centroid, in the axes of this row's frame",
    "`inertia = { xx = 1.0, yy = 1.0, zz = 1.0 }`",
);

pub(crate) static ACCEPT_INERTIA: Key = Key::required(
    "accept_inertia",
    Kind::Flag,
    "With `true` an inertia that no rigid body can have is taken over as it is, with a warning. For identified sets, whose \
     parameters give the right torques without being those of a body",
    "`accept_inertia = true`",
)
.need(Need::Default(|| "false".to_owned()));

static INERTIA_SECTION: Section = Section {
    header: "inertia = { }",
    meaning: "The tensor's entries. It must be one that a rigid body can have: positive definite, and no principal moment \
              beyond the sum of the other two",
    // Written with the link.
    example: "",
    keys: &[&XX, &YY, &ZZ, &XY, &XZ, &YZ],
};
pub(crate) static XX: Key = moment("xx", "`xx = 1.0`");
pub(crate) static YY: Key = moment("yy", "`yy = 1.0`");
pub(crate) static ZZ: Key = moment("zz", "`zz = 1.0`");
pub(crate) static XY: Key = product("xy", "`xy = 0.0`");
pub(crate) static XZ: Key = product("xz", "`xz = 0.0`");
pub(crate) static YZ: Key = product("yz", "`yz = 0.0`");

const LENGTH: &[Limit] = &[Limit::Within(&bounds::LENGTH)];
const MOMENT: &[Limit] = &[Limit::Within(&bounds::MOMENT)];

const fn moment(name: &'static str, write: &'static str) -> Key {
    Key::required(name, Kind::Number, "A moment of inertia", write).limits(MOMENT)
}

const fn product(name: &'static str, write: &'static str) -> Key {
    let meaning = "An entry beside the diagonal, with the tensor's sign: xy is -sum(m x y)";
    Key::required(name, Kind::Number, meaning, write)
        .limits(MOMENT)
        .need(Need::Default(|| "0.0".to_owned()))
}
