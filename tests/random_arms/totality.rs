//! No method returns NaN, at whatever finite coordinates.

use std::f64::consts::FRAC_PI_2;

use nalgebra::SVector;
use ulna::internal::numbers;
use ulna::proof::State;
use ulna::{Arm, Method};

/// `state`, and its likes where arms are singular, sums of angles round, or coordinates are absurd.
pub(crate) fn special<const N: usize>(state: State<N>) -> Vec<State<N>> {
    let quarters = |i: usize| [0.0, 1.0, -1.0, 2.0][(state.q[i].to_bits() >> 20) as usize % 4];
    let huge = [1e6, 1e9, 1e300].map(|size| state.q.map(|x| x * size));
    let configurations = [
        state.q,
        SVector::zeros(),
        SVector::from_fn(|i, _| quarters(i) * FRAC_PI_2),
        SVector::repeat(FRAC_PI_2),
    ];
    let all = configurations.into_iter().chain(huge);
    all.map(|q| State { q, ..state }).collect()
}

/// The methods of `arm` that return NaN at `state`.
pub(crate) fn methods_with_nan<const N: usize>(arm: &impl Arm<N>, state: &State<N>) -> Vec<Method> {
    let has_nan = |method: &Method| {
        let mut found = false;
        numbers(arm, *method, state, |x| found |= x.is_nan());
        found
    };
    Method::ALL.iter().copied().filter(has_nan).collect()
}
