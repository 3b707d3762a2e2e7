use ulna::control::failure::impact_torque;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{
    Arm, Compensation, Controller, Failure, JointLimits, LockedJoints, PointToPoint, SerialChain,
    Status, Trajectory,
};
use ulna_generated::Ssrms;
use ulna_study::search::{
    CoefficientLaw, ForcePriority, Objective, Operation, OperationOptions, Solution, SolveStatus,
    Stepwise, cancel_per_joint, equivalent_per_joint, least_impact, optimal,
};

use crate::arms::{
    TIMES, failure, limited, on_every_arm, paper_force, paper_like_motion, ssrms, unlimited,
};

/// What is left of each joint's step, joints 1 to 6.
fn left(operation: &Operation<7>, outcome: &Solution<7>) -> [f64; 6] {
    std::array::from_fn(|i| (outcome.assessment.impact[i] / operation.step()[i]).abs())
}

#[test]
fn the_step_without_compensation_is_the_negative_impact_torque() {
    let chain = ssrms();
    for time in TIMES {
        let operation = unlimited(time);
        let joints = operation.failure().joints;
        let state = paper_like_motion().state(time);
        let impact = impact_torque(&chain, &state, joints, &Vector6::zeros());
        assert!((operation.step() + impact.torque).amax() < 1e-10);
        let uncompensated = operation.assess(&Compensation::none());
        assert_eq!(uncompensated.impact, operation.step());
    }
}

#[test]
fn eq_16_cancels_the_step_of_every_joint() {
    for time in TIMES {
        let operation = unlimited(time);
        let outcome = cancel_per_joint(&operation).unwrap();
        for (joint, left) in left(&operation, &outcome).into_iter().enumerate() {
            assert!(left < 1e-9, "joint {} at {time} s: {left:e}", joint + 1);
        }
        // Not for nothing: the tool force bends by several of its 20 N per axis.
        assert!(outcome.assessment.force_error() > 5.0);
    }
    let Compensation::PerJoint(k) = cancel_per_joint(&unlimited(10.0)).unwrap().compensation else {
        panic!("another law");
    };
    let expected = [5.11e7, -8.07e7, 3.90e7, -3.75e7, 1.08e7, 0.78e7];
    for (found, expected) in k.iter().zip(expected) {
        assert!((found - expected).abs() < 0.006e7, "{found:e}");
    }
    // w_D does not change with joint 7, so its coefficient has no say.
    assert_eq!(k[6], 0.0);
}

#[test]
fn equivalent_coefficients_change_each_step_as_another_law_did() {
    for time in TIMES {
        let operation = unlimited(time);
        let exact = cancel_per_joint(&operation).unwrap();
        let found = equivalent_per_joint(&operation, &exact.assessment);
        let Compensation::PerJoint(k) = exact.compensation else {
            panic!("another law");
        };
        assert!((found - k).amax() <= 1e-9 * k.amax());

        let best = optimal(&operation, ForcePriority::Exact).unwrap();
        let k = equivalent_per_joint(&operation, &best.assessment);
        let alike = operation.assess(&Compensation::PerJoint(k));
        for i in 0..6 {
            assert!((alike.impact[i] - best.assessment.impact[i]).abs() < 1e-9);
        }
        assert_eq!(k[6], 0.0);
        // Alike in the step, not in the tool force.
        assert!(alike.force_error() > 1.0 && best.assessment.force_error() < 1e-9);
    }
}

#[test]
fn eq_20_keeps_the_tool_force_and_leaves_what_a_single_direction_can_not_take() {
    for (time, expected) in TIMES.into_iter().zip([18.97, 9.97, 16.19]) {
        let operation = unlimited(time);
        let outcome = least_impact(&operation, Objective::LeastSquares).unwrap();
        let found = outcome.assessment.healthy_impact;
        assert!((found / expected - 1.0).abs() < 1e-3, "{time} s: {found}");
        assert!(outcome.assessment.max_force_error < 1e-9);
        assert_eq!(outcome.status, SolveStatus::ClosedForm);
        let min_max = least_impact(&operation, Objective::MinMax).unwrap();
        let largest = |outcome: &Solution<7>| {
            let joints = operation.failure().joints;
            joints.without(&outcome.assessment.impact).amax()
        };
        assert_eq!(min_max.status, SolveStatus::Solved);
        assert!(min_max.gap.unwrap() < 1e-8);
        assert!(largest(&min_max) <= largest(&outcome) + 1e-8);
        assert!(min_max.assessment.healthy_impact >= found - 1e-8);
        assert!(min_max.assessment.max_force_error < 1e-9);
    }
}

