//! `ulna new`: a table to fill in, or a crate around an arm.

mod fill;
mod package;
mod table;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::output::write_new;
use crate::{Verdict, console};
use package::Package;
use table::Table;

/// Start from nothing: a commented table to fill in, or a crate that builds, tests and runs at once
///
/// Nothing that is there already is touched.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  ulna new my_arm.toml\n  ulna new --crate my_robot my_arm.toml"
)]
pub(crate) struct Arguments {
    /// The table to write, a small arm with every key explained, named after the file. With --crate: the arm's table;
    /// if there is no such file, the template is written into the crate
    table: PathBuf,
    /// Make a crate in this folder, a new or an empty one: the arm compiled by a build script, a test, a bench
    /// and a controller's loop
    #[arg(long = "crate", value_name = "DIR")]
    package: Option<PathBuf>,
    /// The folder of a checkout of ulna, whose crates the new one takes instead of released ones of this version
    #[arg(long = "path", value_name = "CHECKOUT", requires = "package")]
    checkout: Option<PathBuf>,
}

pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<Verdict> {
    let path = &arguments.table;
    match &arguments.package {
        None => new_table(path)?,
        Some(folder) => new_package(path, folder, arguments.checkout.as_deref())?,
    }
    Ok(Verdict::Pass)
}

fn new_table(path: &Path) -> anyhow::Result<()> {
    table::refuse_existing(path)?;
    let table = Table::of_template(path)?;
    write_new(path, table.text().as_bytes())?;
    let shown = shown(path);
    console::note(&format!(
        "written: {path}, the arm `{arm}`\nnext, with your own numbers in it:\n  ulna check {shown}\n  ulna verify {shown}\n  \
         ulna generate {shown} --output {arm}.rs\n  ulna new --crate my_robot {shown}",
        path = path.display(),
        arm = table.name(),
    ));
    Ok(())
}

fn new_package(path: &Path, folder: &Path, checkout: Option<&Path>) -> anyhow::Result<()> {
    // What is wrong with the table comes first: it takes the longest to mend.
    let table = Table::of_file_or_template(path)?;
    let package = Package::new(folder, checkout)?;
    let written = package.write(&table)?;
    let files = written.iter().map(|file| format!("  {}", file.display()));
    console::note(&format!(
        "written: the crate `{package}` around the arm `{arm}`\n{files}\nnext:\n  cd {folder}\n  \
         cargo run       # a controller's loop\n  cargo test      # the code against the textbook's formulas\n  \
         cargo bench     # how long the methods take",
        package = package.name(),
        arm = table.name(),
        files = files.collect::<Vec<_>>().join("\n"),
        folder = shown(folder),
    ));
    Ok(())
}

/// A path as a shell takes it.
fn shown(path: &Path) -> String {
    let path = path.display().to_string();
    let plain = |c: char| c.is_alphanumeric() || "/\\.:_-+~".contains(c);
    if path.chars().all(plain) {
        path
    } else {
        format!("'{}'", path.replace('\'', r"'\''"))
    }
}
