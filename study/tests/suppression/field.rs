//! Other vector fields in the place of ∇w_D: the same residuals at the lock, another tool force.

use ulna::LockedJoints;
use ulna::control::compensation::{Projector, TaskPose};
use ulna::nalgebra::SVector;
use ulna_generated::Ssrms;
use ulna_study::search::{
    Field, Objective, Operation, OperationOptions, cancel_per_joint, least_impact,
};

use crate::arms::{TIMES, failure, paper_force, paper_like_motion};

const FIELDS: [Field; 4] = [
    Field::DynamicManipulability,
    Field::KinematicManipulability,
    Field::Ones,
    Field::Random(2026),
];

fn operation(time: f64, field: Field) -> Operation<7> {
    let options = OperationOptions {
        sample_period: 0.25,
        field,
        effort: 0.0,
        ..OperationOptions::default()
    };
    let (motion, wrench) = (paper_like_motion(), |_| paper_force());
    Operation::new(&Ssrms, &motion, wrench, &failure(&[1], time), &options).unwrap()
}

#[test]
fn a_field_replaces_the_gradient_alone_and_leaves_locked_joints_out() {
    let q = SVector::from([0.3, 0.5, -0.4, 0.8, -1.0, 0.6, 0.2]);
    let locked = LockedJoints::new(&[1, 3]).unwrap();
    let paper = TaskPose::new(&Ssrms, &q, locked, Projector::Static);
    let x = SVector::from([1.0, -2.0, 3.0, -4.0, 5.0, -6.0, 7.0]);
    for field in FIELDS {
        let pose = field.pose(&Ssrms, &q, locked, Projector::Static);
        assert_eq!(pose.project(&x), paper.project(&x));
        assert_eq!(pose.jacobian, paper.jacobian);
        assert_eq!((pose.gradient[1], pose.gradient[3]), (0.0, 0.0));
        assert_eq!(pose.gradient == paper.gradient, field == FIELDS[0]);
        assert!(pose.gradient.amax() > 0.0);
    }
    let ones = Field::Ones.pose(&Ssrms, &q, locked, Projector::Static);
    assert_eq!(ones.gradient.sum(), 5.0);
    let random = |seed| Field::Random(seed).pose(&Ssrms, &q, locked, Projector::Static);
    assert_eq!(random(1).gradient, random(1).gradient);
    assert_ne!(random(1).gradient, random(2).gradient);
}

#[test]
fn the_residual_at_the_lock_does_not_depend_on_the_field() {
    for (time, expected) in TIMES.into_iter().zip([18.9707, 9.9728, 16.1903]) {
        for field in FIELDS {
            let operation = operation(time, field);
            let joints = operation.failure().joints;
            let before = joints.without(&operation.step()).norm();
            let cancelled = cancel_per_joint(&operation).unwrap().assessment;
            // Joint 7, which ∇w_D can not reach, has next to no step.
            assert!(
                cancelled.healthy_impact < 1e-3 && before > 10.0,
                "{field:?} at {time} s: {}",
                cancelled.healthy_impact
            );
            let projected = least_impact(&operation, Objective::LeastSquares).unwrap();
            let left = projected.assessment.healthy_impact;
            assert!(
                (left - expected).abs() < 6e-5,
                "{field:?} at {time} s: {left}"
            );
            assert!(projected.assessment.max_force_error < 1e-9);
        }
    }
}

#[test]
fn only_the_force_error_depends_on_the_field() {
    let force_error = |field| {
        let found = cancel_per_joint(&operation(18.0, field)).unwrap();
        found.assessment.force_error()
    };
    let errors = FIELDS.map(force_error);
    assert!((errors[0] - 9.3).abs() < 0.05, "{errors:?}");
    assert!((errors[1] - 99.8).abs() < 0.05, "{errors:?}");
}
