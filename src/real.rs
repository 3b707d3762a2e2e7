//! [`Real`]: the scalars that generated code runs on.

use core::ops::{Add, Div, Mul, Neg, Sub};

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

    /// The square root.
    fn sqrt(self) -> Self;

    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
}

macro_rules! scalar {
    ($scalar:ident, $sqrt:path, $sincos:path) => {
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
        }
    };
}

scalar!(f64, libm::sqrt, libm::sincos);
scalar!(f32, libm::sqrtf, libm::sincosf);
