//! [`ArmBatch`]: every method of [`Arm`] for many states at once, in lanes where that is quicker than a loop over single calls.
//!
//! The rule, measured by `benches/batch.rs`: a register has to hold at least two doubles; where a result is a matrix for each
//! joint (∂J, ∂M, and M with ∂M), at least four, since there writing the numbers takes as long as computing them. Lanes are filled
//! with states from the first on. The last few states are computed with some before them once more if they need three quarters
//! of the lanes, or else one by one, and so is a batch of fewer states than the narrowest lanes.

mod lengths;
mod slots;

use core::ops::Range;

use nalgebra::{IsometryMatrix3, SMatrix, SVector};

use crate::arm::coordinates::{are_plain, coordinates};
use crate::kernels::simd::{self, BLOCK, BatchCall, Lanes, MAX_WIDTH};
use crate::{Arm, SerialChain, Unrolled};

pub use lengths::LengthMismatch;
use slots::{Numbers, Slots};

/// Gives each lane's result its numbers of a part.
#[inline(always)]
fn scatter<R: Lanes, T: Slots>(numbers: &[R], part: usize, out: &mut [T]) {
    let (blocks, rest) = numbers.as_chunks::<BLOCK>();
    for (index, block) in blocks.iter().enumerate() {
        let rows = R::transpose(block);
        for (result, row) in out.iter_mut().zip(&rows) {
            result.part(part)[index * BLOCK..][..BLOCK].copy_from_slice(row);
        }
    }
    if let Some(first) = rest.first() {
        let mut block = [*first; BLOCK];
        block[..rest.len()].copy_from_slice(rest);
        let rows = R::transpose(&block);
        for (result, row) in out.iter_mut().zip(&rows) {
            result.part(part)[blocks.len() * BLOCK..].copy_from_slice(&row[..rest.len()]);
        }
    }
}

/// As many vectors as lanes, a component in each.
#[inline(always)]
fn gather<R: Lanes, const N: usize>(vectors: &[SVector<f64, N>]) -> [R; N] {
    let mut lanes = [R::of(0.0); N];
    for (joint, lanes) in lanes.iter_mut().enumerate() {
        let mut numbers = [0.0; MAX_WIDTH];
        for (number, vector) in numbers.iter_mut().zip(vectors) {
            *number = vector[joint];
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
fn settle<A: Unrolled<N>, R: Lanes, T: Slots, const N: usize>(
    q: &[R; N],
    volume_squared: R,
    out: &mut [T],
) {
    let mut apart = [[0.0; N]; MAX_WIDTH];
    for (joint, lanes) in q.iter().enumerate() {
        for (q, number) in apart.iter_mut().zip(lanes.store()) {
            q[joint] = number;
        }
    }
    for ((result, q), volume) in out.iter_mut().zip(&apart).zip(volume_squared.store()) {
        if A::CHAIN.is_singular(q, volume) {
            result.settle();
        }
    }
}

/// Every method: its name in a batch, its own, the first argument `q` and the others, the result, the kernel, from registers
/// of how many doubles on lanes are quicker, and what of the kernel's returns are the result's parts and, of w_D, the volume.
macro_rules! methods {
    ($($batch:ident $method:ident(q $(, $other:ident)*) -> $output:ty = $kernel:ident from $width:literal |$result:pat_param| ($($index:tt $part:ident),+) $(, $volume:ident)?;)+) => {
        /// An arm that computes many states at once.
        ///
        /// A batch may have any length, but all its slices have the same. Results are those of the methods of [`Arm`] to the bit.
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
                    $(lengths::check(q.len(), stringify!($other), $other.len())?;)*
                    lengths::check(q.len(), "out", out.len())?;
                    for (i, out) in out.iter_mut().enumerate() {
                        *out = self.$method(&q[i] $(, &$other[i])*);
                    }
                    Ok(())
                }
            )+
        }

        /// In lanes where they are worth it.
        impl<A: Unrolled<N> + Arm<N>, const N: usize> ArmBatch<N> for A {
            $(
                fn $batch(&self, q: &[SVector<f64, N>], $($other: &[SVector<f64, N>],)* out: &mut [$output]) -> Result<(), LengthMismatch> {
                    struct Run<'a, A, const N: usize> {
                        arm: &'a A,
                        q: &'a [SVector<f64, N>],
                        $($other: &'a [SVector<f64, N>],)*
                        out: &'a mut [$output],
                    }
                    impl<A: Unrolled<N> + Arm<N>, const N: usize> BatchCall for Run<'_, A, N> {
                        const LEAST_WIDTH: usize = $width;

                        #[inline(always)]
                        fn in_lanes<R: Lanes>(&mut self, states: Range<usize>) {
                            for start in states.clone().step_by(R::WIDTH) {
                                let start = start.min(states.end - R::WIDTH);
                                let q = gather_coordinates::<A, R, N>(&self.q[start..][..R::WIDTH]);
                                $(let $other = gather::<R, N>(&self.$other[start..][..R::WIDTH]);)*
                                let out = &mut self.out[start..][..R::WIDTH];
                                let $result = A::$kernel::<R>(&q $(, &$other)*);
                                $(scatter(Numbers::<R>::numbers(&$part), $index, out);)+
                                $(settle::<A, R, _, N>(&q, $volume, out);)?
                            }
                        }

                        #[inline]
                        fn one_by_one(&mut self, states: Range<usize>) {
                            for i in states {
                                self.out[i] = self.arm.$method(&self.q[i] $(, &self.$other[i])*);
                            }
                        }
                    }
                    $(lengths::check(q.len(), stringify!($other), $other.len())?;)*
                    lengths::check(q.len(), "out", out.len())?;
                    simd::run_batch(&mut Run { arm: self, q, $($other,)* out }, q.len());
                    Ok(())
                }
            )+
        }
    };
}

