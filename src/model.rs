//! The model of an arm: SI units, radians, one convention, validated. What every backend is built from.
//!
//! A chain is kept in modified (Craig) Denavit–Hartenberg form,
//! `T_i = Rx(alpha) Tx(a) Rz(theta) Tz(d)` with the joint's axis along z of frame i.
//! A table in standard form is rewritten into it (see [`Model`]), so that nothing after this stage knows two conventions.

use core::f64::consts::FRAC_PI_2;

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3};

/// An angle in radians whose sine and cosine are exact at whole quarter turns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angle {
    /// The angle, rad.
    pub radians: f64,
}

impl Angle {
    /// The angle of `radians`.
    pub const fn from_radians(radians: f64) -> Self {
        Self { radians }
    }

    /// The whole number of quarter turns nearest to the angle, and what is left, rad:
    /// exactly 0 where the angle is a quarter turn's multiple to within its last few bits.
    pub fn quarter_turns(self) -> (i64, f64) {
        let quarters = round(self.radians / FRAC_PI_2);
        let rest = self.radians - quarters * FRAC_PI_2;
        let rounding = 4.0 * f64::EPSILON * self.radians.abs();
        (
            quarters as i64,
            if rest.abs() <= rounding { 0.0 } else { rest },
        )
    }

    /// Sine and cosine; exactly 0 and ±1 at quarter turns.
    pub fn sin_cos(self) -> (f64, f64) {
        match self.quarter_turns() {
            (quarters, 0.0) => match quarters.rem_euclid(4) {
                0 => (0.0, 1.0),
                1 => (1.0, 0.0),
                2 => (0.0, -1.0),
                _ => (-1.0, 0.0),
            },
            _ => crate::Real::sin_cos(self.radians),
        }
    }
}

/// Rounds half away from zero; `f64::round` needs the standard library.
fn round(x: f64) -> f64 {
    (x + 0.5_f64.copysign(x)) as i64 as f64
}

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

/// One row of the geometric Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TaskRow {
    /// Linear velocity along world x.
    X,
    /// Linear velocity along world y.
    Y,
    /// Linear velocity along world z.
    Z,
    /// Angular velocity about world x.
    Rx,
    /// Angular velocity about world y.
    Ry,
    /// Angular velocity about world z.
    Rz,
}

impl TaskRow {
    /// All rows, in the Jacobian's order.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::Rx, Self::Ry, Self::Rz];

    /// The name in a table.
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::Rx => "rx",
            Self::Ry => "ry",
            Self::Rz => "rz",
        }
    }

    /// The row's index in the Jacobian, 0 to 5.
    pub const fn index(self) -> usize {
        self as usize
    }
}

/// The rows of the geometric Jacobian that make up a task: a set, in the Jacobian's order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TaskRows(u8);

impl TaskRows {
    /// The three linear rows.
    pub const POSITION: Self = Self(0b00_0111);
    /// All six rows.
    pub const POSE: Self = Self(0b11_1111);

    /// The set of `rows`.
    pub const fn new(rows: &[TaskRow]) -> Self {
        let mut bits = 0;
        let mut i = 0;
        while i < rows.len() {
            bits |= 1 << rows[i].index();
            i += 1;
        }
        Self(bits)
    }

    /// Whether `row` belongs to the task.
    pub const fn contains(self, row: TaskRow) -> bool {
        self.0 & (1 << row.index()) != 0
    }

    /// How many rows.
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether there is no row.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The rows, in the Jacobian's order.
    pub fn iter(self) -> impl Iterator<Item = TaskRow> {
        TaskRow::ALL
            .into_iter()
            .filter(move |row| self.contains(*row))
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
