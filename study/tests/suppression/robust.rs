//! A compensation for failures of which neither joint nor time is known, the best constants, and the recourse after a lock.

use ulna::nalgebra::{SVector, Vector6};
use ulna::{Failure, JointLimits, LockedJoints, PointToPoint};
use ulna_generated::{Planar2r, Ssrms};
use ulna_study::search::{
    CoefficientLaw, ForcePriority, Moment, Operation, OperationOptions, RobustObjective,
    RobustOptions, RobustPlan, SearchError, best_constant, nearest_torque, optimal, robust,
};

use crate::arms::{failure, operation, paper_like_motion};

const NO_LIMIT: f64 = f64::INFINITY;

/// `joints` of the paper-like motion, each by itself, at `count` times.
fn moments(joints: &[usize], count: u32) -> Vec<Moment<7>> {
    let moment = |i: u32| {
        let time = 20.0 * f64::from(i) / f64::from(count + 1);
        moment_at(joints, time)
    };
    (1..=count).map(moment).collect()
}

fn moment_at(joints: &[usize], time: f64) -> Moment<7> {
    let operations = joints.iter().map(|joint| {
        let options = OperationOptions {
            sample_period: 20.0,
            ..OperationOptions::default()
        };
        let wrench = |_| crate::arms::paper_force();
        let failure = failure(&[*joint], time);
        Operation::new(&Ssrms, &paper_like_motion(), wrench, &failure, &options).unwrap()
    });
    let operations: Vec<_> = operations.collect();
    Moment {
        before: *operations[0].before(),
        after: operations.iter().map(|one| *one.after()).collect(),
    }
}

/// After to before, lock by lock.
fn ratios(plan: &RobustPlan<7>, moments: &[Moment<7>]) -> Vec<Vec<f64>> {
    let pairs = plan.samples.iter().zip(moments);
    let ratios = pairs.map(|(sample, moment)| {
        let locks = sample.impact.iter().zip(&moment.after);
        let ratio = |(impact, after): (&f64, &_)| impact / step(moment, after).norm();
        locks.map(ratio).collect()
    });
    ratios.collect()
}

fn step(moment: &Moment<7>, after: &ulna_study::search::OperatingPoint<7>) -> SVector<f64, 7> {
    after
        .locked
        .without(&(after.planned - moment.before.planned))
}

