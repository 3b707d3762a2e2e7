use ulna::nalgebra::{SVector, Vector6};
use ulna::{Compensation, Failure, JointLimits, LockedJoints, PointToPoint};
use ulna_generated::Planar2r;
use ulna_study::search::{
    CoefficientLaw, ForcePriority, Objective, Operation, OperationOptions, Stepwise,
    cancel_per_joint, frontier, least_impact, optimal,
};

use crate::arms::{TIMES, failure, limited, operation, unlimited};

#[test]
fn the_least_that_keeping_the_force_can_leave() {
    for (time, expected) in TIMES.into_iter().zip([17.70, 6.59, 14.98]) {
        let outcome = optimal(&unlimited(time), ForcePriority::Exact).unwrap();
        let found = outcome.assessment.healthy_impact;
        assert!((found / expected - 1.0).abs() < 1e-3, "{time} s: {found}");
        assert!(outcome.assessment.max_force_error < 1e-9);
    }
}

/// Two joints and a task of two rows: whatever is found would be made of rounding.
#[test]
fn without_a_null_space_no_law_finds_a_compensation() {
    let (start, goal) = (SVector::from([0.2, 1.0]), SVector::from([1.1, 0.4]));
    let motion = PointToPoint::new(start, goal, 2.0, 0.5, &JointLimits::none()).unwrap();
    let wrench = |_| Vector6::new(1.0, 2.0, 0.0, 0.0, 0.0, 0.0);
    for joint in 0..2 {
        let joints = LockedJoints::new(&[joint]).unwrap();
        for rated_torque in [f64::INFINITY, 40.0] {
            let options = OperationOptions {
                rated_torque: SVector::repeat(rated_torque),
                ..OperationOptions::default()
            };
            let failure = Failure { joints, time: 0.9 };
            let operation = Operation::new(&Planar2r, &motion, wrench, &failure, &options).unwrap();
            for found in [
                cancel_per_joint(&operation).unwrap(),
                least_impact(&operation, Objective::LeastSquares).unwrap(),
                least_impact(&operation, Objective::MinMax).unwrap(),
                optimal(&operation, ForcePriority::Exact).unwrap(),
            ] {
                let assessment = found.assessment;
                assert!(assessment.peak_compensation.amax() < 1e-12, "{found:?}");
                assert!((assessment.impact - operation.step()).amax() < 1e-12);
                assert!(assessment.max_force_error < 1e-12);
                if let Compensation::PerJoint(k) | Compensation::Projected(k) = found.compensation {
                    assert_eq!(k.amax(), 0.0);
                }
            }
        }
    }
}

/// Whatever a law reaches at the lock, the optimal law reaches too, at no more force error.
#[test]
fn no_law_is_better_than_the_optimal_one_at_its_own_force_error() {
    for joints in [&[1][..], &[3], &[0, 4]] {
        for time in TIMES {
            let failure = failure(joints, time);
            let free = operation(&failure, SVector::repeat(f64::INFINITY));
            for operation in [&free, &limited(&failure, 15.0)] {
                let stepwise = Stepwise::with_step(1e6);
                for other in [
                    cancel_per_joint(operation).unwrap(),
                    stepwise
                        .search(operation, CoefficientLaw::PerJoint)
                        .unwrap(),
                    stepwise
                        .search(operation, CoefficientLaw::Projected)
                        .unwrap(),
                    least_impact(operation, Objective::LeastSquares).unwrap(),
                    least_impact(operation, Objective::MinMax).unwrap(),
                ] {
                    let other = other.assessment;
                    let allowed = match other.force_error() {
                        rounding if rounding < 1e-9 => ForcePriority::Exact,
                        error => ForcePriority::AtMost(error),
                    };
                    let best = optimal(operation, allowed).unwrap().assessment;
                    assert!(
                        best.healthy_impact <= other.healthy_impact + 1e-6,
                        "{joints:?} at {time} s: {} after {}",
                        best.healthy_impact,
                        other.healthy_impact
                    );
                    assert!(best.force_error() <= other.force_error() + 1e-7);
                }
            }
        }
    }
}

#[test]
fn the_frontier_falls_from_the_force_keeping_limit_to_no_impact() {
    for (time, limit) in TIMES.into_iter().zip([17.70, 6.59, 14.98]) {
        let operation = unlimited(time);
        let per_joint = cancel_per_joint(&operation).unwrap().assessment;
        let allowed: Vec<f64> = (0..=20)
            .map(|i| per_joint.force_error() * f64::from(i) / 20.0)
            .collect();
        let points = frontier(&operation, &allowed).unwrap();
        let impact = |i: usize| points[i].solution.assessment.healthy_impact;
        assert!((impact(0) / limit - 1.0).abs() < 1e-3);
        for i in 1..points.len() {
            assert!(impact(i) <= impact(i - 1) + 1e-7);
            assert!(points[i].solution.assessment.force_error() <= allowed[i] + 1e-7);
        }
        assert!(impact(points.len() - 1) <= per_joint.healthy_impact + 1e-7);
        // All of the step can go for far less force error than Eq. 16 takes.
        let whole = optimal(&operation, ForcePriority::AtMost(f64::INFINITY)).unwrap();
        assert!(whole.assessment.healthy_impact < 1e-6);
        assert!(whole.assessment.force_error() < 0.25 * per_joint.force_error());
    }
}

#[test]
fn the_weight_leads_from_no_impact_to_no_force_error() {
    let operation = unlimited(10.0);
    let exact = optimal(&operation, ForcePriority::Exact)
        .unwrap()
        .assessment;
    let mut last = (0.0, f64::INFINITY);
    for weight in [1e-3, 0.1, 1.0, 10.0, 100.0, 1e4] {
        let found = optimal(&operation, ForcePriority::Weight(weight))
            .unwrap()
            .assessment;
        let point = (found.healthy_impact, found.force_error());
        assert!(point.0 >= last.0 - 1e-9 && point.1 <= last.1 + 1e-9);
        last = point;
    }
    assert!((last.0 - exact.healthy_impact).abs() < 1e-3 && last.1 < 1e-5);
}
