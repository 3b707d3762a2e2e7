use ulna::failure::impact_torque;
use ulna::nalgebra::{SVector, Vector6};
use ulna::search::{
    CoefficientLaw, ForcePriority, Objective, Operation, OperationOptions, Outcome, SearchError,
    SolveStatus, Stepwise, cancel_per_joint, feasible_interval, frontier, least_impact, optimal,
};
use ulna::{
    Arm, Compensation, Controller, Failure, JointLimits, LockedJoints, SerialChain, Status,
    Trajectory, Trapezoid,
};
use ulna_generated::Ssrms;

use crate::arms::{on_every_arm, paper_force, paper_like_motion, ssrms};

const TIMES: [f64; 3] = [3.0, 10.0, 18.0];

fn failure(joints: &[usize], time: f64) -> Failure<7> {
    Failure {
        joints: LockedJoints::new(joints).unwrap(),
        time,
    }
}

fn operation(failure: &Failure<7>, rated_torque: SVector<f64, 7>) -> Operation<7> {
    let options = OperationOptions {
        sample_period: 0.25,
        rated_torque,
        ..OperationOptions::default()
    };
    let wrench = |_| paper_force();
    Operation::new(&Ssrms, &paper_like_motion(), wrench, failure, &options).unwrap()
}

/// Section 5.2: joint 2, no limits.
fn unlimited(time: f64) -> Operation<7> {
    operation(&failure(&[1], time), SVector::repeat(f64::INFINITY))
}

/// Rated torques `room` N·m above what the motion needs by itself.
fn limited(failure: &Failure<7>, room: f64) -> Operation<7> {
    let free = operation(failure, SVector::repeat(f64::INFINITY));
    let needed = free.assess(&Compensation::none()).peak_torque;
    operation(failure, needed.add_scalar(room))
}

/// What is left of each joint's step, joints 1 to 6.
fn left(operation: &Operation<7>, outcome: &Outcome<7>) -> [f64; 6] {
    std::array::from_fn(|i| (outcome.assessment.impact[i] / operation.step()[i]).abs())
}

