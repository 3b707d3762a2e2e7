//! The dynamically consistent projector, in coordinates in which M is the identity.

use nalgebra::{SMatrix, SVector};

use crate::control::null_space::NullSpace;
use crate::{Real, TaskRows};

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

/// L with L Lᵀ = M, L lower triangular. Nalgebra's takes three times as long, for it does not know the dimension.
///
/// All loops run over whole columns, whose upper parts are 0: the compiler unrolls them.
#[derive(Clone, Copy, Debug)]
struct Factor<const N: usize> {
    columns: [SVector<f64, N>; N],
    /// One over L's diagonal.
    inverse: [f64; N],
}

impl<const N: usize> Factor<N> {
    /// Column by column (Golub and Van Loan, 4.2.5).
    #[inline]
    fn new(matrix: &SMatrix<f64, N, N>) -> Option<Self> {
        let mut columns = [SVector::<f64, N>::zeros(); N];
        let mut inverse = [0.0; N];
        for j in 0..N {
            let mut column: SVector<f64, N> = matrix.column(j).into();
            for before in &columns[..j] {
                column.axpy(-before[j], before, 1.0);
            }
            let pivot = column[j];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
            inverse[j] = 1.0 / Real::sqrt(pivot);
            column *= inverse[j];
            column.iter_mut().take(j).for_each(|entry| *entry = 0.0);
            columns[j] = column;
        }
        Some(Self { columns, inverse })
    }

    /// `L⁻¹ x`, forwards.
    #[inline]
    fn solve(&self, mut x: SVector<f64, N>) -> SVector<f64, N> {
        for (j, (column, inverse)) in self.columns.iter().zip(&self.inverse).enumerate() {
            let solved = x[j] * inverse;
            x.axpy(-solved, column, 1.0);
            x[j] = solved;
        }
        x
    }

    /// `L x`.
    #[inline]
    fn multiply(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        let mut product = SVector::<f64, N>::zeros();
        for (column, x) in self.columns.iter().zip(x) {
            product.axpy(*x, column, 1.0);
        }
        product
    }
}
