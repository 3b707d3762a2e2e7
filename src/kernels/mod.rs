//! [`Unrolled`]: the arithmetic of an arm on any scalar, as generated code provides it; and what makes an [`Arm`](crate::Arm) of it.

pub mod batch;
pub mod real;
pub mod simd;
pub mod trigonometry;

use crate::{Real, SerialChain};

/// The arithmetic of every method of [`Arm`](crate::Arm), on any [`Real`].
///
/// Each kernel is a straight line of operations without branches. A matrix is an array of its columns.
/// Coordinates are passed through [`coordinates`](crate::arm::coordinates) first, and [`SerialChain::is_singular`] judges the volume of J's rows after.
pub trait Unrolled<const N: usize> {
    /// The arm as data.
    const CHAIN: SerialChain<N>;

    /// `world_from_tool`: rotation and translation.
    fn forward_kinematics_kernel<R: Real>(q: &[R; N]) -> ([[R; 3]; 3], [R; 3]);

    /// J.
    fn geometric_jacobian_kernel<R: Real>(q: &[R; N]) -> [[R; 6]; N];

    /// ∂J/∂q_i.
    fn jacobian_derivatives_kernel<R: Real>(q: &[R; N]) -> [[[R; 6]; N]; N];

    /// M.
    fn mass_matrix_kernel<R: Real>(q: &[R; N]) -> [[R; N]; N];

    /// ∂M/∂q_i.
    fn mass_matrix_derivatives_kernel<R: Real>(q: &[R; N]) -> [[[R; N]; N]; N];

    /// w_D, and det(JJᵀ) over the task's rows.
    fn dynamic_manipulability_kernel<R: Real>(q: &[R; N]) -> (R, R);

    /// w_D, ∇w_D, and det(JJᵀ) over the task's rows.
    fn dynamic_manipulability_gradient_kernel<R: Real>(q: &[R; N]) -> (R, [R; N], R);

    /// τ = M q̈ + c + g.
    fn inverse_dynamics_kernel<R: Real>(q: &[R; N], qd: &[R; N], qdd: &[R; N]) -> [R; N];

    /// c + g.
    fn bias_force_kernel<R: Real>(q: &[R; N], qd: &[R; N]) -> [R; N];

    /// g.
    fn gravity_torque_kernel<R: Real>(q: &[R; N]) -> [R; N];

    /// q̈ = M⁻¹(τ − c − g).
    fn forward_dynamics_kernel<R: Real>(q: &[R; N], qd: &[R; N], tau: &[R; N]) -> [R; N];

    /// M and ∂M/∂q_i.
    fn mass_matrix_and_derivatives_kernel<R: Real>(q: &[R; N]) -> ([[R; N]; N], [[[R; N]; N]; N]);

    /// J, w_D, ∇w_D, and det(JJᵀ) over the task's rows.
    fn jacobian_and_gradient_kernel<R: Real>(q: &[R; N]) -> ([[R; 6]; N], R, [R; N], R);
}

/// Runs a kernel on the best scalar of the machine: `on_machine!(A, N, kernel(arguments) -> output)`, arguments as arrays
/// by reference; `|result: type| output` makes the output of what the kernel returns, in the same function.
macro_rules! on_machine {
    ($arm:ident, $n:ident, $kernel:ident($($argument:ident),+) -> $output:ty) => {
        on_machine!($arm, $n, $kernel($($argument),+) |output: $output| -> $output { output })
    };
    ($arm:ident, $n:ident, $kernel:ident($($argument:ident),+) |$result:tt: $plain:ty| -> $output:ty $finish:block) => {{
        struct Run<'a, $arm, const $n: usize> {
            $($argument: &'a [f64; $n],)+
            arm: PhantomData<$arm>,
        }
        impl<$arm: Unrolled<$n>, const $n: usize> Call for Run<'_, $arm, $n> {
            type Output = $output;
            #[inline(always)]
            fn run<R: Double>(self) -> $output {
                $(let $argument = self.$argument;)+
                let $result: $plain =
                    $arm::$kernel::<R>($(cast_ref::<[f64; $n], [R; $n]>($argument)),+).plain();
                $finish
            }
        }
        simd::run(Run::<$arm, $n> { $($argument,)+ arm: PhantomData })
    }};
}

/// The methods of [`Arm`](crate::Arm), for any unrolled arm; [`implement_arm!`](crate::implement_arm) forwards to them.
pub mod methods {
    use core::marker::PhantomData;

