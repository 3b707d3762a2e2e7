//! `ulna convert`: the same arm in the other Denavit-Hartenberg convention.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use ulna::Placement;
use ulna_table::{Convention, Model};

use crate::output::write_whole;
use crate::{Verdict, console};

/// Rewrite a table in the other Denavit-Hartenberg convention, its physics unchanged
///
/// Every chain has both forms. What a form has no row for goes into [base] (a and alpha before the first joint, which
/// standard form lacks) or into [tool] (a and alpha behind the last one, which modified form lacks).
#[derive(Args)]
#[command(
    after_help = "Examples:\n  ulna convert arms/ssrms.toml --to standard\n  \
                  ulna convert arms/ssrms.toml --to standard --output target/ssrms_standard.toml"
)]
pub(crate) struct Arguments {
    /// The arm's table (TOML)
    table: PathBuf,
    /// The convention to write
    #[arg(long, value_name = "CONVENTION")]
    to: Form,
    /// The file to write, whole or not at all; without it the table goes to stdout
    #[arg(long, short, value_name = "TABLE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Form {
    /// Denavit and Hartenberg's: a row holds a_i and alpha_i
    Standard,
    /// Craig's: a row holds a_{i-1} and alpha_{i-1}
    Modified,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let path = &arguments.table;
    let (text, model) = console::examine(path)?;
    let to = match arguments.to {
        Form::Standard => Convention::Standard,
        Form::Modified => Convention::Modified,
    };
    if model.convention() == to {
        let form = form(to);
        let path = path.display();
        console::note(&format!(
            "{path} is in {form} form already: it is written anew"
        ));
    }
    // A model is in modified form, whatever its table is in.
    let given = model.description();
    let arm = given.in_convention(to);
    let mut heading = comments(&text);
    heading.push(said(path, &model, to));
    if arm.base != given.base {
        heading
            .push("What stood in a and alpha before the first joint is a part of [base].".into());
    }
    if model.convention() != to && to == Convention::Modified && given.tool != Placement::IDENTITY {
        heading.push("What stood in a and alpha behind the last joint is a part of [tool].".into());
    }
    let table = arm
        .to_table(model.angle_unit())
        .heading(&heading.join("\n"))
        .to_string();
    // A number at the edge of its bound may have been rounded over it.
    Model::parse(&table, "the converted table")?;
    match &arguments.output {
        None => out.write_all(table.as_bytes())?,
        Some(file) => write_whole(file, table.as_bytes())?,
    }
    Ok(Verdict::Pass)
}

/// The comments before the first key: what the arm is, and where its numbers are from.
fn comments(text: &str) -> Vec<String> {
    let lines = text.trim_start_matches('\u{feff}').lines();
    let comments = lines.map_while(|line| line.trim().strip_prefix('#'));
    let mut comments: Vec<String> = comments.map(|line| line.trim().to_owned()).collect();
    if !comments.is_empty() {
        comments.push(String::new());
    }
    comments
}

fn said(path: &Path, model: &Model, to: Convention) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    format!(
        "Written by `ulna convert` from {} in {} form; com and inertia are in the frames of these rows in {} form.",
        name.display(),
        form(model.convention()),
        form(to)
    )
}

fn form(convention: Convention) -> &'static str {
    match convention {
        Convention::Standard => "standard",
        Convention::Modified => "modified",
    }
}
