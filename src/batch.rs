//! [`ArmBatch`]: every method of [`Arm`] for many states at once, in lanes.

use core::marker::PhantomData;

use nalgebra::{IsometryMatrix3, SMatrix, SVector};

use crate::simd::{self, BatchCall, Lanes, MAX_WIDTH};
use crate::unrolled::{Margins, coordinate, is_singular};
use crate::{Arm, SerialChain, Unrolled};

/// A result of a method, filled element by element in the order in which a kernel returns them.
trait Slots {
    /// Puts the `index`-th number.
    fn put(&mut self, index: usize, value: f64);

    /// What the method returns where the task is singular, if it has a part of w_D.
    fn settle(&mut self) {}
}

impl Slots for f64 {
    #[inline(always)]
    fn put(&mut self, _: usize, value: f64) {
        *self = value;
    }

    fn settle(&mut self) {
        *self = 0.0;
    }
}

impl<const R: usize, const C: usize> Slots for SMatrix<f64, R, C> {
    #[inline(always)]
    fn put(&mut self, index: usize, value: f64) {
        self.data.0[index / R][index % R] = value;
    }
}

impl<const R: usize, const C: usize, const K: usize> Slots for [SMatrix<f64, R, C>; K] {
    #[inline(always)]
    fn put(&mut self, index: usize, value: f64) {
        self[index / (R * C)].put(index % (R * C), value);
    }
}

impl Slots for IsometryMatrix3<f64> {
    #[inline(always)]
    fn put(&mut self, index: usize, value: f64) {
        match index {
            0..9 => self.rotation.matrix_mut_unchecked().put(index, value),
            _ => self.translation.vector[index - 9] = value,
        }
    }
}

impl<const N: usize> Slots for (f64, SVector<f64, N>) {
    #[inline(always)]
    fn put(&mut self, index: usize, value: f64) {
        match index {
            0 => self.0 = value,
            _ => self.1[index - 1] = value,
        }
    }

    fn settle(&mut self) {
        *self = (0.0, SVector::zeros());
    }
}

impl<const N: usize> Slots for (SMatrix<f64, N, N>, [SMatrix<f64, N, N>; N]) {
    #[inline(always)]
    fn put(&mut self, index: usize, value: f64) {
        match index.checked_sub(N * N) {
            None => self.0.put(index, value),
            Some(index) => self.1.put(index, value),
        }
    }
}

impl<const N: usize> Slots for (SMatrix<f64, 6, N>, f64, SVector<f64, N>) {
    #[inline(always)]
    fn put(&mut self, index: usize, value: f64) {
        match index.checked_sub(6 * N) {
            None => self.0.put(index, value),
            Some(0) => self.1 = value,
            Some(index) => self.2[index - 1] = value,
        }
    }

    fn settle(&mut self) {
        self.1 = 0.0;
        self.2 = SVector::zeros();
    }
}

/// What a kernel returns on lanes `R`, to be handed out number by number.
trait Numbers<R> {
    /// Puts the numbers into the results of the lanes, the first number at `index`; returns the next index.
    fn scatter<T: Slots>(&self, index: usize, out: &mut [T]) -> usize;
}

impl<R: Lanes> Numbers<R> for R {
    #[inline(always)]
    fn scatter<T: Slots>(&self, index: usize, out: &mut [T]) -> usize {
        for (result, number) in out.iter_mut().zip(self.store()) {
            result.put(index, number);
        }
        index + 1
    }
}

impl<R: Lanes, T: Numbers<R>, const K: usize> Numbers<R> for [T; K] {
    #[inline(always)]
    fn scatter<S: Slots>(&self, mut index: usize, out: &mut [S]) -> usize {
        for item in self {
            index = item.scatter(index, out);
        }
        index
    }
}

/// Two results one after the other.
impl<R: Lanes, A: Numbers<R>, B: Numbers<R>> Numbers<R> for (A, B) {
    #[inline(always)]
    fn scatter<T: Slots>(&self, index: usize, out: &mut [T]) -> usize {
        let next = self.0.scatter(index, out);
        self.1.scatter(next, out)
    }
}

