//! `[[experiment]]`, its references and its figures.

use super::{List, Number, Numbers, list, number, string, text_of};
use crate::scenario::format::experiment as format;
use ulna_table::diagnostics::{Diagnostic, Sink};
use ulna_table::toml_reader::{Fields, Located, Value};

/// `[[experiment]]`
pub(in crate::scenario) struct ExperimentTable {
    pub(in crate::scenario) section: Option<Located<String>>,
    pub(in crate::scenario) title: String,
    pub(in crate::scenario) force: Option<Located<Vec<Option<Numbers>>>>,
    pub(in crate::scenario) moment: Option<Located<Vec<Option<Numbers>>>>,
    pub(in crate::scenario) rated_torque: Option<RatedTable>,
    pub(in crate::scenario) step_time: Number,
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

/// `rated_torque` where it is a word.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::scenario) enum RatedWord {
    None,
    OfArm,
}

/// `[[experiment.reference]]`
pub(in crate::scenario) struct ReferenceTable {
    pub(in crate::scenario) source: String,
    pub(in crate::scenario) time: Number,
    pub(in crate::scenario) failed_joints: List,
    pub(in crate::scenario) joints: List,
    pub(in crate::scenario) before: List,
    pub(in crate::scenario) after: List,
    pub(in crate::scenario) coefficients: List,
    pub(in crate::scenario) free_after: List,
    pub(in crate::scenario) decrease: List,
    pub(in crate::scenario) mean_room: Number,
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
        section: string(fields.value(&format::SECTION)),
        title: text_of(fields.value(&format::TITLE)),
        force: fields.value(&format::FORCE).and_then(polynomials),
        moment: fields.value(&format::MOMENT).and_then(polynomials),
        rated_torque: fields
            .value(&format::RATED_TORQUE)
            .and_then(read_rated_torque),
        step_time: number(fields.value(&format::STEP_TIME)),
        references: fields
            .value(&format::REFERENCES)
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
            .value(&format::FIGURES)
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

pub(super) fn read_rated_torque(value: Value<'_>) -> Option<RatedTable> {
    if value.is_string() {
        Some(match value.choice()?.value {
            RatedWord::None => RatedTable::None,
            RatedWord::OfArm => RatedTable::OfArm,
        })
    } else if value.is_array() {
        value.list_of_numbers().map(RatedTable::Each)
    } else {
        value.number().map(RatedTable::Common)
    }
}

fn read_reference(fields: &mut Fields<'_>, _: &str) -> ReferenceTable {
    ReferenceTable {
        source: text_of(fields.value(&format::SOURCE)),
        time: number(fields.value(&format::REFERENCE_TIME)),
        failed_joints: list(fields.value(&format::REFERENCE_FAILED_JOINTS)),
        joints: list(fields.value(&format::REFERENCE_JOINTS)),
        before: list(fields.value(&format::BEFORE)),
        after: list(fields.value(&format::AFTER)),
        coefficients: list(fields.value(&format::COEFFICIENTS)),
        free_after: list(fields.value(&format::FREE_AFTER)),
        decrease: list(fields.value(&format::DECREASE)),
        mean_room: number(fields.value(&format::MEAN_ROOM)),
    }
}

fn read_figure(fields: &mut Fields<'_>, _: &str) -> FigureTable {
    let name = string(fields.value(&format::FIGURE_NAME));
    let kind: Option<Located<FigureWord>> =
        fields.value(&format::FIGURE_KIND).and_then(Value::choice);
    let kind = kind.map(|kind| kind.value);
    let of_torque = kind != Some(FigureWord::Impact);
    FigureTable {
        name,
        kind,
        joints: list(fields.value_if(&format::FIGURE_JOINTS, of_torque)),
        time: number(fields.value_if(&format::FIGURE_TIME, of_torque)),
    }
}
