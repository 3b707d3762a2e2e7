//! `[motors]`.

use super::bounds::{RATIO as RATIO_BOUND, ROTOR_INERTIA as ROTOR_INERTIA_BOUND};
use ulna_table::toml_reader::{Key, Kind, Limit, Need, Section};

/// The inertia of a rotor, kg m², in a scenario that does not say.
pub(in crate::scenario) const DEFAULT_ROTOR_INERTIA: f64 = 0.0;
/// The ratio of a gear in a scenario that does not say.
pub(in crate::scenario) const DEFAULT_RATIO: f64 = 1.0;

pub(super) static MOTORS: Section = Section {
    header: "[motors]",
    meaning: "At most once: what turns behind the gears where the lock is simulated. A joint's motor takes rotor_inertia times ratio^2 \
              to accelerate, and what goes into that does not reach the structure. An arm whose table has motors has them in all of its dynamics, \
              and needs none here",
    example: "[motors]\nrotor_inertia = 1e-4\nratio = [100.0, 160.0]\n",
    keys: &[&ROTOR_INERTIA, &RATIO],
};

const COMMON_OR_EACH: Kind = Kind::OneOf(&[
    Kind::Number,
    Kind::List(&Kind::Number, "one for each joint"),
]);

pub(in crate::scenario) static ROTOR_INERTIA: Key = Key::required(
    "rotor_inertia",
    COMMON_OR_EACH,
    "The inertia of a rotor, and of what turns as fast, about its axis; one number counts for all joints",
    "`rotor_inertia = 1e-4`, or a list with a number for each joint",
)
.limits(&[Limit::Within(&ROTOR_INERTIA_BOUND)])
.need(Need::Default(|| format!("{DEFAULT_ROTOR_INERTIA:?}")));
pub(in crate::scenario) static RATIO: Key = Key::required(
    "ratio",
    COMMON_OR_EACH,
    "How many turns of the rotor one of the joint takes (rad per m if prismatic); one number counts for all joints",
    "`ratio = 100.0`, or a list with a number for each joint",
)
.limits(&[Limit::Within(&RATIO_BOUND)])
.need(Need::Default(|| format!("{DEFAULT_RATIO:?}")));
