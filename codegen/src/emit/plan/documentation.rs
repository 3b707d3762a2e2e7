//! What is said about a method: what it computes, of what, in what units, at what cost; and what the names in it mean.

use std::collections::BTreeSet;

use super::names::angle_names;
use super::{PAYLOAD, Plan};
use crate::accuracy::rounded_up;
use crate::cost::Counts;
use crate::formulate::legend::{meaning, place};
use crate::label::Label;
use crate::schedule::Program;

/// What an arm carries.
const CARRIED: &str = " - `payload`: of what the arm carries, about the origin of the last link's frame, m, mx, my, mz, Ixx, Ixy, Ixz, Iyy, Iyz, Izz";

/// The parts of a method's docs, in lines that begin with a space.
pub(in crate::emit) struct Documentation {
    /// What the method computes: its docs in the trait.
    pub(in crate::emit) about: Vec<&'static str>,
    /// Of each argument, its name and what it is.
    pub(in crate::emit) arguments: Vec<(&'static str, &'static str)>,
    /// What the kernel returns.
    pub(in crate::emit) returns: &'static str,
    /// Operations, and how exact it is.
    pub(in crate::emit) cost: [String; 2],
    /// What names mean, a line for each family; empty if there are none.
    pub(in crate::emit) legend: Vec<String>,
}

impl Documentation {
    /// What there is to say about `plan`. `results` tells whether results have their own names; `element` is how one is written, given the
    /// number of its part, as `tau_i` for example: how many indices it has, called i, j and k and counted from 1.
    pub(in crate::emit) fn of(
        plan: &Plan<'_>,
        results: bool,
        element: &dyn Fn(usize) -> String,
    ) -> Self {
        let method = plan.compiled.method;
        let program = &plan.compiled.program;
        let counts = Counts::of(program);
        let (operations, angles) = (counts.total, counts.sin_cos);
        let trigonometry = match angles {
            0 => String::new(),
            1 => ", and sine and cosine of 1 angle".to_owned(),
            _ => format!(", and sines and cosines of {angles} angles"),
        };
        let cost = [
            format!(" Operations: {operations}{trigonometry}."),
            format!(
                " Rounding error of the worst entry, relative to the largest: {}.",
                rounded_up(plan.compiled.error)
            ),
        ];
        let payload = plan
            .arguments
            .iter()
            .any(|argument| argument.name == PAYLOAD);
        let payload = payload.then(|| CARRIED.to_owned());
        let legend = payload.into_iter().chain(angles_line(program));
        let legend = legend.chain(families(plan, plan.labels(results), element));
        let names = plan.values.iter().map(|value| value.name.as_str());
        Self {
            about: method.documentation().to_vec(),
            arguments: method
                .arguments()
                .iter()
                .map(|argument| (argument.name(), argument.meaning()))
                .collect(),
            returns: method.returns(),
            cost,
            legend: legend.chain(endings(names)).collect(),
        }
    }
}

/// What sines and cosines are called.
fn angles_line(program: &Program) -> Option<String> {
    let longest = program
        .angles
        .iter()
        .zip(angle_names(&program.angles))
        .max_by_key(|(angle, _)| angle.joints.len());
    let (angle, name) = longest?;
    let joints = angle.joints.iter().map(|joint| format!("q_{}", joint + 1));
    let fixed = match program.angles.iter().any(|angle| angle.offset != 0.0) {
        true => ", with what the table adds to it",
        false => "",
    };
    Some(format!(
        " - `s{name}, c{name}`: sine and cosine of {}{fixed}",
        joints.collect::<Vec<_>>().join(" + ")
    ))
}

/// What is behind a name, or before one, or instead of one.
fn endings<'a>(names: impl Iterator<Item = &'a str>) -> impl Iterator<Item = String> {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|c| c.is_ascii_digit());
    let mut found = [false; 5];
    for name in names {
        let positive = name.strip_suffix("_neg").unwrap_or(name);
        let turned = positive
            .strip_suffix("_z")
            .or_else(|| positive.strip_suffix("_zx"));
        let turned = turned.is_some_and(|rest| rest.ends_with(|c: char| c.is_ascii_digit()));
        let term = name.rsplit_once("_term");
        found[0] |= turned;
        found[1] |= positive.len() < name.len();
        found[2] |= term.is_some_and(|(_, rest)| is_number(rest));
        found[3] |= ["_before", "_before_x"]
            .iter()
            .any(|ending| positive.ends_with(ending));
        found[4] |= name.strip_prefix('t').is_some_and(is_number);
    }
    let lines = [
        " - `x_z, x_zx`: x turned about z by the joint's angle, and then about x into the axes of the link before",
        " - `x_neg`: what stands behind the minus of x",
        " - `x_term1 ...`: a term of the sum x, or its first terms together",
        " - `x_before, x_before_x`: x as the link before has it, in that link's axes; turned about x, and not yet about z",
        " - `t1 ...`: parts of formulas, without a name",
    ];
    let lines = lines.into_iter().zip(found);
    lines
        .filter(|(_, found)| *found)
        .map(|(line, _)| line.to_owned())
}

/// A line for each family of names, in the legend's order. Families without a meaning there are results, called after them.
fn families<'p>(
    plan: &Plan<'_>,
    labels: impl Iterator<Item = &'p Label>,
    element: &dyn Fn(usize) -> String,
) -> impl Iterator<Item = String> {
    let families: BTreeSet<(usize, &str)> = labels
        .map(|label| (place(label.family), label.family))
        .collect();
    families.into_iter().filter_map(move |(_, family)| {
        if let Some((names, meaning)) = meaning(family) {
            return Some(format!(" - `{names}`: {meaning}"));
        }
        let mut outputs = plan.outputs.iter();
        let part = outputs.position(|output| output.name == family)?;
        let dimensions = plan.outputs[part].shape.len();
        let indices: String = ["_i", "_j", "_k"].into_iter().take(dimensions).collect();
        Some(format!(" - `{family}{indices}`: `{}`", element(part)))
    })
}
