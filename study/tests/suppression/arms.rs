//! The arms, the motion and the force that the tests share.

use std::f64::consts::FRAC_PI_2;

use ulna::nalgebra::{SVector, Vector6};
use ulna::{
    Compensation, Failure, JointLimits, JointState, LockedJoints, PointToPoint, SerialChain,
};
use ulna_generated::Ssrms;
use ulna_study::search::{Operation, OperationOptions};
use ulna_table::Model;

pub(crate) fn chain<const N: usize>(name: &str) -> SerialChain<N> {
    let model = Model::load(format!("../arms/{name}.toml")).unwrap();
    SerialChain::try_from(&model).unwrap()
}

pub(crate) fn ssrms() -> SerialChain<7> {
    chain("ssrms")
}

/// Random states, the same ones at every run.
pub(crate) fn states<const N: usize>(
    chain: &SerialChain<N>,
    count: usize,
) -> impl Iterator<Item = JointState<N>> {
    ulna::proof::states(chain)
        .take(count)
        .map(|state| JointState {
            q: state.q,
            qd: state.qd,
            qdd: state.qdd,
        })
}

/// Calls `$check::<N>(chain, name)` for every arm.
macro_rules! on_every_arm {
    ($check:ident) => {
        $check::<7>(&$crate::arms::chain("ssrms"), "ssrms");
        $check::<7>(&$crate::arms::chain("table1_literal"), "table1_literal");
        $check::<2>(&$crate::arms::chain("planar_2r"), "planar_2r");
        $check::<6>(&$crate::arms::chain("oblique_6"), "oblique_6");
    };
}
pub(crate) use on_every_arm;

/// Section 5.2: 20 N along each axis.
pub(crate) fn paper_force() -> Vector6<f64> {
    Vector6::new(20.0, 20.0, 20.0, 0.0, 0.0, 0.0)
}

/// The motion that was fitted to the paper's Table 2.
pub(crate) fn paper_like_motion() -> PointToPoint<7> {
    let theta = SVector::from([0.0, FRAC_PI_2, 0.0, 0.0, 0.0, -FRAC_PI_2, 0.0]);
    let start = SVector::from([0.0, 0.601, -0.895, -2.108, -1.398, 1.437, 0.0]) - theta;
    let travel = SVector::from([1.474, 0.689, -4.400, 0.273, -3.284, 0.820, 0.0]);
    PointToPoint::new(start, start + travel, 20.0, 4.455, &JointLimits::none()).unwrap()
}

/// The failure times of Section 5.
pub(crate) const TIMES: [f64; 3] = [3.0, 10.0, 18.0];

pub(crate) fn failure(joints: &[usize], time: f64) -> Failure<7> {
    Failure {
        joints: LockedJoints::new(joints).unwrap(),
        time,
    }
}

/// Impact alone counts, effort does not.
pub(crate) fn operation(failure: &Failure<7>, rated_torque: SVector<f64, 7>) -> Operation<7> {
    weighted(failure, rated_torque, 0.0)
}

/// The same with a weight of effort.
pub(crate) fn weighted(
    failure: &Failure<7>,
    rated_torque: SVector<f64, 7>,
    effort: f64,
) -> Operation<7> {
    let options = OperationOptions {
        sample_period: 0.25,
        rated_torque,
        effort,
        ..OperationOptions::default()
    };
    let wrench = |_| paper_force();
    Operation::new(&Ssrms, &paper_like_motion(), wrench, failure, &options).unwrap()
}

/// Section 5.2: joint 2, no limits.
pub(crate) fn unlimited(time: f64) -> Operation<7> {
    operation(&failure(&[1], time), SVector::repeat(f64::INFINITY))
}

/// Rated torques `room` N·m above what the motion needs by itself.
pub(crate) fn limited(failure: &Failure<7>, room: f64) -> Operation<7> {
    let free = operation(failure, SVector::repeat(f64::INFINITY));
    let needed = free.assess(&Compensation::none()).peak_torque;
    operation(failure, needed.add_scalar(room))
}
