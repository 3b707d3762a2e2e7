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

/// Pivots below this part of the size of what a matrix is computed from count as 0.
const RANK_TOLERANCE: f64 = 1e-9;

/// An orthonormal basis of a matrix's column space, by Householder's QR with column pivoting (Golub and Van Loan, 5.4.2).
///
/// `size` is that of the entries if none has been cancelled: what is far below it is rounding, even if all of the matrix is.
pub(super) fn column_space(matrix: &DMatrix<f64>, size: f64) -> DMatrix<f64> {
    if matrix.is_empty() {
        return DMatrix::zeros(matrix.nrows(), 0);
    }
    let qr = matrix.clone().col_piv_qr();
    let r = qr.r();
    // The pivots shrink along the diagonal.
    let pivots = (0..r.nrows().min(r.ncols())).map(|i| r[(i, i)].abs());
    let rank = pivots
        .take_while(|pivot| *pivot > RANK_TOLERANCE * size)
        .count();
    qr.q().columns(0, rank).into_owned()
}

/// An orthonormal basis of a matrix's null space.
pub(super) fn null_space(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    null_space_of_size(matrix, matrix.amax())
}

/// The same; `size` as above.
pub(super) fn null_space_of_size(matrix: &DMatrix<f64>, size: f64) -> DMatrix<f64> {
    let rows = column_space(&matrix.transpose(), size);
    let projector = DMatrix::identity(rows.nrows(), rows.nrows()) - &rows * rows.transpose();
    column_space(&projector, 1.0)
}

/// A†, by a complete orthogonal decomposition `A = Q C Zᵀ`, C square and regular (Golub and Van Loan, 5.4.7); `size` as above.
/// A singular value decomposition would do as well, but nalgebra's loses half of the digits where the rank is deficient.
pub(super) fn pseudo_inverse(matrix: &DMatrix<f64>, size: f64) -> DMatrix<f64> {
    let q = column_space(matrix, size);
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
