//! The methods of [`Arm`](crate::Arm) for any unrolled arm; [`implement_arm!`](crate::implement_arm) forwards to them.

use core::marker::PhantomData;

use bytemuck::cast_ref;
use nalgebra::SVector;

use super::Unrolled;
use super::simd::{self, Call, Double, Plain as _, Settled};
use crate::arm::coordinates::{are_plain, coordinates};

macro_rules! define_methods {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($q:ident $(, $other:ident)*) -> $output:ty
        { kernel $returns:literal $kernel:ident -> $returned:ty $(, zero from $zero:literal)? }
        $({ $($rest:tt)* })*
    )+) => {
        $(
            #[doc = concat!("[`Arm::", stringify!($method), "`](crate::Arm::", stringify!($method), ").")]
            pub fn $method<A: Unrolled<N>, const N: usize>($q: &SVector<f64, N> $(, $other: &SVector<f64, N>)*) -> $output {
                struct Run<'a, A, const N: usize> {
                    $q: &'a [f64; N],
                    $($other: &'a [f64; N],)*
                    arm: PhantomData<A>,
                }
                impl<A: Unrolled<N>, const N: usize> Call for Run<'_, A, N> {
                    type Output = $output;

                    #[inline(always)]
                    fn run<R: Double>(self) -> $output {
                        let returned = A::$kernel::<R>(
                            cast_ref::<[f64; N], [R; N]>(self.$q)
                            $(, cast_ref::<[f64; N], [R; N]>(self.$other))*
                        );
                        finish!(returned $(, A, self.$q, $zero)?)
                    }
                }
                // In place wherever the kernel may read them there.
                let safe;
                let $q = &$q.data.0[0];
                let $q = if are_plain($q) {
                    $q
                } else {
                    safe = coordinates(&A::CHAIN, $q);
                    &safe
                };
                $(let $other = &$other.data.0[0];)*
                simd::run(Run::<A, N> { $q, $($other,)* arm: PhantomData })
            }
        )+
    };
}

/// What a method returns, of what its kernel does.
macro_rules! finish {
    ($returned:ident) => {
        $returned.plain()
    };
    ($returned:ident, $arm:ty, $q:expr, $zero:literal) => {
        $returned.settle($zero, |volume_squared| {
            <$arm>::CHAIN.is_singular($q, volume_squared)
        })
    };
}

crate::methods! { [N] define_methods {} }

/// Implements [`Arm`](crate::Arm) for a type that is [`Unrolled`], by the methods here: for the type itself, so that the kernels
/// are compiled in the type's own crate, with that crate's optimisation. Generated code calls it.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_arm {
    ($type:ident, $n:literal) => {
        $crate::methods! { [$n] $crate::implement_arm { @methods $type $n } }
    };
    ([@methods $type:ident $n:literal] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        impl $crate::Arm<$n> for $type {
            fn task(&self) -> $crate::TaskRows {
                <Self as $crate::Unrolled<$n>>::CHAIN.task
            }

            fn rated_torque(&self) -> $crate::nalgebra::SVector<f64, $n> {
                $crate::Arm::rated_torque(&<Self as $crate::Unrolled<$n>>::CHAIN)
            }

            $(
                fn $method(&self, $($argument: &$crate::nalgebra::SVector<f64, $n>),+) -> $output {
                    $crate::internal::methods::$method::<Self, $n>($($argument),+)
                }
            )+
        }
    };
}
