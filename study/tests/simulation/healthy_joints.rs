//! The healthy joints: with the planned motion as long as nothing happens, off it when a joint locks.

use ulna::control::failure::impact_torque_of;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{Arm, Trajectory};
use ulna_generated::Ssrms;
use ulna_study::simulation::{Brake, Feedback, Resolution};

use crate::{Compensation, cancelling, lock, oblique, oblique_motion, ssrms, ssrms_motion};

#[test]
fn an_arm_without_failure_and_compensation_does_as_planned() {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, Compensation::none(), 0.1);
    simulation.brake = Brake::none();
    let outcome = simulation
        .run(0.0..6.0, &Resolution::default(), |sample| {
            assert_eq!(sample.brake.amax(), 0.0);
            let off = sample.state.q - sample.planned.q;
            assert!(off.amax() < 1e-7, "{} s: {off}", sample.time);
        })
        .unwrap();
    assert!(outcome.impact.is_none());
    assert!(outcome.balance.energy_error < 1e-8);
}

/// A joint that locks at rest shocks nothing: the paper's assumption then holds, and its brake bears what the paper says.
#[test]
fn a_joint_that_locks_before_it_moves_leaves_the_others_to_their_plan() {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, Compensation::none(), 0.01);
    simulation.brake.failure = lock(&[1], 0.0);
    simulation
        .run(0.0..2.0, &Resolution::default(), |sample| {
            assert!((sample.state.q - sample.planned.q).amax() < 1e-9);
            let needed =
                Ssrms.inverse_dynamics(&sample.planned.q, &sample.planned.qd, &sample.planned.qdd)
                    + Ssrms
                        .geometric_jacobian(&sample.planned.q)
                        .tr_mul(&crate::pushing(0.0));
            assert!(
                (sample.joint_torque() - needed).amax() < 1e-6,
                "{}",
                sample.time
            );
        })
        .unwrap();
}

/// What the paper assumes, that the healthy joints keep their rates, is wrong as soon as the locked joint moved.
#[test]
fn the_healthy_joints_rates_jump_with_the_lock() {
    let motion = ssrms_motion();
    let simulation = ssrms(&motion, Compensation::none(), 1e-4);
    let outcome = simulation
        .run(9.9..10.1, &Resolution::default(), |_| ())
        .unwrap();
    let impact = outcome.impact.unwrap();
    for joint in [0, 2, 3, 4, 5] {
        assert!(impact.planned_rate_jump[joint].abs() < 1e-4);
    }
    let jump = impact.rate_jump - impact.planned_rate_jump;
    assert!((jump - (impact.ideal.rate_jump - impact.planned_rate_jump)).amax() < 1e-3);
    // Joint 3 and 4 pass on more than a tenth of what joint 2 loses.
    assert!(
        jump.amax() > 0.1 * impact.planned_rate_jump[1].abs(),
        "{jump}"
    );
    assert_eq!(jump[1], 0.0);
}

#[test]
fn the_predicted_step_is_minus_the_impact_torque_plus_the_change_of_compensation() {
    let motion = ssrms_motion();
    let simulation = ssrms(&motion, Compensation::none(), 1e-6);
    let outcome = simulation
        .run(10.0..10.1, &Resolution::default(), |_| ())
        .unwrap();
    let impact = outcome.impact.unwrap();
    let failure = lock(&[1], 10.0);
    let step = impact_torque_of(
        &Ssrms,
        &motion.state(10.0),
        failure.joints,
        &Vector6::zeros(),
    );
    assert!((impact.predicted_step + step).amax() < 1e-9);

    let compensated = ssrms(&motion, cancelling(), 1e-6);
    let outcome = compensated
        .run(10.0..10.1, &Resolution::default(), |_| ())
        .unwrap();
    let left = outcome.impact.unwrap().predicted_step;
    for joint in [0, 2, 3, 4, 5] {
        assert!(
            left[joint].abs() < 0.01 * step[joint].abs(),
            "{joint}: {}",
            left[joint]
        );
    }
}

#[test]
fn feedback_brings_the_healthy_joints_back() {
    let motion = oblique_motion();
    let off_after = |feedback| {
        let mut simulation = oblique(&motion, 1, 0.01);
        simulation.feedback = feedback;
        let mut off = SVector::zeros();
        simulation
            .run(1.1..2.5, &Resolution::default(), |sample| {
                off = sample.state.q - sample.planned.q;
            })
            .unwrap();
        off[1] = 0.0;
        off.amax()
    };
    let (without, with) = (
        off_after(Feedback::NONE),
        off_after(Feedback::critical(10.0)),
    );
    assert!(with < 1e-3 && without > 0.05, "{without} {with}");
}

/// Motors that get U on top of what the motion needs move the arm with it. Feedback takes that for a disturbance:
/// it holds the arm, and in the end takes U back.
#[test]
fn a_compensation_moves_the_arm_unless_feedback_undoes_it() {
    let motion = ssrms_motion();
    let after_half_a_second = |feedback| {
        let mut simulation = ssrms(&motion, cancelling(), 0.1);
        simulation.brake = Brake::none();
        simulation.feedback = feedback;
        let mut last = None;
        simulation
            .run(9.0..9.5, &Resolution::default(), |sample| {
                last = Some(*sample);
            })
            .unwrap();
        let sample = last.unwrap();
        let planned = sample.planned;
        let needed = Ssrms.inverse_dynamics(&planned.q, &planned.qd, &planned.qdd)
            + Ssrms
                .geometric_jacobian(&planned.q)
                .tr_mul(&crate::pushing(0.0));
        let off = (sample.state.q - planned.q).amax();
        // U, and what of it is left in the motors' torque.
        let compensation = sample.control.compensation.norm();
        (
            off,
            (sample.motor - needed).norm() / compensation,
            compensation,
        )
    };
    let (off, left, compensation) = after_half_a_second(Feedback::NONE);
    assert!(off > 0.05 && left > 0.9, "{off} {left}");
    assert!(compensation > 50.0, "{compensation}");
    let (off, left, _) = after_half_a_second(Feedback::critical(30.0));
    assert!(off < 0.02 && left < 0.1, "{off} {left}");
}
