//! The model of an arm: SI units, radians, one convention, validated. What every backend is built from.
//!
//! A chain is kept in modified (Craig) Denavit–Hartenberg form,
//! `T_i = Rx(alpha) Tx(a) Rz(theta) Tz(d)` with the joint's axis along z of frame i.
//! A table in standard form is rewritten into it (see [`Model`]), so that nothing after this stage knows two conventions.

mod angle;
#[cfg(feature = "table")]
mod convention;
#[cfg(feature = "table")]
mod light;
#[cfg(feature = "table")]
mod name;
mod task;
#[cfg(feature = "table")]
mod validate;

pub use angle::Angle;
pub use task::{TaskRow, TaskRows};
#[cfg(feature = "table")]
pub(crate) use validate::RATED_TORQUE;

#[cfg(feature = "table")]
use std::path::Path;

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3};
#[cfg(feature = "table")]
use sha2::{Digest, Sha256};

#[cfg(feature = "table")]
use crate::diagnostics::{Diagnostics, Sink, TableErrors};
#[cfg(feature = "table")]
use crate::table::ArmTable;
#[cfg(feature = "table")]
use crate::toml_reader::read_file;

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about z of its frame: the row's angle is `theta + q`.
    Revolute,
    /// Slides along z of its frame: the row's offset is `d + q`.
    Prismatic,
}

/// One joint, its place on the link before it, and the link that it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// How the joint moves.
    pub kind: JointKind,
    /// Twist α_{i−1} about x of the frame before.
    pub alpha: Angle,
    /// Length a_{i−1} along x of the frame before, m.
    pub a: f64,
    /// Angle θ_i about z, at q = 0.
    pub theta: Angle,
    /// Offset d_i along z, m, at q = 0.
    pub d: f64,
    /// Rated torque, N·m (N for a prismatic joint), if the table states one.
    pub rated_torque: Option<f64>,
    /// The link that the joint moves.
    pub link: Link,
}

/// A rigid body, in its joint's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Mass, kg.
    pub mass: f64,
    /// Centroid, m.
    pub com: [f64; 3],
    /// Inertia tensor about the centroid, kg·m²; symmetric, positive definite.
    pub inertia: [[f64; 3]; 3],
}

/// A fixed pose: the rotation's rows, and the translation in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Rows of the rotation matrix.
    pub rotation: [[f64; 3]; 3],
    /// Translation, m.
    pub translation: [f64; 3],
}

impl Placement {
    /// No rotation, no translation.
    pub const IDENTITY: Self = Self {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };

    /// The same pose as nalgebra's type.
    pub fn isometry(&self) -> IsometryMatrix3<f64> {
        let rows = &self.rotation;
        let matrix = Matrix3::from_fn(|i, j| rows[i][j]);
        let [x, y, z] = self.translation;
        IsometryMatrix3::from_parts(
            Translation3::new(x, y, z),
            Rotation3::from_matrix_unchecked(matrix),
        )
    }
}

/// A validated arm of any number of joints.
///
/// Nothing after this stage can fail on a user's input.
#[cfg(feature = "table")]
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// The arm's name, `snake_case`, a Rust identifier that is no keyword.
    pub name: String,
    /// Gravity, m/s², world axes.
    pub gravity: [f64; 3],
    /// The rows of J in w_D.
    pub task: TaskRows,
    /// `world_from_base`.
    pub base: Placement,
    /// `frame_N_from_tool`.
    pub tool: Placement,
    /// The joints, base first; at least one.
    pub joints: Vec<Joint>,
    /// SHA-256 of the table's text, hexadecimal.
    pub table_hash: String,
}

#[cfg(feature = "table")]
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
        let text = read_file(folder.as_ref(), path.as_ref(), Self::MAX_BYTES)?;
        Self::lint_text(&text, &path.as_ref().display().to_string())
    }

    /// [`Model::load`], together with warnings of what is allowed but rarely meant.
    ///
    /// # Errors
    /// Everything that is wrong with the file, at once.
    pub fn lint(path: impl AsRef<Path>) -> Result<(Self, Diagnostics), TableErrors> {
        Self::lint_in("", path)
    }

    fn lint_text(text: &str, source_name: &str) -> Result<(Self, Diagnostics), TableErrors> {
        let sink = Sink::new(source_name, text);
        let model = ArmTable::read(text, &sink).and_then(|table| table.into_model(&sink));
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

    /// The name of the type that stands for the arm in generated code: `planar_2r` becomes `Planar2r`.
    pub fn type_name(&self) -> String {
        name::type_name(&self.name)
    }
}
