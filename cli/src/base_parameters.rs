//! `ulna cost --base-parameters`: which combinations of inertial parameters an arm's torques depend on.

use std::io::{self, Write};

use serde_json::{Value, json};
use ulna::Parameter;
use ulna_codegen::{BaseParameter, BaseParameters};
use ulna_table::Model;

/// A line for each, or JSON; links count from 1.
///
/// # Errors
/// What writing fails with.
pub(crate) fn print(model: &Model, as_json: bool, out: &mut dyn Write) -> io::Result<()> {
    let base = BaseParameters::of(model);
    if as_json {
        let list: Vec<Value> = base.list().iter().map(value).collect();
        let all = json!({ "arm": model.name(), "base_parameters": list });
        return writeln!(out, "{all:#}");
    }
    writeln!(
        out,
        "{}: {} base parameters of {} inertial ones, about the origins of the links' frames",
        model.name(),
        base.list().len(),
        base.links() * Parameter::COUNT
    )?;
    base.list()
        .iter()
        .try_for_each(|base| writeln!(out, "{base}"))
}

fn value(base: &BaseParameter) -> Value {
    let grouped = base.grouped.iter().map(|term| {
        json!({
            "coefficient": term.coefficient,
            "link": term.link + 1,
            "parameter": term.parameter.name(),
        })
    });
    let grouped: Vec<Value> = grouped.collect();
    json!({ "link": base.link + 1, "parameter": base.parameter.name(), "grouped": grouped })
}
