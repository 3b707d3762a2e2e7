//! Beside the controller without a memory, schedules, broken cycles and singular poses.

use ulna::control::compensation::{FreeTorque, TaskPose};
use ulna::control::suppression::ScheduleError;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{
    Compensation, Controller, JointState, LockedJoints, OnLine, Projector, Schedule, Status,
    SuppressionLaw, SuppressionLoop, Trajectory,
};
use ulna_generated::Ssrms;

use super::{Loop, NONE, PERIOD, locked, on_line, samples, unlimited};
use crate::arms::{paper_force, paper_like_motion};

#[test]
fn a_broken_cycle_gives_nothing_and_the_next_one_goes_on() {
    let motion = paper_like_motion();
    let cycle = |suppression: &mut Loop<'_>, i: i32, told| {
        let time = 9.5 + PERIOD * f64::from(i);
        suppression.cycle(time, &motion.state(time), &paper_force(), told)
    };
    let (mut broken, mut whole) = (on_line(), on_line());
    for suppression in [&mut broken, &mut whole] {
        cycle(suppression, 0, NONE);
        cycle(suppression, 1, locked(&[1]));
    }
    let mut bad = motion.state(9.52);
    bad.q[2] = f64::NAN;
    let huge = JointState {
        qd: SVector::repeat(1e200),
        ..motion.state(9.52)
    };
    let good = motion.state(9.52);
    for (time, state, wrench) in [
        (9.52, bad, paper_force()),
        (9.52, huge, paper_force()),
        (f64::NAN, good, paper_force()),
        (9.52, good, Vector6::repeat(f64::INFINITY)),
    ] {
        let nothing = broken.cycle(time, &state, &wrench, locked(&[1, 3]));
        assert_eq!(nothing.control.status, Status::NotFinite);
        assert_eq!(nothing.control.torque, SVector::<f64, 7>::zeros());
        assert_eq!(nothing.newly_locked, locked(&[3]));
    }
    for i in 3..6 {
        let told = locked(&[1, 3]);
        let (a, b) = (cycle(&mut broken, i, told), cycle(&mut whole, i, told));
        assert_eq!(a, b);
        assert_eq!(a.newly_locked != NONE, i == 3);
    }
    // Forgetting is starting anew.
    broken.reset();
    assert_eq!(cycle(&mut broken, 6, NONE), cycle(&mut on_line(), 6, NONE));
}

/// Without a recourse and limits it is what the controller without a memory does.
#[test]
fn it_agrees_with_the_controller() {
    let (z, f) = samples();
    let free = FreeTorque {
        torque: z[0],
        wrench: f[1],
    };
    let k = SVector::from([2e7, -3e7, 1e7, 1e7, 5e6, 3e6, 0.0]);
    for compensation in [
        Compensation::PerJoint(k),
        Compensation::Projected(k),
        Compensation::Optimal {
            before: free,
            after: free,
        },
    ] {
        let law = SuppressionLaw::Coefficients(compensation);
        for rated in [f64::INFINITY, 300.0] {
            let rated = SVector::repeat(rated);
            let mut suppression = unlimited(law, law).with_rated_torque(rated);
            let controller = Controller::new(&Ssrms, compensation).with_rated_torque(rated);
            for i in 0..20 {
                let time = f64::from(i);
                let state = paper_like_motion().state(time);
                let told = if i < 8 { NONE } else { locked(&[2]) };
                assert_eq!(
                    suppression
                        .cycle(time, &state, &paper_force(), told)
                        .control,
                    controller.cycle(&state, &paper_force(), told)
                );
            }
        }
    }
}

#[test]
fn a_schedule_is_followed_wherever_the_arm_is() {
    let (z, f) = samples();
    let schedule = Schedule::new(2.0, 0.5, &z).unwrap();
    assert_eq!(schedule.at(-1e300).torque, z[0]);
    assert_eq!(schedule.at(2.5).torque, z[1]);
    assert_eq!(schedule.at(1e300).torque, z[3]);
    assert_eq!(schedule.at(2.5).wrench, Vector6::zeros());
    let quarter = z[1] * 0.75 + z[2] * 0.25;
    assert!((schedule.at(2.625).torque - quarter).amax() < 1e-12);
    let schedule = schedule.with_wrenches(&f).unwrap();
    let mut suppression = unlimited(
        SuppressionLaw::Schedule(schedule),
        SuppressionLaw::Schedule(schedule),
    );
    for i in 0..40 {
        let time = 1.5 + 0.1 * f64::from(i);
        let state = paper_like_motion().state(time);
        for told in [NONE, locked(&[4])] {
            let cycle = suppression
                .cycle(time, &state, &paper_force(), told)
                .control;
            let expected = schedule.at(time);
            assert!((cycle.force_error - expected.wrench).amax() < 1e-9);
            let pose = TaskPose::new(&Ssrms, &state.q, told, Projector::Static);
            let u = pose.project(&expected.torque) + pose.static_torque(&expected.wrench);
            assert!((cycle.compensation - u).amax() < 1e-9);
        }
    }
    let new = |start, period, z| Schedule::<7>::new(start, period, z).unwrap_err();
    assert_eq!(new(0.0, 1.0, &[]), ScheduleError::Empty);
    for (start, period) in [(f64::NAN, 1.0), (0.0, 0.0), (0.0, -1.0), (0.0, f64::NAN)] {
        assert!(matches!(new(start, period, &z), ScheduleError::Time { .. }));
    }
    let broken = [z[0], SVector::repeat(f64::NAN)];
    assert_eq!(new(0.0, 1.0, &broken), ScheduleError::NotFinite(1));
    let error = schedule.with_wrenches(&f[..3]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "a schedule needs a wrench for each of its 4 torques, not 3"
    );
}

/// On the singular set U is 0, whatever is remembered.
#[test]
fn through_a_singular_pose_it_stays_bounded() {
    let mut arm = crate::arms::ssrms();
    for joint in &mut arm.joints {
        joint.d = 0.0;
    }
    for rate in [f64::INFINITY, 100.0, 0.1] {
        let mut suppression = SuppressionLoop::on_line(&arm, OnLine::equal())
            .with_rated_torque(SVector::repeat(f64::INFINITY))
            .with_rate_limit(SVector::repeat(rate));
        for i in -20..=20 {
            let time = PERIOD * f64::from(i);
            let state = JointState {
                q: SVector::from([0.3, -0.8, 0.4, 0.1 * time, 0.7, 0.9, -0.2]),
                qd: SVector::repeat(0.1),
                qdd: SVector::repeat(0.02),
            };
            let told = LockedJoints::new(if i < -10 { &[] } else { &[0] }).unwrap();
            let cycle = suppression
                .cycle(time, &state, &paper_force(), told)
                .control;
            assert!(cycle.compensation.amax() < 50.0, "{}", cycle.compensation);
            if i == 0 {
                assert_eq!(cycle.compensation, SVector::<f64, 7>::zeros());
            }
        }
    }
}
