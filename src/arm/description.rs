//! An arm as data: SI units, radians, one convention.
//!
//! A chain is kept in modified (Craig) Denavit–Hartenberg form,
//! `T_i = Rx(alpha) Tx(a) Rz(theta) Tz(d)` with the joint's axis along z of frame i.

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3};

use super::{Angle, Friction, Limits, Motor};

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
    /// How far and how fast it may go; [`Limits::NONE`] if the table does not say.
    pub limits: Limits,
    /// Its motor's rotor; [`Motor::NONE`] if the table does not say.
    pub motor: Motor,
    /// Its friction; [`Friction::NONE`] if the table does not say.
    pub friction: Friction,
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
