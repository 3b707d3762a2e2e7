//! The model of an arm: SI units, radians, one convention, validated. What every backend is built from.
//!
//! A chain is kept in modified (Craig) Denavit–Hartenberg form,
//! `T_i = Rx(alpha) Tx(a) Rz(theta) Tz(d)` with the joint's axis along z of frame i.
//! A table in standard form is rewritten into it (see [`Model`]), so that nothing after this stage knows two conventions.

mod angle;
mod convention;
mod definite;
mod description;
mod drive;
mod inertia;
mod joint_names;
mod light;
mod name;
mod placement;
mod validate;
mod written;

pub(crate) use convention::standard_to_modified;
pub use description::Description;
pub use inertia::{ImpossibleInertia, impossible_inertia};
pub use joint_names::joint_name;
pub(crate) use joint_names::{RULE as JOINT_NAME_RULE, called, is_word};
pub use name::{is_keyword, name_for};
pub use written::{TableText, shortest};

use std::path::Path;

use sha2::{Digest, Sha256};
use ulna::{Joint, Placement, TaskRows};

use crate::diagnostics::{Diagnostics, Sink, TableErrors};
use crate::lint::{self, Lint, Places};
use crate::table::{AngleUnit, ArmTable, Author, Convention};
use crate::toml_reader::read_file;

/// A validated arm of any number of joints: read from a table, or made by a program from a [`Description`].
///
/// Nothing after this stage can fail on a user's input: there is no model that has not been examined, and none can be changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    name: String,
    gravity: [f64; 3],
    task: TaskRows,
    base: Placement,
    tool: Placement,
    payload: bool,
    joints: Vec<Joint>,
    joint_names: Vec<String>,
    allow: Vec<Lint>,
    accept_inertia: Vec<bool>,
    convention: Convention,
    angle_unit: AngleUnit,
    table_hash: String,
}

impl Model {
    /// The most bytes that a table may have; one of the most joints has a fifth of it.
    const MAX_BYTES: u64 = 256 * 1024;

    /// Reads the table at `path`.
    ///
    /// # Errors
    /// Everything that is wrong with the file, at once.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, TableErrors> {
        Self::lint(path).map(|(model, _)| model)
    }

    /// Reads the table `text`, which errors call `source_name`.
    ///
    /// # Errors
    /// Everything that is wrong with the text, at once.
    pub fn parse(text: &str, source_name: &str) -> Result<Self, TableErrors> {
        Self::lint_text(text, source_name).map(|(model, _)| model)
    }

    /// Reads the table at `path` in `folder`. Errors call it `path`, as the user wrote it, wherever `folder` is.
    ///
    /// # Errors
    /// Everything that is wrong with the file, at once.
    pub fn load_in(folder: impl AsRef<Path>, path: impl AsRef<Path>) -> Result<Self, TableErrors> {
        Self::lint_in(folder, path).map(|(model, _)| model)
    }

    /// [`Model::load_in`], together with warnings of what is allowed but rarely meant.
    ///
    /// # Errors
    /// Everything that is wrong with the file, at once.
    pub fn lint_in(
        folder: impl AsRef<Path>,
        path: impl AsRef<Path>,
    ) -> Result<(Self, Diagnostics), TableErrors> {
        let text = Self::read_in(folder, &path)?;
        Self::lint_text(&text, &path.as_ref().display().to_string())
    }

    /// The text of the table at `path` in `folder`, not examined: for who wants it beside what [`Model::lint_text`] makes of it.
    ///
    /// # Errors
    /// Why there is none, or that it is longer than any table.
    pub fn read_in(
        folder: impl AsRef<Path>,
        path: impl AsRef<Path>,
    ) -> Result<String, TableErrors> {
        read_file(folder.as_ref(), path.as_ref(), Self::MAX_BYTES)
    }

    /// [`Model::load`], together with warnings of what is allowed but rarely meant.
    ///
    /// # Errors
    /// Everything that is wrong with the file, at once.
    pub fn lint(path: impl AsRef<Path>) -> Result<(Self, Diagnostics), TableErrors> {
        Self::lint_in("", path)
    }

    /// [`Model::parse`], together with warnings of what is allowed but rarely meant.
    ///
    /// # Errors
    /// Everything that is wrong with the text, at once.
    pub fn lint_text(text: &str, source_name: &str) -> Result<(Self, Diagnostics), TableErrors> {
        Self::examine(text, source_name, Author::Person, |_, _| ())
    }

    /// The model of the table `text`. `amend` may take out of the table what it reports.
    fn examine(
        text: &str,
        source_name: &str,
        author: Author,
        amend: impl FnOnce(&mut ArmTable, &Sink),
    ) -> Result<(Self, Diagnostics), TableErrors> {
        let sink = Sink::new(source_name, text);
        let model = ArmTable::read(text, author, &sink).and_then(|mut table| {
            amend(&mut table, &sink);
            table.allow.iter().for_each(|lint| sink.allow(lint.name()));
            let places = Places::of(&table);
            let model = table.into_model(&sink)?;
            if !sink.has_errors() {
                lint::examine(&model, &places, &sink);
            }
            Some(model)
        });
        let found = sink.finish();
        match model {
            Some(model) if !found.has_errors() => Ok((model.hashed(text), found)),
            _ => Err(found),
        }
    }

    fn hashed(mut self, text: &str) -> Self {
        let hash = Sha256::digest(text);
        self.table_hash = hash.iter().map(|byte| format!("{byte:02x}")).collect();
        self
    }
}

