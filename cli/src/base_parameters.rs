//! `ulna cost --base-parameters`: which combinations of inertial parameters an arm's torques depend on.

use std::io::{self, Write};

use serde_json::{Value, json};
use ulna::Parameter;
use ulna_codegen::{BaseParameter, BaseParameters};
use ulna_table::Model;

/// A line for each; links count from 1.
///
/// # Errors
/// What writing fails with.
pub(crate) fn write(model: &Model, out: &mut dyn Write) -> io::Result<()> {
    let base = BaseParameters::of(model);
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

/// All of them as JSON; links count from 1.
pub(crate) fn json(model: &Model) -> Value {
    let list: Vec<Value> = BaseParameters::of(model).list().iter().map(value).collect();
    json!({ "arm": model.name(), "base_parameters": list })
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
