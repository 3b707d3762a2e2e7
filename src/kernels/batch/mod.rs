//! [`ArmBatch`]: every method of [`Arm`] for many states at once, in lanes where that is quicker than a loop over single calls.
//!
//! The rule, measured by `benches/batch.rs`: a register has to hold at least two doubles; where a result is a matrix for each
//! joint (∂J, ∂M, and M with ∂M), at least four, since there writing the numbers takes as long as computing them. Lanes are filled
//! with states from the first on. The last few states are computed with some before them once more if they need three quarters
//! of the lanes, or else one by one, and so is a batch of fewer states than the narrowest lanes.

mod lengths;
mod returned;

use core::ops::Range;

use nalgebra::SVector;

use crate::arm::coordinates::{are_plain, coordinates};
use crate::arm::quantity::Quantity;
use crate::kernels::simd::{self, BLOCK, BatchCall, Lanes, MAX_WIDTH};
use crate::{Arm, Method, SerialChain, Unrolled};

pub use lengths::LengthMismatch;
use returned::Returned;

/// Gives each lane's result its numbers of a part.
#[inline(always)]
fn scatter<R: Lanes, T: Quantity>(numbers: &[R], part: usize, out: &mut [T]) {
    let (blocks, rest) = numbers.as_chunks::<BLOCK>();
    for (index, block) in blocks.iter().enumerate() {
        let rows = R::transpose(block);
        for (result, row) in out.iter_mut().zip(&rows) {
            result.part_mut(part)[index * BLOCK..][..BLOCK].copy_from_slice(row);
        }
    }
    if let Some(first) = rest.first() {
        let mut block = [*first; BLOCK];
        block[..rest.len()].copy_from_slice(rest);
        let rows = R::transpose(&block);
        for (result, row) in out.iter_mut().zip(&rows) {
            result.part_mut(part)[blocks.len() * BLOCK..].copy_from_slice(&row[..rest.len()]);
        }
    }
}

/// As many vectors as lanes, a component in each.
#[inline(always)]
fn gather<R: Lanes, const N: usize>(vectors: &[SVector<f64, N>]) -> [R; N] {
    let mut lanes = [R::of(0.0); N];
    for (joint, lanes) in lanes.iter_mut().enumerate() {
        let mut numbers = [0.0; MAX_WIDTH];
        for (number, vector) in numbers.iter_mut().zip(vectors) {
            *number = vector[joint];
        }
        *lanes = R::load(&numbers);
    }
    lanes
}

/// As [`gather`], of joint coordinates.
#[inline(always)]
fn gather_coordinates<A: Unrolled<N>, R: Lanes, const N: usize>(q: &[SVector<f64, N>]) -> [R; N] {
    let mut all_plain = true;
    for q in q {
        all_plain &= are_plain(&q.data.0[0]);
    }
    if all_plain {
        return gather(q);
    }
    let mut safe = [SVector::zeros(); MAX_WIDTH];
    for (safe, q) in safe.iter_mut().zip(q) {
        *safe = coordinates(&A::CHAIN, &q.data.0[0]).into();
    }
    gather(&safe[..q.len()])
}

/// Makes the parts from `zero` on 0 of those among the lanes that are singular.
#[inline(always)]
fn settle<A: Unrolled<N>, R: Lanes, T: Quantity, const N: usize>(
    q: &[R; N],
    volume_squared: R,
    zero: usize,
    out: &mut [T],
) {
    let mut apart = [[0.0; N]; MAX_WIDTH];
    for (joint, lanes) in q.iter().enumerate() {
        for (q, number) in apart.iter_mut().zip(lanes.store()) {
            q[joint] = number;
        }
    }
    for ((result, q), volume) in out.iter_mut().zip(&apart).zip(volume_squared.store()) {
        if A::CHAIN.is_singular(q, volume) {
            *result = result.zero_from(zero);
        }
    }
}

/// An argument of as many states as lanes.
macro_rules! gather {
    ($arm:ident, $lanes:ident, q $q:expr) => {
        gather_coordinates::<$arm, $lanes, N>($q)
    };
    ($arm:ident, $lanes:ident, $argument:ident $vectors:expr) => {
        gather::<$lanes, _>($vectors)
    };
}

