//! Kernels of many states.

use std::slice;

use ulna::ArmBatch;
use ulna::nalgebra::SVector;

use crate::Subject;
use crate::layout;

/// Reads `count` vectors q, then as many of q̇, then of q̈ (or τ), and writes as many results.
pub(crate) type BatchKernel = unsafe extern "C" fn(*const f64, usize, *mut f64);

macro_rules! place {
    (q) => {
        0
    };
    (qd) => {
        1
    };
    (qdd) => {
        2
    };
    (tau) => {
        2
    };
}

macro_rules! define_batches {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        { kernel $($kernel:tt)+ }
        { batch $batch:ident $($width:tt)+ }
        $({ $($rest:tt)* })*
    )+) => {
        /// The batch kernel of a method of an arm; none where a result's numbers are in another order than the caller reads them.
        pub(crate) fn kernel<S: Subject<N>, const N: usize>(quantity: &[u8]) -> Option<BatchKernel> {
            $(if quantity == stringify!($method).as_bytes() {
                unsafe extern "C" fn batch<S: Subject<N>, const N: usize>(x: *const f64, count: usize, out: *mut f64) {
                    let x = x.cast::<SVector<f64, N>>();
                    // SAFETY: the caller passes 3 * count vectors of N numbers, and room for `count` results.
                    unsafe {
                        let vectors = |i: usize| slice::from_raw_parts(x.add(i * count), count);
                        let out = slice::from_raw_parts_mut(out.cast::<$output>(), count);
                        let written = S::ARM.$batch($(vectors(place!($argument))),+, out);
                        assert!(written.is_ok(), "all slices have `count` entries");
                    }
                }
                return layout::is_in_order::<$output>().then_some(batch::<S, N>);
            })+
            None
        }
    };
}

ulna::methods! { [N] define_batches {} }
