//! [`Unrolled`]: the arithmetic of an arm on any scalar, as generated code provides it; and what makes an
//! [`Arm`](crate::Arm) and an [`ArmBatch`](crate::ArmBatch) of it.

pub(crate) mod batch;
pub(crate) mod real;
pub mod scalar;
pub(crate) mod simd;
pub(crate) mod trigonometry;

use crate::{Method, MethodSet, Real, SerialChain};

macro_rules! define_unrolled {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        { kernel $returns:literal $kernel:ident -> $returned:ty $(, zero from $zero:literal)? }
        $({ $($rest:tt)* })*
    )+) => {
        /// The arithmetic of every method of [`Arm`](crate::Arm), on any [`Real`].
        ///
        /// Each kernel is a straight line of operations without branches. A matrix is an array of its columns.
        /// A revolute coordinate must lie within ±[`PLAIN_LIMIT`](crate::arm::PLAIN_LIMIT), and a prismatic one within
        /// ±[`PRISMATIC_LIMIT`](crate::arm::PRISMATIC_LIMIT); [`SerialChain::is_singular`] judges the volume of J's rows.
        /// The methods of [`Arm`](crate::Arm) see to both.
        ///
        /// # Panics
        /// A kernel that is not [generated](Self::GENERATED) and called all the same. The methods of [`Arm`](crate::Arm) do not call it.
        pub trait Unrolled<const N: usize> {
            /// The arm as data, without what it carries at run time.
            const CHAIN: SerialChain<N>;

            /// The methods that have a kernel of their own. [`Arm`](crate::Arm) computes the others by the formulas of [`SerialChain`].
            const GENERATED: MethodSet;

            /// The arm as data, with what it carries.
            fn chain(&self) -> SerialChain<N> {
                Self::CHAIN
            }

            $(
                #[doc = $returns]
                fn $kernel<R: Real>(&self, $($argument: &$crate::argument_type!([R; N] $argument)),+) -> $returned {
                    $(let _ = $argument;)+
                    not_generated(Method::$variant)
                }
            )+
        }
    };
}

#[cold]
fn not_generated(method: Method) -> ! {
    panic!(
        "no kernel of `{method}` was generated for this arm: generate it, or call the method of `ulna::Arm`"
    )
}

crate::methods! { [N] define_unrolled {} }
