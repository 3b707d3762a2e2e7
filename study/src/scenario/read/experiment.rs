//! `[[experiment]]`, its references and its figures.

use super::{List, Number, Numbers, list, number, string, text_of};
use ulna_table::diagnostics::{Diagnostic, Sink};
use ulna_table::toml_reader::{Fields, Located, Value};

/// `[[experiment]]`
pub(in crate::scenario) struct ExperimentTable {
    pub(in crate::scenario) section: Option<Located<String>>,
    pub(in crate::scenario) title: String,
    pub(in crate::scenario) force: Option<Located<Vec<Option<Numbers>>>>,
    pub(in crate::scenario) moment: Option<Located<Vec<Option<Numbers>>>>,
    pub(in crate::scenario) rated_torque: Option<RatedTable>,
    pub(in crate::scenario) references: Vec<ReferenceTable>,
    pub(in crate::scenario) figures: Vec<FigureTable>,
}

/// `rated_torque` of `[[experiment]]`
pub(in crate::scenario) enum RatedTable {
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
pub(in crate::scenario) struct ReferenceTable {
    pub(in crate::scenario) source: String,
    pub(in crate::scenario) time: Number,
    pub(in crate::scenario) joints: List,
    pub(in crate::scenario) before: List,
    pub(in crate::scenario) after: List,
    pub(in crate::scenario) coefficients: List,
}

/// `[[experiment.figure]]`
pub(in crate::scenario) struct FigureTable {
    pub(in crate::scenario) name: Option<Located<String>>,
    pub(in crate::scenario) kind: Option<FigureWord>,
    pub(in crate::scenario) joints: List,
    pub(in crate::scenario) time: Number,
}

/// What a figure shows.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::scenario) enum FigureWord {
    Torque,
    Impact,
}

pub(super) fn read_experiments(value: Value<'_>, sink: &Sink) -> Option<Vec<ExperimentTable>> {
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
    Value::tables(rows, |i| format!("experiment {i}"), read_experiment)
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
            .and_then(|rows| {
                Value::tables(
                    rows,
                    |i| format!("reference {i} of {owner}"),
                    read_reference,
                )
            })
            .unwrap_or_default(),
        figures: fields
            .optional(
                "figure",
                "[[experiment.figure]]` with name and kind below it",
            )
            .and_then(|value| value.items("a list, each under its own [[experiment.figure]]"))
            .and_then(|rows| Value::tables(rows, |i| format!("figure {i} of {owner}"), read_figure))
            .unwrap_or_default(),
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

fn read_reference(fields: &mut Fields<'_>, _: &str) -> ReferenceTable {
    ReferenceTable {
        source: text_of(fields.required("source", "source = \"paper, Table 2\"")),
        time: number(fields.required("time", "time = 10.0")),
        joints: list(fields.optional("joints", "joints = [4, 5, 6]")),
        before: list(fields.optional("before", "before = [30.18, 66.72]")),
        after: list(fields.optional("after", "after = [0.15, 0.14]")),
        coefficients: list(fields.optional("coefficients", "coefficients = [1e7, -1e7]")),
    }
}

fn read_figure(fields: &mut Fields<'_>, _: &str) -> FigureTable {
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
