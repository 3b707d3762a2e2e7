//! What `lock_impacts` replaces: loops over inverse dynamics. Column k is τ before joint k locks, minus τ after, but for the friction
//! of joint k, which the lock takes over.

use ulna::Arm;
use ulna::nalgebra::{SMatrix, SVector};

use crate::Subject;
use crate::layout;
use crate::singles::{Arguments, Kernel};

/// What they compute, by the name it has among the quantities.
const QUANTITY: &[u8] = b"lock_impacts";

/// As someone asks for one joint after the other: two inverse dynamics each.
pub(crate) fn by_pairs<S: Subject<N>, const N: usize>(quantity: &[u8]) -> Option<Kernel> {
    unsafe extern "C" fn pairs<S: Subject<N>, const N: usize>(out: *mut f64, x: *const f64) {
        // SAFETY: the caller of a `Kernel` passes the arguments, and room for the result.
        let x = unsafe { Arguments::at(x) };
        let mut impacts = SMatrix::<f64, N, N>::zeros();
        for joint in 0..N {
            let before = S::arm().inverse_dynamics(x.vector(0), x.vector(N), x.vector(2 * N));
            impacts.set_column(joint, &(before - locked::<S, N>(x, joint)));
            impacts[(joint, joint)] -= S::arm().friction_torque(x.vector(N))[joint];
        }
        // SAFETY: as above.
        unsafe { layout::write(&impacts, out) };
    }
    (quantity == QUANTITY).then_some(pairs::<S, N>)
}

/// With what is the same for all joints computed once: N + 1 inverse dynamics.
pub(crate) fn by_one_more<S: Subject<N>, const N: usize>(quantity: &[u8]) -> Option<Kernel> {
    unsafe extern "C" fn one_more<S: Subject<N>, const N: usize>(out: *mut f64, x: *const f64) {
        // SAFETY: the caller of a `Kernel` passes the arguments, and room for the result.
        let x = unsafe { Arguments::at(x) };
        let mut impacts = SMatrix::<f64, N, N>::zeros();
        let before = S::arm().inverse_dynamics(x.vector(0), x.vector(N), x.vector(2 * N));
        for joint in 0..N {
            impacts.set_column(joint, &(before - locked::<S, N>(x, joint)));
            impacts[(joint, joint)] -= S::arm().friction_torque(x.vector(N))[joint];
        }
        // SAFETY: as above.
        unsafe { layout::write(&impacts, out) };
    }
    (quantity == QUANTITY).then_some(one_more::<S, N>)
}

/// The torques while `joint` stands still and the others move as before.
#[inline(always)]
fn locked<S: Subject<N>, const N: usize>(x: Arguments, joint: usize) -> SVector<f64, N> {
    let (mut rates, mut accelerations) = (*x.vector(N), *x.vector(2 * N));
    rates[joint] = 0.0;
    accelerations[joint] = 0.0;
    S::arm().inverse_dynamics(x.vector(0), &rates, &accelerations)
}
