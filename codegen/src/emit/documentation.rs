//! The docs of a kernel: what it computes, of what, in what units, at what cost; and what the names in it mean.

use std::collections::BTreeSet;

use super::names::angle_names;
use crate::MethodProgram;
use crate::accuracy::rounded_up;
use crate::cost::Counts;
use crate::formulate::legend::{meaning, place};
use crate::label::Label;
use crate::schedule::Program;

/// Above the legend.
const NAMES: &str = " Names, everything counted from 1:";

/// What an arm carries.
const PAYLOAD: &str = " - `payload`: of what the arm carries, about the origin of the last link's frame, m, mx, my, mz, Ixx, Ixy, Ixz, Iyy, Iyz, Izz";

/// The lines. `names` are those of its values, `labels` those of the values that the formulas gave a name; `payload` tells whether
/// it reads what the arm carries.
pub(super) fn lines<'p>(
    compiled: &MethodProgram,
    payload: bool,
    names: impl Iterator<Item = String>,
    labels: impl Iterator<Item = &'p Label>,
) -> Vec<String> {
    let counts = Counts::of(&compiled.program);
    let (operations, angles) = (counts.total, counts.sin_cos);
    let method = compiled.method;
    // The method's docs link to what their own crate calls `crate`.
    let about = method.documentation().iter();
    let mut lines: Vec<String> = about
        .map(|line| line.trim_end().replace("crate::", "ulna::"))
        .collect();
    lines.push(String::new());
    let arguments = method.arguments().iter();
    let arguments =
        arguments.map(|argument| format!("`{}`, {}", argument.name(), argument.meaning()));
    lines.push(format!(
        " Arguments: {}.",
        arguments.collect::<Vec<_>>().join("; ")
    ));
    lines.push(format!(" Returns: {}", method.returns()));
    let outputs = &compiled.program.outputs;
    if outputs.iter().any(|output| output.shape.len() > 1) {
        lines.push(" A matrix is the array of its columns.".to_owned());
    }
    lines.push(String::new());
    let trigonometry = match angles {
        0 => String::new(),
        1 => ", and sine and cosine of 1 angle".to_owned(),
        _ => format!(", and sines and cosines of {angles} angles"),
    };
    lines.push(format!(" Operations: {operations}{trigonometry}."));
    lines.push(format!(
        " Rounding error of the worst entry, relative to the largest: {}.",
        rounded_up(compiled.error)
    ));
    let payload = payload.then(|| PAYLOAD.to_owned());
    let legend = payload.into_iter().chain(angles_line(&compiled.program));
    let legend = legend.chain(families(compiled, labels));
    let mut legend = legend.chain(endings(names)).peekable();
    if legend.peek().is_some() {
        lines.extend([String::new(), NAMES.to_owned()]);
        lines.extend(legend);
    }
    lines
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
fn endings(names: impl Iterator<Item = String>) -> impl Iterator<Item = String> {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|c| c.is_ascii_digit());
    let mut found = [false; 5];
    for name in names {
        let positive = name.strip_suffix("_neg").unwrap_or(&name);
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
    compiled: &MethodProgram,
    labels: impl Iterator<Item = &'p Label>,
) -> impl Iterator<Item = String> {
    let families: BTreeSet<(usize, &str)> = labels
        .map(|label| (place(label.family), label.family))
        .collect();
    let outputs = &compiled.program.outputs;
    families.into_iter().filter_map(move |(_, family)| {
        if let Some((names, meaning)) = meaning(family) {
            return Some(format!(" - `{names}`: {meaning}"));
        }
        let part = outputs.iter().position(|output| output.name == family)?;
        let output = &outputs[part];
        let result = match outputs.len() {
            1 => "result".to_owned(),
            _ => format!("result.{part}"),
        };
        let indices = ["_i", "_j", "_k"].iter().take(output.shape.len());
        let places = ["[i - 1]", "[j - 1]", "[k - 1]"];
        let places = places.iter().take(output.shape.len());
        Some(format!(
            " - `{family}{}`: `{result}{}`",
            indices.copied().collect::<String>(),
            places.copied().collect::<String>(),
        ))
    })
}