/// What is in it.
impl Model {
    /// The most joints that an arm may have.
    pub const MAX_JOINTS: usize = ArmTable::MAX_JOINTS;

    /// The arm's name, `snake_case`, a Rust identifier that is no keyword.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The name of the type that stands for the arm in generated code: `planar_2r` becomes `Planar2r`.
    pub fn type_name(&self) -> String {
        name::type_name(&self.name)
    }

    /// Gravity, m/s², world axes.
    pub fn gravity(&self) -> [f64; 3] {
        self.gravity
    }

    /// The rows of J in w_D; at least one, and no more than there are joints.
    pub fn task(&self) -> TaskRows {
        self.task
    }

    /// `world_from_base`.
    pub fn base(&self) -> &Placement {
        &self.base
    }

    /// `frame_N_from_tool`.
    pub fn tool(&self) -> &Placement {
        &self.tool
    }

    /// Whether the arm has a payload that is known only at run time ([`ulna::Payload`]).
    pub fn has_payload(&self) -> bool {
        self.payload
    }

    /// The joints, base first, 1 to 32, in modified form.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// What the joints are called, base first: by their names, or `joint 1` where the table gives none. No two are the same.
    pub fn joint_names(&self) -> &[String] {
        &self.joint_names
    }

    /// The lints that the table switches off.
    pub fn allow(&self) -> &[Lint] {
        &self.allow
    }

    /// Whether the table switches `lint` off.
    pub fn allows(&self, lint: Lint) -> bool {
        self.allow.contains(&lint)
    }

    /// Whether a link's inertia was taken over although no rigid body can have it, base first: `accept_inertia` of a table.
    pub fn accepts_inertia(&self) -> &[bool] {
        &self.accept_inertia
    }

    /// The convention of the table; [`joints`](Self::joints) are in modified form.
    pub fn convention(&self) -> Convention {
        self.convention
    }

    /// The unit of the angles in the table; here they are in radians.
    pub fn angle_unit(&self) -> AngleUnit {
        self.angle_unit
    }

    /// SHA-256 of the table's text, hexadecimal; for a model made by a program, of the text that [`Model::new`] writes.
    pub fn table_hash(&self) -> &str {
        &self.table_hash
    }
}
