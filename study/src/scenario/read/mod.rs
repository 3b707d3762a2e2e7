//! TOML text → [`ScenarioTable`]: a scenario as it is written, every value with its place in the text.
//!
//! After this stage keys, types and words are right. Numbers of joints, units and bounds are `validate`'s business.
//! A `None` stands for a value that is absent or has been reported.

mod experiment;
mod motion;

use crate::simulation::BrakeProfile;
use ulna_table::AngleUnit;
use ulna_table::diagnostics::Sink;
use ulna_table::toml_reader::{self, Fields, Located, Value};

use experiment::read_experiments;
pub(super) use experiment::{ExperimentTable, FigureTable, FigureWord, RatedTable, ReferenceTable};
use motion::read_motion;
pub(super) use motion::{Angles, MotionTable, PathTable};

/// Numbers, each read by itself.
pub(super) type Numbers = Vec<Option<Located<f64>>>;
/// One number for each joint, or for some.
pub(super) type List = Option<Located<Numbers>>;
/// A single number.
pub(super) type Number = Option<Located<f64>>;

/// A scenario, key by key.
pub(super) struct ScenarioTable {
    pub(super) name: Option<String>,
    pub(super) description: String,
    pub(super) arm: Option<Located<String>>,
    pub(super) angle_unit: Option<AngleUnit>,
    pub(super) motion: Option<MotionTable>,
    pub(super) failure: Option<FailureTable>,
    pub(super) cycle: Number,
    pub(super) search: Option<SearchTable>,
    pub(super) brake: BrakeTable,
    pub(super) experiments: Option<Vec<ExperimentTable>>,
    pub(super) campaign: CampaignTable,
}

/// `[failure]`
pub(super) struct FailureTable {
    pub(super) joints: List,
    pub(super) times: List,
}

/// `[search]`
pub(super) struct SearchTable {
    pub(super) start: Number,
    pub(super) step: Number,
}

/// `[brake]`; all keys are optional.
#[derive(Default)]
pub(super) struct BrakeTable {
    pub(super) duration: Number,
    pub(super) profile: Option<BrakeProfile>,
}

/// `[campaign]`; all keys are optional.
#[derive(Default)]
pub(super) struct CampaignTable {
    pub(super) cases: Option<Located<u64>>,
    pub(super) seed: Option<Located<u64>>,
    pub(super) failure_times: Option<Located<u64>>,
    pub(super) start_spread: Number,
    pub(super) goal_spread: Number,
    pub(super) force_spread: Number,
}

impl ScenarioTable {
    /// Reads a scenario. `None` if `text` is no TOML; everything that is wrong goes to `sink`.
    pub(super) fn read(text: &str, sink: &Sink) -> Option<Self> {
        toml_reader::read(text, sink, |fields| Self {
            name: string(fields.required("name", "name = \"my_scenario\"")).map(|name| name.value),
            description: text_of(
                fields.optional("description", "description = \"what it is about\""),
            ),
            arm: string(fields.required("arm", "arm = \"ssrms\"` or `arm = \"my_arm.toml\"")),
            angle_unit: AngleUnit::read(fields),
            motion: fields
                .required(
                    "motion",
                    "[motion]` with kind, angles, start, goal, duration and blend below it",
                )
                .and_then(|value| value.table("[motion]", read_motion)),
            failure: fields
                .required("failure", "[failure]` with joints and times below it")
                .and_then(|value| {
                    value.table("[failure]", |failure| FailureTable {
                        joints: list(failure.required("joints", "joints = [2]")),
                        times: list(failure.required("times", "times = [10.0]")),
                    })
                }),
            cycle: fields
                .required("control", "[control]` and below it `cycle = 0.01")
                .and_then(|value| {
                    value.table("[control]", |control| {
                        number(control.required("cycle", "cycle = 0.01"))
                    })
                })
                .flatten(),
            search: fields
                .required("search", "[search]` with start and step below it")
                .and_then(|value| {
                    value.table("[search]", |search| SearchTable {
                        start: number(search.required("start", "start = 0.0")),
                        step: number(search.required("step", "step = 1e6")),
                    })
                }),
            brake: fields
                .optional("brake", "[brake]` and below it `duration = 0.1")
                .and_then(|value| value.table("[brake]", read_brake))
                .unwrap_or_default(),
            experiments: fields
                .required("experiment", "[[experiment]]` once for each tool force")
                .and_then(|value| read_experiments(value, sink)),
            campaign: fields
                .optional("campaign", "[campaign]` and below it `cases = 10_000")
                .and_then(|value| value.table("[campaign]", read_campaign))
                .unwrap_or_default(),
        })
    }
}

fn read_brake(brake: &mut Fields<'_>) -> BrakeTable {
    let profiles = [
        ("constant", BrakeProfile::Constant),
        ("smooth", BrakeProfile::Smooth),
    ];
    BrakeTable {
        duration: number(brake.optional("duration", "duration = 0.1")),
        profile: brake
            .optional(
                "profile",
                "profile = \"constant\"` or `profile = \"smooth\"",
            )
            .and_then(|value| value.choice(&profiles))
            .map(|profile| profile.value),
    }
}

fn read_campaign(fields: &mut Fields<'_>) -> CampaignTable {
    CampaignTable {
        cases: fields
            .optional("cases", "cases = 10_000")
            .and_then(Value::whole_number),
        seed: fields
            .optional("seed", "seed = 1")
            .and_then(Value::whole_number),
        failure_times: fields
            .optional("failure_times", "failure_times = 20")
            .and_then(Value::whole_number),
        start_spread: number(fields.optional("start_spread", "start_spread = 0.5")),
        goal_spread: number(fields.optional("goal_spread", "goal_spread = 0.5")),
        force_spread: number(fields.optional("force_spread", "force_spread = 20.0")),
    }
}

fn number(value: Option<Value<'_>>) -> Number {
    value.and_then(Value::number)
}

fn list(value: Option<Value<'_>>) -> List {
    value.and_then(Value::list_of_numbers)
}

fn string(value: Option<Value<'_>>) -> Option<Located<String>> {
    let read = value.and_then(Value::string)?;
    Some(read.map(str::to_owned))
}

fn text_of(value: Option<Value<'_>>) -> String {
    string(value).map(|text| text.value).unwrap_or_default()
}