fn keeps_limits(operation: &Operation<7>, outcome: &Outcome<7>) {
    let over = outcome.assessment.peak_torque - operation.rated_torque();
    assert!(over.max() <= 1e-9, "{:e}", over.max());
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
fn eq_20_keeps_the_tool_force_and_leaves_what_a_single_direction_can_not_take() {
    for (time, expected) in TIMES.into_iter().zip([18.97, 9.97, 16.19]) {
        let operation = unlimited(time);
        let outcome = least_impact(&operation, Objective::LeastSquares).unwrap();
        let found = outcome.assessment.healthy_impact;
        assert!((found / expected - 1.0).abs() < 1e-3, "{time} s: {found}");
        assert!(outcome.assessment.max_force_error < 1e-9);
        assert_eq!(outcome.status, SolveStatus::ClosedForm);
        let min_max = least_impact(&operation, Objective::MinMax).unwrap();
        let largest = |outcome: &Outcome<7>| {
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
fn the_least_that_keeping_the_force_can_leave() {
    for (time, expected) in TIMES.into_iter().zip([17.70, 6.59, 14.98]) {
        let outcome = optimal(&unlimited(time), ForcePriority::Exact).unwrap();
        let found = outcome.assessment.healthy_impact;
        assert!((found / expected - 1.0).abs() < 1e-3, "{time} s: {found}");
        assert!(outcome.assessment.max_force_error < 1e-9);
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
fn rated_torques_that_bind_are_kept_by_every_search() {
    let mut bound = 0;
    for time in TIMES {
        let failure = failure(&[1], time);
        let operation = limited(&failure, 8.0);
        let per_joint = cancel_per_joint(&operation).unwrap();
        let Compensation::PerJoint(k) = per_joint.compensation else {
            panic!("another law");
        };
        let Compensation::PerJoint(wish) = cancel_per_joint(&unlimited(time)).unwrap().compensation
        else {
            panic!("another law");
        };
        for i in 0..7 {
            let interval = feasible_interval(&operation, CoefficientLaw::PerJoint, i, &k).unwrap();
            assert_eq!(k[i], wish[i].max(interval.lower).min(interval.upper));
            if k[i] != wish[i] {
                bound += 1;
                let time = if k[i] == interval.lower {
                    interval.lower_time
                } else {
                    interval.upper_time
                };
                assert!(time.is_some());
            }
        }
        keeps_limits(&operation, &per_joint);
        for law in [CoefficientLaw::PerJoint, CoefficientLaw::Projected] {
            let walked = Stepwise::with_step(1e6).search(&operation, law).unwrap();
            keeps_limits(&operation, &walked);
        }
        for objective in [Objective::LeastSquares, Objective::MinMax] {
            let outcome = least_impact(&operation, objective).unwrap();
            keeps_limits(&operation, &outcome);
            assert!(outcome.gap.unwrap() < 1e-6);
        }
        for priority in [
            ForcePriority::Exact,
            ForcePriority::AtMost(0.5),
            ForcePriority::AtMost(f64::INFINITY),
            ForcePriority::Weight(1.0),
        ] {
            let outcome = optimal(&operation, priority).unwrap();
            keeps_limits(&operation, &outcome);
            assert!(outcome.gap.unwrap() < 1e-6);
        }
    }
    assert!(
        bound >= 3,
        "the limits must bind for this to mean something"
    );
}

#[test]
fn an_empty_interval_names_the_joint_and_the_time() {
    // The motion alone takes up to 405 N·m at joint 4.
    let operation = operation(&failure(&[1], 10.0), SVector::repeat(300.0));
    let empty = feasible_interval(&operation, CoefficientLaw::PerJoint, 3, &SVector::zeros());
    let Err(SearchError::Empty { joint: 3, time }) = empty else {
        panic!("{empty:?}");
    };
    let until = |end: f64| {
        let samples = operation.samples().iter();
        samples.take_while(move |sample| sample.time <= end)
    };
    let overloaded = |sample: &ulna::search::Sample<7>| sample.planned[3].abs() > 300.0;
    assert!(until(time).any(overloaded));
    for search in [
        cancel_per_joint(&operation),
        Stepwise::with_step(1e6).search(&operation, CoefficientLaw::PerJoint),
        Stepwise::with_step(1e6).search(&operation, CoefficientLaw::Projected),
        least_impact(&operation, Objective::LeastSquares),
        least_impact(&operation, Objective::MinMax),
        optimal(&operation, ForcePriority::Exact),
    ] {
        let refusal = search.unwrap_err();
        assert!(
            refusal
                .to_string()
                .starts_with("no compensation keeps joint 4 within its rated torque at "),
            "{refusal}"
        );
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
        let impact = |i: usize| points[i].outcome.assessment.healthy_impact;
        assert!((impact(0) / limit - 1.0).abs() < 1e-3);
        for i in 1..points.len() {
            assert!(impact(i) <= impact(i - 1) + 1e-7);
            assert!(points[i].outcome.assessment.force_error() <= allowed[i] + 1e-7);
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

#[test]
fn the_controller_flies_what_the_search_found() {
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
fn a_control_period_takes_the_torques_one_cycle_later() {
    let options = OperationOptions {
        control_period: 1e-3,
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
        let motion = Trapezoid::new(start, goal, 4.0, 1.0, &JointLimits::none()).unwrap();
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

#[test]
fn what_makes_no_operation_and_no_search_is_refused() {
    let motion = paper_like_motion();
    let wrench = |_| paper_force();
    let options = OperationOptions::default();
    let new = |failure: Failure<7>, options| {
        Operation::new(&Ssrms, &motion, wrench, &failure, &options).map(|_| ())
    };
    for time in [-1.0, 20.1, f64::NAN] {
        let refusal = new(failure(&[1], time), options);
        assert!(
            matches!(refusal, Err(SearchError::FailureTime { .. })),
            "{time}"
        );
    }
    for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = OperationOptions {
            sample_period: period,
            ..options
        };
        let refusal = new(failure(&[1], 10.0), options);
        assert!(
            matches!(refusal, Err(SearchError::Period { .. })),
            "{period}"
        );
    }
    let nan = Operation::new(
        &Ssrms,
        &motion,
        |time| {
            if time > 5.0 {
                Vector6::repeat(f64::NAN)
            } else {
                paper_force()
            }
        },
        &failure(&[1], 10.0),
        &options,
    );
    assert!(matches!(nan, Err(SearchError::NotFinite { time }) if time > 5.0 && time < 5.1));
    let operation = unlimited(10.0);
    for step in [0.0, -1.0, f64::NAN] {
        let search = Stepwise::with_step(step).search(&operation, CoefficientLaw::PerJoint);
        assert!(matches!(search, Err(SearchError::Argument { .. })));
    }
    for priority in [
        ForcePriority::AtMost(-1.0),
        ForcePriority::AtMost(f64::NAN),
        ForcePriority::Weight(0.0),
        ForcePriority::Weight(f64::INFINITY),
    ] {
        assert!(matches!(
            optimal(&operation, priority),
            Err(SearchError::Argument { .. })
        ));
    }
    let few = Stepwise {
        max_steps: 3,
        ..Stepwise::with_step(1e6)
    };
    let outcome = few.search(&operation, CoefficientLaw::PerJoint).unwrap();
    assert_eq!(
        (outcome.status, outcome.iterations),
        (SolveStatus::StepLimit, 3)
    );
}
