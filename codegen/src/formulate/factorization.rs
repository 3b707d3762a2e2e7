//! M = U D Uᵀ with U unit upper triangular, the tip's pivot first, without square roots.
//!
//! From the tip because there M is simplest: its last pivots are constants or nearly so.

use crate::graph::Expr;

/// The factors of a symmetric positive definite matrix.
pub(crate) struct Factors<'g> {
    /// U above the diagonal, by rows.
    pub(super) upper: Vec<Vec<Expr<'g>>>,
    /// The pivots.
    pub pivots: Vec<Expr<'g>>,
    /// One over the pivots.
    pub(super) inverse_pivots: Vec<Expr<'g>>,
}

/// Factors the matrix.
pub(crate) fn factor<'g>(matrix: &[Vec<Expr<'g>>]) -> Factors<'g> {
    let n = matrix.len();
    let mut rest: Vec<Vec<Expr<'g>>> = matrix.to_vec();
    let mut upper = rest.clone();
    let mut pivots = Vec::new();
    let mut inverse_pivots = Vec::new();
    for k in (0..n).rev() {
        let pivot = rest[k][k].named("d", &[k]);
        let inverse = (pivot.of(1.0) / pivot).named("d_inv", &[k]);
        for i in 0..k {
            rest[i][k].named("ud", &[i, k]);
            upper[i][k] = (rest[i][k] * inverse).named("u", &[i, k]);
        }
        let column: Vec<Expr<'g>> = rest[..k].iter().map(|row| row[k]).collect();
        for (i, row) in rest[..k].iter_mut().enumerate() {
            for (j, (entry, other)) in (i..).zip(row[i..k].iter_mut().zip(&column[i..])) {
                *entry = *entry - upper[i][k] * *other;
                // The pivot to come has its own name.
                if k > 1 && j + 1 < k {
                    entry.named("schur", &[i, j, k]);
                }
            }
        }
        pivots.push(pivot);
        inverse_pivots.push(inverse);
    }
    pivots.reverse();
    inverse_pivots.reverse();
    Factors {
        upper,
        pivots,
        inverse_pivots,
    }
}

impl<'g> Factors<'g> {
    /// x of (U D Uᵀ) x = b.
    pub(crate) fn solve(&self, b: &[Expr<'g>]) -> Vec<Expr<'g>> {
        self.solve_in_steps(b).1
    }

    /// The inverse of U D Uᵀ, full and symmetric: `Vᵀ D⁻¹ V`, V = U⁻¹.
    pub(crate) fn inverse(&self) -> Vec<Vec<Expr<'g>>> {
        let n = self.pivots.len();
        let (zero, one) = (self.pivots[0].of(0.0), self.pivots[0].of(1.0));
        // By columns, each up to its diagonal.
        let column = |j: usize| {
            let mut column = vec![zero; j + 1];
            column[j] = one;
            for i in (0..j).rev() {
                let sum = (i + 1..=j).fold(zero, |sum, k| sum + self.upper[i][k] * column[k]);
                column[i] = (-sum).named("v", &[i, j]);
            }
            column
        };
        let v: Vec<Vec<Expr<'g>>> = (0..n).map(column).collect();
        let over_pivots = |column: &Vec<Expr<'g>>| {
            let pairs = column.iter().zip(&self.inverse_pivots);
            pairs.map(|(x, inverse)| *x * *inverse).collect()
        };
        let scaled: Vec<Vec<Expr<'g>>> = v.iter().map(over_pivots).collect();
        for (j, column) in scaled.iter().enumerate() {
            for (i, x) in column.iter().enumerate() {
                x.named("v_over_d", &[i, j]);
            }
        }
        let entry = |i: usize, j: usize| {
            let (short, long) = (&scaled[i.min(j)], &v[i.max(j)]);
            let pairs = short.iter().zip(long);
            pairs.fold(zero, |sum, (x, y)| sum + *x * *y)
        };
        let row = |i: usize| {
            (0..n)
                .map(|j| entry(i, j).named("m_inv", &[i, j]))
                .collect()
        };
        (0..n).map(row).collect()
    }

    /// Uᵀ x, and x, of (U D Uᵀ) x = b.
    pub(crate) fn solve_in_steps(&self, b: &[Expr<'g>]) -> (Vec<Expr<'g>>, Vec<Expr<'g>>) {
        let mut halfway = self.solve_upper(b);
        for (x, inverse) in halfway.iter_mut().zip(&self.inverse_pivots) {
            *x = *x * *inverse;
        }
        let x = self.solve_upper_transposed(&halfway);
        (halfway, x)
    }

    /// x of U x = b.
    pub(super) fn solve_upper(&self, b: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut x = b.to_vec();
        for k in (0..x.len()).rev() {
            for i in 0..k {
                x[i] = x[i] - self.upper[i][k] * x[k];
            }
        }
        x
    }

    /// x of Uᵀ x = b.
    pub(super) fn solve_upper_transposed(&self, b: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut x = b.to_vec();
        for k in 0..x.len() {
            for i in 0..k {
                x[k] = x[k] - self.upper[i][k] * x[i];
            }
        }
        x
    }
}
