//! Frames of all links and the geometric Jacobian of a point on any of them.

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, SMatrix, SVector, Translation3, Vector3};

use super::SerialChain;
use crate::Real;
use crate::arm::coordinates::prismatic_offset;
use crate::{Joint, JointKind};

/// What a joint's coordinate enters the kinematics as.
///
/// A revolute joint enters by sine and cosine only, so that a coordinate of any size keeps its accuracy
/// and a turn by a known angle needs no new sine (see [`super::finite_difference`]).
#[derive(Clone, Copy)]
pub(super) enum JointInput {
    /// A revolute joint's angle q.
    Angle { sin: f64, cos: f64 },
    /// A prismatic joint's offset q, m.
    Offset(f64),
}

/// Where everything is, in world axes.
pub(super) struct Frames<const N: usize> {
    /// `world_from_frame_i`, base first.
    pub(super) world_from_frame: [IsometryMatrix3<f64>; N],
    /// From the origin of frame i−1 (the base for the first) to that of frame i, m, world axes.
    pub(super) steps: [Vector3<f64>; N],
    /// `world_from_tool`.
    pub(super) world_from_tool: IsometryMatrix3<f64>,
}

impl Joint {
    /// `T_i = Rx(alpha) Tx(a) Rz(theta + q) Tz(d)`, or `Tz(d + q)`: frame i as seen from frame i−1 (Craig, Eq. 3.6).
    pub(super) fn transform(&self, input: JointInput) -> IsometryMatrix3<f64> {
        let (sin_alpha, cos_alpha) = self.alpha.sin_cos();
        let (sin_theta, cos_theta) = self.theta.sin_cos();
        let (sin, cos, d) = match input {
            JointInput::Angle { sin, cos } => (
                sin_theta * cos + cos_theta * sin,
                cos_theta * cos - sin_theta * sin,
                self.d,
            ),
            JointInput::Offset(q) => (sin_theta, cos_theta, self.d + q),
        };
        let rotation = Matrix3::new(
            cos,
            -sin,
            0.0,
            sin * cos_alpha,
            cos * cos_alpha,
            -sin_alpha,
            sin * sin_alpha,
            cos * sin_alpha,
            cos_alpha,
        );
        IsometryMatrix3::from_parts(
            Translation3::new(self.a, -sin_alpha * d, cos_alpha * d),
            Rotation3::from_matrix_unchecked(rotation),
        )
    }
}

impl<const N: usize> SerialChain<N> {
    /// `world_from_frame_i` of every link frame, base first (the joint's axis is z; a link's centroid and inertia are in it).
    pub fn link_frames(&self, q: &SVector<f64, N>) -> [IsometryMatrix3<f64>; N] {
        self.frames(&self.inputs(q)).world_from_frame
    }

    /// Each frame as seen from the one before, the base for the first.
    pub(crate) fn link_transforms(&self, q: &SVector<f64, N>) -> [IsometryMatrix3<f64>; N] {
        self.transforms(&self.inputs(q))
    }

    pub(super) fn inputs(&self, q: &SVector<f64, N>) -> [JointInput; N] {
        core::array::from_fn(|i| match self.joints[i].kind {
            JointKind::Revolute => {
                let (sin, cos) = Real::sin_cos(q[i]);
                JointInput::Angle { sin, cos }
            }
            JointKind::Prismatic => JointInput::Offset(prismatic_offset(q[i])),
        })
    }

    /// The offsets of prismatic joints; 0 for revolute ones.
    pub(super) fn offsets(inputs: &[JointInput; N]) -> [f64; N] {
        inputs.map(|input| match input {
            JointInput::Angle { .. } => 0.0,
            JointInput::Offset(q) => q,
        })
    }

    /// `T_1 … T_N`.
    pub(super) fn transforms(&self, inputs: &[JointInput; N]) -> [IsometryMatrix3<f64>; N] {
        core::array::from_fn(|i| self.joints[i].transform(inputs[i]))
    }

    pub(super) fn frames(&self, inputs: &[JointInput; N]) -> Frames<N> {
        let mut world_from_last = self.base.isometry();
        let mut steps = [Vector3::zeros(); N];
        let world_from_frame = core::array::from_fn(|i| {
            let transform = self.joints[i].transform(inputs[i]);
            steps[i] = world_from_last.rotation * transform.translation.vector;
            world_from_last *= transform;
            world_from_last
        });
        Frames {
            world_from_frame,
            steps,
            world_from_tool: world_from_last * self.tool.isometry(),
        }
    }

    /// Geometric Jacobian of a point fixed to link `link`, in world axes (Siciliano 3.1.3, Eq. 3.30):
    /// column j is `[z_j × (p − o_j); z_j]` for a revolute joint and `[z_j; 0]` for a prismatic one.
    ///
    /// `arm` is the point as seen from the origin of the link's frame, world axes. The distances `p − o_j` are summed from
    /// the link towards the base, not taken as differences of positions: the last joints' short arms,
    /// on which the small entries of M hang, then carry no rounding of the whole chain's length.
    pub(super) fn jacobian(
        &self,
        frames: &Frames<N>,
        link: usize,
        arm: Vector3<f64>,
    ) -> SMatrix<f64, 6, N> {
        let mut jacobian = SMatrix::<f64, 6, N>::zeros();
        let mut arm = arm;
        for j in (0..=link).rev() {
            let axis = frames.world_from_frame[j].rotation * Vector3::z();
            let (linear, angular) = match self.joints[j].kind {
                JointKind::Revolute => (axis.cross(&arm), axis),
                JointKind::Prismatic => (axis, Vector3::zeros()),
            };
            jacobian.fixed_view_mut::<3, 1>(0, j).copy_from(&linear);
            jacobian.fixed_view_mut::<3, 1>(3, j).copy_from(&angular);
            arm += frames.steps[j];
        }
        jacobian
    }

    /// The geometric Jacobian at the tool point.
    pub(super) fn tool_jacobian(&self, inputs: &[JointInput; N]) -> SMatrix<f64, 6, N> {
        let frames = self.frames(inputs);
        let Some(last) = frames.world_from_frame.last() else {
            return SMatrix::zeros();
        };
        let arm = last.rotation * Vector3::from(self.tool.translation);
        self.jacobian(&frames, N - 1, arm)
    }
}
