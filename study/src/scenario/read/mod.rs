//! TOML text → [`ScenarioTable`]: a scenario as it is written, every value with its place in the text.
//!
//! After this stage keys, types and words are right. Numbers of joints, units and bounds are `validate`'s business.
//! A `None` stands for a value that is absent or has been reported.

mod drives;
mod experiment;
mod laws;
mod motion;

use super::format::{self, assess, campaign};
use crate::simulation::BrakeProfile;
use ulna_table::AngleUnit;
use ulna_table::diagnostics::Sink;
use ulna_table::toml_reader::{self, Fields, Located, SCENARIO, Value};

pub(super) use drives::{CommonOrEach, MotorsTable, ProjectorWord, ServoTable};
use drives::{read_motors, read_servo};
pub(super) use experiment::{
    ExperimentTable, FigureTable, FigureWord, RatedTable, RatedWord, ReferenceTable,
};
use experiment::{read_experiments, read_rated_torque};
pub(super) use laws::LawList;
use laws::read_laws;
use motion::read_motion;
pub(super) use motion::{Angles, MotionKind, MotionTable, PathTable, ProfileWord};

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
    pub(super) servo: ServoTable,
    pub(super) motors: MotorsTable,
    pub(super) experiments: Option<Vec<ExperimentTable>>,
    pub(super) campaign: CampaignTable,
    pub(super) assess: AssessTable,
}

/// `[failure]`
pub(super) struct FailureTable {
    pub(super) joints: List,
    pub(super) times: List,
    pub(super) step_time: Number,
    pub(super) force_step: List,
    pub(super) moment_step: List,
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
    pub(super) laws: LawList,
}

/// `[assess]`; all keys are optional.
#[derive(Default)]
pub(super) struct AssessTable {
    pub(super) failure_times: Option<Located<u64>>,
    pub(super) locks_at_once: Option<Located<u64>>,
    pub(super) force_budgets: List,
    pub(super) rate_limit: Number,
    pub(super) ramp: Number,
    pub(super) rated_torque: Option<RatedTable>,
    pub(super) laws: LawList,
}

impl ScenarioTable {
    /// Reads a scenario. `None` if `text` is no TOML; everything that is wrong goes to `sink`.
    pub(super) fn read(text: &str, sink: &Sink) -> Option<Self> {
        toml_reader::read(text, &SCENARIO, &format::SCENARIO, sink, |fields| Self {
            name: string(fields.value(&format::NAME)).map(|name| name.value),
            description: text_of(fields.value(&format::DESCRIPTION)),
            arm: string(fields.value(&format::ARM)),
            angle_unit: AngleUnit::read(fields),
            motion: fields
                .value(&format::MOTION)
                .and_then(|value| value.table("[motion]", read_motion)),
            failure: fields.value(&format::FAILURE).and_then(|value| {
                value.table("[failure]", |failure| FailureTable {
                    joints: list(failure.value(&format::FAILED_JOINTS)),
                    times: list(failure.value(&format::TIMES)),
                    step_time: number(failure.value(&format::STEP_TIME)),
                    force_step: list(failure.value(&format::FORCE_STEP)),
                    moment_step: list(failure.value(&format::MOMENT_STEP)),
                })
            }),
            cycle: fields
                .value(&format::CONTROL)
                .and_then(|value| {
                    value.table("[control]", |control| number(control.value(&format::CYCLE)))
                })
                .flatten(),
            search: fields.value(&format::SEARCH).and_then(|value| {
                value.table("[search]", |search| SearchTable {
                    start: number(search.value(&format::START)),
                    step: number(search.value(&format::STEP)),
                })
            }),
            brake: fields
                .value(&format::BRAKE)
                .and_then(|value| value.table("[brake]", read_brake))
                .unwrap_or_default(),
            servo: fields
                .value(&format::SERVO)
                .and_then(|value| value.table("[servo]", read_servo))
                .unwrap_or_default(),
            motors: fields
                .value(&format::MOTORS)
                .and_then(|value| value.table("[motors]", read_motors))
                .unwrap_or_default(),
            experiments: fields
                .value(&format::EXPERIMENTS)
                .and_then(|value| read_experiments(value, sink)),
            campaign: fields
                .value(&format::CAMPAIGN)
                .and_then(|value| value.table("[campaign]", read_campaign))
                .unwrap_or_default(),
            assess: fields
                .value(&format::ASSESS)
                .and_then(|value| value.table("[assess]", read_assess))
                .unwrap_or_default(),
        })
    }
}

fn read_brake(brake: &mut Fields<'_>) -> BrakeTable {
    BrakeTable {
        duration: number(brake.value(&format::BRAKE_DURATION)),
        profile: brake
            .value(&format::PROFILE)
            .and_then(Value::choice)
            .map(|profile| profile.value),
    }
}

fn read_campaign(fields: &mut Fields<'_>) -> CampaignTable {
    let mut whole = |key| fields.value(key).and_then(Value::whole_number);
    CampaignTable {
        cases: whole(&campaign::CASES),
        seed: whole(&campaign::SEED),
        failure_times: whole(&campaign::FAILURE_TIMES),
        start_spread: number(fields.value(&campaign::START_SPREAD)),
        goal_spread: number(fields.value(&campaign::GOAL_SPREAD)),
        force_spread: number(fields.value(&campaign::FORCE_SPREAD)),
        laws: fields.value(&campaign::LAWS).and_then(read_laws),
    }
}

fn read_assess(fields: &mut Fields<'_>) -> AssessTable {
    let mut whole = |key| fields.value(key).and_then(Value::whole_number);
    AssessTable {
        failure_times: whole(&assess::FAILURE_TIMES),
        locks_at_once: whole(&assess::LOCKS_AT_ONCE),
        force_budgets: list(fields.value(&assess::FORCE_BUDGETS)),
        rate_limit: number(fields.value(&assess::RATE_LIMIT)),
        ramp: number(fields.value(&assess::RAMP_TIME)),
        rated_torque: fields
            .value(&assess::ASSESSED_RATED_TORQUE)
            .and_then(read_rated_torque),
        laws: fields.value(&assess::LAWS).and_then(read_laws),
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
