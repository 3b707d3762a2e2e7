//! No compensation that keeps the tool force lowers every joint, or one does: never neither, never both.

use ulna::control::compensation::FreeTorque;
use ulna::nalgebra::{SVector, Vector6};
use ulna::proof::random::SplitMix64;
use ulna::{Compensation, Failure, JointLimits, LockedJoints, PointToPoint, SerialChain, TaskRows};
use ulna_study::search::{
    Acts, Assessment, Certificate, Fairness, ForcePriority, LowerAll, Objective, Operation,
    OperationOptions, Optimum, Scope, least_impact, lower_every_joint, optimal,
};

use crate::arms::{TIMES, chain, failure, operation, unlimited};

const SCOPES: [Scope; 2] = [Scope::Healthy, Scope::All];

fn counts<const N: usize>(operation: &Operation<N>, scope: Scope, joint: usize) -> bool {
    scope == Scope::All || !operation.failure().joints.contains(joint)
}

/// The joints of the scope that have a step.
fn stepping<const N: usize>(operation: &Operation<N>, scope: Scope) -> Vec<usize> {
    let planned = operation.before().planned.sup(&operation.after().planned);
    let step = operation.step();
    let large = |joint: &usize| step[*joint].abs() > 1e-12 * planned.amax();
    (0..N)
        .filter(|joint| counts(operation, scope, *joint))
        .filter(large)
        .collect()
}

/// Signs, and `y = Jᵀ f`, by plain arithmetic.
fn verify<const N: usize>(operation: &Operation<N>, scope: Scope, found: &Certificate<N>) {
    let pose = &operation.before().pose;
    let expected = pose.jacobian.tr_mul(&found.wrench);
    let size = found.weights.amax();
    if pose.conditioning > 1e-2 {
        let error = (expected - found.weights).amax();
        assert!(error < 1e-9 * size, "{error:e} of {size}: {found:?}");
    }
    assert!((found.wrench.amax() - 1.0).abs() < 1e-12);
    let step = operation.step();
    let stepping = stepping(operation, scope);
    assert!(!found.joints.is_empty() && found.margin > 0.0);
    for joint in 0..N {
        let weight = found.weights[joint];
        if found.joints.contains(&joint) {
            assert!(stepping.contains(&joint));
            assert!(weight * step[joint].signum() >= found.margin, "{found:?}");
        } else if stepping.contains(&joint) || !counts(operation, scope, joint) {
            assert!(weight.abs() < 1e-9 * size, "{found:?}");
        }
    }
}

/// What the certificate says of any compensation that keeps the tool force.
fn agrees<const N: usize>(
    operation: &Operation<N>,
    found: &Certificate<N>,
    assessment: &Assessment<N>,
) {
    let (step, impact) = (operation.step(), assessment.impact);
    let sum = |impact: &SVector<f64, N>| found.weights.abs().dot(&impact.abs());
    let (before, after) = (sum(&step), sum(&impact));
    assert!(after >= before * (1.0 - 1e-8), "{after} after {before}");
    let lowered = |joint: &usize| impact[*joint].abs() < step[*joint].abs() * (1.0 - 1e-6);
    // Where joints without a step weigh, all others may be lowered at the price of a step for those.
    let price = (0..N).any(|joint| {
        let still = found.weights[joint] != 0.0 && step[joint].abs() < 1e-9 * step.amax();
        still && impact[joint].abs() > 1e-6 * step.amax()
    });
    assert!(price || !found.joints.iter().all(lowered));
}

fn lowers_all<const N: usize>(
    operation: &Operation<N>,
    scope: Scope,
    assessment: &Assessment<N>,
) -> bool {
    let step = operation.step();
    let mut joints = stepping(operation, scope).into_iter();
    joints.all(|joint| assessment.impact[joint].abs() < step[joint].abs())
}

