//! Other objectives than the least norm, acting on one side of the lock alone, and what effort weighs.

use ulna::Compensation;
use ulna::nalgebra::SVector;
use ulna_study::search::{
    Acts, EFFORT, Fairness, ForcePriority, Objective, Operation, Optimum, Scope, SearchError,
    Solution, SolveStatus, Stepwise, cancel_per_joint, least_impact, optimal, worse_joints,
};
use ulna_study::search::{CoefficientLaw, OperationOptions};

use crate::arms::{
    TIMES, failure, limited, operation, paper_force, paper_like_motion, unlimited, weighted,
};

const SCOPES: [Scope; 2] = [Scope::Healthy, Scope::All];

fn fair(operation: &Operation<7>, fairness: Fairness, priority: ForcePriority) -> Solution<7> {
    let optimum = Optimum {
        priority,
        fairness,
        ..Optimum::default()
    };
    optimum.solve(operation).unwrap()
}

fn exact(operation: &Operation<7>, fairness: Fairness) -> Solution<7> {
    fair(operation, fairness, ForcePriority::Exact)
}

/// |Δτ̃_i| / |step_i|.
fn ratios(operation: &Operation<7>, found: &Solution<7>) -> SVector<f64, 7> {
    let impact = found.assessment.impact;
    impact.component_div(&operation.step()).abs()
}

/// Of the healthy joints, norm and worst ratio with none worse; and the least worst ratio.
#[test]
fn what_fairness_costs_at_the_papers_times() {
    let expected = [(32.2039, 0.97839), (39.2073, 0.95127), (f64::NAN, 0.99784)];
    for (time, (norm, ratio)) in TIMES.into_iter().zip(expected) {
        let operation = unlimited(time);
        let whole = operation.failure().joints.without(&operation.step()).norm();
        let least = exact(&operation, Fairness::LeastNorm);
        assert!(!operation.worse_joints(&least.assessment).is_empty());
        let found = exact(&operation, Fairness::NoJointWorse(Scope::Healthy));
        assert!(found.assessment.max_force_error < 1e-9);
        assert_eq!(operation.worse_joints(&found.assessment), []);
        let healthy = found.assessment.healthy_impact;
        assert!(healthy >= least.assessment.healthy_impact && healthy < whole);
        if !norm.is_nan() {
            assert!((healthy - norm).abs() < 6e-5, "{time} s: {healthy}");
        }
        // The locked joint's brake pays: with it included nothing is gained (but joint 7's step of 0.0004 N m).
        let nothing = exact(&operation, Fairness::NoJointWorse(Scope::All));
        assert!((nothing.assessment.healthy_impact / whole - 1.0).abs() < 1e-9);
        assert!(ratios(&operation, &found)[1] > 1.0);

        let found = exact(&operation, Fairness::WorstRatio(Scope::Healthy));
        let worst = operation.worst_ratio(&found.assessment, Scope::Healthy);
        assert!((worst - ratio).abs() < 6e-6, "{time} s: {worst}");
        let none = exact(&operation, Fairness::WorstRatio(Scope::All));
        assert!(none.assessment.peak_compensation.amax() == 0.0);
        assert_eq!(none.status, SolveStatus::ClosedForm);
    }
}

/// By another road: none of many compensations around the solution does better.
#[test]
fn no_compensation_around_a_fair_one_is_better() {
    let operation = unlimited(10.0);
    let bounded = exact(&operation, Fairness::NoJointWorse(Scope::Healthy));
    let even = exact(&operation, Fairness::WorstRatio(Scope::Healthy));
    let ratio = |found: &Solution<7>| operation.worst_ratio(&found.assessment, Scope::Healthy);
    for start in [&bounded, &even] {
        let Compensation::Optimal { before, after } = start.compensation else {
            panic!("another law");
        };
        let mut random = ulna::proof::random::SplitMix64::new(3);
        for size in [1e-3, 0.1, 3.0] {
            for _ in 0..100 {
                let mut moved = before;
                moved.torque += SVector::<f64, 7>::from_fn(|_, _| size * random.symmetric());
                let near = operation.assess(&Compensation::Optimal {
                    before: moved,
                    after,
                });
                let (norm, worst) = (
                    near.healthy_impact,
                    operation.worst_ratio(&near, Scope::Healthy),
                );
                assert!(worst >= ratio(&even) - 1e-8);
                assert!(worst > 1.0 || norm >= bounded.assessment.healthy_impact - 1e-7);
            }
        }
    }
}

