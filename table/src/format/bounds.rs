//! What the numbers of an arm's table may be. Generous: 100 m of link, the gravity of the Sun.

use crate::toml_reader::Bound;
use ulna::Payload;

pub(super) static LENGTH: Bound = Bound {
    range: -Payload::MAX_DISTANCE..=Payload::MAX_DISTANCE,
    unit: "m",
    help: "lengths are in metres",
};
pub(super) static BASE_LENGTH: Bound = Bound {
    range: -1e5..=1e5,
    unit: "m",
    help: "lengths are in metres",
};
pub(super) static MASS: Bound = Bound {
    range: 1e-6..=Payload::MAX_MASS,
    unit: "kg",
    help: "masses are positive and in kilograms",
};
pub(super) static MOMENT: Bound = Bound {
    range: -Payload::MAX_MOMENT..=Payload::MAX_MOMENT,
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
pub(super) static COORDINATE: Bound = Bound {
    range: -1e5..=1e5,
    unit: "in angle_unit (m if prismatic)",
    help: "limits are in the file's angle_unit, those of a prismatic joint in metres",
};
pub(super) static VELOCITY: Bound = Bound {
    range: 1e-6..=1e6,
    unit: "in angle_unit/s (m/s if prismatic)",
    help: "a largest speed is positive; leave the key out if there is none",
};
pub(super) static ROTOR: Bound = Bound {
    range: 0.0..=1e3,
    unit: "kg m^2",
    help: "a rotor's inertia is in kg m^2, on its own side of the gears",
};
pub(super) static RATIO: Bound = Bound {
    range: 1e-3..=1e6,
    unit: "(rad/m if prismatic)",
    help: "write how often the rotor turns for one turn of the joint, without a sign",
};
pub(super) static VISCOUS: Bound = Bound {
    range: 0.0..=1e7,
    unit: "N m s/rad (N s/m if prismatic)",
    help: "friction is not negative, and per rad/s whatever angle_unit is",
};
pub(super) static COULOMB: Bound = Bound {
    range: 0.0..=1e7,
    unit: "N m (N if prismatic)",
    help: "friction is not negative",
};
pub(super) static SMOOTHING: Bound = Bound {
    range: 1e-9..=1e3,
    unit: "rad/s (m/s if prismatic)",
    help: "Coulomb's friction is smoothed over a speed above 0, such as 1e-3, in rad/s whatever angle_unit is",
};