/// Everything that keeps the tool force, by whatever objective.
fn force_exact<const N: usize>(operation: &Operation<N>) -> Vec<Assessment<N>> {
    let fairness = [
        Fairness::LeastNorm,
        Fairness::NoJointWorse(Scope::Healthy),
        Fairness::NoJointWorse(Scope::All),
        Fairness::WorstRatio(Scope::Healthy),
        Fairness::WorstRatio(Scope::All),
    ];
    let optima = fairness.map(|fairness| Optimum {
        fairness,
        ..Optimum::default()
    });
    let sides = [Acts::Before, Acts::After].map(|acts| Optimum {
        acts,
        ..Optimum::default()
    });
    let found = optima.into_iter().chain(sides);
    let mut found: Vec<_> = found
        .map(|optimum| match optimum.solve(operation) {
            Ok(found) => found.assessment,
            Err(error) => panic!(
                "{optimum:?}: {error} {:?} {}",
                operation.step().as_slice(),
                operation.effort()
            ),
        })
        .collect();
    for objective in [Objective::LeastSquares, Objective::MinMax] {
        found.push(least_impact(operation, objective).unwrap().assessment);
    }
    found
}

#[test]
fn at_the_papers_times_a_wrench_proves_it() {
    for (time, margin) in TIMES.into_iter().zip([0.3237, 0.5564, 0.3534]) {
        let operation = unlimited(time);
        let LowerAll::Certificate(found) = lower_every_joint(&operation, Scope::All).unwrap()
        else {
            panic!("not at {time} s");
        };
        verify(&operation, Scope::All, &found);
        // Joint 7, whose column of J is 0, is not covered.
        assert_eq!(found.joints, [0, 1, 2, 3, 4, 5]);
        assert!((found.margin - margin).abs() < 5e-5, "{}", found.margin);
        for assessment in force_exact(&operation) {
            agrees(&operation, &found, &assessment);
        }
        // Any other torques that keep the force.
        let mut random = SplitMix64::new(7);
        for _ in 0..50 {
            let mut free = || FreeTorque {
                torque: SVector::from_fn(|_, _| 50.0 * random.symmetric()),
                wrench: Vector6::zeros(),
            };
            let (before, after) = (free(), free());
            let assessment = operation.assess(&Compensation::Optimal { before, after });
            assert!(assessment.force_error() < 1e-9);
            agrees(&operation, &found, &assessment);
        }
        // With the force bent it no longer holds.
        let bent = optimal(&operation, ForcePriority::AtMost(f64::INFINITY)).unwrap();
        let step = operation.failure().joints.without(&operation.step());
        assert!(bent.assessment.healthy_impact < 1e-6 * step.norm());
    }
}

/// The locked joint pays.
#[test]
fn the_healthy_joints_alone_can_all_be_lowered_a_little() {
    for (time, ratio) in TIMES.into_iter().zip([0.9784, 0.9513, 0.9978]) {
        let operation = unlimited(time);
        let LowerAll::Witness(found) = lower_every_joint(&operation, Scope::Healthy).unwrap()
        else {
            panic!("not at {time} s");
        };
        assert!(lowers_all(&operation, Scope::Healthy, &found.assessment));
        let worst = operation.worst_ratio(&found.assessment, Scope::Healthy);
        assert!((worst - ratio).abs() < 5e-5, "{worst}");
        assert!(operation.worst_ratio(&found.assessment, Scope::All) > 1.0);
        assert!(found.assessment.max_force_error < 1e-9);
    }
}

