//! The methods of [`Arm`](crate::Arm) for any unrolled arm; [`implement_arm!`](crate::implement_arm) forwards to them.

use bytemuck::cast_ref;

use super::Unrolled;
use super::simd::{self, Call, Double, Plain as _, Settled};
use crate::arm::coordinates::{are_plain, coordinates};

/// An argument where a kernel may read it: in place, but for coordinates that are absurd.
macro_rules! read {
    ($arm:ident q $q:ident) => {
        let safe;
        let $q = &$q.data.0[0];
        let $q = if are_plain($q) {
            $q
        } else {
            safe = coordinates(&$arm::CHAIN, $q);
            &safe
        };
    };
    ($arm:ident $other:ident $name:ident) => {
        let $name = &$name.data.0[0];
    };
}

macro_rules! define_methods {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        { kernel $returns:literal $kernel:ident -> $returned:ty $(, zero from $zero:literal)? }
        $({ $($rest:tt)* })*
    )+) => {
        $(
            #[doc = concat!("[`Arm::", stringify!($method), "`](crate::Arm::", stringify!($method), ").")]
            pub fn $method<A: Unrolled<N>, const N: usize>(
                arm: &A,
                $($argument: &$crate::argument_type!([N] $argument)),+
            ) -> $output {
                if const { !A::GENERATED.contains(crate::Method::$variant) } {
                    return crate::Arm::$method(&arm.chain(), $($argument),+);
                }
                struct Run<'a, A, const N: usize> {
                    arm: &'a A,
                    $($argument: &'a $crate::argument_type!([f64; N] $argument),)+
                }
                impl<A: Unrolled<N>, const N: usize> Call for Run<'_, A, N> {
                    type Output = $output;

                    #[inline(always)]
                    fn run<R: Double>(self) -> $output {
                        let returned = self.arm.$kernel::<R>($(
                            cast_ref::<_, $crate::argument_type!([R; N] $argument)>(self.$argument)
                        ),+);
                        finish!(returned $(, A, self.q, $zero)?)
                    }
                }
                $(read! { A $argument $argument })+
                simd::run(Run::<A, N> { arm, $($argument),+ })
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
                fn $method(&self, $($argument: &$crate::argument_type!([$n] $argument)),+) -> $output {
                    $crate::internal::methods::$method::<Self, $n>(self, $($argument),+)
                }
            )+
        }
    };
}