/// A newton of force error buys a lot of fairness.
#[test]
fn fairness_with_the_force_bent_lies_between() {
    for time in TIMES {
        let free = unlimited(time);
        for operation in [&free, &limited(free.failure(), 20.0)] {
            for fairness in SCOPES
                .into_iter()
                .flat_map(|scope| [Fairness::NoJointWorse(scope), Fairness::WorstRatio(scope)])
            {
                let (Fairness::NoJointWorse(scope) | Fairness::WorstRatio(scope)) = fairness else {
                    continue;
                };
                let kept = exact(operation, fairness).assessment;
                let bent = fair(operation, fairness, ForcePriority::AtMost(1.0)).assessment;
                assert!(bent.force_error() <= 1.0 + 1e-7);
                let worst = |assessment| operation.worst_ratio(assessment, scope);
                assert!(worst(&bent) <= worst(&kept) + 1e-6);
                assert!(worst(&bent) <= 1.0 + 1e-6);
                if matches!(fairness, Fairness::NoJointWorse(_)) {
                    assert!(bent.healthy_impact < kept.healthy_impact);
                    let unfair = optimal(operation, ForcePriority::AtMost(1.0)).unwrap();
                    assert!(unfair.assessment.healthy_impact <= bent.healthy_impact + 1e-7);
                } else {
                    assert!(worst(&bent) < 0.95);
                }
                let weighed = fair(operation, fairness, ForcePriority::Weight(1.0));
                assert!(worst(&weighed.assessment) <= 1.0 + 1e-6);
            }
        }
    }
}

#[test]
fn before_the_lock_alone_does_all_and_after_it_alone_little() {
    let expected = [
        (17.701_388_060, 32.601),
        (6.591_299_128, 42.215),
        (14.977_536_344, 15.005),
    ];
    for (time, (both, after)) in TIMES.into_iter().zip(expected) {
        let operation = unlimited(time);
        let acting = |acts| {
            let optimum = Optimum {
                acts,
                ..Optimum::default()
            };
            optimum.solve(&operation).unwrap()
        };
        for acts in [Acts::Both, Acts::Before] {
            let found = acting(acts).assessment.healthy_impact;
            assert!((found - both).abs() < 1e-9, "{acts:?} at {time} s: {found}");
        }
        let found = acting(Acts::After);
        let left = found.assessment.healthy_impact;
        assert!((left - after).abs() < 6e-4, "{time} s: {left}");
        // U' = −P' step.
        let step = operation.failure().joints.without(&operation.step());
        let projected = operation.after().pose.project(&step);
        assert!((left - (step - projected).norm()).abs() < 1e-10);
        let Compensation::Optimal { before, after } = found.compensation else {
            panic!("another law");
        };
        assert_eq!((before.torque.amax(), before.wrench.amax()), (0.0, 0.0));
        let acting = operation.after().pose.project(&after.torque);
        assert!((acting + projected).amax() < 1e-10);
    }
}

/// What was found before effort had a weight, to the last digit but rounding.
#[test]
fn without_weight_impact_alone_counts() {
    let expected = [
        [17.701_388_060_478, 18.970_718_116_410],
        [6.591_299_127_817, 9.972_800_205_136],
        [14.977_536_343_943, 16.190_342_822_264],
    ];
    for (time, [best, projected]) in TIMES.into_iter().zip(expected) {
        for effort in [0.0, EFFORT] {
            // The default costs less than anything that is printed.
            let tolerance = if effort == 0.0 { 1e-9 } else { 1e-6 };
            let none = SVector::repeat(f64::INFINITY);
            let operation = weighted(&failure(&[1], time), none, effort);
            let found = [
                optimal(&operation, ForcePriority::Exact).unwrap(),
                least_impact(&operation, Objective::LeastSquares).unwrap(),
            ];
            for (found, expected) in found.iter().zip([best, projected]) {
                let left = found.assessment.healthy_impact;
                assert!((left - expected).abs() < tolerance, "{time} s: {left}");
                assert_eq!(found.status, SolveStatus::ClosedForm);
            }
            // Eq. 16 still cancels all that it can reach.
            let cancelled = cancel_per_joint(&operation).unwrap();
            assert!(ratios(&operation, &cancelled).rows(0, 6).amax() < 1e-9);
        }
    }
}

/// ‖(U, U')‖ at the lock.
fn effort(operation: &Operation<7>, found: &Solution<7>) -> f64 {
    let at =
        |pose: &ulna::control::compensation::TaskPose<7>| pose.compensation(&found.compensation);
    let (before, after) = (at(&operation.before().pose), at(&operation.after().pose));
    before.norm().hypot(after.norm())
}

/// Eq. 20's coefficients share one direction: of all that leave the same, the cheapest.
#[test]
fn effort_chooses_among_compensations_that_are_as_good() {
    let none = SVector::repeat(f64::INFINITY);
    let failure = failure(&[0], 5.0);
    let (free, weighed) = (operation(&failure, none), weighted(&failure, none, EFFORT));
    for objective in [Objective::LeastSquares, Objective::MinMax] {
        let (a, b) = (
            least_impact(&free, objective).unwrap(),
            least_impact(&weighed, objective).unwrap(),
        );
        let (before, after) = (a.assessment.healthy_impact, b.assessment.healthy_impact);
        assert!((after - before).abs() < 1e-6, "{before}, {after}");
        assert!(effort(&weighed, &b) < 0.2 * effort(&free, &a));
    }
}

