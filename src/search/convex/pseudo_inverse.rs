//! Matrices of deficient rank.

use nalgebra::DMatrix;

/// One on the other.
pub(super) fn stack(upper: &DMatrix<f64>, lower: &DMatrix<f64>) -> DMatrix<f64> {
    let mut both = upper
        .clone()
        .resize_vertically(upper.nrows() + lower.nrows(), 0.0);
    both.rows_mut(upper.nrows(), lower.nrows()).copy_from(lower);
    both
}

/// Pivots below this part of the largest count as 0.
const RANK_TOLERANCE: f64 = 1e-9;

/// An orthonormal basis of a matrix's column space, by Householder's QR with column pivoting (Golub and Van Loan, 5.4.2).
pub(super) fn column_space(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    if matrix.is_empty() {
        return DMatrix::zeros(matrix.nrows(), 0);
    }
    let qr = matrix.clone().col_piv_qr();
    let r = qr.r();
    // The pivots shrink along the diagonal.
    let pivots = (0..r.nrows().min(r.ncols())).map(|i| r[(i, i)].abs());
    let rank = pivots
        .take_while(|pivot| *pivot > RANK_TOLERANCE * r[(0, 0)].abs())
        .count();
    qr.q().columns(0, rank).into_owned()
}

/// A†, by a complete orthogonal decomposition `A = Q C Zᵀ`, C square and regular (Golub and Van Loan, 5.4.7).
/// A singular value decomposition would do as well, but nalgebra's loses half of the digits where the rank is deficient.
pub(super) fn pseudo_inverse(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let q = column_space(matrix);
    if q.is_empty() {
        return DMatrix::zeros(matrix.ncols(), matrix.nrows());
    }
    let rows = q.tr_mul(matrix).transpose();
    let decomposition = rows.qr();
    // Qᵀ A = Rᵀ Zᵀ, so A† = Z R⁻ᵀ Qᵀ.
    match decomposition
        .r()
        .transpose()
        .solve_lower_triangular(&q.transpose())
    {
        Some(solved) => decomposition.q() * solved,
        None => DMatrix::zeros(matrix.ncols(), matrix.nrows()),
    }
}
