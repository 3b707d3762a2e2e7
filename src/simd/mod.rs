//! Instructions that the machine has and the compiler was not told of: fused multiply-adds for programs built without flags.
//!
//! The only module with `unsafe` in it. What makes it sound: a function compiled for an instruction set is called only
//! after the processor has been asked for it.
//!
//! What runs on these scalars must end up inside such a function, or each instruction becomes a call: functions over
//! [`Real`] are inlined always, and loop instead of handing closures to iterators, which are functions of their own.
#![allow(unsafe_code)]

#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod avx2;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod avx512;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod fused;
mod plain;
mod portable;

use bytemuck::Pod;

use crate::Real;

pub use plain::Plain;

/// A [`Real`] of one double in memory.
pub trait Double: Real + Pod {}

impl Double for f64 {}

/// A computation on any scalar of one double.
pub trait Call {
    /// Its result.
    type Output;

    /// Computes it on scalars `R`. To be inlined always: it is compiled for the instructions of its caller.
    fn run<R: Double>(self) -> Self::Output;
}

/// Several doubles at once: a [`Real`] that a batch of configurations runs on.
pub trait Lanes: Real {
    /// How many.
    const WIDTH: usize;

    /// The first numbers of the array.
    fn load(numbers: &[f64; MAX_WIDTH]) -> Self;

    /// The lanes' numbers, the first of the array.
    fn store(self) -> [f64; MAX_WIDTH];

    /// A block of lanes, lane by lane: the first rows of the array.
    #[inline(always)]
    fn transpose(block: &[Self; BLOCK]) -> [[f64; BLOCK]; MAX_WIDTH] {
        let mut rows = [[0.0; BLOCK]; MAX_WIDTH];
        for (column, lanes) in block.iter().enumerate() {
            let numbers = lanes.store();
            for lane in 0..Self::WIDTH {
                rows[lane][column] = numbers[lane];
            }
        }
        rows
    }
}

/// No lanes are wider.
pub const MAX_WIDTH: usize = 8;

/// How many results are handed out at once.
pub const BLOCK: usize = 8;

/// A computation on lanes.
pub trait BatchCall {
    /// Computes it on lanes `R`. To be inlined always: it is compiled for the instructions of its caller.
    fn run<R: Lanes>(self);
}

/// Runs `call` on scalars that fuse multiply-adds if the machine does.
#[inline]
pub fn run<C: Call>(call: C) -> C::Output {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    return run_on(has_avx2(), call);
    #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
    return call.run::<f64>();
}

/// Runs `call` on the widest lanes of the machine.
pub fn run_batch<C: BatchCall>(call: C) {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    return run_batch_on(has_avx512(), has_avx2(), call);
    #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
    return call.run::<wide::f64x4>();
}

// The processor is asked elsewhere: while a function holds a call and something else might unwind, the compiler puts a
// clean-up around all that it inlines there, at a cost that grows with the square of a kernel's length (dev profile).

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline]
fn run_on<C: Call>(has_avx2: bool, call: C) -> C::Output {
    if has_avx2 {
        // SAFETY: the processor has both.
        unsafe { run_fused(call) }
    } else {
        call.run::<f64>()
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
fn run_batch_on<C: BatchCall>(has_avx512: bool, has_avx2: bool, call: C) {
    if has_avx512 {
        // SAFETY: the processor has both.
        unsafe { run_avx512(call) }
    } else if has_avx2 {
        // SAFETY: the processor has both.
        unsafe { run_avx2(call) }
    } else {
        call.run::<wide::f64x4>();
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline]
fn has_avx512() -> bool {
    std::is_x86_feature_detected!("avx512f") && std::is_x86_feature_detected!("avx512dq")
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline]
fn has_avx2() -> bool {
    std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2,fma")]
fn run_fused<C: Call>(call: C) -> C::Output {
    call.run::<fused::Fused>()
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2,fma")]
fn run_avx2<C: BatchCall>(call: C) {
    call.run::<avx2::Avx2>();
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx512f,avx512dq")]
fn run_avx512<C: BatchCall>(call: C) {
    call.run::<avx512::Avx512>();
}

/// Operators of a newtype, each by an expression over both fields.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
macro_rules! operators {
    ($type:ident: $($trait:ident $method:ident |$a:ident, $b:ident| $value:expr),+) => {
        $(
            impl core::ops::$trait for $type {
                type Output = Self;

                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    let ($a, $b) = (self.0, other.0);
                    Self($value)
                }
            }
        )+
    };
}
#[cfg(all(feature = "std", target_arch = "x86_64"))]
use operators;

/// [`Real::apart`] for scalars that are made only where the processor has the features.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
macro_rules! apart {
    ($features:literal) => {
        #[inline(always)]
        fn apart<P: crate::real::Part<S>, S>(state: &mut S) {
            #[target_feature(enable = $features)]
            #[inline(never)]
            fn run<P: crate::real::Part<S>, S>(state: &mut S) {
                P::run(state);
            }
            // SAFETY: whoever calls this is compiled for the features, and was called after the processor had been asked.
            unsafe { run::<P, S>(state) }
        }
    };
}
#[cfg(all(feature = "std", target_arch = "x86_64"))]
use apart;
