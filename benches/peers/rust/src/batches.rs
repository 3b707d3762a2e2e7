//! Kernels of many states.

use std::marker::PhantomData;
use std::slice;

use ulna::ArmBatch;
use ulna::nalgebra::SVector;

use crate::Subject;
use crate::layout;
use crate::singles::place;

/// Reads `count` vectors q, then as many of q̇, then of q̈ (or τ), then wrenches for who wants them, and writes as many results.
pub(crate) type BatchKernel = unsafe extern "C" fn(*const f64, usize, *mut f64);

/// Where a batch kernel's arguments are.
struct Arguments<'a> {
    x: *const f64,
    count: usize,
    of: PhantomData<&'a f64>,
}

impl<'a> Arguments<'a> {
    fn vectors<const K: usize>(&self, start: usize) -> &'a [SVector<f64, K>] {
        // SAFETY: the caller of a `BatchKernel` passes so many numbers; a vector of fixed size is its components, contiguous.
        unsafe { slice::from_raw_parts(self.x.add(start * self.count).cast(), self.count) }
    }
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
                    let x = Arguments { x, count, of: PhantomData };
                    // SAFETY: the caller passes room for `count` results.
                    let out = unsafe { slice::from_raw_parts_mut(out.cast::<$output>(), count) };
                    let written = S::arm().$batch($(x.vectors(place!(N $argument))),+, out);
                    assert!(written.is_ok(), "all slices have `count` entries");
                }
                return layout::is_in_order::<$output>().then_some(batch::<S, N>);
            })+
            None
        }
    };
}

ulna::methods! { [N] define_batches {} }