macro_rules! define_batches {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($first:ident $(, $other:ident)*) -> $output:ty
        { kernel $returns:literal $kernel:ident -> $returned:ty $(, zero from $zero:literal)? }
        { batch $batch:ident from $width:literal }
        $({ $($rest:tt)* })*
    )+) => {
        /// An arm that computes many states at once.
        ///
        /// A batch may have any length, but all its slices have the same. Results are those of the methods of [`Arm`] to the bit.
        /// To share a batch among threads, split the slices, at multiples of 8 states: `rayon`'s `par_chunks` does it.
        pub trait ArmBatch<const N: usize>: Arm<N> {
            $(
                #[doc = concat!("[`Arm::", stringify!($method), "`] for each state.")]
                ///
                /// # Errors
                /// A slice that is not as long as the first; nothing is written then.
                fn $batch(
                    &self,
                    $first: &[$crate::argument_type!([N] $first)],
                    $($other: &[$crate::argument_type!([N] $other)],)*
                    out: &mut [$output],
                ) -> Result<(), LengthMismatch>;
            )+
        }

        /// One by one.
        impl<const N: usize> ArmBatch<N> for SerialChain<N> {
            $(
                fn $batch(
                    &self,
                    $first: &[$crate::argument_type!([N] $first)],
                    $($other: &[$crate::argument_type!([N] $other)],)*
                    out: &mut [$output],
                ) -> Result<(), LengthMismatch> {
                    $(lengths::check($first.len(), stringify!($other), $other.len())?;)*
                    lengths::check($first.len(), "out", out.len())?;
                    for (i, out) in out.iter_mut().enumerate() {
                        *out = self.$method(&$first[i] $(, &$other[i])*);
                    }
                    Ok(())
                }
            )+
        }

        /// In lanes where they are worth it.
        impl<A: Unrolled<N> + Arm<N>, const N: usize> ArmBatch<N> for A {
            $(
                fn $batch(
                    &self,
                    $first: &[$crate::argument_type!([N] $first)],
                    $($other: &[$crate::argument_type!([N] $other)],)*
                    out: &mut [$output],
                ) -> Result<(), LengthMismatch> {
                    struct Run<'a, A, const N: usize> {
                        arm: &'a A,
                        $first: &'a [$crate::argument_type!([N] $first)],
                        $($other: &'a [$crate::argument_type!([N] $other)],)*
                        out: &'a mut [$output],
                    }
                    impl<A: Unrolled<N> + Arm<N>, const N: usize> BatchCall for Run<'_, A, N> {
                        const LEAST_WIDTH: usize = if A::GENERATED.contains(Method::$variant) {
                            $width
                        } else {
                            usize::MAX
                        };

                        #[inline(always)]
                        fn in_lanes<R: Lanes>(&mut self, states: Range<usize>) {
                            for start in states.clone().step_by(R::WIDTH) {
                                let start = start.min(states.end - R::WIDTH);
                                let $first = gather!(A, R, $first &self.$first[start..][..R::WIDTH]);
                                $(let $other = gather!(A, R, $other &self.$other[start..][..R::WIDTH]);)*
                                let out = &mut self.out[start..][..R::WIDTH];
                                let returned: $returned = self.arm.$kernel::<R>(&$first $(, &$other)*);
                                for part in 0..<$output>::PARTS {
                                    scatter::<R, _>(returned.part(part), part, out);
                                }
                                $(
                                    let volume_squared = returned.part(<$output>::PARTS)[0];
                                    settle::<A, R, _, N>(&$first, volume_squared, $zero, out);
                                )?
                            }
                        }

                        #[inline]
                        fn one_by_one(&mut self, states: Range<usize>) {
                            for i in states {
                                self.out[i] = self.arm.$method(&self.$first[i] $(, &self.$other[i])*);
                            }
                        }
                    }
                    $(lengths::check($first.len(), stringify!($other), $other.len())?;)*
                    lengths::check($first.len(), "out", out.len())?;
                    let states = $first.len();
                    simd::run_batch(&mut Run { arm: self, $first, $($other,)* out }, states);
                    Ok(())
                }
            )+
        }
    };
}

crate::methods! { [N] define_batches {} }
