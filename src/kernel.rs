//! What generated code calls besides [`Real`](crate::Real): the rules that make its results total.

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, SVector, Translation3};

pub use crate::real::{prismatic_offset, revolute_angle};

/// A pivot of HHᵀ, relative to the diagonal entry before elimination, below which it is rounding.
const PIVOT_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Whether the task counts as singular, from the pivots and the diagonal of HHᵀ, H = JM⁻¹.
///
/// A pivot is the squared distance of one row of H from the rows eliminated before, so that the rule reads:
/// a row within about 1e-7 of its length of the others' span is not told from a dependent one.
fn is_singular<const R: usize>(pivots: &[f64; R], diagonal: &[f64; R]) -> bool {
    let regular = |(pivot, whole): (&f64, &f64)| *pivot > PIVOT_ROUNDING * whole;
    !pivots.iter().zip(diagonal).all(regular)
}

/// w_D, or 0 where the task is singular.
#[inline]
pub fn settled_value<const R: usize>(value: f64, pivots: &[f64; R], diagonal: &[f64; R]) -> f64 {
    if is_singular(pivots, diagonal) {
        0.0
    } else {
        value
    }
}

/// w_D and ∇w_D, or zeros where the task is singular and Eq. 23 would divide by zero.
#[inline]
pub fn settled_gradient<const N: usize, const R: usize>(
    value: f64,
    gradient: [f64; N],
    pivots: &[f64; R],
    diagonal: &[f64; R],
) -> (f64, SVector<f64, N>) {
    if is_singular(pivots, diagonal) {
        (0.0, SVector::zeros())
    } else {
        (value, gradient.into())
    }
}

/// A pose from the rotation's columns and the translation.
#[inline]
pub fn pose(rotation: [[f64; 3]; 3], translation: [f64; 3]) -> IsometryMatrix3<f64> {
    IsometryMatrix3::from_parts(
        Translation3::from(translation),
        Rotation3::from_matrix_unchecked(Matrix3::from(rotation)),
    )
}
