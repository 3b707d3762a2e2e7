//! `[assess]`.

use super::bounds::{
    COMPENSATION_RATE, FORCE_BUDGET, MAX_ASSESSED_TIMES, MAX_BUDGETS, RAMP, RATED,
};
use super::experiment::RATED_TORQUES;
use crate::laws::{LawName, LawSet};
use crate::scenario::AssessSettings;
use ulna_table::toml_reader::{Choice, Key, Kind, Limit, Need, Section};

/// What counts where a key is left out.
pub(in crate::scenario) const FAILURE_TIMES_DEFAULT: u64 = 79;
pub(in crate::scenario) const LOCKS_AT_ONCE_DEFAULT: u64 = 2;
pub(in crate::scenario) const FORCE_BUDGETS_DEFAULT: [f64; 4] = [0.0, 2.0, 5.0, 10.0];
pub(in crate::scenario) const RATE_LIMIT_DEFAULT: f64 = 100.0;
pub(in crate::scenario) const RAMP_DEFAULT: f64 = 1.0;

/// What every other law is measured against: they are judged whether chosen or not.
pub(in crate::scenario) const ALWAYS_ASSESSED: [LawName; 2] = [LawName::None, LawName::Limit];
pub(in crate::scenario) const LAWS_DEFAULT: LawSet = LawSet::ALL;

pub(super) static ASSESS: Section = Section {
    header: "[assess]",
    meaning: "At most once: every law over a grid of failures for which it was not tuned",
    example: "[assess]\nfailure_times = 79\nlocks_at_once = 2\nforce_budgets = [0.0, 2.0, 5.0, 10.0]\nrate_limit = 100.0\nramp = 1.0\n\
              rated_torque = 600.0\nlaws = [\"eq16\", \"eq20\", \"on_line\", \"robust\"]\n",
    keys: &[
        &FAILURE_TIMES,
        &LOCKS_AT_ONCE,
        &FORCE_BUDGETS,
        &RATE_LIMIT,
        &RAMP_TIME,
        &ASSESSED_RATED_TORQUE,
        &LAWS,
    ],
};

pub(in crate::scenario) static FAILURE_TIMES: Key = Key::required(
    "failure_times",
    Kind::Whole,
    "How many failure times, evenly spread over the motion without its ends",
    "`failure_times = 79`",
)
.limits(&[Limit::Count(MAX_ASSESSED_TIMES)])
.need(Need::Default(|| FAILURE_TIMES_DEFAULT.to_string()));
pub(in crate::scenario) static LOCKS_AT_ONCE: Key = Key::required(
    "locks_at_once",
    Kind::Whole,
    "The most joints that lock together: 1 for each joint, 2 for each pair as well",
    "`locks_at_once = 2`",
)
.limits(&[Limit::Count(AssessSettings::MOST_LOCKS_AT_ONCE)])
.need(Need::Default(|| LOCKS_AT_ONCE_DEFAULT.to_string()));
pub(in crate::scenario) static FORCE_BUDGETS: Key = Key::required(
    "force_budgets",
    Kind::List(&Kind::Number, "at least one"),
    "How far a law may bend the static tool force: the robust law at all times, the on-line law and the one after the lock in their recourse; one law for each",
    "`force_budgets = [0.0, 5.0]`",
)
.limits(&[
    Limit::Within(&FORCE_BUDGET),
    Limit::Said(|| format!("at most {MAX_BUDGETS}, each once")),
])
.need(Need::Default(|| format!("{FORCE_BUDGETS_DEFAULT:?}")));
pub(in crate::scenario) static RATE_LIMIT: Key = Key::required(
    "rate_limit",
    Kind::Number,
    "The fastest that the robust law's compensation may change in any joint",
    "`rate_limit = 100.0`",
)
.limits(&[Limit::Within(&COMPENSATION_RATE)])
.need(Need::Default(|| format!("{RATE_LIMIT_DEFAULT:?}")));
pub(in crate::scenario) static RAMP_TIME: Key = Key::required(
    "ramp",
    Kind::Number,
    "How long the on-line and the robust law take after a lock to fade their recourse out",
    "`ramp = 1.0`",
)
.limits(&[Limit::Within(&RAMP)])
.need(Need::Default(|| format!("{RAMP_DEFAULT:?}")));
pub(in crate::scenario) static ASSESSED_RATED_TORQUE: Key = Key::required(
    "rated_torque",
    RATED_TORQUES,
    "The torque limits to keep, as in an experiment",
    "`rated_torque = \"table\"` or `rated_torque = 300.0`",
)
.limits(&[Limit::Within(&RATED)])
.need(Need::Optional("those of the first experiment count"));
pub(in crate::scenario) static LAWS: Key = Key::required(
    "laws",
    Kind::List(&Kind::Words(LawName::listed), "at least one"),
    "Which laws are judged; results keep to the order below, however they are written",
    "`laws = [\"eq16\", \"on_line\"]`",
)
.limits(&[Limit::Said(|| {
    let always = ALWAYS_ASSESSED.map(|law| format!("{:?}", law.name()));
    format!("each once; {} are always there", always.join(" and "))
})])
.need(Need::Optional("all of them are"));
