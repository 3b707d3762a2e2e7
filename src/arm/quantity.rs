//! [`Quantity`]: what methods return, as numbers in a row.

use core::slice;

use bytemuck::{Pod, cast_slice, cast_slice_mut};
use nalgebra::{IsometryMatrix3, SMatrix};

/// A result of a method of [`Arm`](crate::Arm), in the parts that its kernel returns, each of numbers in a row:
/// matrices by columns, a pose as its rotation and its translation.
pub trait Quantity: Copy {
    /// How many parts.
    const PARTS: usize;

    /// All numbers 0.
    fn zero() -> Self;

    /// The numbers of a part.
    fn part(&self, part: usize) -> &[f64];

    /// Where the numbers of a part go.
    fn part_mut(&mut self, part: usize) -> &mut [f64];

    /// Hands out where the numbers of every part go, the first part first.
    fn give_parts<'a>(&'a mut self, take: &mut impl FnMut(&'a mut [f64]));

    /// The same with 0 in the parts from `first` on.
    fn zero_from(self, first: usize) -> Self;

    /// All numbers, part by part.
    fn numbers(&self) -> impl Iterator<Item = f64> {
        (0..Self::PARTS).flat_map(|part| self.part(part).iter().copied())
    }
}

impl Quantity for f64 {
    const PARTS: usize = 1;

    fn zero() -> Self {
        0.0
    }

    #[inline(always)]
    fn zero_from(self, first: usize) -> Self {
        if first == 0 { Self::zero() } else { self }
    }

    #[inline(always)]
    fn part(&self, _: usize) -> &[f64] {
        slice::from_ref(self)
    }

    #[inline(always)]
    fn part_mut(&mut self, _: usize) -> &mut [f64] {
        slice::from_mut(self)
    }

    #[inline(always)]
    fn give_parts<'a>(&'a mut self, take: &mut impl FnMut(&'a mut [f64])) {
        take(self.part_mut(0));
    }
}

impl<const R: usize, const C: usize> Quantity for SMatrix<f64, R, C> {
    const PARTS: usize = 1;

    fn zero() -> Self {
        Self::zeros()
    }

    #[inline(always)]
    fn zero_from(self, first: usize) -> Self {
        if first == 0 { Self::zero() } else { self }
    }

    #[inline(always)]
    fn part(&self, _: usize) -> &[f64] {
        self.as_slice()
    }

    #[inline(always)]
    fn part_mut(&mut self, _: usize) -> &mut [f64] {
        self.as_mut_slice()
    }

    #[inline(always)]
    fn give_parts<'a>(&'a mut self, take: &mut impl FnMut(&'a mut [f64])) {
        take(self.part_mut(0));
    }
}

/// Matrices or poses, one after another: nalgebra keeps a pose as its rotation and its translation in a row.
impl<T: Quantity + Pod, const K: usize> Quantity for [T; K] {
    const PARTS: usize = 1;

    fn zero() -> Self {
        [T::zero(); K]
    }

    #[inline(always)]
    fn zero_from(self, first: usize) -> Self {
        if first == 0 { Self::zero() } else { self }
    }

    #[inline(always)]
    fn part(&self, _: usize) -> &[f64] {
        cast_slice(self)
    }

    #[inline(always)]
    fn part_mut(&mut self, _: usize) -> &mut [f64] {
        cast_slice_mut(self)
    }

    #[inline(always)]
    fn give_parts<'a>(&'a mut self, take: &mut impl FnMut(&'a mut [f64])) {
        take(self.part_mut(0));
    }
}

impl Quantity for IsometryMatrix3<f64> {
    const PARTS: usize = 2;

    fn zero() -> Self {
        let mut pose = Self::identity();
        pose.rotation.matrix_mut_unchecked().fill(0.0);
        pose
    }

    fn zero_from(mut self, first: usize) -> Self {
        (first..Self::PARTS).for_each(|part| self.part_mut(part).fill(0.0));
        self
    }

    #[inline(always)]
    fn part(&self, part: usize) -> &[f64] {
        match part {
            0 => self.rotation.matrix().as_slice(),
            _ => self.translation.vector.as_slice(),
        }
    }

    #[inline(always)]
    fn part_mut(&mut self, part: usize) -> &mut [f64] {
        match part {
            0 => self.rotation.matrix_mut_unchecked().as_mut_slice(),
            _ => self.translation.vector.as_mut_slice(),
        }
    }

    #[inline(always)]
    fn give_parts<'a>(&'a mut self, take: &mut impl FnMut(&'a mut [f64])) {
        take(self.rotation.matrix_mut_unchecked().as_mut_slice());
        take(self.translation.vector.as_mut_slice());
    }
}

/// Those of one after those of the other.
impl<A: Quantity, B: Quantity> Quantity for (A, B) {
    const PARTS: usize = A::PARTS + B::PARTS;

    fn zero() -> Self {
        (A::zero(), B::zero())
    }

    #[inline(always)]
    fn zero_from(self, first: usize) -> Self {
        let second = first.saturating_sub(A::PARTS);
        (self.0.zero_from(first), self.1.zero_from(second))
    }

    #[inline(always)]
    fn part(&self, part: usize) -> &[f64] {
        if part < A::PARTS {
            self.0.part(part)
        } else {
            self.1.part(part - A::PARTS)
        }
    }

    #[inline(always)]
    fn part_mut(&mut self, part: usize) -> &mut [f64] {
        if part < A::PARTS {
            self.0.part_mut(part)
        } else {
            self.1.part_mut(part - A::PARTS)
        }
    }

    #[inline(always)]
    fn give_parts<'a>(&'a mut self, take: &mut impl FnMut(&'a mut [f64])) {
        self.0.give_parts(take);
        self.1.give_parts(take);
    }
}

/// Likewise.
impl<A: Quantity, B: Quantity, C: Quantity> Quantity for (A, B, C) {
    const PARTS: usize = A::PARTS + B::PARTS + C::PARTS;

    fn zero() -> Self {
        (A::zero(), B::zero(), C::zero())
    }

    #[inline(always)]
    fn zero_from(self, first: usize) -> Self {
        let second = first.saturating_sub(A::PARTS);
        (
            self.0.zero_from(first),
            self.1.zero_from(second),
            self.2.zero_from(second.saturating_sub(B::PARTS)),
        )
    }

    #[inline(always)]
    fn part(&self, part: usize) -> &[f64] {
        if part < A::PARTS {
            self.0.part(part)
        } else if part < A::PARTS + B::PARTS {
            self.1.part(part - A::PARTS)
        } else {
            self.2.part(part - A::PARTS - B::PARTS)
        }
    }

    #[inline(always)]
    fn part_mut(&mut self, part: usize) -> &mut [f64] {
        if part < A::PARTS {
            self.0.part_mut(part)
        } else if part < A::PARTS + B::PARTS {
            self.1.part_mut(part - A::PARTS)
        } else {
            self.2.part_mut(part - A::PARTS - B::PARTS)
        }
    }

    #[inline(always)]
    fn give_parts<'a>(&'a mut self, take: &mut impl FnMut(&'a mut [f64])) {
        self.0.give_parts(take);
        self.1.give_parts(take);
        self.2.give_parts(take);
    }
}
