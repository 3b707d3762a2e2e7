//! A generated arm without the standard library and without an allocator, as firmware would link it.
#![no_std]

include!(concat!(env!("OUT_DIR"), "/ssrms.rs"));

use ulna::nalgebra::{SVector, Vector6};
use ulna::{Arm, JointState, LockedJoints, OnLine, SerialChain, SuppressionLoop};

/// w_D of the generated arm, or of its textbook chain.
pub fn manipulability(generated: bool) -> f64 {
    const CHAIN: SerialChain<7> = Ssrms::CHAIN;
    let q = SVector::from([0.1, 0.6, -0.9, -2.1, -1.4, 1.4, 0.2]);
    if generated {
        Ssrms.dynamic_manipulability(&q)
    } else {
        CHAIN.dynamic_manipulability(&q)
    }
}

/// A cycle of the suppression loop, the on-line law included.
pub fn suppression(time: f64, state: &JointState<7>, locked: LockedJoints<7>) -> SVector<f64, 7> {
    let mut suppression = SuppressionLoop::on_line(&Ssrms, OnLine::equal());
    let cycle = suppression.cycle(time, state, &Vector6::zeros(), locked);
    cycle.control.torque
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
