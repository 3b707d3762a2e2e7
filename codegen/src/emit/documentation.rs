//! The docs of a kernel: what it computes, of what, in what units, at what cost; and what the names in it mean.

use std::collections::BTreeSet;

use crate::MethodProgram;
use crate::accuracy::rounded_up;
use crate::cost::Counts;
use crate::formulate::legend::{meaning, place};
use crate::label::Label;

/// Above the legend.
const NAMES: &str = " Names, everything counted from 1; `x_neg` is what stands behind the minus of x, `x_term1` and so on are terms \
                     of the sum x or first parts of it, `t1` and so on have no name:";

/// The lines. `labels` are those of the values that have a name.
pub(super) fn lines<'p>(
    compiled: &MethodProgram,
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
        arguments.map(|argument| format!("`{}` {}", argument.name(), argument.meaning()));
    lines.push(format!(" Of {}.", arguments.collect::<Vec<_>>().join(", ")));
    lines.push(format!(" Returns: {}", method.returns()));
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
    let mut legend = legend(compiled, labels).peekable();
    if legend.peek().is_some() {
        lines.extend([String::new(), NAMES.to_owned()]);
        lines.extend(legend);
    }
    lines
}

/// A line for each family of names, in the legend's order. Families without a meaning there are results, called after them.
fn legend<'p>(
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