/// With growing weight there is more impact and less effort, in every search.
#[test]
fn the_weight_trades_effort_for_impact() {
    type Found = Result<Solution<7>, SearchError>;
    type Find = fn(&Operation<7>) -> Found;
    let worst_ratio = |operation: &Operation<7>| {
        let fairness = Fairness::WorstRatio(Scope::Healthy);
        Ok(exact(operation, fairness))
    };
    let searches: [(&str, Find); 7] = [
        ("Eq. 20", |operation| {
            least_impact(operation, Objective::LeastSquares)
        }),
        ("min-max", |operation| {
            least_impact(operation, Objective::MinMax)
        }),
        ("optimum", |operation| {
            optimal(operation, ForcePriority::Exact)
        }),
        ("1 N", |operation| {
            optimal(operation, ForcePriority::AtMost(1.0))
        }),
        ("weight", |operation| {
            optimal(operation, ForcePriority::Weight(1.0))
        }),
        ("worst ratio", worst_ratio),
        ("Eq. 16", |operation| cancel_per_joint(operation)),
    ];
    for time in TIMES {
        let free = unlimited(time);
        let room = limited(free.failure(), 20.0);
        // Limits at one time are enough.
        let rated = [*free.rated_torque(), *room.rated_torque()];
        for rated in rated.into_iter().take(if time == 10.0 { 2 } else { 1 }) {
            for (name, find) in searches {
                let mut last = f64::INFINITY;
                for weight in [0.0, 0.1, 1.0, 1e3] {
                    let operation = weighted(free.failure(), rated, weight);
                    let found = find(&operation).unwrap();
                    let spent = effort(&operation, &found);
                    assert!(
                        spent <= last * (1.0 + 1e-5) + 1e-5 || (weight == 0.1 && name == "1 N"),
                        "{name} at {time} s, {weight}: {spent} after {last}"
                    );
                    last = spent;
                }
                assert!(last < 0.02, "{name} at {time} s: {last}");
            }
        }
    }
}

/// Joint 1 locks at 18 s: Eq. 16 would spend 7·10⁵ N m to take the last joints' steps away.
#[test]
fn eq_16_leaves_a_joint_alone_whose_step_costs_a_thousand_times_as_much() {
    let none = SVector::repeat(f64::INFINITY);
    let failure = failure(&[0], 18.0);
    let (free, weighed) = (operation(&failure, none), weighted(&failure, none, EFFORT));
    let stepwise = Stepwise::with_step(1e6);
    let (a, b) = (
        cancel_per_joint(&free).unwrap(),
        cancel_per_joint(&weighed).unwrap(),
    );
    assert!(effort(&free, &a) > 5e5 && effort(&weighed, &b) < 2e3);
    let (Compensation::PerJoint(free_k), Compensation::PerJoint(k)) =
        (a.compensation, b.compensation)
    else {
        panic!("another law");
    };
    for joint in 0..7 {
        assert!(k[joint] == free_k[joint] || k[joint] == 0.0);
    }
    assert!(k != free_k && k.amax() > 0.0);
    // The search in steps sees it too.
    let walked = stepwise.search(&weighed, CoefficientLaw::PerJoint).unwrap();
    assert!(effort(&weighed, &walked) < 2e3);
}

#[test]
fn a_weight_that_is_none_is_refused() {
    for effort in [-1e-3, f64::NAN, f64::INFINITY] {
        let options = OperationOptions {
            effort,
            ..OperationOptions::default()
        };
        let (motion, wrench) = (paper_like_motion(), |_| paper_force());
        let failure = failure(&[1], 10.0);
        let made = Operation::new(&ulna_generated::Ssrms, &motion, wrench, &failure, &options);
        assert!(made.unwrap_err().to_string().contains("weight of effort"));
    }
}

#[test]
fn worse_joints_are_the_healthy_ones_that_bear_more() {
    let found = worse_joints(
        &[4.0, -2.0, 1.0, 0.0, 3.0, 0.0],
        &[5.0, 5.0, -1.0, 0.5, -2.0, 1e-12],
        &[1],
    );
    let seen: Vec<_> = found
        .iter()
        .map(|joint| (joint.joint, joint.ratio))
        .collect();
    assert_eq!(seen, [(0, 1.25), (3, f64::INFINITY)]);
    let operation = unlimited(10.0);
    let best = optimal(&operation, ForcePriority::Exact).unwrap();
    let worse = operation.worse_joints(&best.assessment);
    let [joint] = worse[..] else {
        panic!("{worse:?}");
    };
    assert_eq!(joint.joint, 3);
    assert!((joint.ratio - 2.50).abs() < 5e-3 && (joint.after - 3.10).abs() < 5e-3);
}
