//! The docs of a kernel.

use super::super::plan::{Documentation, Plan};

/// Above the legend.
const NAMES: &str = " Names, everything counted from 1:";

/// The lines. `results` tells whether results have names of their own.
pub(super) fn lines(plan: &Plan<'_>, results: bool) -> Vec<String> {
    let found = Documentation::of(plan, results, &|part| element(plan, part));
    // The method's docs link to what their own crate calls `crate`.
    let about = found.about.iter();
    let mut lines: Vec<String> = about
        .map(|line| line.trim_end().replace("crate::", "ulna::"))
        .collect();
    lines.push(String::new());
    let arguments = found.arguments.iter();
    let arguments = arguments.map(|(name, meaning)| format!("`{name}`, {meaning}"));
    lines.push(format!(
        " Arguments: {}.",
        arguments.collect::<Vec<_>>().join("; ")
    ));
    lines.push(format!(" Returns: {}", found.returns));
    if plan.outputs.iter().any(|output| output.shape.len() > 1) {
        lines.push(" A matrix is the array of its columns.".to_owned());
    }
    lines.push(String::new());
    lines.extend(found.cost);
    if !found.legend.is_empty() {
        lines.extend([String::new(), NAMES.to_owned()]);
        lines.extend(found.legend);
    }
    lines
}

/// An element of a part of the result, as the function's user writes it.
fn element(plan: &Plan<'_>, part: usize) -> String {
    let result = match plan.outputs.len() {
        1 => "result".to_owned(),
        _ => format!("result.{part}"),
    };
    let places = ["[i - 1]", "[j - 1]", "[k - 1]"];
    let places = places.into_iter().take(plan.outputs[part].shape.len());
    format!("{result}{}", places.collect::<String>())
}
