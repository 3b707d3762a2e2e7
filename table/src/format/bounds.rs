//! What the numbers of an arm's table may be. Generous: 100 m of link, the gravity of the Sun.

use crate::toml_reader::Bound;

pub(super) static LENGTH: Bound = Bound {
    range: -100.0..=100.0,
    unit: "m",
    help: "lengths are in metres",
};
pub(super) static BASE_LENGTH: Bound = Bound {
    range: -1e5..=1e5,
    unit: "m",
    help: "lengths are in metres",
};
pub(super) static MASS: Bound = Bound {
    range: 1e-6..=1e6,
    unit: "kg",
    help: "masses are positive and in kilograms",
};
pub(super) static MOMENT: Bound = Bound {
    range: -1e9..=1e9,
    unit: "kg m^2",
    help: "inertias are in kg m^2, about the centroid",
};
/// What a rated torque may be, wherever one is written.
pub const RATED_TORQUE: Bound = Bound {
    range: 1e-6..=1e7,
    unit: "N m (N if prismatic)",
    help: "a rated torque is positive; leave the key out if there is none",
};
pub(super) static GRAVITY: Bound = Bound {
    range: -300.0..=300.0,
    unit: "m/s^2",
    help: "gravity is in m/s^2, for example [0.0, 0.0, -9.81]",
};
