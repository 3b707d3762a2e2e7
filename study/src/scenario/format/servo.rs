//! `[servo]`.

use super::bounds::{DETECTION as DETECTION_BOUND, GAIN as GAIN_BOUND, LEAD as LEAD_BOUND};
use crate::scenario::read::ProjectorWord;
use ulna_table::toml_reader::{Choice, Key, Kind, Limit, Need, Section};

/// How fast departures from the plan die out, rad/s, in a scenario that does not say.
pub(in crate::scenario) const DEFAULT_GAIN: f64 = 5.0;
/// From the failure until the controller knows, s, in a scenario that does not say.
pub(in crate::scenario) const DEFAULT_DETECTION: f64 = 0.0;
/// From the begin of a simulated lock to the failure, s, in a scenario that does not say.
pub(in crate::scenario) const DEFAULT_LEAD: f64 = 0.25;
/// The projector of every law in a scenario that does not say.
pub(in crate::scenario) const DEFAULT_PROJECTOR: ProjectorWord = ProjectorWord::Static;

pub(super) static SERVO: Section = Section {
    header: "[servo]",
    meaning: "At most once: how the controller follows the plan, what it knows, and the projector of its compensation",
    example: "[servo]\ngain = 5.0\ndetection = 0.0\nlead = 0.25\nprojector = \"static\"\n",
    keys: &[&GAIN, &DETECTION, &LEAD, &PROJECTOR],
};

pub(in crate::scenario) static GAIN: Key = Key::required(
    "gain",
    Kind::Number,
    "How fast departures from the plan die out, critically damped, where the lock is simulated; 0 is no feedback",
    "`gain = 5.0`",
)
.limits(&[Limit::Within(&GAIN_BOUND)])
.need(Need::Default(|| format!("{DEFAULT_GAIN:?}")));
pub(in crate::scenario) static DETECTION: Key = Key::required(
    "detection",
    Kind::Number,
    "From the failure until the controller knows of it, where the lock is simulated",
    "`detection = 0.02`",
)
.limits(&[Limit::Within(&DETECTION_BOUND)])
.need(Need::Default(|| format!("{DEFAULT_DETECTION:?}")));
pub(in crate::scenario) static LEAD: Key = Key::required(
    "lead",
    Kind::Number,
    "How long before the failure its simulation begins, in the planned state: so long the compensation acts, and moves the arm",
    "`lead = 0.25`",
)
.limits(&[Limit::Within(&LEAD_BOUND)])
.need(Need::Default(|| format!("{DEFAULT_LEAD:?}")));
pub(in crate::scenario) static PROJECTOR: Key = Key::required(
    "projector",
    Kind::Words(ProjectorWord::listed),
    "The projector P of every law, in searches and controllers alike",
    "`projector = \"static\"` or `projector = \"dynamically_consistent\"`",
)
.need(Need::Default(|| DEFAULT_PROJECTOR.quoted()));
