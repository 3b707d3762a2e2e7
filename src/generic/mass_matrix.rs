//! The mass matrix as the links' kinetic energies add up to it, and its factorisation.

use nalgebra::{Cholesky, Const, Matrix3, SMatrix, SVector, Vector3};

use super::SerialChain;
use super::kinematics::JointInput;

impl<const N: usize> SerialChain<N> {
    /// What the rotors behind their gears add to M's diagonal, kg·m² (kg).
    pub(crate) fn reflected_inertias(&self) -> SVector<f64, N> {
        SVector::from_fn(|i, _| self.joints[i].motor.reflected_inertia())
    }

    /// M: that of the links, and on its diagonal what the rotors add: of Siciliano's Eq. 7.32 their spin about their own axes,
    /// which rigid gears make `ratio · q̇_i`.
    pub(super) fn mass_matrix_at(&self, inputs: &[JointInput; N]) -> SMatrix<f64, N, N> {
        let rotors = self.reflected_inertias();
        self.links_mass_matrix_at(inputs) + SMatrix::from_diagonal(&rotors)
    }

    /// `M = Σ_i m_i J_viᵀ J_vi + J_wiᵀ R_i I_i R_iᵀ J_wi` over the links, with the Jacobian at each centroid
    /// (Siciliano 7.1.1, Eq. 7.32). All of M that changes with the configuration.
    pub(super) fn links_mass_matrix_at(&self, inputs: &[JointInput; N]) -> SMatrix<f64, N, N> {
        let frames = self.frames(inputs);
        let mut mass_matrix = SMatrix::zeros();
        for (i, joint) in self.joints.iter().enumerate() {
            let rotation = frames.world_from_frame[i].rotation;
            let jacobian = self.jacobian(&frames, i, rotation * Vector3::from(joint.link.com));
            let linear = jacobian.fixed_rows::<3>(0);
            let angular = rotation.matrix().tr_mul(&jacobian.fixed_rows::<3>(3));
            let inertia = Matrix3::from_fn(|r, c| joint.link.inertia[r][c]);
            mass_matrix += linear.tr_mul(&linear) * joint.link.mass;
            mass_matrix += angular.tr_mul(&(inertia * angular));
        }
        // Equal but for rounding; the contract is a symmetric matrix.
        mass_matrix.fill_lower_triangle_with_upper_triangle();
        mass_matrix
    }
}

/// Cholesky's factor of a mass matrix; of one that is NaN, a factor that is.
///
/// M is positive definite, and its rounded entries are: tables are refused in which a link is so light beside what it carries
/// that they might not be ([`crate::arm::bounds::LEAST_SHARE`]).
/// Cholesky needs no scaling although M's diagonal spans orders of magnitude: its error in entry (i, j)
/// is a few units of rounding of `√(M_ii M_jj)`.
pub(crate) fn factor<const N: usize>(mass_matrix: SMatrix<f64, N, N>) -> Cholesky<f64, Const<N>> {
    Cholesky::new(mass_matrix).unwrap_or_else(|| Cholesky::new_unchecked(mass_matrix))
}
