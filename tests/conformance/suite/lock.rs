//! What a lock of each joint does to the torques, and how it hangs together with the paper's recursion and with inverse dynamics.

use nalgebra::{SMatrix, SVector, Vector6};
use ulna::control::failure::{LockedJoints, impact_torque};
use ulna::control::trajectory::JointState;
use ulna::proof::State;
use ulna::{Arm, SerialChain};

use super::{at_states, near};

pub(crate) fn lock_impacts_are_those_of_the_papers_recursion<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, qdd, .. }| {
        let impacts = arm.lock_impacts(&q, &qd, &qdd);
        let state = JointState { q, qd, qdd };
        for k in 0..N {
            let locked = LockedJoints::new(&[k]).expect("the arm has this joint");
            let expected = impact_torque(chain, &state, locked, &Vector6::zeros()).torque;
            near(impacts.column(k), &expected, 0.0, 1e-12, "lock");
        }
    });
}

/// Before minus after by two calls of inverse dynamics; all joints moving, and one of them alone.
pub(crate) fn lock_impacts_are_differences_of_inverse_dynamics<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, qdd, .. }| {
        for alone in [None, Some(0), Some(N - 1)] {
            let moves = |v: SVector<f64, N>| match alone {
                Some(joint) => SVector::from_fn(|i, _| if i == joint { v[i] } else { 0.0 }),
                None => v,
            };
            let (qd, qdd) = (moves(qd), moves(qdd));
            let torque = arm.inverse_dynamics(&q, &qd, &qdd);
            let impacts = arm.lock_impacts(&q, &qd, &qdd);
            for k in 0..N {
                let (mut held, mut unaccelerated) = (qd, qdd);
                held[k] = 0.0;
                unaccelerated[k] = 0.0;
                let mut step = torque - arm.inverse_dynamics(&q, &held, &unaccelerated);
                // A brake's own load is no friction of the joint: the lock's mechanics are without.
                step[k] -= arm.friction_torque(&qd)[k];
                near(impacts.column(k), &step, torque.amax(), 1e-12, "lock");
            }
        }
    });
}

pub(crate) fn a_lock_of_a_joint_at_rest_changes_nothing<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(
        chain,
        |State {
             q, mut qd, mut qdd, ..
         }| {
            for k in 0..N {
                qd[k] = 0.0;
                qdd[k] = 0.0;
                let impacts = arm.lock_impacts(&q, &qd, &qdd);
                let resting = impacts.columns(0, k + 1);
                assert!(resting.iter().all(|x| *x == 0.0), "exactly: {resting}");
            }
        },
    );
}

/// A lock at rest takes M's column times the acceleration; one without acceleration goes with the square of the rates.
pub(crate) fn lock_impacts_have_the_parts_of_inverse_dynamics<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, qdd, .. }| {
        let none = SVector::zeros();
        let m = arm.mass_matrix(&q);
        let started = SMatrix::<f64, N, N>::from_fn(|i, k| m[(i, k)] * qdd[k]);
        let at_rest = arm.lock_impacts(&q, &none, &qdd);
        near(&at_rest, &started, 0.0, 1e-13, "at rest");

        let steady = arm.lock_impacts(&q, &qd, &none);
        let faster = arm.lock_impacts(&q, &(qd * 2.0), &none);
        near(&faster, &(steady * 4.0), 0.0, 1e-13, "twice as fast");
        let backwards = arm.lock_impacts(&q, &-qd, &none);
        near(&backwards, &steady, 0.0, 1e-13, "backwards");
        let both = arm.lock_impacts(&q, &qd, &qdd);
        near(&both, &(steady + started), steady.amax(), 1e-12, "both");
    });
}
