//! What kernels return, on scalars of one double, as what methods return: the same bytes.

use bytemuck::cast;
use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, SMatrix, SVector, Translation3, Vector3};

use super::Double;
use crate::arm::quantity::Quantity;

/// What a kernel returns, as plain doubles.
pub(crate) trait Plain<T> {
    /// The same numbers.
    fn plain(self) -> T;
}

impl<R: Double> Plain<f64> for R {
    #[inline(always)]
    fn plain(self) -> f64 {
        cast(self)
    }
}

macro_rules! same_bytes {
    ($($from:ty => $to:ty, <$($size:ident),+>;)+) => {
        $(
            impl<R: Double, $(const $size: usize),+> Plain<$to> for $from {
                #[inline(always)]
                fn plain(self) -> $to {
                    cast(self)
                }
            }
        )+
    };
}

same_bytes! {
    [R; K] => SVector<f64, K>, <K>;
    [[R; K]; L] => SMatrix<f64, K, L>, <K, L>;
    [[[R; K]; L]; M] => [SMatrix<f64, K, L>; M], <K, L, M>;
}

impl<R: Double> Plain<IsometryMatrix3<f64>> for ([[R; 3]; 3], [R; 3]) {
    #[inline(always)]
    fn plain(self) -> IsometryMatrix3<f64> {
        let (rotation, translation): (Matrix3<f64>, Vector3<f64>) =
            (self.0.plain(), self.1.plain());
        IsometryMatrix3::from_parts(
            Translation3::from(translation),
            Rotation3::from_matrix_unchecked(rotation),
        )
    }
}

/// Each pose as the columns of its rotation and its translation, which is how nalgebra keeps one.
impl<R: Double, const N: usize> Plain<[IsometryMatrix3<f64>; N]> for [[[R; 3]; 4]; N] {
    #[inline(always)]
    fn plain(self) -> [IsometryMatrix3<f64>; N] {
        cast(self)
    }
}

/// What a kernel of w_D returns: a result, and det(JJᵀ) after it.
pub(crate) trait Settled<T> {
    /// The result, with 0 in its parts from `zero` on where det(JJᵀ) counts as 0.
    fn settle(self, zero: usize, counts_as_zero: impl FnOnce(f64) -> bool) -> T;
}

impl<R: Double, A: Plain<X>, X: Quantity> Settled<X> for (A, R) {
    #[inline(always)]
    fn settle(self, zero: usize, counts_as_zero: impl FnOnce(f64) -> bool) -> X {
        let (result, volume_squared): (X, f64) = (self.0.plain(), cast(self.1));
        if counts_as_zero(volume_squared) {
            result.zero_from(zero)
        } else {
            result
        }
    }
}

macro_rules! tuple {
    ($($from:ident $to:ident $value:ident $field:tt),+; $volume:tt) => {
        impl<$($from: Plain<$to>, $to),+> Plain<($($to,)+)> for ($($from,)+) {
            #[inline(always)]
            fn plain(self) -> ($($to,)+) {
                ($(self.$field.plain(),)+)
            }
        }

        impl<R: Double, $($from: Plain<$to>, $to: Quantity),+> Settled<($($to,)+)> for ($($from,)+ R) {
            #[inline(always)]
            fn settle(self, zero: usize, counts_as_zero: impl FnOnce(f64) -> bool) -> ($($to,)+) {
                let volume_squared: f64 = cast(self.$volume);
                $(let $value: $to = self.$field.plain();)+
                if counts_as_zero(volume_squared) {
                    ($($value,)+).zero_from(zero)
                } else {
                    ($($value,)+)
                }
            }
        }
    };
}

tuple!(A X x 0, B Y y 1; 2);
tuple!(A X x 0, B Y y 1, C Z z 2; 3);
