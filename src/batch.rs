//! [`ArmBatch`]: every method of [`Arm`] for many states at once, in lanes.

mod lengths;

use core::marker::PhantomData;
use core::slice;

use bytemuck::cast_slice_mut;
use nalgebra::{IsometryMatrix3, SMatrix, SVector};

use crate::simd::{self, BLOCK, BatchCall, Lanes, MAX_WIDTH};
use crate::unrolled::{Margins, are_plain, coordinates, is_singular};
use crate::{Arm, SerialChain, Unrolled};

pub use lengths::LengthMismatch;

/// A result of a method, in parts as a kernel returns them, each of numbers in a row.
trait Slots {
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
trait Numbers<R> {
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

/// Gives each lane's result its numbers of a part.
#[inline(always)]
fn scatter<R: Lanes, T: Slots>(numbers: &[R], part: usize, out: &mut [T]) {
    let (blocks, rest) = numbers.as_chunks::<BLOCK>();
    let mut start = 0;
    for block in blocks {
        let rows = R::transpose(block);
        for (result, row) in out.iter_mut().zip(&rows) {
            result.part(part)[start..][..BLOCK].copy_from_slice(row);
        }
        start += BLOCK;
    }
    if !rest.is_empty() {
        let mut block = [rest[0]; BLOCK];
        block[..rest.len()].copy_from_slice(rest);
        let rows = R::transpose(&block);
        for (result, row) in out.iter_mut().zip(&rows) {
            result.part(part)[start..].copy_from_slice(&row[..rest.len()]);
        }
    }
}

/// The lanes of at most as many vectors; the last one repeats where there are fewer.
#[inline(always)]
fn gather<R: Lanes, const N: usize>(vectors: &[SVector<f64, N>]) -> [R; N] {
    let last = vectors.len() - 1;
    let mut lanes = [R::of(0.0); N];
    for (joint, lanes) in lanes.iter_mut().enumerate() {
        let mut numbers = [0.0; MAX_WIDTH];
        for (lane, number) in numbers[..R::WIDTH].iter_mut().enumerate() {
            *number = vectors[lane.min(last)][joint];
        }
        *lanes = R::load(&numbers);
    }
    lanes
}

/// As [`gather`], of joint coordinates.
#[inline(always)]
fn gather_coordinates<A: Unrolled<N>, R: Lanes, const N: usize>(q: &[SVector<f64, N>]) -> [R; N] {
    let mut all_plain = true;
    for q in q {
        all_plain &= are_plain(&q.data.0[0]);
    }
    if all_plain {
        return gather(q);
    }
    let mut safe = [SVector::zeros(); MAX_WIDTH];
    for (safe, q) in safe.iter_mut().zip(q) {
        *safe = coordinates(&A::CHAIN, &q.data.0[0]).into();
    }
    gather(&safe[..q.len()])
}

/// Sets right what the singular ones among the lanes have.
#[inline(always)]
fn settle<R: Lanes, T: Slots>(margins: &Margins<R>, out: &mut [T]) {
    let mut apart = [[[0.0; 6]; 2]; MAX_WIDTH];
    for (part, row) in margins.iter().enumerate() {
        for (index, lanes) in row.iter().enumerate() {
            for (margins, number) in apart.iter_mut().zip(lanes.store()) {
                margins[part][index] = number;
            }
        }
    }
    for (result, margins) in out.iter_mut().zip(&apart) {
        if is_singular(margins) {
            result.settle();
        }
    }
}

/// Every method: its name in a batch, its own, the first argument `q` and the others, the result, the kernel,
/// and what of the kernel's returns are the result's parts and, of w_D, the margins.
macro_rules! methods {
    ($($batch:ident $method:ident(q $(, $other:ident)*) -> $output:ty = $kernel:ident |$result:pat_param| ($($part:ident),+) $(, $margins:ident)?;)+) => {
        /// An arm that computes many states at once.
        ///
        /// A batch may have any length, but all its slices have the same.
        /// Generated arms run in lanes, four or eight states at a time as the machine allows. Their results are those of the
        /// methods of [`Arm`] to the bit, except on machines whose lanes of `wide` round multiply-adds otherwise than
        /// one double does (none that we know of).
        pub trait ArmBatch<const N: usize>: Arm<N> {
            $(
                #[doc = concat!("[`Arm::", stringify!($method), "`] for each state.")]
                ///
                /// # Errors
                /// A slice that is not as long as `q`; nothing is written then.
                fn $batch(&self, q: &[SVector<f64, N>], $($other: &[SVector<f64, N>],)* out: &mut [$output]) -> Result<(), LengthMismatch>;
            )+
        }

        /// One by one.
        impl<const N: usize> ArmBatch<N> for SerialChain<N> {
            $(
                fn $batch(&self, q: &[SVector<f64, N>], $($other: &[SVector<f64, N>],)* out: &mut [$output]) -> Result<(), LengthMismatch> {
                    lengths::check(q.len(), &[$((stringify!($other), $other.len()),)* ("out", out.len())])?;
                    for (i, out) in out.iter_mut().enumerate() {
                        *out = self.$method(&q[i] $(, &$other[i])*);
                    }
                    Ok(())
                }
            )+
        }

        /// In lanes.
        impl<A: Unrolled<N> + Arm<N>, const N: usize> ArmBatch<N> for A {
            $(
                fn $batch(&self, q: &[SVector<f64, N>], $($other: &[SVector<f64, N>],)* out: &mut [$output]) -> Result<(), LengthMismatch> {
                    struct Run<'a, A, const N: usize> {
                        q: &'a [SVector<f64, N>],
                        $($other: &'a [SVector<f64, N>],)*
                        out: &'a mut [$output],
                        arm: PhantomData<A>,
                    }
                    impl<A: Unrolled<N>, const N: usize> BatchCall for Run<'_, A, N> {
                        #[inline(always)]
                        fn run<R: Lanes>(self) {
                            for (chunk, out) in self.out.chunks_mut(R::WIDTH).enumerate() {
                                let states = chunk * R::WIDTH..chunk * R::WIDTH + out.len();
                                let q = gather_coordinates::<A, R, N>(&self.q[states.clone()]);
                                $(let $other = gather::<R, N>(&self.$other[states.clone()]);)*
                                let $result = A::$kernel::<R>(&q $(, &$other)*);
                                let parts = [$(Numbers::<R>::numbers(&$part)),+];
                                for (part, numbers) in parts.into_iter().enumerate() {
                                    scatter(numbers, part, out);
                                }
                                $(settle(&$margins, out);)?
                            }
                        }
                    }
                    lengths::check(q.len(), &[$((stringify!($other), $other.len()),)* ("out", out.len())])?;
                    simd::run_batch(Run::<A, N> { q, $($other,)* out, arm: PhantomData });
                    Ok(())
                }
            )+
        }
    };
}

#[rustfmt::skip]
methods! {
    forward_kinematics_batch forward_kinematics(q) -> IsometryMatrix3<f64> = forward_kinematics_kernel |(rotation, translation)| (rotation, translation);
    geometric_jacobian_batch geometric_jacobian(q) -> SMatrix<f64, 6, N> = geometric_jacobian_kernel |all| (all);
    jacobian_derivatives_batch jacobian_derivatives(q) -> [SMatrix<f64, 6, N>; N] = jacobian_derivatives_kernel |all| (all);
    mass_matrix_batch mass_matrix(q) -> SMatrix<f64, N, N> = mass_matrix_kernel |all| (all);
    mass_matrix_derivatives_batch mass_matrix_derivatives(q) -> [SMatrix<f64, N, N>; N] = mass_matrix_derivatives_kernel |all| (all);
    dynamic_manipulability_batch dynamic_manipulability(q) -> f64 = dynamic_manipulability_kernel |(value, margins)| (value), margins;
    dynamic_manipulability_gradient_batch dynamic_manipulability_gradient(q) -> (f64, SVector<f64, N>) = dynamic_manipulability_gradient_kernel |(value, gradient, margins)| (value, gradient), margins;
    inverse_dynamics_batch inverse_dynamics(q, qd, qdd) -> SVector<f64, N> = inverse_dynamics_kernel |all| (all);
    bias_force_batch bias_force(q, qd) -> SVector<f64, N> = bias_force_kernel |all| (all);
    gravity_torque_batch gravity_torque(q) -> SVector<f64, N> = gravity_torque_kernel |all| (all);
    forward_dynamics_batch forward_dynamics(q, qd, tau) -> SVector<f64, N> = forward_dynamics_kernel |all| (all);
    mass_matrix_and_derivatives_batch mass_matrix_and_derivatives(q) -> (SMatrix<f64, N, N>, [SMatrix<f64, N, N>; N]) = mass_matrix_and_derivatives_kernel |(mass, derivatives)| (mass, derivatives);
    jacobian_and_gradient_batch jacobian_and_gradient(q) -> (SMatrix<f64, 6, N>, f64, SVector<f64, N>) = jacobian_and_gradient_kernel |(jacobian, value, gradient, margins)| (jacobian, value, gradient), margins;
}

/// Runs `batch` on chunks of the states in parallel: `in_parallel(&q, &mut out, |q, out| arm.mass_matrix_batch(q, out))`.
///
/// # Errors
/// There are more or fewer results than states, and nothing is written; or a chunk's own.
#[cfg(feature = "rayon")]
pub fn in_parallel<S: Sync, T: Send>(
    states: &[S],
    out: &mut [T],
    batch: impl Fn(&[S], &mut [T]) -> Result<(), LengthMismatch> + Sync,
) -> Result<(), LengthMismatch> {
    use rayon::prelude::*;

    /// A multiple of every lane's width, and long enough to be worth a thread's while.
    const CHUNK: usize = 256;
    lengths::check(states.len(), &[("out", out.len())])?;
    let chunks = states.par_chunks(CHUNK).zip(out.par_chunks_mut(CHUNK));
    chunks.try_for_each(|(states, out)| batch(states, out))
}
