//! Instructions that the machine has and the compiler was not told of: fused multiply-adds for programs built without flags.
//!
//! The only module with `unsafe` in it. What makes it sound: a function compiled for an instruction set is called only
//! after the processor has been asked for it.
#![allow(unsafe_code)]

use core::ops::{Add, Div, Mul, Neg, Sub};

use bytemuck::{Pod, Zeroable, cast};

use crate::Real;

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

/// Runs `call` on scalars that fuse multiply-adds if the machine does.
#[inline]
pub fn run<C: Call>(call: C) -> C::Output {
    #[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "fma")))]
    if std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma") {
        // SAFETY: the processor has both.
        return unsafe { run_fused(call) };
    }
    call.run::<f64>()
}

#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "fma")))]
#[target_feature(enable = "avx2,fma")]
fn run_fused<C: Call>(call: C) -> C::Output {
    call.run::<Fused>()
}

/// A double whose multiply-adds are fused: quick only in code compiled for a processor that has the instruction.
#[cfg(feature = "std")]
#[derive(Clone, Copy)]
#[repr(transparent)]
struct Fused(f64);

#[cfg(feature = "std")]
mod fused {
    use super::{Add, Div, Double, Fused, Mul, Neg, Pod, Real, Sub, Zeroable};

    // SAFETY: a transparent f64.
    unsafe impl Zeroable for Fused {}
    // SAFETY: a transparent f64.
    unsafe impl Pod for Fused {}

    impl Double for Fused {}

    macro_rules! operator {
        ($trait:ident, $method:ident) => {
            impl $trait for Fused {
                type Output = Self;

                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    Self(self.0.$method(other.0))
                }
            }
        };
    }

    operator!(Add, add);
    operator!(Sub, sub);
    operator!(Mul, mul);
    operator!(Div, div);

    impl Neg for Fused {
        type Output = Self;

        #[inline(always)]
        fn neg(self) -> Self {
            Self(-self.0)
        }
    }

    impl Real for Fused {
        #[inline(always)]
        fn of(value: f64) -> Self {
            Self(value)
        }

        #[inline(always)]
        fn mul_add(self, factor: Self, summand: Self) -> Self {
            Self(self.0.mul_add(factor.0, summand.0))
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            Self(self.0.sqrt())
        }

        #[inline(always)]
        fn sin_cos(self) -> (Self, Self) {
            let (sin, cos) = self.0.sin_cos();
            (Self(sin), Self(cos))
        }
    }
}

/// What a kernel returns, as plain doubles.
pub trait Plain<T> {
    /// The same numbers.
    fn plain(self) -> T;
}

impl<R: Double> Plain<f64> for R {
    #[inline(always)]
    fn plain(self) -> f64 {
        cast(self)
    }
}

impl<R: Double, const K: usize> Plain<[f64; K]> for [R; K] {
    #[inline(always)]
    fn plain(self) -> [f64; K] {
        cast(self)
    }
}

impl<R: Double, const K: usize, const L: usize> Plain<[[f64; K]; L]> for [[R; K]; L] {
    #[inline(always)]
    fn plain(self) -> [[f64; K]; L] {
        cast(self)
    }
}

impl<R: Double, const K: usize, const L: usize, const M: usize> Plain<[[[f64; K]; L]; M]>
    for [[[R; K]; L]; M]
{
    #[inline(always)]
    fn plain(self) -> [[[f64; K]; L]; M] {
        cast(self)
    }
}

macro_rules! tuple {
    ($($from:ident $to:ident $field:tt),+) => {
        impl<$($from: Plain<$to>, $to),+> Plain<($($to,)+)> for ($($from,)+) {
            #[inline(always)]
            fn plain(self) -> ($($to,)+) {
                ($(self.$field.plain(),)+)
            }
        }
    };
}

tuple!(A X 0, B Y 1);
tuple!(A X 0, B Y 1, C Z 2);
tuple!(A X 0, B Y 1, C Z 2, D W 3);
