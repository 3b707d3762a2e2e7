//! What is known of a joint beside its row and its link: its limits, its motor, its friction.

use super::bounds;
use crate::toml_reader::{Key, Kind, Limit, Need, Section};
use ulna::{Friction, Motor};

pub(crate) static LIMITS: Key = Key::required(
    "limits",
    Kind::Table(&LIMITS_SECTION),
    "How far and how fast the joint may go; how hard, `rated_torque` says",
    "`limits = { lower = -180.0, upper = 180.0, velocity = 90.0 }`",
)
.need(Need::Optional("there are no limits"));

static LIMITS_SECTION: Section = Section {
    header: "limits = { }",
    meaning: "Limits of a joint's motion, each optional. Those of a revolute joint are in `angle_unit`, those of a prismatic one in m",
    // Written with the joint, as those below.
    example: "",
    keys: &[&LOWER, &UPPER, &VELOCITY],
};
pub(crate) static LOWER: Key = Key::required(
    "lower",
    Kind::Number,
    "The least q, measured from the table's configuration as q is",
    "`lower = -180.0`",
)
.limits(COORDINATE)
.need(Need::Optional("there is no limit this way"));
pub(crate) static UPPER: Key =
    Key::required("upper", Kind::Number, "The largest q", "`upper = 180.0`")
        .limits(&[
            Limit::Within(&bounds::COORDINATE),
            Limit::Said(|| "above `lower`".to_owned()),
        ])
        .need(Need::Optional("there is no limit this way"));
pub(crate) static VELOCITY: Key = Key::required(
    "velocity",
    Kind::Number,
    "The largest speed, either way",
    "`velocity = 90.0`",
)
.limits(&[Limit::Within(&bounds::VELOCITY)])
.need(Need::Optional("there is no limit"));

const COORDINATE: &[Limit] = &[Limit::Within(&bounds::COORDINATE)];

pub(crate) static MOTOR: Key = Key::required(
    "motor",
    Kind::Table(&MOTOR_SECTION),
    "The rotor that drives the joint",
    "`motor = { inertia = 1e-4, ratio = 100.0 }`",
)
.need(Need::Optional("no rotor counts"));

static MOTOR_SECTION: Section = Section {
    header: "motor = { }",
    meaning: "A rotor behind rigid gears. It adds inertia times ratio squared to the joint's own entry of the mass matrix; its \
              gyroscopic effects are neglected, and its mass is a part of the link that carries it",
    example: "",
    keys: &[&ROTOR, &RATIO],
};
pub(crate) static ROTOR: Key = Key::required(
    "inertia",
    Kind::Number,
    "Of the rotor and all that turns with it, about its own axis",
    "`inertia = 1e-4`",
)
.limits(&[Limit::Within(&bounds::ROTOR)]);
pub(crate) static RATIO: Key = Key::required(
    "ratio",
    Kind::Number,
    "Turns of the rotor for one of the joint; for a prismatic joint, rad of the rotor for a metre",
    "`ratio = 100.0`",
)
.limits(&[Limit::Within(&bounds::RATIO)])
.need(Need::Default(|| format!("{:?}", Motor::NONE.ratio)));

pub(crate) static FRICTION: Key = Key::required(
    "friction",
    Kind::Table(&FRICTION_SECTION),
    "What resists the joint's motion",
    "`friction = { viscous = 0.5, coulomb = 2.0 }`",
)
.need(Need::Optional("there is none"));

static FRICTION_SECTION: Section = Section {
    header: "friction = { }",
    meaning: "Friction in a joint: viscous q' + coulomb q' / sqrt(q'^2 + smoothing^2), q' being the joint's rate. \
              Always in rad and m, whatever `angle_unit` says",
    example: "",
    keys: &[&VISCOUS, &COULOMB, &SMOOTHING],
};
pub(crate) static VISCOUS: Key = Key::required(
    "viscous",
    Kind::Number,
    "Torque for each rad/s (force for each m/s)",
    "`viscous = 0.5`",
)
.limits(&[Limit::Within(&bounds::VISCOUS)])
.need(ZERO);
pub(crate) static COULOMB: Key = Key::required(
    "coulomb",
    Kind::Number,
    "Torque (force) at any speed, against the motion",
    "`coulomb = 2.0`",
)
.limits(&[Limit::Within(&bounds::COULOMB)])
.need(ZERO);
pub(crate) static SMOOTHING: Key = Key::required(
    "smoothing",
    Kind::Number,
    "The speed at which Coulomb's friction has reached 0.71 of its size; it is smooth through rest, where it holds nothing",
    "`smoothing = 1e-3`",
)
.limits(&[Limit::Within(&bounds::SMOOTHING)])
.need(Need::Default(|| format!("{:?}", Friction::SMOOTHING)));

const ZERO: Need = Need::Default(|| "0.0".to_owned());