/// The lanes of joint vectors from `start` on, read by `read`; the last vector repeats where there are too few.
#[inline(always)]
fn gather<R: Lanes, const N: usize>(
    vectors: &[SVector<f64, N>],
    start: usize,
    read: impl Fn(usize, f64) -> f64,
) -> [R; N] {
    let last = vectors.len() - 1;
    let mut lanes = [R::of(0.0); N];
    for (joint, lanes) in lanes.iter_mut().enumerate() {
        let mut numbers = [0.0; MAX_WIDTH];
        for (lane, number) in numbers[..R::WIDTH].iter_mut().enumerate() {
            *number = read(joint, vectors[(start + lane).min(last)][joint]);
        }
        *lanes = R::load(&numbers);
    }
    lanes
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
/// and what of the kernel's returns are the numbers and, of w_D, the margins.
macro_rules! methods {
    ($($batch:ident $method:ident(q $(, $other:ident)*) -> $output:ty = $kernel:ident |$result:pat_param| $numbers:expr $(, $margins:ident)?;)+) => {
        /// An arm that computes many states at once.
        ///
        /// Each method writes as many results as both the states and `out` have room for; lengths may be anything.
        /// Generated arms run in lanes, four or eight states at a time as the machine allows. Their results are those of the
        /// methods of [`Arm`] to the bit, except on machines whose lanes of `wide` round multiply-adds otherwise than
        /// one double does (none that we know of).
        pub trait ArmBatch<const N: usize>: Arm<N> {
            $(
                #[doc = concat!("[`Arm::", stringify!($method), "`] for each state.")]
                fn $batch(&self, q: &[SVector<f64, N>], $($other: &[SVector<f64, N>],)* out: &mut [$output]);
            )+
        }

        /// One by one.
        impl<const N: usize> ArmBatch<N> for SerialChain<N> {
            $(
                fn $batch(&self, q: &[SVector<f64, N>], $($other: &[SVector<f64, N>],)* out: &mut [$output]) {
                    let count = [q.len(), $($other.len(),)* out.len()].into_iter().min().unwrap_or(0);
                    for (i, out) in out[..count].iter_mut().enumerate() {
                        *out = self.$method(&q[i] $(, &$other[i])*);
                    }
                }
            )+
        }

        /// In lanes.
        impl<A: Unrolled<N> + Arm<N>, const N: usize> ArmBatch<N> for A {
            $(
                fn $batch(&self, q: &[SVector<f64, N>], $($other: &[SVector<f64, N>],)* out: &mut [$output]) {
                    struct Run<'a, A, const N: usize> {
                        q: &'a [SVector<f64, N>],
                        $($other: &'a [SVector<f64, N>],)*
                        out: &'a mut [$output],
                        arm: PhantomData<A>,
                    }
                    impl<A: Unrolled<N>, const N: usize> BatchCall for Run<'_, A, N> {
                        #[inline(always)]
                        fn run<R: Lanes>(self) {
                            let read = |joint: usize, q| coordinate(A::CHAIN.joints[joint].kind, q);
                            for (chunk, out) in self.out.chunks_mut(R::WIDTH).enumerate() {
                                let start = chunk * R::WIDTH;
                                let q = gather::<R, N>(self.q, start, read);
                                $(let $other = gather::<R, N>(self.$other, start, |_, x| x);)*
                                let $result = A::$kernel::<R>(&q $(, &$other)*);
                                Numbers::<R>::scatter(&$numbers, 0, out);
                                $(settle(&$margins, out);)?
                            }
                        }
                    }
                    let count = [q.len(), $($other.len(),)* out.len()].into_iter().min().unwrap_or(0);
                    if count > 0 {
                        let out = &mut out[..count];
                        simd::run_batch(Run::<A, N> { q, $($other,)* out, arm: PhantomData });
                    }
                }
            )+
        }
    };
}

#[rustfmt::skip]
methods! {
    forward_kinematics_batch forward_kinematics(q) -> IsometryMatrix3<f64> = forward_kinematics_kernel |all| all;
    geometric_jacobian_batch geometric_jacobian(q) -> SMatrix<f64, 6, N> = geometric_jacobian_kernel |all| all;
    jacobian_derivatives_batch jacobian_derivatives(q) -> [SMatrix<f64, 6, N>; N] = jacobian_derivatives_kernel |all| all;
    mass_matrix_batch mass_matrix(q) -> SMatrix<f64, N, N> = mass_matrix_kernel |all| all;
    mass_matrix_derivatives_batch mass_matrix_derivatives(q) -> [SMatrix<f64, N, N>; N] = mass_matrix_derivatives_kernel |all| all;
    dynamic_manipulability_batch dynamic_manipulability(q) -> f64 = dynamic_manipulability_kernel |(value, margins)| value, margins;
    dynamic_manipulability_gradient_batch dynamic_manipulability_gradient(q) -> (f64, SVector<f64, N>) = dynamic_manipulability_gradient_kernel |(value, gradient, margins)| (value, gradient), margins;
    inverse_dynamics_batch inverse_dynamics(q, qd, qdd) -> SVector<f64, N> = inverse_dynamics_kernel |all| all;
    bias_force_batch bias_force(q, qd) -> SVector<f64, N> = bias_force_kernel |all| all;
    gravity_torque_batch gravity_torque(q) -> SVector<f64, N> = gravity_torque_kernel |all| all;
    forward_dynamics_batch forward_dynamics(q, qd, tau) -> SVector<f64, N> = forward_dynamics_kernel |all| all;
    mass_matrix_and_derivatives_batch mass_matrix_and_derivatives(q) -> (SMatrix<f64, N, N>, [SMatrix<f64, N, N>; N]) = mass_matrix_and_derivatives_kernel |all| all;
    jacobian_and_gradient_batch jacobian_and_gradient(q) -> (SMatrix<f64, 6, N>, f64, SVector<f64, N>) = jacobian_and_gradient_kernel |(jacobian, value, gradient, margins)| (jacobian, (value, gradient)), margins;
}

/// Runs `batch` on chunks of the states in parallel: `in_parallel(&q, &mut out, |q, out| arm.mass_matrix_batch(q, out))`.
#[cfg(feature = "rayon")]
pub fn in_parallel<S: Sync, T: Send>(
    states: &[S],
    out: &mut [T],
    batch: impl Fn(&[S], &mut [T]) + Sync,
) {
    use rayon::prelude::*;

    /// A multiple of every lane's width, and long enough to be worth a thread's while.
    const CHUNK: usize = 256;
    let chunks = states.par_chunks(CHUNK).zip(out.par_chunks_mut(CHUNK));
    chunks.for_each(|(states, out)| batch(states, out));
}