#[test]
fn one_locked_joint_leaves_eq_20_one_direction() {
    for time in TIMES {
        let operation = unlimited(time);
        let joints = operation.failure().joints;
        let change = |k| {
            let found = operation.assess(&Compensation::Projected(k));
            joints
                .without(&(found.impact - operation.step()))
                .normalize()
        };
        let first = change(SVector::from([0.0, 1e7, 0.0, 0.0, 0.0, 0.0, 0.0]));
        for i in 2..6 {
            let mut k = SVector::zeros();
            k[i] = 1e7;
            assert!((first.dot(&change(k)).abs() - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn the_papers_search_ends_within_half_a_step_of_the_exact_coefficients() {
    for time in TIMES {
        let operation = unlimited(time);
        let Compensation::PerJoint(exact) = cancel_per_joint(&operation).unwrap().compensation
        else {
            panic!("another law");
        };
        for step in [1e7, 1e6] {
            let outcome = Stepwise::with_step(step)
                .search(&operation, CoefficientLaw::PerJoint)
                .unwrap();
            let Compensation::PerJoint(found) = outcome.compensation else {
                panic!("another law");
            };
            assert_eq!(outcome.status, SolveStatus::GridOptimum);
            assert!((found - exact).amax() <= 0.5 * step * (1.0 + 1e-9));
            let on_grid = found.map(|k| (k / step - (k / step).round()).abs());
            assert!(on_grid.amax() < 1e-9);
            if step == 1e6 {
                let whole = outcome.assessment.impact.norm() / operation.step().norm();
                assert!(whole < 0.05, "{time} s: {whole}");
            }
        }
        let refined = Stepwise {
            refinements: 2,
            ..Stepwise::with_step(1e6)
        };
        let outcome = refined
            .search(&operation, CoefficientLaw::PerJoint)
            .unwrap();
        for left in left(&operation, &outcome) {
            assert!(left < 0.05, "{time} s: {left}");
        }
    }
    // In the middle of the motion the step alone leaves less than 5 % in every joint.
    let operation = unlimited(10.0);
    let outcome = Stepwise::with_step(1e6).search(&operation, CoefficientLaw::PerJoint);
    for left in left(&operation, &outcome.unwrap()) {
        assert!(left < 0.05, "{left}");
    }
}

#[test]
fn the_papers_search_does_no_better_than_the_exact_one() {
    for time in TIMES {
        let unlimited = unlimited(time);
        for operation in [&unlimited, &limited(unlimited.failure(), 20.0)] {
            let exact = least_impact(operation, Objective::LeastSquares).unwrap();
            let refined = Stepwise {
                refinements: 3,
                ..Stepwise::with_step(1e6)
            };
            let walked = refined
                .search(operation, CoefficientLaw::Projected)
                .unwrap();
            let (exact, walked) = (exact.assessment, walked.assessment);
            assert!(walked.healthy_impact >= exact.healthy_impact - 1e-7);
            assert!(walked.max_force_error < 1e-9);
            // From the exact coefficients, no small step leads further down.
            let Compensation::Projected(start) = least_impact(operation, Objective::LeastSquares)
                .unwrap()
                .compensation
            else {
                panic!("another law");
            };
            let polish = Stepwise {
                start,
                ..Stepwise::with_step(1e4)
            };
            let polished = polish.search(operation, CoefficientLaw::Projected).unwrap();
            let gained = exact.healthy_impact - polished.assessment.healthy_impact;
            assert!(gained < 1e-6, "{time} s: {gained:e}");
        }
    }
}

#[test]
fn the_controller_executes_what_the_search_found() {
    for time in TIMES {
        let failure = failure(&[1], time);
        let operation = limited(&failure, 20.0);
        for outcome in [
            cancel_per_joint(&operation).unwrap(),
            least_impact(&operation, Objective::LeastSquares).unwrap(),
            optimal(&operation, ForcePriority::AtMost(0.3)).unwrap(),
        ] {
            let controller = Controller::new(&Ssrms, outcome.compensation)
                .with_rated_torque(*operation.rated_torque());
            let state = paper_like_motion().state(time);
            let cycle = |locked| controller.cycle(&state, &paper_force(), locked);
            let (before, after) = (cycle(LockedJoints::NONE), cycle(failure.joints));
            let impact = after.torque - before.torque;
            let found = &outcome.assessment;
            assert!((impact - found.impact).amax() < 1e-9);
            assert!((before.force_error - found.force_error_before).amax() < 1e-9);
            assert!((after.force_error - found.force_error_after).amax() < 1e-9);
            assert_eq!(
                (before.status, after.status),
                (Status::Nominal, Status::Nominal)
            );
        }
    }
}

#[test]
fn a_step_time_takes_the_torques_so_much_later() {
    let options = OperationOptions {
        step_time: 1e-3,
        ..OperationOptions::default()
    };
    // Section 5.4: F_e = 0.2 t² + 4 t along each axis.
    let wrench = |t: f64| {
        let force = 0.2 * t * t + 4.0 * t;
        Vector6::new(force, force, force, 0.0, 0.0, 0.0)
    };
    let motion = paper_like_motion();
    let failure = failure(&[1], 10.0);
    let operation = Operation::new(&Ssrms, &motion, wrench, &failure, &options).unwrap();
    assert_eq!(operation.before().time, 10.0);
    assert_eq!(operation.after().time, 10.001);
    let after = failure.state(&motion, 10.001);
    let torque = Ssrms.inverse_dynamics(&after.q, &after.qd, &after.qdd)
        + Ssrms.geometric_jacobian(&after.q).tr_mul(&wrench(10.001));
    assert!((operation.after().planned - torque).amax() < 1e-10);
    let instant = OperationOptions::default();
    let instant = Operation::new(&Ssrms, &motion, wrench, &failure, &instant).unwrap();
    let drift = (operation.step() - instant.step()).amax();
    assert!(drift > 1e-4 && drift < 0.5, "{drift:e}");
}

#[test]
fn arms_without_freedom_to_spare_are_searched_too() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        let start = SVector::<f64, N>::from_fn(|i, _| 0.3 + 0.4 * i as f64);
        let goal = start.add_scalar(0.5);
        let motion = PointToPoint::new(start, goal, 4.0, 1.0, &JointLimits::none()).unwrap();
        let failure = Failure {
            joints: LockedJoints::new(&[N - 1]).unwrap(),
            time: 2.0,
        };
        let options = OperationOptions {
            sample_period: 0.25,
            ..OperationOptions::default()
        };
        let wrench = |_| Vector6::new(1.0, 2.0, 3.0, 0.0, 0.0, 0.0);
        let operation = Operation::new(chain, &motion, wrench, &failure, &options).unwrap();
        for outcome in [
            cancel_per_joint(&operation),
            Stepwise::with_step(1e3).search(&operation, CoefficientLaw::PerJoint),
            Stepwise {
                max_steps: 1000,
                ..Stepwise::with_step(1e3)
            }
            .search(&operation, CoefficientLaw::Projected),
            least_impact(&operation, Objective::LeastSquares),
            optimal(&operation, ForcePriority::Exact),
            optimal(&operation, ForcePriority::AtMost(1.0)),
            optimal(&operation, ForcePriority::Weight(1.0)),
        ] {
            let assessment = outcome.unwrap().assessment;
            assert!(assessment.impact.iter().all(|x| x.is_finite()), "{name}");
            let step = failure.joints.without(&operation.step()).norm();
            assert!(assessment.healthy_impact <= step * (1.0 + 1e-9), "{name}");
        }
        let min_max = least_impact(&operation, Objective::MinMax).unwrap();
        let largest = failure.joints.without(&min_max.assessment.impact).amax();
        let step = failure.joints.without(&operation.step()).amax();
        assert!(largest <= step * (1.0 + 1e-9), "{name}");
    }
    on_every_arm!(check);
}
