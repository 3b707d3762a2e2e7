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
    /// By [`trigonometry`](crate::trigonometry), as lanes do it.
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Self; K]) -> ([Self; K], [Self; K]) {
        let (mut sines, mut cosines) = (angles, angles);
        for i in 0..K {
            (sines[i], cosines[i]) = crate::trigonometry::sin_cos(angles[i]);
        }
        (sines, cosines)
    }
});
scalar!(f32, libm::sqrtf, libm::sincosf, {});

/// The farthest that a prismatic joint's coordinate is read as, m: ten times the longest link of a table.
///
/// Farther out, what a light link before the joint adds to M would drown in the rounding of what the joint carries:
/// tables are refused whose links are too light for this distance.
pub const PRISMATIC_LIMIT: f64 = 1e3;

/// A prismatic joint's coordinate as every backend reads it: held within ±[`PRISMATIC_LIMIT`],
/// so that no finite coordinate, however absurd, makes a result NaN. An infinite one is no coordinate: NaN.
#[inline]
pub fn prismatic_offset(q: f64) -> f64 {
    if q.is_infinite() {
        f64::NAN
    } else {
        q.clamp(-PRISMATIC_LIMIT, PRISMATIC_LIMIT)
    }
}

/// Up to here coordinates, rad or m, are read as they are by [`revolute_angle`] and [`prismatic_offset`]: two turns and a half.
pub const PLAIN_LIMIT: f64 = 16.0;

/// A revolute joint's coordinate as generated code reads it: beyond [`PLAIN_LIMIT`], the same angle within ±π. NaN if infinite.
///
/// Generated code adds angles of parallel joints before it takes their sine; of large angles the sum would be rounded
/// coarsely, or overflow. The sine and cosine of the angle itself are exact however large it is.
#[inline]
pub fn revolute_angle(q: f64) -> f64 {
    if q.abs() <= PLAIN_LIMIT {
        q
    } else {
        let (sin, cos) = Real::sin_cos(q);
        nalgebra::RealField::atan2(sin, cos)
    }
}
