//! Kinetic and potential energy (Siciliano 7.1).

use nalgebra::{SVector, Vector3};

use super::SerialChain;
use super::kinematics::JointInput;

impl<const N: usize> SerialChain<N> {
    /// `T = ½ q̇ᵀ M q̇` (Siciliano 7.1.1): of all that M holds.
    pub(super) fn energy_of_motion(&self, inputs: &[JointInput; N], qd: &SVector<f64, N>) -> f64 {
        0.5 * qd.dot(&(self.mass_matrix_at(inputs) * qd))
    }

    /// `U = −Σ m_i gᵀ p_i` over the links' centroids (Siciliano 7.1.2): 0 with all mass at the world's origin.
    pub(super) fn energy_of_position(&self, inputs: &[JointInput; N]) -> f64 {
        -self.first_moment(inputs).dot(&Vector3::from(self.gravity))
    }
}
