//! Instructions that the machine has and the compiler was not told of: fused multiply-adds for programs built without flags.
//!
//! The only module of this crate with `unsafe` in it. What makes it sound: a function compiled for an instruction set is called only
//! after the processor has been asked for it.
//!
//! What runs on these scalars must end up inside such a function, or each instruction becomes a call: functions over
//! [`Real`] are inlined always, and loop instead of handing closures to iterators, which are functions of their own.
#![allow(unsafe_code)]

#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod avx2;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod avx512;
mod eight;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod fused;
mod instructions;
mod plain;
mod portable;

use core::ops::Range;

use bytemuck::Pod;

use crate::Real;

pub use eight::{EightSines, eight_sines};
pub use instructions::Instructions;
pub(crate) use plain::{Plain, Settled};

/// A [`Real`] of one double in memory.
pub(crate) trait Double: Real + Pod {}

impl Double for f64 {}

/// A computation on any scalar of one double.
pub(crate) trait Call {
    /// Its result.
    type Output;

    /// Computes it on scalars `R`. To be inlined always: it is compiled for the instructions of its caller.
    fn run<R: Double>(self) -> Self::Output;
}

/// Several doubles at once: a [`Real`] that a batch of configurations runs on.
pub(crate) trait Lanes: Real {
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
pub(crate) const MAX_WIDTH: usize = 8;

/// How many results are handed out at once.
pub(crate) const BLOCK: usize = 8;

/// A computation for many states, on lanes or one by one.
pub(crate) trait BatchCall {
    /// Lanes are quicker where a register holds at least so many doubles.
    const LEAST_WIDTH: usize;

    /// Computes those states on lanes `R`; the last ones together with some before them, if they do not fill the lanes.
    /// To be inlined always: it is compiled for the instructions of its caller.
    fn in_lanes<R: Lanes>(&mut self, states: Range<usize>);

    /// Computes those states by single calls.
    fn one_by_one(&mut self, states: Range<usize>);
}

/// Runs `call` on scalars that fuse multiply-adds if the machine does.
#[inline]
pub(crate) fn run<C: Call>(call: C) -> C::Output {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    return run_on(Instructions::in_use() >= Instructions::Avx2, call);
    #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
    return call.run::<f64>();
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
#[target_feature(enable = "avx2,fma")]
fn run_fused<C: Call>(call: C) -> C::Output {
    call.run::<fused::Fused>()
}

/// Runs `call` for so many states: on the widest lanes that they fill, the rest on narrower ones or one by one.
#[inline]
pub(crate) fn run_batch<C: BatchCall>(call: &mut C, states: usize) {
    let done = run_in_lanes(call, states);
    call.one_by_one(done..states);
}

/// Doubles in a register of the instructions that the program was compiled for.
const COMPILED_WIDTH: usize = if cfg!(target_feature = "avx") {
    4
} else if cfg!(any(
    target_feature = "sse2",
    target_feature = "neon",
    target_feature = "simd128"
)) {
    2
} else {
    1
};

/// The end of those states, from the first that is not done, that are worth lanes of such a width: lanes are filled, or, at the
/// end of the batch, at most a quarter of them computes once more what is done.
const fn worth(width: usize, done: usize, states: usize) -> usize {
    let rest = (states - done) % width;
    if states >= width && 4 * rest >= 3 * width {
        states
    } else {
        states - rest
    }
}

/// Runs `call` for the first states, as many as are worth lanes, and returns how many.
#[inline]
fn run_in_lanes<C: BatchCall>(call: &mut C, states: usize) -> usize {
    let mut done = 0;
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    let set = Instructions::in_use();
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if set >= Instructions::Avx2 {
        if const { C::LEAST_WIDTH <= 8 } && set >= Instructions::Avx512 {
            done = worth(8, 0, states);
            if done > 0 {
                // SAFETY: the processor has both.
                unsafe { run_avx512(call, 0..done) }
            }
        }
        if const { C::LEAST_WIDTH <= 4 } {
            let start = done;
            done = worth(4, start, states);
            if start < done {
                // SAFETY: the processor has both.
                unsafe { run_avx2(call, start..done) }
            }
        }
        return done;
    }
    if const { C::LEAST_WIDTH <= COMPILED_WIDTH } {
        done = worth(4, 0, states);
        if done > 0 {
            run_compiled(call, 0..done);
        }
    }
    done
}

/// A function of its own, so that what is not worth lanes does not pay for their place on the stack.
#[inline(never)]
fn run_compiled<C: BatchCall>(call: &mut C, states: Range<usize>) {
    call.in_lanes::<wide::f64x4>(states);
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2,fma")]
fn run_avx2<C: BatchCall>(call: &mut C, states: Range<usize>) {
    call.in_lanes::<avx2::Avx2>(states);
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx512f,avx512dq")]
fn run_avx512<C: BatchCall>(call: &mut C, states: Range<usize>) {
    call.in_lanes::<avx512::Avx512>(states);
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
        fn apart<P: crate::internal::Part<S>, S>(state: &mut S) {
            #[target_feature(enable = $features)]
            #[inline(never)]
            fn run<P: crate::internal::Part<S>, S>(state: &mut S) {
                P::run(state);
            }
            // SAFETY: whoever calls this is compiled for the features, and was called after the processor had been asked.
            unsafe { run::<P, S>(state) }
        }
    };
}
#[cfg(all(feature = "std", target_arch = "x86_64"))]
use apart;
