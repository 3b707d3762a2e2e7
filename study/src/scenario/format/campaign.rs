//! `[campaign]`.

use super::bounds::{FORCE_SPREAD as FORCE_SPREAD_BOUND, MAX_CASES, MAX_FAILURE_TIMES, SPREAD};
use crate::laws::{LawName, LawSet};
use crate::scenario::CampaignSettings;
use ulna_table::toml_reader::{Key, Kind, Limit, Need, Section};

/// What counts where a key is left out.
pub(in crate::scenario) const DEFAULTS: CampaignSettings = CampaignSettings {
    cases: 10_000,
    seed: 1,
    failure_times: 20,
    start_spread: 0.5,
    goal_spread: 0.5,
    force_spread: 20.0,
    laws: LawSet::of(&[
        LawName::PerJoint,
        LawName::Projected,
        LawName::Kinematic,
        LawName::AfterOnly,
        LawName::OnLine,
        LawName::Limit,
    ]),
};

/// Why a campaign cannot have `law`; `None` if it can.
pub(in crate::scenario) fn refusal(law: LawName) -> Option<&'static str> {
    match law {
        LawName::None => Some("what no law leaves is always there, as `before`"),
        LawName::ConstantPerJoint | LawName::ConstantProjected | LawName::Robust => {
            Some("it is made for all failures of one motion, and each case has a motion of its own")
        }
        LawName::PerJoint
        | LawName::Projected
        | LawName::Kinematic
        | LawName::AfterOnly
        | LawName::OnLine
        | LawName::Limit => None,
    }
}

pub(super) static CAMPAIGN: Section = Section {
    header: "[campaign]",
    meaning: "At most once: all ranges are symmetric and uniform",
    example: "[campaign]\ncases = 10_000\nseed = 1\nfailure_times = 20\nstart_spread = 0.5\ngoal_spread = 0.5\nforce_spread = 20.0\n\
              laws = [\"eq16\", \"eq20\", \"on_line\", \"limit\"]\n",
    keys: &[
        &CASES,
        &SEED,
        &FAILURE_TIMES,
        &START_SPREAD,
        &GOAL_SPREAD,
        &FORCE_SPREAD,
        &LAWS,
    ],
};

pub(in crate::scenario) static CASES: Key =
    Key::required("cases", Kind::Whole, "How many cases", "`cases = 10_000`")
        .limits(&[Limit::Count(MAX_CASES)])
        .need(Need::Default(|| DEFAULTS.cases.to_string()));
pub(in crate::scenario) static SEED: Key = Key::required(
    "seed",
    Kind::Whole,
    "The seed of all random numbers",
    "`seed = 1`",
)
.need(Need::Default(|| DEFAULTS.seed.to_string()));
pub(in crate::scenario) static FAILURE_TIMES: Key = Key::required(
    "failure_times",
    Kind::Whole,
    "How many failure times, evenly spread over the motion",
    "`failure_times = 20`",
)
.limits(&[Limit::Count(MAX_FAILURE_TIMES)])
.need(Need::Default(|| DEFAULTS.failure_times.to_string()));
pub(in crate::scenario) static START_SPREAD: Key = Key::required(
    "start_spread",
    Kind::Number,
    "Each joint's start is moved by at most so much",
    "`start_spread = 0.5`",
)
.limits(&[Limit::Within(&SPREAD)])
.need(Need::Default(|| format!("{:?}", DEFAULTS.start_spread)));
pub(in crate::scenario) static GOAL_SPREAD: Key = Key::required(
    "goal_spread",
    Kind::Number,
    "Each joint's goal is moved by at most so much",
    "`goal_spread = 0.5`",
)
.limits(&[Limit::Within(&SPREAD)])
.need(Need::Default(|| format!("{:?}", DEFAULTS.goal_spread)));
pub(in crate::scenario) static FORCE_SPREAD: Key = Key::required(
    "force_spread",
    Kind::Number,
    "Each component of the tool force that the task has is within so much, constant in time",
    "`force_spread = 20.0`",
)
.limits(&[Limit::Within(&FORCE_SPREAD_BOUND)])
.need(Need::Default(|| format!("{:?}", DEFAULTS.force_spread)));
pub(in crate::scenario) static LAWS: Key = Key::required(
    "laws",
    Kind::List(&Kind::Words(laws_of_campaigns), "at least one"),
    "Which laws meet every case, tuned for it where they are tuned; results keep to the order below, however they are written",
    "`laws = [\"eq16\", \"on_line\"]`",
)
.limits(&[Limit::Said(|| "each once".to_owned())])
.need(Need::Default(|| {
    let laws: Vec<_> = DEFAULTS.laws.iter().map(LawName::name).collect();
    format!("{laws:?}")
}));

fn laws_of_campaigns() -> Vec<(&'static str, &'static str)> {
    let laws = LawName::ALL.into_iter();
    let laws = laws.filter(|law| refusal(*law).is_none());
    laws.map(|law| (law.name(), law.meaning())).collect()
}
