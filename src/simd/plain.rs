//! Arrays of scalars of one double, as arrays of doubles: the same bytes.

use bytemuck::cast;

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
