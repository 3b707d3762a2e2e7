//! The Coriolis matrix of Christoffel's symbols.

use nalgebra::{SMatrix, SVector};

use super::SerialChain;
use super::kinematics::JointInput;

impl<const N: usize> SerialChain<N> {
    /// `C_ij = Σ_k c_ijk q̇_k` with `c_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i)` (Siciliano 7.1.3, Eq. 7.45).
    pub(super) fn christoffel_matrix(
        &self,
        inputs: &[JointInput; N],
        qd: &SVector<f64, N>,
    ) -> SMatrix<f64, N, N> {
        let dm = self.derivatives(inputs, |shifted| self.links_mass_matrix_at(shifted));
        let symbol =
            |i: usize, j: usize, k: usize| (dm[k][(i, j)] + dm[j][(i, k)] - dm[i][(j, k)]) * 0.5;
        SMatrix::from_fn(|i, j| (0..N).map(|k| symbol(i, j, k) * qd[k]).sum())
    }
}
