//! What kernels return, on scalars of one double, as what methods return: the same bytes.

use bytemuck::cast;
use nalgebra::{SMatrix, SVector};

use super::Double;

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
    [R; K] => [f64; K], <K>;
    [R; K] => SVector<f64, K>, <K>;
    [[R; K]; L] => [[f64; K]; L], <K, L>;
    [[R; K]; L] => SMatrix<f64, K, L>, <K, L>;
    [[[R; K]; L]; M] => [SMatrix<f64, K, L>; M], <K, L, M>;
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
