//! The dynamically consistent projector, in coordinates in which M is the identity.

use nalgebra::{SMatrix, SVector};

use super::factor::Factor;
use crate::TaskRows;
use crate::control::null_space::NullSpace;

/// With M = L Lᵀ and Ĵ = J L⁻ᵀ, `I − Jᵀ J̄ᵀ = L (I − Ĵ†Ĵ) L⁻¹`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Whitening<const N: usize> {
    factor: Factor<N>,
    /// Ĵ, taken apart.
    null_space: NullSpace<N>,
}

impl<const N: usize> Whitening<N> {
    /// `None` if rounding leaves M without a Cholesky factor, as only absurd arguments can.
    #[inline]
    pub(super) fn new(
        mass_matrix: &SMatrix<f64, N, N>,
        jacobian: &SMatrix<f64, 6, N>,
        task: TaskRows,
    ) -> Option<Self> {
        let factor = Factor::new(mass_matrix)?;
        let mut whitened = SMatrix::<f64, 6, N>::zeros();
        for row in task.iter() {
            let row = row.index();
            let solved = factor.solve(jacobian.row(row).transpose());
            whitened.set_row(row, &solved.transpose());
        }
        Some(Self {
            factor,
            null_space: NullSpace::new(&whitened, task),
        })
    }

    /// `L (I − Ĵ†Ĵ) L⁻¹ x`.
    #[inline]
    pub(super) fn project(&self, x: SVector<f64, N>) -> SVector<f64, N> {
        self.factor
            .multiply(&self.null_space.project(&self.factor.solve(x)))
    }
}
