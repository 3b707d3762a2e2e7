//! The links one by one: Jacobians at their frames' origins, and where their mass is.

use core::array::from_fn;

use nalgebra::{SMatrix, Vector3};

use super::SerialChain;
use super::kinematics::JointInput;

impl<const N: usize> SerialChain<N> {
    /// The geometric Jacobian of each link at the origin of its frame (Siciliano 3.1.3, Eq. 3.30, up to that link).
    pub(super) fn jacobians_at_origins(&self, inputs: &[JointInput; N]) -> [SMatrix<f64, 6, N>; N] {
        let frames = self.frames(inputs);
        from_fn(|link| self.jacobian(&frames, link, Vector3::zeros()))
    }

    /// Σ m_i p_i over the links' centroids p_i, kg·m, about the world's origin in world axes.
    pub(super) fn first_moment(&self, inputs: &[JointInput; N]) -> Vector3<f64> {
        let frames = self.frames(inputs).world_from_frame;
        let pairs = self.joints.iter().zip(frames);
        pairs
            .map(|(joint, frame)| {
                let com = frame.rotation * Vector3::from(joint.link.com);
                (frame.translation.vector + com) * joint.link.mass
            })
            .sum()
    }

    /// Mass of all links, kg.
    pub(super) fn mass(&self) -> f64 {
        self.joints.iter().map(|joint| joint.link.mass).sum()
    }
}
