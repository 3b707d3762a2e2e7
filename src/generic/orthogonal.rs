//! Orthogonal factorisation of the few rows of a task; nalgebra's asks for dimensions that are known numbers, not `N`.

use nalgebra::{Matrix6, SMatrix, SVector};

/// `A Π = Q R`, Q with orthonormal columns, R upper triangular with a falling diagonal:
/// Gram–Schmidt with column pivoting, each column orthogonalised three times: twice keeps Q orthonormal
/// to rounding however ill-conditioned A is (Parlett, *The Symmetric Eigenvalue Problem*, 6.9); once more makes its small entries
/// exact by themselves, which M⁻¹ may multiply.
///
/// The diagonal's product is that of A's singular values: the volume of the box that the columns span.
pub(crate) struct ThinQr<const N: usize> {
    q: SMatrix<f64, N, 6>,
    r: Matrix6<f64>,
    /// `order[k]`: which column of A is the k-th of A Π.
    order: [usize; 6],
    count: usize,
}

impl<const N: usize> ThinQr<N> {
    /// Factors the first `count` columns.
    pub(crate) fn new(mut columns: SMatrix<f64, N, 6>, count: usize) -> Self {
        let mut r = Matrix6::zeros();
        let mut order = core::array::from_fn(|k| k);
        for k in 0..count {
            let longest = (k..count)
                .max_by(|a, b| {
                    let [a, b] = [a, b].map(|c| columns.column(*c).norm_squared());
                    a.total_cmp(&b)
                })
                .unwrap_or(k);
            columns.swap_columns(k, longest);
            r.swap_columns(k, longest);
            order.swap(k, longest);

            r[(k, k)] = columns.column(k).norm();
            if r[(k, k)] > 0.0 {
                columns.column_mut(k).unscale_mut(r[(k, k)]);
            }
            let (done, mut rest) = columns.columns_range_pair_mut(0..k + 1, k + 1..count);
            for (c, mut column) in rest.column_iter_mut().enumerate() {
                for _ in 0..3 {
                    for (row, basis) in done.column_iter().enumerate() {
                        let along = basis.dot(&column);
                        r[(row, k + 1 + c)] += along;
                        column.axpy(-along, &basis, 1.0);
                    }
                }
            }
        }
        Self {
            q: columns,
            r,
            order,
            count,
        }
    }

    /// R's diagonal, falling: how far each column stands out of the span of those before it.
    pub(crate) fn heights(&self) -> impl Iterator<Item = f64> {
        (0..self.count).map(|k| self.r[(k, k)])
    }

    /// The columns dual to A's: `A†ᵀ = Q R⁻ᵀ Πᵀ`, if no height is 0. Column c is orthogonal to every column of A but
    /// column c, with which its product is 1.
    pub(crate) fn duals(&self) -> SMatrix<f64, N, 6> {
        let mut duals = SMatrix::<f64, N, 6>::zeros();
        for k in (0..self.count).rev() {
            let mut dual: SVector<f64, N> = self.q.column(k).clone_owned();
            for later in k + 1..self.count {
                dual.axpy(-self.r[(k, later)], &duals.column(self.order[later]), 1.0);
            }
            duals.set_column(self.order[k], &dual.unscale(self.r[(k, k)]));
        }
        duals
    }
}
