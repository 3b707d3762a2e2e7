//! What generated code calls besides [`Real`](crate::Real): the rules that make its results total.

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, SVector, Translation3};

pub use crate::real::{prismatic_offset, revolute_angle};

/// The squared distance of a row of H from the span of those before, relative to its squared length,
/// below which it is rounding: a distance of 1e-10.
const ROUNDING: f64 = 1e-20;

/// Whether the task counts as singular, H = JM⁻¹: `pivots` are the squared distances, `diagonal` the squared lengths.
fn is_singular<const R: usize>(pivots: &[f64; R], diagonal: &[f64; R]) -> bool {
    let regular = |(pivot, whole): (&f64, &f64)| *pivot > ROUNDING * whole;
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
