//! TOML text → [`ScenarioTable`]: a scenario as it is written, every value with its place in the text.
//!
//! After this stage keys, types and words are right. Numbers of joints, units and bounds are `validate`'s business.
//! A `None` stands for a value that is absent or has been reported.

use crate::diagnostics::{Diagnostic, Sink};
use crate::simulation::BrakeProfile;
use crate::table::AngleUnit;
use crate::toml_reader::{self, Fields, Located, Value};

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

/// `[motion]`
pub(super) struct MotionTable {
    pub(super) angles: Option<Angles>,
    pub(super) start: List,
    pub(super) path: Option<PathTable>,
    pub(super) duration: Number,
    pub(super) blend: Number,
    pub(super) max_velocity: List,
    pub(super) max_acceleration: List,
}

/// What the numbers of a position are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Angles {
    /// The quantity that moves in the joint's DH row: θ + q, or d + q.
    Dh,
    /// q itself.
    Q,
}

/// Where the motion leads.
pub(super) enum PathTable {
    /// `goal`
    Joint(List),
    /// `displacement`
    Tool(List),
}

#[derive(Clone, Copy)]
enum MotionKind {
    Joint,
    Tool,
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

/// `[[experiment]]`
pub(super) struct ExperimentTable {
    pub(super) section: Option<Located<String>>,
    pub(super) title: String,
    pub(super) force: Option<Located<Vec<Option<Numbers>>>>,
    pub(super) moment: Option<Located<Vec<Option<Numbers>>>>,
    pub(super) rated_torque: Option<RatedTable>,
    pub(super) references: Vec<ReferenceTable>,
    pub(super) figures: Vec<FigureTable>,
}

/// `rated_torque` of `[[experiment]]`
pub(super) enum RatedTable {
    /// No limit.
    None,
    /// The arm's own.
    OfArm,
    /// One for all joints.
    Common(Located<f64>),
    /// One for each joint.
    Each(Located<Numbers>),
}

/// `[[experiment.reference]]`
pub(super) struct ReferenceTable {
    pub(super) source: String,
    pub(super) time: Number,
    pub(super) joints: List,
    pub(super) before: List,
    pub(super) after: List,
    pub(super) coefficients: List,
}

/// `[[experiment.figure]]`
pub(super) struct FigureTable {
    pub(super) name: Option<Located<String>>,
    pub(super) kind: Option<FigureWord>,
    pub(super) joints: List,
    pub(super) time: Number,
}

/// What a figure shows.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FigureWord {
    Torque,
    Impact,
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
            angle_unit: fields
                .required(
                    "angle_unit",
                    "angle_unit = \"deg\"` or `angle_unit = \"rad\"",
                )
                .and_then(|value| value.choice(&AngleUnit::WORDS))
                .map(|unit| unit.value),
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

fn read_motion(motion: &mut Fields<'_>) -> MotionTable {
    let kinds = [("joint", MotionKind::Joint), ("tool", MotionKind::Tool)];
    let kind = motion
        .required("kind", "kind = \"joint\"` or `kind = \"tool\"")
        .and_then(|kind| kind.choice(&kinds));
    let angles = [("dh", Angles::Dh), ("q", Angles::Q)];
    MotionTable {
        angles: motion
            .required("angles", "angles = \"dh\"` or `angles = \"q\"")
            .and_then(|value| value.choice(&angles))
            .map(|angles| angles.value),
        start: list(motion.required(
            "start",
            "start = [0.0, 0.5]` with a number for each joint, `[0.0, 0.5]",
        )),
        path: match kind.map(|kind| kind.value) {
            Some(MotionKind::Joint) => Some(PathTable::Joint(list(
                motion.required("goal", "goal = [1.0, 0.5]"),
            ))),
            Some(MotionKind::Tool) => Some(PathTable::Tool(list(motion.required(
                "displacement",
                "displacement = [0.0, 0.0, 0.5, 0.0, 0.0, 0.0]",
            )))),
            None => {
                // Either key may be meant: none is unknown.
                motion.optional("goal", "goal = [1.0, 0.5]");
                motion.optional(
                    "displacement",
                    "displacement = [0.0, 0.0, 0.5, 0.0, 0.0, 0.0]",
                );
                None
            }
        },
        duration: number(motion.required("duration", "duration = 20.0")),
        blend: number(motion.required("blend", "blend = 4.0")),
        max_velocity: list(motion.optional("max_velocity", "max_velocity = [0.5, 0.5]")),
        max_acceleration: list(
            motion.optional("max_acceleration", "max_acceleration = [0.1, 0.1]"),
        ),
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

fn read_experiments(value: Value<'_>, sink: &Sink) -> Option<Vec<ExperimentTable>> {
    let place = value.location();
    let rows = value.items("a list of experiments, each under its own [[experiment]]")?;
    if rows.is_empty() {
        sink.push(
            Diagnostic::error(place.span, "a scenario without experiments")
                .label("empty")
                .help("write `[[experiment]]` once for each tool force"),
        );
        return None;
    }
    let read = |(i, experiment): (usize, Value<'_>)| {
        let owner = format!("experiment {}", i + 1);
        experiment.table(&owner, |fields| read_experiment(fields, &owner))
    };
    let read: Vec<_> = rows.into_iter().enumerate().map(read).collect();
    read.into_iter().collect()
}

fn read_experiment(fields: &mut Fields<'_>, owner: &str) -> ExperimentTable {
    ExperimentTable {
        section: string(fields.required("section", "section = \"5.2\"")),
        title: text_of(fields.optional("title", "title = \"constant force\"")),
        force: fields
            .required("force", "force = [20.0, 20.0, 20.0]")
            .and_then(polynomials),
        moment: fields
            .optional("moment", "moment = [0.0, 0.0, 0.0]")
            .and_then(polynomials),
        rated_torque: fields
            .required(
                "rated_torque",
                "rated_torque = \"table\"` or `rated_torque = 300.0",
            )
            .and_then(read_rated_torque),
        references: fields
            .optional(
                "reference",
                "[[experiment.reference]]` with source, time, before and after below it",
            )
            .and_then(|value| value.items("a list, each under its own [[experiment.reference]]"))
            .unwrap_or_default()
            .into_iter()
            .enumerate()
            .filter_map(|(i, value)| {
                let owner = format!("reference {} of {owner}", i + 1);
                value.table(&owner, read_reference)
            })
            .collect(),
        figures: fields
            .optional(
                "figure",
                "[[experiment.figure]]` with name and kind below it",
            )
            .and_then(|value| value.items("a list, each under its own [[experiment.figure]]"))
            .unwrap_or_default()
            .into_iter()
            .enumerate()
            .filter_map(|(i, value)| {
                let owner = format!("figure {} of {owner}", i + 1);
                value.table(&owner, read_figure)
            })
            .collect(),
    }
}

/// An array of which each item is a number or the coefficients of a polynomial, the constant first.
fn polynomials(value: Value<'_>) -> Option<Located<Vec<Option<Numbers>>>> {
    let place = value.location();
    let items = value.items("an array of numbers or of lists of coefficients")?;
    let read = |item: Value<'_>| {
        if item.is_array() {
            item.list_of_numbers().map(|list| list.value)
        } else {
            item.number().map(|number| vec![Some(number)])
        }
    };
    Some(place.map(|()| items.into_iter().map(read).collect()))
}

fn read_rated_torque(value: Value<'_>) -> Option<RatedTable> {
    if value.is_string() {
        let choices = [("none", false), ("table", true)];
        let of_arm = value.choice(&choices)?.value;
        Some(if of_arm {
            RatedTable::OfArm
        } else {
            RatedTable::None
        })
    } else if value.is_array() {
        value.list_of_numbers().map(RatedTable::Each)
    } else {
        value.number().map(RatedTable::Common)
    }
}

fn read_reference(fields: &mut Fields<'_>) -> ReferenceTable {
    ReferenceTable {
        source: text_of(fields.required("source", "source = \"paper, Table 2\"")),
        time: number(fields.required("time", "time = 10.0")),
        joints: list(fields.optional("joints", "joints = [4, 5, 6]")),
        before: list(fields.optional("before", "before = [30.18, 66.72]")),
        after: list(fields.optional("after", "after = [0.15, 0.14]")),
        coefficients: list(fields.optional("coefficients", "coefficients = [1e7, -1e7]")),
    }
}

fn read_figure(fields: &mut Fields<'_>) -> FigureTable {
    let kinds = [
        ("torque", FigureWord::Torque),
        ("impact", FigureWord::Impact),
    ];
    let name = string(fields.required("name", "name = \"my_figure\""));
    let kind = fields
        .required("kind", "kind = \"torque\"` or `kind = \"impact\"")
        .and_then(|kind| kind.choice(&kinds))
        .map(|kind| kind.value);
    let of_torque = kind != Some(FigureWord::Impact);
    FigureTable {
        name,
        kind,
        joints: list(
            of_torque
                .then(|| fields.required("joints", "joints = [1, 3]"))
                .flatten(),
        ),
        time: number(
            of_torque
                .then(|| fields.required("time", "time = 10.0"))
                .flatten(),
        ),
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
