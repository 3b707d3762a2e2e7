//! What is said above a function: in the header what it computes, of what, in what order; in the source what its names mean.

use ulna::Payload;

use super::super::plan::{Documentation, PAYLOAD, Plan};
use super::function::Results;
use super::lines::{paragraphs, plain, wrap};
use crate::schedule::Output;

/// What the kernel's docs say at their end of a number that the C function keeps for itself.
const KEPT: &str = ", and det(JJᵀ)";

/// How far the lines of an item are indented after its first.
const HANGING: usize = 4;

/// Above the prototype.
pub(super) fn prototype(plan: &Plan<'_>, payload: Option<&str>) -> Vec<String> {
    let found = Documentation::of(plan, false, &|_| String::new());
    let about: Vec<String> = found.about.iter().map(|line| plain(line)).collect();
    let mut lines = paragraphs(&about, 0);
    lines.push(String::new());
    let arguments = plan.arguments.iter().zip(&found.arguments);
    let arguments = arguments.map(|(argument, (name, meaning))| {
        format!("{name}[{}]: {}", argument.length, plain(meaning))
    });
    lines.extend(arguments);
    if let Some(function) = payload {
        lines.push(format!(
            "{PAYLOAD}[{}]: what the arm carries, as {function} writes it",
            Payload::PARAMETERS
        ));
    }
    let results = Results::of(plan);
    let returns = found.returns.split(KEPT).next().unwrap_or_default();
    let end = if returns.ends_with('.') { "" } else { "." };
    let result = format!("result[{}]: {}{end}", results.length, plain(returns));
    lines.extend(wrap(&result, HANGING));
    for (output, first) in results.outputs(plan) {
        lines.extend(layout(output, first, results.length).map(|line| format!("    {line}")));
    }
    lines.push(String::new());
    lines.extend(found.cost.iter().map(|line| plain(line)));
    lines
}

/// Where the numbers of an output stand, indices from 0; nothing to say of a single list.
fn layout<T>(output: &Output<T>, first: usize, length: usize) -> Option<String> {
    let name = output.name.replace('_', " ");
    let at = |index: &str| match first {
        0 => format!("result[{index}]"),
        _ => format!("result[{first} + {index}]"),
    };
    match output.shape.as_slice() {
        [] if length == 1 => None,
        [] => Some(format!("{name}: result[{first}]")),
        [n] if *n == length => None,
        [n] => Some(format!(
            "{name}: result[{first}] to result[{}]",
            first + n - 1
        )),
        [_, rows] => Some(format!(
            "{name}: row i of column j is {}",
            at(&format!("{rows} j + i"))
        )),
        [_, columns, rows] => Some(format!(
            "{name}: row i of column j of block k is {}",
            at(&format!("{} k + {rows} j + i", columns * rows))
        )),
        _ => None,
    }
}

/// Above the function itself.
pub(super) fn definition(plan: &Plan<'_>) -> Vec<String> {
    let element = |part| element(plan, part);
    let found = Documentation::of(plan, false, &element);
    if found.legend.is_empty() {
        return Vec::new();
    }
    let above = "Names, everything counted from 1:".to_owned();
    let legend = found.legend.iter().map(|line| plain(line));
    let legend = legend.flat_map(|line| wrap(&line, 2));
    [above].into_iter().chain(legend).collect()
}

/// An element of a result, its indices being called i, j and k and counted from 1.
fn element(plan: &Plan<'_>, part: usize) -> String {
    let results = Results::of(plan);
    let Some((output, first)) = results.outputs(plan).nth(part) else {
        return "det(JJᵀ) over the task's rows".to_owned();
    };
    let index = match output.shape.as_slice() {
        [] => return format!("result[{first}]"),
        [_] => "i - 1".to_owned(),
        [_, b] => format!("{b} (i - 1) + j - 1"),
        [_, b, c, ..] => format!("{} (i - 1) + {c} (j - 1) + k - 1", b * c),
    };
    match first {
        0 => format!("result[{index}]"),
        _ => format!("result[{first} + {index}]"),
    }
}

#[cfg(test)]
mod tests {
    use ulna::Method;

    use super::KEPT;

    /// Where a kernel returns det(JJᵀ), its docs end with that; where it does not, they do not speak of it like that.
    #[test]
    fn what_is_kept_is_not_documented() {
        for method in Method::ALL {
            let speaks = method.returns().contains(KEPT);
            assert_eq!(speaks, method.zero_where_singular().is_some(), "{method}");
        }
    }
}
