use ulna::nalgebra::{SVector, Vector6};
use ulna::{Compensation, Failure};
use ulna_generated::Ssrms;
use ulna_study::search::{
    CoefficientLaw, ForcePriority, Objective, OperatingPoint, Operation, OperationOptions,
    SearchError, Solution, SolveStatus, Stepwise, cancel_per_joint, feasible_interval,
    least_impact, optimal,
};

use crate::arms::{TIMES, failure, limited, operation, paper_force, paper_like_motion, unlimited};

fn keeps_limits(operation: &Operation<7>, outcome: &Solution<7>) {
    let over = outcome.assessment.peak_torque - operation.rated_torque();
    assert!(over.max() <= 1e-9, "{:e}", over.max());
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
    let overloaded = |sample: &OperatingPoint<7>| sample.planned[3].abs() > 300.0;
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
    for period in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        let options = OperationOptions {
            sample_period: period,
            ..options
        };
        let refusal = new(failure(&[1], 10.0), options);
        assert!(
            matches!(refusal, Err(SearchError::Argument { .. })),
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
