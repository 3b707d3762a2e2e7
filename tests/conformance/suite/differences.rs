//! Derivatives by central differences, extrapolated.

use core::array::from_fn;

use nalgebra::{SMatrix, SVector};

/// ∂f/∂q_i for every i: central differences with steps h, h/2 and h/4, and Richardson's extrapolation of them to h = 0.
/// What is left is of order h⁶ and of rounding divided by h.
pub(super) fn derivative<const N: usize, const R: usize, const C: usize>(
    q: &SVector<f64, N>,
    h: f64,
    f: impl Fn(&SVector<f64, N>) -> SMatrix<f64, R, C>,
) -> [SMatrix<f64, R, C>; N] {
    from_fn(|i| {
        let difference = |h: f64| {
            let step = unit(i, h);
            (f(&(q + step)) - f(&(q - step))) / (2.0 * h)
        };
        let [coarse, middle, fine] = [difference(h), difference(h / 2.0), difference(h / 4.0)];
        let better = (middle * 4.0 - coarse) / 3.0;
        let best = (fine * 4.0 - middle) / 3.0;
        (best * 16.0 - better) / 15.0
    })
}

/// The vector that is `length` in entry `i` and 0 elsewhere.
pub(super) fn unit<const N: usize>(i: usize, length: f64) -> SVector<f64, N> {
    SVector::from_fn(|j, _| if i == j { length } else { 0.0 })
}