fn worst(ratios: &[f64]) -> f64 {
    ratios.iter().copied().fold(0.0, f64::max)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
fn with_one_joint_at_risk_it_is_the_force_exact_optimum_at_every_time() {
    let moments = moments(&[1], 19);
    let options = RobustOptions {
        objective: RobustObjective::WorstTorque,
        effort: 1e-7,
        ..RobustOptions::default()
    };
    let plan = robust(&moments, &options).unwrap();
    for (sample, moment) in plan.samples.iter().zip(&moments) {
        let operation = operation(&failure(&[1], sample.time), SVector::repeat(NO_LIMIT));
        let best = optimal(&operation, ForcePriority::Exact).unwrap();
        let best = best.assessment.healthy_impact;
        assert!((sample.impact[0] - best).abs() < 1e-4, "{} s", sample.time);
        let before = step(moment, &moment.after[0]).norm();
        assert!(sample.impact[0] <= before * (1.0 + 1e-9));
    }
}

/// The worst ratio over six joints at 79 times: the median of those.
#[test]
fn a_force_budget_buys_what_keeping_the_force_cannot() {
    let moments = moments(&[0, 1, 2, 3, 4, 5], 79);
    let mut last = f64::INFINITY;
    for (budget, expected) in [(0.0, 0.9994), (2.0, 0.892), (5.0, 0.780), (10.0, 0.606)] {
        let options = RobustOptions {
            objective: RobustObjective::WorstRatio { floor: 1e-3 },
            force_budget: budget,
            ..RobustOptions::default()
        };
        let plan = robust(&moments, &options).unwrap();
        let ratios = ratios(&plan, &moments);
        let worsts: Vec<_> = ratios.iter().map(|ratios| worst(ratios)).collect();
        assert!(
            worst(&worsts) < 1.0 + 1e-6,
            "{budget} N: {}",
            worst(&worsts)
        );
        let median = median(worsts);
        assert!((median - expected).abs() < 2e-3, "{budget} N: {median}");
        assert!(plan.objective < last);
        last = plan.objective;
        for (sample, moment) in plan.samples.iter().zip(&moments) {
            let pose = &moment.before.pose;
            let u = pose.project(&sample.before.torque) + pose.static_torque(&sample.before.wrench);
            let force = pose.null_space.static_wrench(&u).norm();
            assert!(force <= budget + 1e-6, "{force} N at {} s", sample.time);
        }
    }
}

#[test]
fn rates_and_rated_torques_are_kept_and_cost_something() {
    let moments = moments(&[0, 1, 2, 3, 4, 5], 39);
    let free = RobustOptions {
        force_budget: 5.0,
        ..RobustOptions::default()
    };
    let (rate, rated) = (20.0, 520.0);
    let bound = RobustOptions {
        rate: SVector::repeat(rate),
        rated_torque: SVector::repeat(rated),
        ..free.clone()
    };
    let (free, plan) = (
        robust(&moments, &free).unwrap(),
        robust(&moments, &bound).unwrap(),
    );
    assert!(plan.objective > free.objective);
    let mut last: Option<(f64, SVector<f64, 7>)> = None;
    for (sample, moment) in plan.samples.iter().zip(&moments) {
        let pose = &moment.before.pose;
        let u = pose.project(&sample.before.torque) + pose.static_torque(&sample.before.wrench);
        assert!((moment.before.planned + u).amax() <= rated + 1e-4);
        if let Some((time, before)) = last {
            let most = rate * (sample.time - time);
            assert!((u - before).amax() <= most + 1e-4);
        }
        last = Some((sample.time, u));
        for (after, point) in sample.after.iter().zip(&moment.after) {
            let pose = &point.pose;
            let u = pose.project(&after.torque) + pose.static_torque(&after.wrench);
            let torque = point.locked.without(&(point.planned + u));
            assert!(torque.amax() <= rated + 1e-4, "{} s", sample.time);
        }
    }
}

#[test]
fn what_it_promises_is_what_the_torques_do() {
    let moments = moments(&[0, 1, 2, 3, 4, 5], 9);
    for rated in [NO_LIMIT, 600.0] {
        let options = RobustOptions {
            force_budget: 3.0,
            rated_torque: SVector::repeat(rated),
            ..RobustOptions::default()
        };
        let plan = robust(&moments, &options).unwrap();
        for (sample, moment) in plan.samples.iter().zip(&moments) {
            let torque = |point: &ulna_study::search::OperatingPoint<7>, free: &_| {
                let ulna::control::compensation::FreeTorque { torque, wrench } = free;
                point.pose.project(torque) + point.pose.static_torque(wrench)
            };
            let u = torque(&moment.before, &sample.before);
            for ((after, free), impact) in
                moment.after.iter().zip(&sample.after).zip(&sample.impact)
            {
                let change = torque(after, free) - u;
                let found = after.locked.without(&(step(moment, after) + change)).norm();
                assert!((found - impact).abs() < 1e-8);
                // The closed recourse leaves no more, where no rated torque is in its way.
                let wanted = after.locked.without(&u) - step(moment, after);
                let closed = torque(after, &nearest_torque(after, &wanted, 3.0));
                let closed = after.locked.without(&(closed - wanted)).norm();
                assert!(closed <= found * (1.0 + 1e-6) + 1e-6, "{closed} {found}");
            }
        }
    }
}

#[test]
fn nothing_near_it_is_nearer() {
    let moment = moment_at(&[1, 3], 7.0);
    let mut random = ulna::proof::random::SplitMix64::stream(5, 0);
    for after in &moment.after {
        for budget in [0.0, 1.0, 7.0, 1e4] {
            let wanted: SVector<f64, 7> = SVector::from_fn(|_, _| 80.0 * random.symmetric());
            let wanted = after.locked.without(&wanted);
            let free = nearest_torque(after, &wanted, budget);
            assert!(free.wrench.norm() <= budget * (1.0 + 1e-9));
            let left = |torque: &SVector<f64, 7>, wrench: &Vector6<f64>| {
                let u = after.pose.project(torque) + after.pose.static_torque(wrench);
                after.locked.without(&(u - wanted)).norm()
            };
            let least = left(&free.torque, &free.wrench);
            for _ in 0..200 {
                let torque = free.torque + SVector::from_fn(|_, _| random.symmetric());
                let mut wrench = free.wrench;
                for row in after.pose.task().iter() {
                    wrench[row.index()] += 0.3 * budget * random.symmetric();
                }
                if wrench.norm() > budget {
                    wrench *= budget / wrench.norm();
                }
                assert!(left(&torque, &wrench) >= least - 1e-9);
            }
        }
    }
}

#[test]
fn constant_coefficients_are_inherently_weak() {
    for (joints, law, none, expected) in [
        (&[1][..], CoefficientLaw::PerJoint, 122.55, 116.26),
        (&[1], CoefficientLaw::Projected, 122.55, 110.39),
        (
            &[0, 1, 2, 3, 4, 5, 6],
            CoefficientLaw::PerJoint,
            449.2,
            425.96,
        ),
        (
            &[0, 1, 2, 3, 4, 5, 6],
            CoefficientLaw::Projected,
            449.2,
            405.15,
        ),
    ] {
        let moments = moments(joints, 79);
        let before = moments.iter().flat_map(|moment| {
            let steps = moment.after.iter().map(|after| step(moment, after).norm());
            steps.collect::<Vec<_>>()
        });
        let before = before.fold(0.0, f64::max);
        assert!((before - none).abs() < 0.05, "{before}");
        let best = best_constant(&moments, law).unwrap();
        assert!((best.worst - expected).abs() < 0.01, "{}", best.worst);
        assert!(best.gap < 1e-3);
    }
}

#[test]
fn a_task_that_takes_all_joints_leaves_it_nothing_but_the_budget() {
    let (start, goal) = (SVector::from([0.2, 1.0]), SVector::from([1.1, 0.4]));
    let motion = PointToPoint::new(start, goal, 4.0, 1.0, &JointLimits::none()).unwrap();
    let wrench = |_| Vector6::new(5.0, -5.0, 0.0, 0.0, 0.0, 0.0);
    let operation = |joint: usize| {
        let joints = LockedJoints::new(&[joint]).unwrap();
        let failure = Failure { joints, time: 1.7 };
        let options = OperationOptions::default();
        Operation::new(&Planar2r, &motion, wrench, &failure, &options).unwrap()
    };
    let (first, second) = (operation(0), operation(1));
    let moment = Moment {
        before: *first.before(),
        after: vec![*first.after(), *second.after()],
    };
    let exact = robust(std::slice::from_ref(&moment), &RobustOptions::default()).unwrap();
    assert!(exact.samples[0].before.torque.amax() == 0.0);
    let bent = RobustOptions {
        force_budget: 1.0,
        ..RobustOptions::default()
    };
    let bent = robust(&[moment], &bent).unwrap();
    assert!(bent.objective < exact.objective);
}

#[test]
fn arguments_that_make_no_program_are_named() {
    let moments = moments(&[1], 1);
    let default = RobustOptions::<7>::default;
    for (options, name) in [
        (
            RobustOptions {
                force_budget: -1.0,
                ..default()
            },
            "force budget",
        ),
        (
            RobustOptions {
                rate: SVector::zeros(),
                ..default()
            },
            "rate of the compensation",
        ),
        (
            RobustOptions {
                effort: f64::NAN,
                ..default()
            },
            "effort",
        ),
        (
            RobustOptions {
                objective: RobustObjective::Expected(vec![0.5, 0.5]),
                ..default()
            },
            "number of probabilities",
        ),
    ] {
        match robust(&moments, &options) {
            Err(SearchError::Argument { name: found, .. }) => assert_eq!(found, name),
            other => panic!("{name}: {other:?}"),
        }
    }
    let tight = RobustOptions {
        rated_torque: SVector::repeat(1.0),
        ..default()
    };
    assert!(matches!(
        robust(&moments, &tight),
        Err(SearchError::Empty { .. })
    ));
}
