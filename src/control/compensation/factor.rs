//! [`Factor`]: the Cholesky factor of a small matrix, unrolled.

use nalgebra::{SMatrix, SVector};

use crate::Real;

/// L with L Lᵀ = M, L lower triangular. Nalgebra's takes three times as long, for it does not know the dimension.
///
/// All loops run over whole columns, whose upper parts are 0: the compiler unrolls them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factor<const N: usize> {
    columns: [SVector<f64, N>; N],
    /// One over L's diagonal.
    inverse: [f64; N],
}

impl<const N: usize> Factor<N> {
    /// Column by column (Golub and Van Loan, 4.2.5).
    #[inline]
    pub(super) fn new(matrix: &SMatrix<f64, N, N>) -> Option<Self> {
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
    pub(super) fn solve(&self, mut x: SVector<f64, N>) -> SVector<f64, N> {
        for (j, (column, inverse)) in self.columns.iter().zip(&self.inverse).enumerate() {
            let solved = x[j] * inverse;
            x.axpy(-solved, column, 1.0);
            x[j] = solved;
        }
        x
    }

    /// `(L Lᵀ)⁻¹ x`: forwards, then backwards.
    #[inline]
    pub(super) fn solve_whole(&self, x: SVector<f64, N>) -> SVector<f64, N> {
        let mut x = self.solve(x);
        for (j, (column, inverse)) in self.columns.iter().zip(&self.inverse).enumerate().rev() {
            // Column j is 0 above the diagonal, and x[j] is set aside: the product is over what is solved.
            let right = x[j];
            x[j] = 0.0;
            x[j] = (right - column.dot(&x)) * inverse;
        }
        x
    }

    /// `L x`.
    #[inline]
    pub(super) fn multiply(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        let mut product = SVector::<f64, N>::zeros();
        for (column, x) in self.columns.iter().zip(x) {
            product.axpy(*x, column, 1.0);
        }
        product
    }
}
