//! What the numbers of a scenario may be.

use ulna_table::RATED_TORQUE;
use ulna_table::toml_reader::Bound;

pub(in crate::scenario) static POSITION: Bound = Bound {
    range: -100.0..=100.0,
    unit: "rad (m)",
    help: "if angles are in degrees, write `angle_unit = \"deg\"`",
};
pub(in crate::scenario) static RATE: Bound = Bound {
    range: 1e-9..=1e6,
    unit: "rad/s, rad/s^2 (m/s, m/s^2)",
    help: "a limit is positive; leave the key out if there is none",
};
pub(in crate::scenario) static JERK: Bound = Bound {
    range: 1e-9..=1e9,
    unit: "rad/s^3 (m/s^3)",
    help: "a limit is positive; leave the key out if there is none",
};
pub(super) static DISPLACEMENT: Bound = Bound {
    range: -100.0..=100.0,
    unit: "m, rad",
    help: "three lengths in metres, then a rotation vector in radians",
};
pub(in crate::scenario) static DURATION: Bound = Bound {
    range: 1e-3..=1e5,
    unit: "s",
    help: "times are in seconds",
};
/// A knot every 0.02 s is integrated and kept, and a campaign does it for every case.
pub(in crate::scenario) static TOOL_DURATION: Bound = Bound {
    range: 1e-3..=1e3,
    unit: "s for a motion of the tool",
    help: "write a shorter duration, or `kind = \"joint\"`",
};
pub(super) static FAILURE_TIME: Bound = Bound {
    range: 0.0..=1e5,
    unit: "s",
    help: "times are in seconds",
};
pub(super) static CYCLE: Bound = Bound {
    range: 1e-5..=10.0,
    unit: "s",
    help: "a control cycle is in seconds, for example 0.01",
};
pub(super) static STEP_TIME: Bound = Bound {
    range: 0.0..=10.0,
    unit: "s",
    help: "the time from the last torque before the lock to the first after it; 0 is the limit of ever shorter ones",
};
pub(super) static BRAKE: Bound = Bound {
    range: 1e-6..=10.0,
    unit: "s",
    help: "a brake takes its joint to rest in a finite time, for example 0.1 s",
};
pub(super) static GAIN: Bound = Bound {
    range: 0.0..=1e4,
    unit: "rad/s",
    help: "a servo of an arm answers within some 1 to 50 rad/s; 0 is no feedback",
};
pub(super) static DETECTION: Bound = Bound {
    range: 0.0..=10.0,
    unit: "s",
    help: "write how long the controller takes to know, for example 0.02 s",
};
pub(super) static LEAD: Bound = Bound {
    range: 0.0..=10.0,
    unit: "s",
    help: "write how long the compensation has acted when the joint fails, for example 0.25 s",
};
pub(super) static ROTOR_INERTIA: Bound = Bound {
    range: 0.0..=1e3,
    unit: "kg m^2",
    help: "write the rotor's own inertia, on its side of the gear, for example 1e-4 kg m^2",
};
pub(super) static RATIO: Bound = Bound {
    range: 1e-3..=1e5,
    unit: "(rad/m if prismatic)",
    help: "a ratio is positive, for example 100",
};
pub(super) static COEFFICIENT: Bound = Bound {
    range: -1e16..=1e16,
    unit: "",
    help: "the paper's coefficients are of the size 1e7",
};
pub(super) static STEP: Bound = Bound {
    range: 1e-6..=1e16,
    unit: "",
    help: "a step is positive; the paper's are 1e6 and 1e7",
};
pub(super) static FORCE: Bound = Bound {
    range: -1e7..=1e7,
    unit: "N (N m) per power of s",
    help: "forces are in newtons",
};
pub(super) static WRENCH_STEP: Bound = Bound {
    range: -1e7..=1e7,
    unit: "N (N m)",
    help: "forces are in newtons",
};
pub(super) static RATED: Bound = Bound {
    help: "a rated torque is positive; write \"none\" if there is none",
    ..RATED_TORQUE
};
pub(super) static FIGURE: Bound = Bound {
    range: -1e16..=1e16,
    unit: "",
    help: "write the figure as it is printed",
};
pub(super) static SPREAD: Bound = Bound {
    range: 0.0..=100.0,
    unit: "rad (m)",
    help: "a spread is the largest deviation, not negative",
};
pub(super) static FORCE_SPREAD: Bound = Bound {
    range: 0.0..=1e7,
    unit: "N (N m)",
    help: "a spread is the largest deviation, not negative",
};

pub(super) static FORCE_BUDGET: Bound = Bound {
    range: 0.0..=1e7,
    unit: "N (N m)",
    help: "a budget is the largest norm of the force error, not negative",
};
pub(super) static COMPENSATION_RATE: Bound = Bound {
    range: 1e-6..=1e9,
    unit: "N m/s (N/s)",
    help: "a rate is positive; write 1e9 if there is no limit",
};
pub(super) static RAMP: Bound = Bound {
    range: 1e-3..=1e5,
    unit: "s",
    help: "a ramp takes some time, for example 1.0 s",
};

/// The most control cycles in a motion: a search keeps each in memory, with all that a compensation is made of,
/// and as many searches run at once as there are cores. For 7 joints that is 8 KB for each cycle and core.
pub(in crate::scenario) const MAX_CYCLES: f64 = 1e4;
/// The most studies, experiments times failure times: the series and figures of all are in memory before any is written,
/// some 1 MB for each with 7 joints.
pub(in crate::scenario) const MAX_STUDIES: usize = 100;
/// The highest power of time in a force, plus 1.
pub(in crate::scenario) const MAX_COEFFICIENTS: usize = 8;
/// The most figures in a scenario: all are in memory before any is written.
pub(in crate::scenario) const MAX_FIGURES: usize = 100;
/// The most cases: more than all machines that anybody has make in a year.
pub(in crate::scenario) const MAX_CASES: u64 = 1_000_000_000_000;
/// The most failure times of a campaign: each is a column of the figure.
pub(in crate::scenario) const MAX_FAILURE_TIMES: u64 = 1000;
/// The most failure times that laws are assessed at: each is looked at with every lock, and so are all pairs of joints.
pub(in crate::scenario) const MAX_ASSESSED_TIMES: u64 = 2000;
/// The most force budgets, each of which is a law with a figure of its own.
pub(in crate::scenario) const MAX_BUDGETS: usize = 8;
