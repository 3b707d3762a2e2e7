//! Methods chosen at run time, for tests and measurements.

use core::hint::black_box;

use super::State;
use crate::arm::quantity::Quantity;
use crate::{Arm, Method};

macro_rules! define_calls {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        /// What calls `method` with its arguments from a state, and hides from the compiler that nobody reads the result.
        pub fn call<A: Arm<N>, const N: usize>(method: Method) -> fn(&A, &State<N>) {
            match method {
                $(Method::$variant => |arm, state| {
                    black_box(arm.$method($(&state.$argument),+));
                },)+
            }
        }

        /// Hands each number of what `method` returns to `take`.
        pub fn numbers<A: Arm<N>, const N: usize>(
            arm: &A,
            method: Method,
            state: &State<N>,
            take: impl FnMut(f64),
        ) {
            match method {
                $(Method::$variant => {
                    arm.$method($(&state.$argument),+).numbers().for_each(take);
                })+
            }
        }
    };
}

crate::methods! { [N] define_calls {} }
