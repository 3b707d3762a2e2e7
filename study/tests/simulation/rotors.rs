//! Rotors behind their gears: what they take up, and the arm that keeps its plan in the limit of heavy ones.

use ulna::control::failure::impact_torque_of;
use ulna::nalgebra::{SMatrix, SVector, Vector6};
use ulna::{Arm, LockedJoints, Trajectory};
use ulna_generated::{Oblique6, Ssrms};
use ulna_study::simulation::{
    Brake, Control, Ending, Feedback, Resolution, ideal_lock, tool_acceleration,
};

use crate::{
    Compensation, cancelling, lock, oblique, oblique_motion, pushing, ssrms, ssrms_motion,
};

/// Different at every joint.
fn uneven() -> SVector<f64, 7> {
    SVector::from([900.0, 400.0, 1500.0, 0.0, 30.0, 2.0, 0.1])
}

#[test]
fn balances_account_for_the_rotors() {
    let motion = ssrms_motion();
    for (compensation, duration) in [
        (Compensation::none(), 0.0),
        (Compensation::none(), 0.1),
        (cancelling(), 0.05),
    ] {
        let mut simulation = ssrms(&motion, compensation, duration);
        simulation.reflected_inertia = uneven();
        simulation.control = Control::Every(0.02);
        let outcome = simulation
            .run(9.9..10.3, &Resolution::default(), |_| ())
            .unwrap();
        assert_eq!(outcome.ending, Ending::Complete);
        let balance = outcome.balance;
        assert!(balance.energy_error < 1e-8, "{duration}: {balance:?}");
        assert!(balance.momentum_error < 1e-8, "{duration}: {balance:?}");
        // Without the rotors' share the balance would not close.
        let plain = ssrms(&motion, compensation, duration);
        let without = plain
            .run(9.9..10.3, &Resolution::default(), |_| ())
            .unwrap();
        assert!((balance.kinetic / without.balance.kinetic - 1.0).abs() > 0.01);
    }
}

/// What gets through a joint is what the structure behind it needs: Newton–Euler on the motion that came about.
#[test]
fn joints_transmit_what_the_structure_needs() {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, cancelling(), 0.1);
    simulation.reflected_inertia = uneven();
    simulation.feedback = Feedback::critical(4.0);
    let mut rotors_take = 0.0_f64;
    simulation
        .run(9.9..10.3, &Resolution::default(), |sample| {
            let state = &sample.state;
            let needed = Ssrms.inverse_dynamics(&state.q, &state.qd, &state.qdd)
                + Ssrms.geometric_jacobian(&state.q).tr_mul(&pushing(0.0));
            let error = (sample.joint_torque() - needed).amax();
            assert!(error < 1e-8, "{} s: {error:.1e}", sample.time);
            rotors_take = rotors_take.max(sample.rotor.amax());
        })
        .unwrap();
    assert!(rotors_take > 100.0, "{rotors_take}");
}

#[test]
fn an_arm_with_rotors_does_as_planned_without_feedback() {
    let motion = oblique_motion();
    let mut simulation = oblique(&motion, 1, 0.1);
    simulation.brake = Brake::none();
    simulation.feedback = Feedback::NONE;
    simulation.reflected_inertia = SVector::from([5.0, 0.3, 20.0, 0.0, 1.0, 0.2]);
    simulation
        .run(0.0..1.0, &Resolution::default(), |sample| {
            let off = (sample.state.q - sample.planned.q).amax();
            assert!(off < 1e-7, "{} s: {off:.1e}", sample.time);
        })
        .unwrap();
}

/// With the inverse of M + R spelt out, and the work of the impulse.
#[test]
fn the_ideal_lock_stops_rotors_too() {
    let motion = oblique_motion();
    let rotors = SVector::from([5.0, 0.3, 20.0, 0.0, 1.0, 0.2]);
    let start = motion.state(1.2);
    let mass_matrix = Oblique6.mass_matrix(&start.q) + SMatrix::from_diagonal(&rotors);
    let inverse = mass_matrix.try_inverse().unwrap();
    for joint in 0..6 {
        let joints = LockedJoints::new(&[joint]).unwrap();
        let ideal = ideal_lock(&Oblique6, &start.q, &start.qd, joints, &rotors).unwrap();
        let impulse = -start.qd[joint] / inverse[(joint, joint)];
        assert!((ideal.brake[joint] / impulse - 1.0).abs() < 1e-12);
        let jump = inverse.column(joint) * impulse;
        assert!((ideal.rate_jump - jump).amax() < 1e-12);
        let mut simulation = oblique(&motion, joint, 0.0);
        simulation.reflected_inertia = rotors;
        let outcome = simulation
            .run(1.2..1.3, &Resolution::default(), |_| ())
            .unwrap();
        assert!((outcome.impact.unwrap().rate_jump - jump).amax() < 1e-12);
        assert!(outcome.balance.energy_error < 1e-8);
    }
}

