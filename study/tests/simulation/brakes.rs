//! The brake: what it does to its joint, and the ideal lock as its limit.

use ulna::nalgebra::{SMatrix, SVector};
use ulna::{Arm, LockedJoints, Trajectory};
use ulna_generated::{Oblique6, Ssrms};
use ulna_study::simulation::{BrakeProfile, Resolution, ideal_lock};

use crate::{Compensation, ideal_impulse, oblique, oblique_motion, ssrms, ssrms_motion};

#[test]
fn a_braked_joint_follows_its_profile_and_stands_still_afterwards() {
    let motion = ssrms_motion();
    for profile in [BrakeProfile::Constant, BrakeProfile::Smooth] {
        let mut simulation = ssrms(&motion, Compensation::none(), 0.4);
        simulation.brake.profile = profile;
        let (series, _) = simulation
            .record(9.5..11.0, &Resolution::default())
            .unwrap();
        let rate = series
            .iter()
            .rfind(|sample| sample.elapsed < 0.0)
            .unwrap()
            .state
            .qd[1];
        let mut stood = None;
        for sample in &series {
            let qd = sample.state.qd[1];
            if (0.0..0.4).contains(&sample.elapsed) {
                let expected = rate * profile.rate(sample.elapsed / 0.4);
                assert!(
                    (qd - expected).abs() < 1e-10,
                    "{} {qd} {expected}",
                    sample.elapsed
                );
            } else if sample.elapsed > 0.4 {
                assert_eq!(qd, 0.0);
                let q = sample.state.q[1];
                assert_eq!(*stood.get_or_insert(q), q);
            }
        }
        // Both profiles lose half of the distance.
        let q0 = series
            .iter()
            .find(|sample| sample.elapsed == 0.0)
            .unwrap()
            .state
            .q[1];
        assert!((stood.unwrap() - q0 - 0.5 * rate * 0.4).abs() < 1e-10);
    }
}

#[test]
fn events_are_hit_exactly_and_seen_from_both_sides() {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, Compensation::none(), 1e-3);
    simulation.brake.detection = 7e-4;
    let (series, _) = simulation
        .record(9.5..10.5, &Resolution::default())
        .unwrap();
    for event in [0.0, 7e-4, 1e-3] {
        let at: Vec<_> = series
            .iter()
            .filter(|sample| sample.elapsed == event)
            .collect();
        assert_eq!(at.len(), 2, "{event}");
        assert_eq!(at[0].state.q, at[1].state.q);
        assert!(
            (at[0].joint_torque() - at[1].joint_torque()).amax() > 1e-3,
            "{event}"
        );
    }
    let braking = series
        .iter()
        .filter(|sample| sample.brake[1] != 0.0 && sample.elapsed <= 7e-4);
    assert!(braking.count() >= 17);
    assert!(
        series
            .windows(2)
            .all(|pair| pair[0].elapsed <= pair[1].elapsed)
    );
}

#[test]
fn the_motor_goes_on_until_the_controller_knows() {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, Compensation::none(), 0.1);
    simulation.brake.detection = 0.3;
    let (series, _) = simulation
        .record(9.5..10.5, &Resolution::default())
        .unwrap();
    for sample in &series {
        let on = sample.elapsed < 0.3;
        if sample.elapsed != 0.3 {
            assert_eq!(sample.motor[1] != 0.0, on, "{}", sample.elapsed);
        }
        assert_eq!(sample.brake[0], 0.0);
    }
}

/// Ten times shorter, ten times nearer: the impulse tends to the ideal lock's, and so do the rates.
#[test]
fn ever_shorter_brakes_tend_to_the_ideal_lock() {
    let motion = ssrms_motion();
    for compensation in [Compensation::none(), crate::cancelling()] {
        let mut last: Option<(f64, f64)> = None;
        for duration in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
            let simulation = ssrms(&motion, compensation, duration);
            let outcome = simulation
                .run(10.0..10.2, &Resolution::default(), |_| ())
                .unwrap();
            let impact = outcome.impact.unwrap();
            let start = motion.state(10.0);
            let ideal = ideal_impulse(&Ssrms, &start.q, &start.qd, 1);
            assert!((impact.ideal.brake[1] / ideal - 1.0).abs() < 1e-12);
            let impulse = (impact.brake_impulse[1] / ideal - 1.0).abs();
            let rates = (impact.rate_jump - impact.ideal.rate_jump).amax();
            if let Some((last_impulse, last_rates)) = last {
                assert!(
                    (7.0..13.0).contains(&(last_impulse / impulse)),
                    "{duration}"
                );
                assert!((7.0..13.0).contains(&(last_rates / rates)), "{duration}");
            }
            last = Some((impulse, rates));
        }
        assert!(last.unwrap().0 < 1e-4);
    }
}

#[test]
fn a_brake_of_no_duration_is_the_ideal_lock() {
    let motion = oblique_motion();
    for joint in 0..6 {
        let simulation = oblique(&motion, joint, 0.0);
        let outcome = simulation
            .run(1.2..1.3, &Resolution::default(), |_| ())
            .unwrap();
        let impact = outcome.impact.unwrap();
        let start = motion.state(1.2);
        let ideal = ideal_impulse(&Oblique6, &start.q, &start.qd, joint);
        assert!(
            (impact.brake_impulse[joint] / ideal - 1.0).abs() < 1e-12,
            "{joint}"
        );
        assert!(
            (impact.rate_jump - impact.ideal.rate_jump).amax() < 1e-14,
            "{joint}"
        );
    }
}

/// The jump from M⁻¹ (Mᵀ's columns of the locked joints taken out), for two joints at once.
#[test]
fn an_ideal_lock_of_two_joints_stops_both_and_pushes_no_other() {
    let state = crate::ssrms_motion().state(7.0);
    let joints = LockedJoints::new(&[1, 3]).unwrap();
    let lock = ideal_lock(&Ssrms, &state.q, &state.qd, joints, &SVector::zeros()).unwrap();
    let mass_matrix = Ssrms.mass_matrix(&state.q);
    let inverse = mass_matrix.try_inverse().unwrap();
    let pick =
        SMatrix::<f64, 7, 2>::from_fn(|row, column| f64::from(u8::from(row == [1, 3][column])));
    let small = (pick.transpose() * inverse * pick).try_inverse().unwrap();
    let impulse: SVector<f64, 7> = -pick * small * pick.tr_mul(&state.qd);
    assert!((lock.brake - impulse).amax() < 1e-10 * impulse.amax());
    assert!((lock.rate_jump - inverse * impulse).amax() < 1e-12);
    assert_eq!(lock.brake[0], 0.0);
    let after = state.qd + lock.rate_jump;
    assert!(after[1].abs() < 1e-15 && after[3].abs() < 1e-15);
    // Kinetic energy can only be lost, by half of the impulses' work at the old rates.
    let lost = -0.5 * lock.brake.dot(&state.qd);
    let kinetic = |qd: &SVector<f64, 7>| 0.5 * (mass_matrix * qd).dot(qd);
    assert!(lost > 0.0);
    assert!((kinetic(&state.qd) - kinetic(&after) - lost).abs() < 1e-10 * kinetic(&state.qd));
}