    use bytemuck::cast_ref;
    use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, SMatrix, SVector, Translation3, Vector3};

    use super::Unrolled;
    use crate::arm::coordinates::{are_plain, coordinates};
    use crate::kernels::simd::{self, Call, Double, Plain as _};

    /// Names the coordinates `$q` as an array that a kernel may read, in place wherever it may.
    macro_rules! read {
        ($arm:ident, $q:ident) => {
            let safe;
            let $q = &$q.data.0[0];
            let $q = if are_plain($q) {
                $q
            } else {
                safe = coordinates(&$arm::CHAIN, $q);
                &safe
            };
        };
    }

    /// w_D and ∇w_D, or zeros where the task is singular.
    #[inline(always)]
    fn settle<A: Unrolled<N>, const N: usize>(
        q: &[f64; N],
        value: f64,
        gradient: SVector<f64, N>,
        volume_squared: f64,
    ) -> (f64, SVector<f64, N>) {
        if A::CHAIN.is_singular(q, volume_squared) {
            (0.0, SVector::zeros())
        } else {
            (value, gradient)
        }
    }

    /// [`Arm::forward_kinematics`](crate::Arm::forward_kinematics).
    pub fn forward_kinematics<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
    ) -> IsometryMatrix3<f64> {
        read!(A, q);
        on_machine!(A, N, forward_kinematics_kernel(q)
        |(rotation, translation): (Matrix3<f64>, Vector3<f64>)| -> IsometryMatrix3<f64> {
            IsometryMatrix3::from_parts(
                Translation3::from(translation),
                Rotation3::from_matrix_unchecked(rotation),
            )
        })
    }

    /// [`Arm::geometric_jacobian`](crate::Arm::geometric_jacobian).
    pub fn geometric_jacobian<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
    ) -> SMatrix<f64, 6, N> {
        read!(A, q);
        on_machine!(A, N, geometric_jacobian_kernel(q) -> SMatrix<f64, 6, N>)
    }

    /// [`Arm::jacobian_derivatives`](crate::Arm::jacobian_derivatives).
    pub fn jacobian_derivatives<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
    ) -> [SMatrix<f64, 6, N>; N] {
        read!(A, q);
        on_machine!(A, N, jacobian_derivatives_kernel(q) -> [SMatrix<f64, 6, N>; N])
    }

    /// [`Arm::mass_matrix`](crate::Arm::mass_matrix).
    pub fn mass_matrix<A: Unrolled<N>, const N: usize>(q: &SVector<f64, N>) -> SMatrix<f64, N, N> {
        read!(A, q);
        on_machine!(A, N, mass_matrix_kernel(q) -> SMatrix<f64, N, N>)
    }

    /// [`Arm::mass_matrix_derivatives`](crate::Arm::mass_matrix_derivatives).
    pub fn mass_matrix_derivatives<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
    ) -> [SMatrix<f64, N, N>; N] {
        read!(A, q);
        on_machine!(A, N, mass_matrix_derivatives_kernel(q) -> [SMatrix<f64, N, N>; N])
    }

    /// [`Arm::dynamic_manipulability`](crate::Arm::dynamic_manipulability).
    pub fn dynamic_manipulability<A: Unrolled<N>, const N: usize>(q: &SVector<f64, N>) -> f64 {
        read!(A, q);
        on_machine!(A, N, dynamic_manipulability_kernel(q)
        |(value, volume): (f64, f64)| -> f64 {
            if A::CHAIN.is_singular(q, volume) { 0.0 } else { value }
        })
    }

    /// [`Arm::dynamic_manipulability_gradient`](crate::Arm::dynamic_manipulability_gradient).
    pub fn dynamic_manipulability_gradient<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
    ) -> (f64, SVector<f64, N>) {
        read!(A, q);
        on_machine!(A, N, dynamic_manipulability_gradient_kernel(q)
        |(value, gradient, volume): (f64, SVector<f64, N>, f64)| -> (f64, SVector<f64, N>) {
            settle::<A, N>(q, value, gradient, volume)
        })
    }

    /// [`Arm::inverse_dynamics`](crate::Arm::inverse_dynamics).
    pub fn inverse_dynamics<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        read!(A, q);
        let (qd, qdd) = (&qd.data.0[0], &qdd.data.0[0]);
        on_machine!(A, N, inverse_dynamics_kernel(q, qd, qdd) -> SVector<f64, N>)
    }

    /// [`Arm::bias_force`](crate::Arm::bias_force).
    pub fn bias_force<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        read!(A, q);
        let qd = &qd.data.0[0];
        on_machine!(A, N, bias_force_kernel(q, qd) -> SVector<f64, N>)
    }

    /// [`Arm::gravity_torque`](crate::Arm::gravity_torque).
    pub fn gravity_torque<A: Unrolled<N>, const N: usize>(q: &SVector<f64, N>) -> SVector<f64, N> {
        read!(A, q);
        on_machine!(A, N, gravity_torque_kernel(q) -> SVector<f64, N>)
    }

    /// [`Arm::forward_dynamics`](crate::Arm::forward_dynamics).
    pub fn forward_dynamics<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        tau: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        read!(A, q);
        let (qd, tau) = (&qd.data.0[0], &tau.data.0[0]);
        on_machine!(A, N, forward_dynamics_kernel(q, qd, tau) -> SVector<f64, N>)
    }

    /// [`Arm::mass_matrix_and_derivatives`](crate::Arm::mass_matrix_and_derivatives).
    pub fn mass_matrix_and_derivatives<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
    ) -> (SMatrix<f64, N, N>, [SMatrix<f64, N, N>; N]) {
        read!(A, q);
        on_machine!(
            A, N, mass_matrix_and_derivatives_kernel(q) -> (SMatrix<f64, N, N>, [SMatrix<f64, N, N>; N])
        )
    }

    /// [`Arm::jacobian_and_gradient`](crate::Arm::jacobian_and_gradient).
    pub fn jacobian_and_gradient<A: Unrolled<N>, const N: usize>(
        q: &SVector<f64, N>,
    ) -> (SMatrix<f64, 6, N>, f64, SVector<f64, N>) {
        read!(A, q);
        on_machine!(A, N, jacobian_and_gradient_kernel(q)
        |(jacobian, value, gradient, volume): (SMatrix<f64, 6, N>, f64, SVector<f64, N>, f64)|
        -> (SMatrix<f64, 6, N>, f64, SVector<f64, N>) {
            let (value, gradient) = settle::<A, N>(q, value, gradient, volume);
            (jacobian, value, gradient)
        })
    }
}