/// The healthy joints' step without feedback, with these rotors at every joint.
fn healthy_step(inertia: f64, compensation: Compensation<7>, duration: f64) -> (f64, f64) {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, compensation, duration);
    simulation.reflected_inertia = SVector::repeat(inertia);
    let failure = lock(&[1], 10.0);
    let mut off = 0.0_f64;
    let outcome = simulation
        .run(
            9.95..10.0 + duration * 1.01,
            &Resolution::default(),
            |sample| {
                let away = sample.state.q - sample.planned.q;
                off = off.max(failure.joints.without(&away).amax());
            },
        )
        .unwrap();
    let impact = outcome.impact.unwrap();
    (failure.joints.without(&impact.torque_step).norm(), off)
}

/// Geared joints are the paper's: the heavier the rotors, the better the healthy joints keep their plan, and the step that
/// they transmit tends to the predicted one as the brake gets shorter.
#[test]
fn heavy_rotors_make_the_papers_assumption_true() {
    let motion = ssrms_motion();
    let state = motion.state(10.0);
    let joints = lock::<7>(&[1], 10.0).joints;
    let step = impact_torque_of(&Ssrms, &state, joints, &Vector6::zeros());
    let predicted = joints.without(&step).norm();
    assert!((predicted - 42.87).abs() < 0.01, "{predicted}");
    let mut last = f64::INFINITY;
    for inertia in [1e3, 1e4, 1e5, 1e6] {
        let (_, off) = healthy_step(inertia, Compensation::none(), 0.1);
        assert!(off < 0.3 * last, "{inertia}: {off:.1e} rad off the plan");
        last = off;
    }
    // What another program found.
    let (felt, _) = healthy_step(1e5, Compensation::none(), 0.1);
    assert!((felt - 42.05).abs() < 0.01, "{felt}");
    let mut last = f64::INFINITY;
    for duration in [1e-1, 1e-2, 1e-3] {
        let (felt, _) = healthy_step(1e9, Compensation::none(), duration);
        let error = (felt / predicted - 1.0).abs();
        assert!(error < 0.2 * last, "{duration} s: {felt} for {predicted}");
        last = error;
    }
    assert!(last < 1e-3, "{last:.1e}");
}

/// What heavy rotors keep from the structure is also what a compensation would have given it.
#[test]
fn heavy_rotors_take_up_a_compensation() {
    let (without, _) = healthy_step(1e5, Compensation::none(), 0.1);
    let (with, _) = healthy_step(1e5, cancelling(), 0.1);
    // Eq. 16 would cancel the step; another program found 40.5 N m left of it.
    assert!((with - 40.5).abs() < 0.05, "{with}");
    let (heavier, _) = healthy_step(1e7, cancelling(), 0.1);
    assert!(
        (heavier / without - 1.0).abs() < 0.02,
        "{heavier} {without}"
    );
}

/// At rest J q̈ is all of the tool's acceleration; a joint behind an immovable rotor is as good as locked.
#[test]
fn a_compensation_moves_the_tool() {
    let q = ssrms_motion().state(10.0).q;
    let none = LockedJoints::NONE;
    let rest = SVector::zeros();
    let torque = SVector::from([36.0, -62.0, 23.0, -1.2, 0.7, 1.6, 0.0]);
    let light = SVector::zeros();
    let moved = tool_acceleration(&Ssrms, &q, &torque, none, &light).unwrap();
    let qdd = Ssrms.forward_dynamics(&q, &rest, &torque);
    let expected = Ssrms.geometric_jacobian(&q) * qdd;
    assert!((moved - expected).fixed_rows::<3>(0).amax() < 1e-10);
    assert!(moved.fixed_rows::<3>(0).norm() > 0.1);
    // The task of this arm is the tool's position.
    assert_eq!(moved.fixed_rows::<3>(3).amax(), 0.0);

    let joints = LockedJoints::new(&[1]).unwrap();
    let locked = tool_acceleration(&Ssrms, &q, &torque, joints, &light).unwrap();
    let mut immovable = light;
    immovable[1] = 1e13;
    let limit = tool_acceleration(&Ssrms, &q, &torque, none, &immovable).unwrap();
    assert!((locked - limit).amax() < 1e-7 && (locked - moved).amax() > 1e-3);
}

#[test]
fn rotors_of_no_sense_are_refused() {
    let motion = ssrms_motion();
    for (inertia, named) in [(-1.0, "-1"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let mut simulation = ssrms(&motion, Compensation::none(), 0.1);
        simulation.reflected_inertia[3] = inertia;
        let refusal = simulation
            .run(9.0..11.0, &Resolution::default(), |_| ())
            .unwrap_err();
        let expected = format!("the rotors' inertia must be finite and not below 0, not {named}");
        assert_eq!(refusal.to_string(), expected);
    }
}
