//! Eq. 18's step by two roads: the difference of an operation's torques, and the recursion of Eq. 1–12.

use ulna::control::failure::{impact_torque, impact_torque_of};
use ulna::nalgebra::Vector6;
use ulna::{Arm, Trajectory};
use ulna_generated::Ssrms;
use ulna_study::search::{Operation, OperationOptions};

use crate::arms::{TIMES, failure, paper_force, paper_like_motion, ssrms};

const WRENCH_STEP: [f64; 6] = [3.0, -1.0, 2.0, 0.5, 0.25, -0.75];

fn operation(
    joints: &[usize],
    time: f64,
    wrench: impl Fn(f64) -> Vector6<f64>,
    step_time: f64,
    wrench_step: Vector6<f64>,
) -> Operation<7> {
    let options = OperationOptions {
        sample_period: 0.5,
        step_time,
        wrench_step,
        ..OperationOptions::default()
    };
    let failure = failure(joints, time);
    Operation::new(&Ssrms, &paper_like_motion(), wrench, &failure, &options).unwrap()
}

/// Section 5.4: F_e = 0.2 t² + 4 t along each axis.
fn varying(time: f64) -> Vector6<f64> {
    paper_force() * ((0.2 * time * time + 4.0 * time) / 20.0)
}

#[test]
fn in_no_time_the_step_is_the_negative_of_eq_12_with_the_wrench_that_the_lock_takes() {
    let delta = Vector6::from(WRENCH_STEP);
    for joints in [vec![1], vec![3, 5]] {
        for time in TIMES {
            let state = paper_like_motion().state(time);
            let locked = failure(&joints, time).joints;
            for (wrench, delta) in [
                (paper_force as fn() -> _, Vector6::zeros()),
                (paper_force as fn() -> _, delta),
                (Vector6::zeros as fn() -> _, delta),
            ] {
                let step = operation(&joints, time, |_| wrench(), 0.0, delta).step();
                let recursion = impact_torque(&ssrms(), &state, locked, &delta).torque;
                let two_passes = impact_torque_of(&Ssrms, &state, locked, &delta);
                assert!((step + recursion).amax() < 1e-10, "{joints:?} at {time} s");
                assert!((step + two_passes).amax() < 1e-10, "{joints:?} at {time} s");
            }
        }
    }
}

#[test]
fn only_what_follows_the_lock_has_the_wrench_without_its_step() {
    let delta = Vector6::from(WRENCH_STEP);
    let stays = operation(&[1], 10.0, varying, 0.01, Vector6::zeros());
    let steps = operation(&[1], 10.0, varying, 0.01, delta);
    for (a, b) in stays.samples().iter().zip(steps.samples()) {
        let taken = a.planned - b.planned;
        let expected = if a.locked.is_empty() {
            taken * 0.0
        } else {
            a.pose.jacobian.tr_mul(&delta)
        };
        assert!((taken - expected).amax() < 1e-9, "at {} s", a.time);
    }
}

/// With Δt the wrench's own growth is a ΔF_e, and the rest is what the locked arm's plan does in Δt: proportional to it.
#[test]
fn a_step_time_adds_what_plan_and_wrench_do_in_it() {
    let motion = paper_like_motion();
    for time in TIMES {
        let state = motion.state(time);
        let failure = failure(&[1], time);
        let drift = |step_time: f64| {
            let step = operation(&[1], time, varying, step_time, Vector6::zeros()).step();
            let delta = varying(time) - varying(time + step_time);
            let recursion = impact_torque(&ssrms(), &state, failure.joints, &delta).torque;
            step + recursion
        };
        let (long, short) = (drift(1e-2), drift(5e-3));
        // First order in Δt, and so is not the wrench's part.
        assert!(
            (long - short * 2.0).amax() < 0.02 * long.amax(),
            "at {time} s"
        );
        // The same by the derivative of the locked arm's torque under the wrench that it has at t_f.
        let locked = |elapsed: f64| {
            let state = failure.state(&motion, time + elapsed);
            let torque = Ssrms.inverse_dynamics(&state.q, &state.qd, &state.qdd);
            torque + Ssrms.geometric_jacobian(&state.q).tr_mul(&varying(time))
        };
        let slope = (locked(2e-5) - locked(0.0)) / 2e-5;
        let error = (long - slope * 1e-2).amax() / long.amax();
        assert!(error < 0.02, "at {time} s: {error}");
    }
}
