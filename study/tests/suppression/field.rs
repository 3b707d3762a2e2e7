//! Other vector fields in the place of ∇w_D: the same residuals at the lock, another tool force.

use ulna::control::compensation::{Projector, TaskPose};
use ulna::nalgebra::{DMatrix, SMatrix, SVector};
use ulna::{Arm, LockedJoints, SerialChain, TaskRow};
use ulna_generated::Ssrms;
use ulna_study::search::{
    Field, Objective, Operation, OperationOptions, cancel_per_joint,
    kinematic_manipulability_gradient, least_impact,
};

use crate::arms::{TIMES, failure, on_every_arm, paper_force, paper_like_motion, states};

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

/// `√det(J Jᵀ)` from the matrix itself.
fn manipulability<const N: usize>(chain: &SerialChain<N>, q: &SVector<f64, N>) -> f64 {
    let jacobian: SMatrix<f64, 6, N> = chain.geometric_jacobian(q);
    let rows: Vec<usize> = chain.task().iter().map(TaskRow::index).collect();
    let rows = DMatrix::from_fn(rows.len(), N, |i, j| jacobian[(rows[i], j)]);
    (&rows * rows.transpose()).determinant().max(0.0).sqrt()
}

#[test]
fn the_kinematic_gradient_is_that_of_the_determinant_by_differences() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        for state in states(chain, 20) {
            let (w, gradient) = kinematic_manipulability_gradient(chain, &state.q);
            let expected = manipulability(chain, &state.q);
            assert!((w - expected).abs() <= 1e-9 * w.max(1.0), "{name}: {w}");
            if w < 1e-2 {
                continue;
            }
            let h = 1e-5;
            let differences = SVector::<f64, N>::from_fn(|i, _| {
                let at = |step: f64| {
                    let mut q = state.q;
                    q[i] += step;
                    manipulability(chain, &q)
                };
                (at(h) - at(-h)) / (2.0 * h)
            });
            let error = (gradient - differences).amax();
            assert!(error <= 1e-6 * gradient.amax().max(w), "{name}: {error:e}");
        }
    }
    on_every_arm!(check);
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

/// At a singular pose J's rows span no volume, and there is no gradient.
#[test]
fn where_the_rows_depend_on_each_other_there_is_no_kinematic_gradient() {
    let chain: SerialChain<2> = crate::arms::chain("planar_2r");
    let (w, gradient) = kinematic_manipulability_gradient(&chain, &SVector::from([0.4, 0.0]));
    assert!(w < 1e-12 && gradient.iter().all(|entry| entry.is_finite()));
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
