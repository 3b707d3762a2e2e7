//! The controller of a real loop: transitions, limits, and what it remembers.

mod agreement;
mod limits;
mod locks;

use ulna::nalgebra::{DMatrix, DVector, SVector, Vector6};
use ulna::{
    Arm, Compensation, JointState, LockedJoints, LoopCycle, OnLine, Schedule, SuppressionLaw,
    SuppressionLoop, Weighting,
};
use ulna_generated::Ssrms;

use crate::arms::{failure, paper_force, paper_like_motion};

const NONE: LockedJoints<7> = LockedJoints::NONE;
const PERIOD: f64 = 0.01;

type Loop<'a> = SuppressionLoop<'a, Ssrms, 7>;

fn locked(joints: &[usize]) -> LockedJoints<7> {
    LockedJoints::new(joints).unwrap()
}

fn unlimited<'a>(before: SuppressionLaw<'a, 7>, after: SuppressionLaw<'a, 7>) -> Loop<'a> {
    SuppressionLoop::new(&Ssrms, before, after).with_rated_torque(SVector::repeat(f64::INFINITY))
}

fn on_line() -> Loop<'static> {
    SuppressionLoop::on_line(&Ssrms, OnLine::equal())
        .with_rated_torque(SVector::repeat(f64::INFINITY))
}

/// Joint 2 known to lock.
fn known() -> OnLine<7> {
    OnLine {
        weights: SVector::from([0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        weighting: Weighting::Absolute,
        damping: 0.0,
        force_budget: 0.0,
    }
}

/// The arm's motion if `joints` stop at `time`.
fn state(joints: &[usize], time: f64, now: f64) -> JointState<7> {
    failure(joints, time).state(&paper_like_motion(), now)
}

/// The norm of what of `torque` the locked arm's null space leaves no choice about: `J'†J' torque`, by singular values.
fn without_choice(state: &JointState<7>, locked: LockedJoints<7>, torque: &SVector<f64, 7>) -> f64 {
    let jacobian = locked.reduce_jacobian(&Ssrms.geometric_jacobian(&state.q));
    let jacobian = DMatrix::from_fn(3, 7, |i, j| jacobian[(i, j)]);
    let inverse = jacobian.clone().pseudo_inverse(1e-9).unwrap();
    let torque = DVector::from_column_slice(locked.without(torque).as_slice());
    (inverse * (jacobian * torque)).norm()
}

/// Cycles up to and with the one at `until`, joint 2 stopping at 10 s, the lock told `late` cycles after.
fn run(suppression: &mut Loop<'_>, from: i32, until: i32, late: i32) -> Vec<LoopCycle<7>> {
    (from..=until)
        .map(|i| {
            let time = PERIOD * f64::from(i);
            let told = if i < 1000 + late { NONE } else { locked(&[1]) };
            suppression.cycle(time, &state(&[1], 10.0, time), &paper_force(), told)
        })
        .collect()
}

fn laws<'a>(z: &'a [SVector<f64, 7>], f: &'a [Vector6<f64>]) -> [SuppressionLaw<'a, 7>; 5] {
    let schedule = Schedule::new(9.0, 0.7, z).unwrap();
    let coefficients = SVector::from([2e7, -3e7, 1e7, 1e7, 5e6, 3e6, 0.0]);
    [
        SuppressionLaw::None,
        SuppressionLaw::Coefficients(Compensation::PerJoint(coefficients)),
        SuppressionLaw::Coefficients(Compensation::Projected(coefficients)),
        SuppressionLaw::Schedule(schedule.with_wrenches(f).unwrap()),
        SuppressionLaw::OnLine(OnLine::equal()),
    ]
}

fn samples() -> ([SVector<f64, 7>; 4], [Vector6<f64>; 4]) {
    let z = [1.0, -0.5, 0.3, 0.8].map(|x| SVector::from_fn(|i, _| x * (30.0 - 9.0 * i as f64)));
    let f = [0.5, 1.0, -1.0, 0.0].map(|x| Vector6::new(x, 2.0 * x, -x, 0.0, 0.0, 0.0));
    (z, f)
}
