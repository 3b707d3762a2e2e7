//! [`Table`]: the arm of a new file or crate.

use std::fs;
use std::io;
use std::path::Path;

use anyhow::{Context, bail};
use ulna_table::{Model, name_for};

use super::fill::fill;
use crate::console;

/// The text of an arm's table, which has been found to be sound.
pub(super) struct Table {
    text: String,
    model: Model,
}

impl Table {
    /// The template, its arm named after the file at `path`.
    pub(super) fn of_template(path: &Path) -> anyhow::Result<Self> {
        let Some(stem) = path.file_stem() else {
            bail!(
                "{} names no file: write for example `ulna new my_arm.toml`",
                path.display()
            );
        };
        let stem = stem.to_string_lossy();
        let (name, fault) = name_for(&stem);
        if let Some(fault) = fault {
            console::note(&format!(
                "the arm is called `{name}`, since the name `{stem}` {fault}"
            ));
        }
        let text = fill(include_str!("template/my_arm.toml"), &[("my_arm", &name)]);
        let model = Model::parse(&text, &path.display().to_string())?;
        Ok(Self { text, model })
    }

    /// That at `path`, its warnings told; or if nothing is there, the template.
    pub(super) fn of_file_or_template(path: &Path) -> anyhow::Result<Self> {
        let shown = path.display();
        match fs::symlink_metadata(path) {
            Ok(_) => {
                let (text, model) = console::examine(path)?;
                Ok(Self { text, model })
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                console::note(&format!(
                    "there is no file {shown}: the arm is that of the template"
                ));
                Self::of_template(path)
            }
            Err(error) => Err(error).with_context(|| format!("cannot read {shown}")),
        }
    }

    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// What the arm is called.
    pub(super) fn name(&self) -> &str {
        self.model.name()
    }

    /// The type that it becomes.
    pub(super) fn type_name(&self) -> String {
        self.model.type_name()
    }
}

/// Refuses a `path` at which something is.
pub(super) fn refuse_existing(path: &Path) -> anyhow::Result<()> {
    // Of a symbolic link itself: where it leads is somebody's choice.
    if fs::symlink_metadata(path).is_ok() {
        bail!(
            "{shown} is there already, and stays as it is: name a new file, or `ulna check {shown}`",
            shown = path.display()
        );
    }
    Ok(())
}
