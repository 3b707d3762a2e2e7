//! `[motion]`.

use super::bounds::{
    DISPLACEMENT as DISPLACEMENT_BOUND, DURATION as DURATION_BOUND, JERK, POSITION, RATE,
    TOOL_DURATION,
};
use crate::scenario::read::{Angles, MotionKind, ProfileWord};
use ulna_table::toml_reader::{Choice, Key, Kind, Limit, Need, Section};

pub(in crate::scenario) static MOTION: Section = Section {
    header: "[motion]",
    meaning: "Once: from rest to rest",
    example: "[motion]\nkind = \"joint\"\nangles = \"q\"\nstart = [0.0, 30.0]\ngoal = [60.0, -20.0]\nduration = 10.0\nblend = 3.0\n\
              profile = \"s_curve\"\njerk_time = 1.0\nmax_velocity = [90.0, 90.0]\nmax_acceleration = [30.0, 30.0]\n\
              max_jerk = [30.0, 30.0]\n",
    keys: &[
        &KIND,
        &ANGLES,
        &START,
        &GOAL,
        &DISPLACEMENT,
        &DURATION,
        &BLEND,
        &PROFILE,
        &JERK_TIME,
        &MAX_VELOCITY,
        &MAX_ACCELERATION,
        &MAX_JERK,
    ],
};

const EACH: Kind = Kind::List(&Kind::Number, "one for each joint");

pub(in crate::scenario) static KIND: Key = Key::required(
    "kind",
    Kind::Words(MotionKind::listed),
    "What moves in a straight line",
    "`kind = \"joint\"` or `kind = \"tool\"`",
);
pub(in crate::scenario) static ANGLES: Key = Key::required(
    "angles",
    Kind::Words(Angles::listed),
    "What the numbers of `start` and `goal` are",
    "`angles = \"dh\"` or `angles = \"q\"`",
);
pub(in crate::scenario) static START: Key = Key::required(
    "start",
    EACH,
    "Where the motion starts",
    "`start = [0.0, 0.5]` with a number for each joint",
)
.limits(POSITIONS);
pub(in crate::scenario) static GOAL: Key = Key::required(
    "goal",
    EACH,
    "Where it ends",
    "`goal = [1.0, 0.5]` with a number for each joint",
)
.limits(POSITIONS)
.need(Need::With("kind = \"joint\""));
pub(in crate::scenario) static DISPLACEMENT: Key = Key::required(
    "displacement",
    Kind::List(&Kind::Number, "six of them"),
    "How far the tool goes along the world's axes, and the rotation vector by which it turns; those of the task count",
    "`displacement = [0.0, 0.0, 0.5, 0.0, 0.0, 0.0]`",
)
.limits(&[Limit::Within(&DISPLACEMENT_BOUND)])
.need(Need::With("kind = \"tool\""));
pub(in crate::scenario) static DURATION: Key = Key::required(
    "duration",
    Kind::Number,
    "The whole motion",
    "`duration = 20.0`",
)
.limits(&[
    Limit::Within(&DURATION_BOUND),
    Limit::Within(&TOOL_DURATION),
]);
pub(in crate::scenario) static BLEND: Key = Key::required(
    "blend",
    Kind::Number,
    "Speeding up, and again slowing down",
    "`blend = 4.0`",
)
.limits(&[Limit::Said(|| {
    "s, above 0, at most half the duration".to_owned()
})]);
pub(in crate::scenario) static PROFILE: Key = Key::required(
    "profile",
    Kind::Words(ProfileWord::listed),
    "How the speed rises in a blend, and falls in the other one",
    "`profile = \"trapezoid\"`, `profile = \"quintic\"` or `profile = \"s_curve\"`",
)
.need(Need::Default(|| ProfileWord::default().quoted()));
pub(in crate::scenario) static JERK_TIME: Key = Key::required(
    "jerk_time",
    Kind::Number,
    "How long the acceleration of an S-curve takes to rise, and again to fall, in each blend",
    "`jerk_time = 1.0`",
)
.limits(&[Limit::Said(|| {
    "s, above 0, at most half the blend; with `profile = \"s_curve\"` only".to_owned()
})])
.need(Need::Optional("it is half the blend"));
pub(in crate::scenario) static MAX_VELOCITY: Key = Key::required(
    "max_velocity",
    EACH,
    "The fastest that each joint may turn; a motion that needs more is refused",
    "`max_velocity = [0.5, 0.5]` with a number for each joint",
)
.limits(RATES)
.need(Need::Optional("there is no limit"));
pub(in crate::scenario) static MAX_ACCELERATION: Key = Key::required(
    "max_acceleration",
    EACH,
    "The most that each joint may accelerate; a motion that needs more is refused",
    "`max_acceleration = [0.1, 0.1]` with a number for each joint",
)
.limits(RATES)
.need(Need::Optional("there is no limit"));
pub(in crate::scenario) static MAX_JERK: Key = Key::required(
    "max_jerk",
    EACH,
    "The fastest that the acceleration of each joint may change; a motion that needs more is refused, and so is any trapezoid",
    "`max_jerk = [0.1, 0.1]` with a number for each joint",
)
.limits(&[IN_UNIT, Limit::Within(&JERK)])
.need(Need::Optional("there is no limit"));

const IN_UNIT: Limit = Limit::Said(|| "in `angle_unit` where the joint turns".to_owned());
const POSITIONS: &[Limit] = &[IN_UNIT, Limit::Within(&POSITION)];
const RATES: &[Limit] = &[IN_UNIT, Limit::Within(&RATE)];
