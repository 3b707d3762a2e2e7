//! Which arm a scenario is about: one that the program was compiled with, or any table.

use std::path::{Path, PathBuf};

use ulna::{Joint, JointKind};
use ulna_table::diagnostics::{Diagnostic, Diagnostics, Sink};
use ulna_table::toml_reader::{Located, closest};
use ulna_table::{Model, TableErrors};

/// An arm that the program was compiled with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownArm {
    /// The name in its table.
    pub name: &'static str,
    /// Its joints, base first.
    pub joints: &'static [Joint],
    /// What they are called, base first.
    pub joint_names: &'static [&'static str],
}

/// The arm of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub enum ScenarioArm {
    /// One that the program was compiled with.
    Known(KnownArm),
    /// Read from a table.
    Table {
        /// Where the table is.
        path: PathBuf,
        /// What is in it.
        model: Box<Model>,
    },
}

impl ScenarioArm {
    /// The arm's name.
    pub fn name(&self) -> &str {
        match self {
            Self::Known(arm) => arm.name,
            Self::Table { model, .. } => model.name(),
        }
    }

    /// Its joints, base first.
    pub fn joints(&self) -> &[Joint] {
        match self {
            Self::Known(arm) => arm.joints,
            Self::Table { model, .. } => model.joints(),
        }
    }

    /// A joint, counted from 0, as messages call it: by its number, and by its name where it has one.
    pub fn joint_called(&self, joint: usize) -> String {
        let name = match self {
            Self::Known(arm) => arm.joint_names.get(joint).copied(),
            Self::Table { model, .. } => model.joint_names().get(joint).map(String::as_str),
        };
        let number = format!("joint {}", joint + 1);
        match name {
            Some(name) if name != number => format!("{number} ({name})"),
            _ => number,
        }
    }

    /// The arm called `name`: a path if it ends in `.toml`, whose table `load` reads.
    /// `Err` with the table's errors, or without where the fault is in the scenario and has been reported.
    pub(super) fn find(
        name: &Located<String>,
        folder: &Path,
        known: &[KnownArm],
        load: &dyn Fn(&Path) -> Result<Model, TableErrors>,
        sink: &Sink,
    ) -> Result<Self, Option<Diagnostics>> {
        let written = name.value.as_str();
        if Path::new(written)
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let path = folder.join(written);
            return match load(&path) {
                Ok(model) => Ok(Self::Table {
                    path,
                    model: model.into(),
                }),
                Err(errors) => {
                    let message = format!("the table {written:?} is refused");
                    sink.push(
                        Diagnostic::error(name.span.clone(), message)
                            .label("for the reasons that follow"),
                    );
                    Err(Some(errors))
                }
            };
        }
        if let Some(arm) = known.iter().find(|arm| arm.name == written) {
            return Ok(Self::Known(*arm));
        }
        let names: Vec<_> = known.iter().map(|arm| arm.name).collect();
        let help = match closest(written, names.iter().copied()) {
            Some(meant) => format!("did you mean {meant:?}?"),
            None => format!(
                "compiled into the program: {}; for any other arm write the path of its table, ending in .toml",
                names.join(", ")
            ),
        };
        let message = format!("no arm is called `{}`", written.escape_debug());
        sink.push(
            Diagnostic::error(name.span.clone(), message)
                .label("unknown arm")
                .help(help),
        );
        Err(None)
    }
}

/// What of a joint's DH row moves, at q = 0: θ of a revolute joint, d of a prismatic one.
pub(super) fn zero_position(joint: &Joint) -> f64 {
    match joint.kind {
        JointKind::Revolute => joint.theta.radians,
        JointKind::Prismatic => joint.d,
    }
}