#[rustfmt::skip]
methods! {
    forward_kinematics_batch forward_kinematics(q) -> IsometryMatrix3<f64> = forward_kinematics_kernel from 2 |(rotation, translation)| (0 rotation, 1 translation);
    geometric_jacobian_batch geometric_jacobian(q) -> SMatrix<f64, 6, N> = geometric_jacobian_kernel from 2 |all| (0 all);
    jacobian_derivatives_batch jacobian_derivatives(q) -> [SMatrix<f64, 6, N>; N] = jacobian_derivatives_kernel from 4 |all| (0 all);
    mass_matrix_batch mass_matrix(q) -> SMatrix<f64, N, N> = mass_matrix_kernel from 2 |all| (0 all);
    mass_matrix_derivatives_batch mass_matrix_derivatives(q) -> [SMatrix<f64, N, N>; N] = mass_matrix_derivatives_kernel from 4 |all| (0 all);
    dynamic_manipulability_batch dynamic_manipulability(q) -> f64 = dynamic_manipulability_kernel from 2 |(value, volume)| (0 value), volume;
    dynamic_manipulability_gradient_batch dynamic_manipulability_gradient(q) -> (f64, SVector<f64, N>) = dynamic_manipulability_gradient_kernel from 2 |(value, gradient, volume)| (0 value, 1 gradient), volume;
    inverse_dynamics_batch inverse_dynamics(q, qd, qdd) -> SVector<f64, N> = inverse_dynamics_kernel from 2 |all| (0 all);
    bias_force_batch bias_force(q, qd) -> SVector<f64, N> = bias_force_kernel from 2 |all| (0 all);
    gravity_torque_batch gravity_torque(q) -> SVector<f64, N> = gravity_torque_kernel from 2 |all| (0 all);
    forward_dynamics_batch forward_dynamics(q, qd, tau) -> SVector<f64, N> = forward_dynamics_kernel from 2 |all| (0 all);
    mass_matrix_and_derivatives_batch mass_matrix_and_derivatives(q) -> (SMatrix<f64, N, N>, [SMatrix<f64, N, N>; N]) = mass_matrix_and_derivatives_kernel from 4 |(mass, derivatives)| (0 mass, 1 derivatives);
    jacobian_and_gradient_batch jacobian_and_gradient(q) -> (SMatrix<f64, 6, N>, f64, SVector<f64, N>) = jacobian_and_gradient_kernel from 2 |(jacobian, value, gradient, volume)| (0 jacobian, 1 value, 2 gradient), volume;
}