#[test]
fn a_certificate_does_not_depend_on_rated_torques_and_a_witness_keeps_them() {
    for time in TIMES {
        let failure = failure(&[1], time);
        let limited = crate::arms::limited(&failure, 0.5);
        let free = unlimited(time);
        for scope in SCOPES {
            let (limited_found, found) = (
                lower_every_joint(&limited, scope).unwrap(),
                lower_every_joint(&free, scope).unwrap(),
            );
            match (limited_found, found) {
                (LowerAll::Certificate(a), LowerAll::Certificate(b)) => assert_eq!(a, b),
                (LowerAll::Witness(found), LowerAll::Witness(_)) => {
                    assert!(lowers_all(&limited, scope, &found.assessment));
                    let rated = limited.rated_torque();
                    for joint in limited.healthy() {
                        let peak = found.assessment.peak_torque[joint];
                        assert!(peak <= rated[joint] * (1.0 + 1e-9));
                    }
                }
                pair => panic!("{pair:?}"),
            }
        }
    }
    // No room at all: neither is beyond the limits, and that is said.
    let failure = failure(&[1], 10.0);
    let overloaded = operation(&failure, SVector::repeat(10.0));
    assert!(lower_every_joint(&overloaded, Scope::Healthy).is_err());
    assert!(lower_every_joint(&overloaded, Scope::All).is_ok());
}

/// Joints in another order, other lengths, other tasks, one or two locks.
#[test]
fn of_random_arms_exactly_one_is_true() {
    fn check<const N: usize>(original: &SerialChain<N>, count: u64, found: &mut [usize; 4]) {
        for case in 0..count {
            let mut random = SplitMix64::stream(11, case);
            let mut picks = SplitMix64::stream(12, case);
            let mut below = |count: usize| {
                let unit = 0.5 * (picks.symmetric() + 1.0);
                ((unit * count as f64) as usize).min(count - 1)
            };
            let mut chain = *original;
            for i in (1..N).rev() {
                chain.joints.swap(i, below(i + 1));
            }
            let tasks = [TaskRows::POSITION, TaskRows::POSE, original.task];
            chain.task = tasks[below(3)];
            let locks = [below(N), below(N)];
            let locks = &locks[..=below(2)];
            for joint in &mut chain.joints {
                joint.a *= 1.0 + 0.5 * random.symmetric();
                joint.d *= 1.0 + 0.5 * random.symmetric();
            }
            let start = SVector::<f64, N>::from_fn(|_, _| 2.0 * random.symmetric());
            let goal = start.map(|q| q + random.symmetric());
            let motion = PointToPoint::new(start, goal, 4.0, 1.0, &JointLimits::none()).unwrap();
            let failure = Failure {
                joints: LockedJoints::new(locks).unwrap(),
                time: 2.0 + 1.9 * random.symmetric(),
            };
            let wrench = Vector6::from_fn(|_, _| 10.0 * random.symmetric());
            let options = OperationOptions {
                sample_period: 4.0,
                effort: [0.0, 1e-3][below(2)],
                ..OperationOptions::default()
            };
            let operation =
                Operation::new(&chain, &motion, |_| wrench, &failure, &options).unwrap();
            let results = force_exact(&operation);
            for (s, scope) in SCOPES.into_iter().enumerate() {
                match lower_every_joint(&operation, scope) {
                    Ok(LowerAll::Certificate(certificate)) => {
                        found[2 * s] += 1;
                        verify(&operation, scope, &certificate);
                        for assessment in &results {
                            agrees(&operation, &certificate, assessment);
                        }
                    }
                    Ok(LowerAll::Witness(witness)) => {
                        found[2 * s + 1] += 1;
                        assert!(lowers_all(&operation, scope, &witness.assessment));
                        assert!(witness.assessment.force_error() < 1e-6);
                        let best = operation.worst_ratio(&witness.assessment, scope);
                        for assessment in &results {
                            let other = operation.worst_ratio(assessment, scope);
                            assert!(best <= other + 1e-3, "{best}, not {other}");
                        }
                    }
                    Err(error) => panic!("case {case} of {N}, {scope:?}: {error}"),
                }
            }
        }
    }
    let mut found = [0; 4];
    check(&chain::<7>("ssrms"), 20, &mut found);
    check(&chain::<7>("table1_literal"), 8, &mut found);
    check(&chain::<6>("oblique_6"), 20, &mut found);
    check(&chain::<2>("planar_2r"), 3, &mut found);
    // Certificates and witnesses over the healthy joints, and over all.
    assert!(found.iter().all(|count| *count > 5), "{found:?}");
}
