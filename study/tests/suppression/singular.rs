use ulna::control::compensation::FreeTorque;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{
    Compensation, Controller, JointState, LockedJoints, Projector, SerialChain, Status, Trajectory,
};

use crate::arms::{chain, paper_force, paper_like_motion, ssrms};

/// The SSRMS without the offsets of its joints: stretched out (q4 = 0), its tool cannot move along the booms.
fn without_offsets() -> SerialChain<7> {
    let mut chain = ssrms();
    for joint in &mut chain.joints {
        joint.d = 0.0;
    }
    chain
}

fn stretched(bend: f64) -> JointState<7> {
    JointState {
        q: SVector::from([0.3, -0.8, 0.4, bend, 0.7, 0.9, -0.2]),
        qd: SVector::repeat(0.1),
        qdd: SVector::repeat(0.02),
    }
}

#[test]
fn at_exactly_singular_poses_the_compensation_is_zero_and_the_status_says_so() {
    let stretched_arm = without_offsets();
    let k = SVector::repeat(1e9);
    let laws = [
        Compensation::PerJoint(k),
        Compensation::Projected(k),
        Compensation::Optimal {
            before: FreeTorque {
                torque: k,
                wrench: Vector6::repeat(5.0),
            },
            after: FreeTorque {
                torque: k,
                wrench: Vector6::repeat(5.0),
            },
        },
    ];
    for law in laws {
        for projector in [Projector::Static, Projector::DynamicallyConsistent] {
            let unlimited = SVector::repeat(f64::INFINITY);
            let controller = Controller::new(&stretched_arm, law)
                .with_projector(projector)
                .with_rated_torque(unlimited);
            let joint_2 = LockedJoints::new(&[1]).unwrap();
            for locked in [LockedJoints::NONE, joint_2] {
                let cycle = controller.cycle(&stretched(0.0), &paper_force(), locked);
                assert_eq!(cycle.status, Status::NearSingular);
                assert!(cycle.conditioning < 1e-12);
                assert_eq!(cycle.compensation, SVector::<f64, 7>::zeros());
                assert_eq!(cycle.torque, cycle.planned);
            }
            // Two joints left for three rows: singular wherever the arm is.
            let arm = ssrms();
            let two_left = LockedJoints::new(&[0, 2, 4, 5, 6]).unwrap();
            let state = paper_like_motion().state(7.0);
            let cycle = Controller::new(&arm, law)
                .with_projector(projector)
                .with_rated_torque(unlimited)
                .cycle(&state, &paper_force(), two_left);
            assert_eq!(cycle.status, Status::NearSingular);
            assert_eq!(cycle.compensation, SVector::<f64, 7>::zeros());
        }
    }
    let planar = chain::<2>("planar_2r");
    let cycle = Controller::new(&planar, Compensation::PerJoint(SVector::repeat(1e6))).cycle(
        &JointState::at_rest(SVector::from([0.4, 0.0])),
        &Vector6::zeros(),
        LockedJoints::NONE,
    );
    assert_eq!(cycle.status, Status::NearSingular);
    assert_eq!(cycle.compensation, SVector::<f64, 2>::zeros());
}

#[test]
fn towards_a_singular_pose_the_compensation_fades_without_a_jump() {
    let arm = without_offsets();
    let k = SVector::repeat(1e7);
    for law in [Compensation::PerJoint(k), Compensation::Projected(k)] {
        for projector in [Projector::Static, Projector::DynamicallyConsistent] {
            let controller = Controller::new(&arm, law)
                .with_projector(projector)
                .with_rated_torque(SVector::repeat(f64::INFINITY));
            let cycle =
                |bend| controller.cycle(&stretched(bend), &paper_force(), LockedJoints::NONE);
            let away = cycle(0.3);
            assert_eq!(away.status, Status::Nominal);
            assert!(away.compensation.amax() > 1.0);
            let mut last = cycle(-2e-3).compensation;
            let steps = 24;
            for i in 1..=steps {
                let cycle = cycle(-2e-3 + 4e-3 * f64::from(i) / f64::from(steps));
                assert_eq!(cycle.status, Status::NearSingular);
                assert!(cycle.force_error.iter().all(|x| x.is_finite()));
                let jump = (cycle.compensation - last).amax();
                assert!(jump < 0.1 * away.compensation.amax(), "{jump:e}");
                last = cycle.compensation;
            }
        }
    }
}
