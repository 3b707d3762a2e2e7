//! Where the numbers of a result come from and go to: [`Numbers`] as a kernel returns them, [`Slots`] of what a method returns.

use core::slice;

use bytemuck::cast_slice_mut;
use nalgebra::{IsometryMatrix3, SMatrix, SVector};

use crate::kernels::simd::Lanes;

/// A result of a method, in parts as a kernel returns them, each of numbers in a row.
pub(super) trait Slots {
    /// Where the numbers of a part go.
    fn part(&mut self, part: usize) -> &mut [f64];

    /// What the method returns where the task is singular, if it has a part of w_D.
    fn settle(&mut self) {}
}

impl Slots for f64 {
    fn part(&mut self, _: usize) -> &mut [f64] {
        slice::from_mut(self)
    }

    fn settle(&mut self) {
        *self = 0.0;
    }
}

impl<const R: usize, const C: usize> Slots for SMatrix<f64, R, C> {
    fn part(&mut self, _: usize) -> &mut [f64] {
        self.as_mut_slice()
    }
}

impl<const R: usize, const C: usize, const K: usize> Slots for [SMatrix<f64, R, C>; K] {
    fn part(&mut self, _: usize) -> &mut [f64] {
        cast_slice_mut(self)
    }
}

impl Slots for IsometryMatrix3<f64> {
    fn part(&mut self, part: usize) -> &mut [f64] {
        match part {
            0 => self.rotation.matrix_mut_unchecked().as_mut_slice(),
            _ => self.translation.vector.as_mut_slice(),
        }
    }
}

impl<const N: usize> Slots for (f64, SVector<f64, N>) {
    fn part(&mut self, part: usize) -> &mut [f64] {
        match part {
            0 => slice::from_mut(&mut self.0),
            _ => self.1.as_mut_slice(),
        }
    }

    fn settle(&mut self) {
        *self = (0.0, SVector::zeros());
    }
}

impl<const N: usize> Slots for (SMatrix<f64, N, N>, [SMatrix<f64, N, N>; N]) {
    fn part(&mut self, part: usize) -> &mut [f64] {
        match part {
            0 => self.0.as_mut_slice(),
            _ => cast_slice_mut(&mut self.1),
        }
    }
}

impl<const N: usize> Slots for (SMatrix<f64, 6, N>, f64, SVector<f64, N>) {
    fn part(&mut self, part: usize) -> &mut [f64] {
        match part {
            0 => self.0.as_mut_slice(),
            1 => slice::from_mut(&mut self.1),
            _ => self.2.as_mut_slice(),
        }
    }

    fn settle(&mut self) {
        self.1 = 0.0;
        self.2 = SVector::zeros();
    }
}

/// A part of what a kernel returns on lanes `R`.
pub(super) trait Numbers<R> {
    /// Its numbers in a row.
    fn numbers(&self) -> &[R];
}

impl<R: Lanes> Numbers<R> for R {
    #[inline(always)]
    fn numbers(&self) -> &[R] {
        slice::from_ref(self)
    }
}

impl<R: Lanes, const K: usize> Numbers<R> for [R; K] {
    #[inline(always)]
    fn numbers(&self) -> &[R] {
        self
    }
}

impl<R: Lanes, const K: usize, const L: usize> Numbers<R> for [[R; K]; L] {
    #[inline(always)]
    fn numbers(&self) -> &[R] {
        self.as_flattened()
    }
}

impl<R: Lanes, const K: usize, const L: usize, const M: usize> Numbers<R> for [[[R; K]; L]; M] {
    #[inline(always)]
    fn numbers(&self) -> &[R] {
        self.as_flattened().as_flattened()
    }
}