/// Implements [`Arm`](crate::Arm) for a type that is [`Unrolled`], by [`methods`]: for the type itself, so that the kernels
/// are compiled in the type's own crate, with that crate's optimisation. Generated code calls it.
#[macro_export]
macro_rules! implement_arm {
    ($arm:ident, $n:literal) => {
        const _: () = {
            use $crate::nalgebra::{IsometryMatrix3, SMatrix, SVector};

            $crate::implement_arm! { @methods $arm, $n,
                forward_kinematics(q) -> IsometryMatrix3<f64>;
                geometric_jacobian(q) -> SMatrix<f64, 6, $n>;
                jacobian_derivatives(q) -> [SMatrix<f64, 6, $n>; $n];
                mass_matrix(q) -> SMatrix<f64, $n, $n>;
                mass_matrix_derivatives(q) -> [SMatrix<f64, $n, $n>; $n];
                dynamic_manipulability(q) -> f64;
                dynamic_manipulability_gradient(q) -> (f64, SVector<f64, $n>);
                inverse_dynamics(q, qd, qdd) -> SVector<f64, $n>;
                bias_force(q, qd) -> SVector<f64, $n>;
                gravity_torque(q) -> SVector<f64, $n>;
                forward_dynamics(q, qd, tau) -> SVector<f64, $n>;
                mass_matrix_and_derivatives(q) -> (SMatrix<f64, $n, $n>, [SMatrix<f64, $n, $n>; $n]);
                jacobian_and_gradient(q) -> (SMatrix<f64, 6, $n>, f64, SVector<f64, $n>);
            }
        };
    };
    (@methods $arm:ident, $n:literal, $($method:ident($($argument:ident),+) -> $output:ty;)+) => {
        impl $crate::Arm<$n> for $arm {
            fn task(&self) -> $crate::TaskRows {
                <Self as $crate::Unrolled<$n>>::CHAIN.task
            }

            fn rated_torque(&self) -> SVector<f64, $n> {
                $crate::Arm::rated_torque(&<Self as $crate::Unrolled<$n>>::CHAIN)
            }

            $(
                fn $method(&self, $($argument: &SVector<f64, $n>),+) -> $output {
                    $crate::kernels::methods::$method::<Self, $n>($($argument),+)
                }
            )+
        }
    };
}
