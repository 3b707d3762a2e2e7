//! [`Returned`]: what kernels return on lanes, in parts.

use core::slice;

use crate::kernels::simd::Lanes;

/// What a kernel returns on lanes `R`, in parts, each of numbers in a row.
pub(super) trait Returned<R> {
    /// The numbers of a part.
    fn part(&self, part: usize) -> &[R];
}

impl<R: Lanes> Returned<R> for R {
    #[inline(always)]
    fn part(&self, _: usize) -> &[R] {
        slice::from_ref(self)
    }
}

impl<R: Lanes, const K: usize> Returned<R> for [R; K] {
    #[inline(always)]
    fn part(&self, _: usize) -> &[R] {
        self
    }
}

impl<R: Lanes, const K: usize, const L: usize> Returned<R> for [[R; K]; L] {
    #[inline(always)]
    fn part(&self, _: usize) -> &[R] {
        self.as_flattened()
    }
}

impl<R: Lanes, const K: usize, const L: usize, const M: usize> Returned<R> for [[[R; K]; L]; M] {
    #[inline(always)]
    fn part(&self, _: usize) -> &[R] {
        self.as_flattened().as_flattened()
    }
}

macro_rules! tuple {
    ($($part:ident $field:tt),+; $last:ident $last_field:tt) => {
        impl<R: Lanes, $($part: Returned<R>,)+ $last: Returned<R>> Returned<R> for ($($part,)+ $last) {
            #[inline(always)]
            fn part(&self, part: usize) -> &[R] {
                match part {
                    $($field => self.$field.part(0),)+
                    _ => self.$last_field.part(0),
                }
            }
        }
    };
}

tuple!(A 0; B 1);
tuple!(A 0, B 1; C 2);
tuple!(A 0, B 1, C 2; D 3);
