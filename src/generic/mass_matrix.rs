//! The mass matrix as the links' kinetic energies add up to it, and its factorisation.

use nalgebra::{Cholesky, Const, Matrix3, SMatrix, Vector3};

use super::SerialChain;
use super::kinematics::JointInput;

impl<const N: usize> SerialChain<N> {
    /// `M = Σ_i m_i J_viᵀ J_vi + J_wiᵀ R_i I_i R_iᵀ J_wi` over the links, with the Jacobian at each centroid
    /// (Siciliano 7.1.1, Eq. 7.32).
    pub(super) fn mass_matrix_at(&self, inputs: &[JointInput; N]) -> SMatrix<f64, N, N> {
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

/// Cholesky's factor of a mass matrix, for any finite one.
///
/// M is positive definite, but where a prismatic joint is so far out that rounding swallows the rest of the arm
/// its rounded entries may not be. A pivot that is not positive is then replaced by the rounding of
/// the largest diagonal entry, which keeps the answer finite.
/// Cholesky needs no scaling although M's diagonal spans orders of magnitude: its error in entry (i, j)
/// is a few units of rounding of `√(M_ii M_jj)`.
pub(super) fn factor<const N: usize>(mass_matrix: SMatrix<f64, N, N>) -> Cholesky<f64, Const<N>> {
    let rounding = f64::EPSILON * mass_matrix.diagonal().amax();
    Cholesky::new_with_substitute(mass_matrix, rounding)
        .unwrap_or_else(|| Cholesky::new_unchecked(mass_matrix))
}
