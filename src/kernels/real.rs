//! [`Real`]: the scalars that generated code runs on.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A part of a long kernel: see [`Real::apart`].
pub trait Part<S> {
    /// Carries on from where the parts before have brought `state`. To be inlined always: it is compiled for the instructions
    /// of its caller.
    fn run(state: &mut S);
}

/// A real scalar, or several in lanes.
///
/// Generated kernels are straight-line functions over this trait; they need nothing else of a number.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number `value`, in every lane.
    fn of(value: f64) -> Self;

    /// `self * factor + summand`, fused where the target has the instruction, in two roundings elsewhere:
    /// without the instruction a fused multiply-add is a library call, many times slower than both operations.
    fn mul_add(self, factor: Self, summand: Self) -> Self;

    /// `self * factor - subtrahend`, fused like [`Real::mul_add`].
    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        self.mul_add(factor, -subtrahend)
    }

    /// `minuend - self * factor`, fused like [`Real::mul_add`].
    #[inline(always)]
    fn neg_mul_add(self, factor: Self, minuend: Self) -> Self {
        (-self).mul_add(factor, minuend)
    }

    /// The square root.
    fn sqrt(self) -> Self;

    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);

    /// Runs a part of a kernel as a function of its own, compiled for the instructions of these scalars.
    ///
    /// Compilers take more than linear time on long functions, and debug builds give each operation its own place on the stack.
    #[inline(never)]
    fn apart<P: Part<S>, S>(state: &mut S) {
        P::run(state);
    }

    /// Sines and cosines of several angles at once, each within ±2²⁶ rad.
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Self; K]) -> ([Self; K], [Self; K]) {
        let (mut sines, mut cosines) = (angles, angles);
        for i in 0..K {
            (sines[i], cosines[i]) = angles[i].sin_cos();
        }
        (sines, cosines)
    }
}

macro_rules! scalar {
    ($scalar:ident, $sqrt:path, $sincos:path, { $($own:tt)* }) => {
        impl Real for $scalar {
            #[inline(always)]
            fn of(value: f64) -> Self {
                value as $scalar
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, summand: Self) -> Self {
                #[cfg(all(
                    feature = "std",
                    any(target_feature = "fma", target_arch = "aarch64")
                ))]
                return $scalar::mul_add(self, factor, summand);
                #[cfg(not(all(
                    feature = "std",
                    any(target_feature = "fma", target_arch = "aarch64")
                )))]
                return self * factor + summand;
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                #[cfg(feature = "std")]
                return $scalar::sqrt(self);
                #[cfg(not(feature = "std"))]
                return $sqrt(self);
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                #[cfg(feature = "std")]
                return $scalar::sin_cos(self);
                #[cfg(not(feature = "std"))]
                return $sincos(self);
            }

            $($own)*
        }
    };
}

scalar!(f64, libm::sqrt, libm::sincos, {
    /// Without branches, as lanes do it.
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Self; K]) -> ([Self; K], [Self; K]) {
        let (mut sines, mut cosines) = (angles, angles);
        for i in 0..K {
            (sines[i], cosines[i]) = crate::kernels::trigonometry::sin_cos(angles[i]);
        }
        (sines, cosines)
    }
});
scalar!(f32, libm::sqrtf, libm::sincosf, {});
