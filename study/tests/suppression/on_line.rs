//! The on-line law: a lock that may be any joint's, suppressed from the state alone.

use ulna::control::compensation::TaskPose;
use ulna::control::failure::impact_torque_of;
use ulna::nalgebra::{DMatrix, DVector, SVector, Vector6};
use ulna::{
    Arm, JointState, LockedJoints, OnLine, Projector, SerialChain, TaskRow, Trajectory, Weighting,
};
use ulna_generated::Ssrms;
use ulna_study::search::{ForcePriority, optimal};

use crate::arms::{TIMES, chain, on_every_arm, paper_like_motion, ssrms, states, unlimited};

const NONE: LockedJoints<7> = LockedJoints::NONE;

fn only<const N: usize>(joint: usize) -> SVector<f64, N> {
    SVector::from_fn(|i, _| f64::from(u8::from(i == joint)))
}

/// Undamped, one joint at risk.
fn known<const N: usize>(joint: usize) -> OnLine<N> {
    OnLine {
        weights: only(joint),
        weighting: Weighting::Absolute,
        damping: 0.0,
        force_budget: 0.0,
    }
}

fn pose_of<const N: usize>(
    arm: &impl Arm<N>,
    state: &JointState<N>,
    locked: LockedJoints<N>,
) -> TaskPose<N> {
    TaskPose::new(arm, &state.q, locked, Projector::Static)
}

/// The healthy torques' step, after minus before, of a lock without any compensation.
fn step<const N: usize>(
    arm: &impl Arm<N>,
    state: &JointState<N>,
    lock: LockedJoints<N>,
) -> SVector<f64, N> {
    lock.without(&-impact_torque_of(arm, state, lock, &Vector6::zeros()))
}

/// What is left of the step in the healthy joints after `u` before the lock and the recourse after it.
fn residual(
    arm: &impl Arm<7>,
    state: &JointState<7>,
    u: &SVector<f64, 7>,
    joint: usize,
) -> SVector<f64, 7> {
    let lock = LockedJoints::new(&[joint]).unwrap();
    let wanted = lock.without(u) - step(arm, state, lock);
    OnLine::recourse(&pose_of(arm, state, lock), &wanted, 0.0) - wanted
}

#[test]
fn a_joint_known_to_lock_leaves_the_least_that_keeping_the_force_can() {
    let motion = paper_like_motion();
    for (time, expected) in TIMES.into_iter().zip([17.70, 6.59, 14.98]) {
        let state = motion.state(time);
        let pose = pose_of(&Ssrms, &state, NONE);
        let u = known(1).compensation(&Ssrms, &state, &pose, NONE);
        let found = residual(&Ssrms, &state, &u, 1).norm();
        assert!((found - expected).abs() < 0.01, "{time} s: {found}");
        // The second road: the study's program, which knows nothing of P.
        let best = optimal(&unlimited(time), ForcePriority::Exact).unwrap();
        let best = best.assessment.healthy_impact.powi(2);
        let error = (found * found - best).abs() / best;
        assert!(error < 1e-9, "{time} s: {error:e}");
        // And no force is bent.
        assert!(pose.null_space.static_wrench(&u).norm() < 1e-9);
    }
}

/// The task's rows of J with singular values, the locked joints' columns 0.
fn task_rows<const N: usize>(
    chain: &SerialChain<N>,
    q: &SVector<f64, N>,
    locked: LockedJoints<N>,
) -> DMatrix<f64> {
    let rows: Vec<usize> = chain.task.iter().map(TaskRow::index).collect();
    let jacobian = locked.reduce_jacobian(&chain.geometric_jacobian(q));
    DMatrix::from_fn(rows.len(), N, |i, j| jacobian[(rows[i], j)])
}

/// `I − J†J` over the moving joints.
fn projector<const N: usize>(jacobian: &DMatrix<f64>, locked: LockedJoints<N>) -> DMatrix<f64> {
    let inverse = jacobian.clone().pseudo_inverse(1e-9).unwrap();
    let mut identity = DMatrix::identity(N, N);
    for joint in locked.iter() {
        identity[(joint, joint)] = 0.0;
    }
    identity - inverse * jacobian
}

fn volume(jacobian: &DMatrix<f64>) -> f64 {
    jacobian.singular_values().product()
}

/// The least squares over U = P z and each lock's own recourse `P_k y_k`, as one dense problem for a singular value decomposition.
fn dense<const N: usize>(
    chain: &SerialChain<N>,
    state: &JointState<N>,
    locked: LockedJoints<N>,
    weights: &SVector<f64, N>,
    fades: &SVector<f64, N>,
    damping: f64,
) -> DVector<f64> {
    let whole = task_rows(chain, &state.q, locked);
    let p = projector(&whole, locked);
    let held = locked.hold(state);
    let mut matrix = DMatrix::zeros(N * (N + 1), N * (N + 1));
    let mut right = DVector::zeros(N * (N + 1));
    for k in locked.healthy() {
        let joints: Vec<usize> = locked.iter().chain([k]).collect();
        let lock = LockedJoints::new(&joints).unwrap();
        let after = task_rows(chain, &state.q, lock);
        let scale = (weights[k] * fades[k]).sqrt();
        let mut healthy = DMatrix::identity(N, N) * scale;
        for joint in lock.iter() {
            healthy[(joint, joint)] = 0.0;
        }
        let rows = k * N;
        matrix
            .view_mut((rows, 0), (N, N))
            .copy_from(&(-&healthy * &p));
        matrix
            .view_mut((rows, N * (k + 1)), (N, N))
            .copy_from(&(&healthy * projector(&after, lock)));
        let step = step(chain, &held, LockedJoints::new(&[k]).unwrap());
        let step = DVector::from_column_slice(lock.without(&step).as_slice()) * fades[k];
        right.rows_mut(rows, N).copy_from(&(-&healthy * step));
    }
    matrix
        .view_mut((N * N, 0), (N, N))
        .copy_from(&(&p * damping));
    let x = matrix.svd(true, true).solve(&right, 1e-12).unwrap();
    p * x.rows(0, N)
}

#[test]
fn for_several_joints_at_risk_it_is_the_dense_least_squares() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        let mut checked = 0;
        for state in states(chain, 5) {
            for locked in [LockedJoints::NONE, LockedJoints::new(&[0]).unwrap()] {
                let whole = task_rows(chain, &state.q, locked);
                let values = whole.singular_values();
                if N - locked.len() <= whole.nrows() || values.min() < 0.05 * values.max() {
                    continue;
                }
                let weights = SVector::from_fn(|i, _| [1.0, 0.2, 3.0][i % 3]);
                // A lock that leaves no recourse fades: by the volume that is left of J's rows.
                let fades = SVector::from_fn(|k, _| {
                    let joints: Vec<usize> = locked.iter().chain([k]).collect();
                    let lock = LockedJoints::new(&joints).unwrap();
                    let left = volume(&task_rows(chain, &state.q, lock)) / volume(&whole);
                    ((left - 1e-6) / (1e-2 - 1e-6)).clamp(0.0, 1.0)
                });
                for damping in [0.03, 0.5] {
                    let law = OnLine {
                        weights,
                        weighting: Weighting::Absolute,
                        damping,
                        force_budget: 0.0,
                    };
                    let pose = pose_of(chain, &state, locked);
                    let found = law.compensation(chain, &state, &pose, locked);
                    let expected = dense(chain, &state, locked, &weights, &fades, damping);
                    let size = expected.amax().max(1.0);
                    let found = DVector::from_column_slice(found.as_slice());
                    let error = (found - expected).amax() / size;
                    assert!(error < 1e-9, "{name}: {error:e}");
                    checked += 1;
                }
            }
        }
        assert!(checked > 0 || N == 2, "{name}");
    }
    on_every_arm!(check);
}

#[test]
fn only_the_entry_of_the_joint_that_locks_counts() {
    let state = paper_like_motion().state(10.0);
    let whole = task_rows(&ssrms(), &state.q, NONE);
    let p = projector(&whole, NONE);
    let z = SVector::<f64, 7>::from_fn(|i, _| 10.0 - 3.0 * i as f64);
    let u = pose_of(&Ssrms, &state, NONE).project(&z);
    for k in 0..7 {
        let lock = LockedJoints::new(&[k]).unwrap();
        let after = task_rows(&ssrms(), &state.q, lock);
        let inverse = after.clone().pseudo_inverse(1e-9).unwrap();
        let s = step(&Ssrms, &state, lock);
        let r = &inverse * (&after * DVector::from_column_slice(s.as_slice()));
        let g = inverse * whole.column(k);
        let expected = &r + &g * u[k];
        let found = residual(&Ssrms, &state, &u, k);
        let found = DVector::from_column_slice(found.as_slice());
        assert!((found - expected).amax() < 1e-9, "joint {k}");
        // The formulas of P alone.
        assert!((g.norm_squared() - (1.0 - p[(k, k)]) / p[(k, k)]).abs() < 1e-9);
        let best = -g.dot(&r);
        let along: f64 = (0..7).filter(|i| *i != k).map(|i| p[(k, i)] * s[i]).sum();
        assert!((best - along / p[(k, k)]).abs() < 1e-9 * best.abs().max(1.0));
    }
}

#[test]
fn relative_weights_are_shares_of_each_joints_own_step() {
    let state = paper_like_motion().state(10.0);
    let pose = pose_of(&Ssrms, &state, NONE);
    let of = |law: OnLine<7>| law.compensation(&Ssrms, &state, &pose, NONE);
    let floor = 5.0;
    let relative = OnLine {
        weights: SVector::from([1.0, 2.0, 1.0, 0.5, 1.0, 1.0, 3.0]),
        weighting: Weighting::Relative { floor },
        damping: 0.4,
        force_budget: 0.0,
    };
    let sizes = SVector::from_fn(|k, _| {
        let lock = LockedJoints::new(&[k]).unwrap();
        step(&Ssrms, &state, lock).norm_squared() + floor * floor
    });
    let mean = relative.weights.dot(&sizes) / relative.weights.sum();
    let by_hand = OnLine {
        weights: relative.weights.component_div(&sizes) * mean,
        weighting: Weighting::Absolute,
        ..relative
    };
    assert!((of(relative) - of(by_hand)).amax() < 1e-9);
    assert!(of(relative).amax() > 1.0);
    // Twice as fast, four times the steps: without a floor four times the compensation.
    let law = OnLine {
        weighting: Weighting::Relative { floor: 0.0 },
        ..relative
    };
    let faster = JointState {
        qd: state.qd * 2.0,
        qdd: state.qdd * 4.0,
        ..state
    };
    let four = law.compensation(&Ssrms, &faster, &pose, NONE);
    assert!((four - of(law) * 4.0).amax() < 1e-9 * four.amax());
}

/// The table at `OnLine::equal`: what its defaults are worth, and that they make little worse.
#[test]
fn the_defaults_keep_their_table() {
    let motion = paper_like_motion();
    let law = OnLine::equal();
    let (mut worse, mut largest, mut peak, mut logarithms) = (0, 0.0_f64, 0.0_f64, 0.0);
    let (mut all, mut of_joint_2) = (0.0, 0.0);
    let mut cases = 0;
    for i in 0..191 {
        if i % 4 != 0 {
            continue; // A quarter of the times is enough to notice.
        }
        let state = motion.state(0.5 + 0.1 * f64::from(i));
        let u = law.compensation(&Ssrms, &state, &pose_of(&Ssrms, &state, NONE), NONE);
        peak = peak.max(u.amax());
        for k in 0..6 {
            let after = residual(&Ssrms, &state, &u, k).norm();
            let before = step(&Ssrms, &state, LockedJoints::new(&[k]).unwrap()).norm();
            all += after * after;
            of_joint_2 += if k == 1 { after * after } else { 0.0 };
            worse += i32::from(after > 1.01 * before);
            largest = largest.max(after / before);
            logarithms += (after / before).max(1e-3).ln();
            cases += 1;
        }
    }
    let share = f64::from(worse) / f64::from(cases);
    let mean = (logarithms / f64::from(cases)).exp();
    let times = f64::from(cases) / 6.0;
    let rms = (all / (7.0 * times)).sqrt();
    let joint_2 = (of_joint_2 / times).sqrt();
    assert!((rms - 125.6).abs() < 3.0, "{rms}");
    assert!((joint_2 - 48.6).abs() < 2.0, "{joint_2}");
    assert!(share < 0.22 && largest < 1.16, "{share}, {largest}");
    assert!(mean < 0.90 && peak < 56.0, "{mean}, {peak}");
}

#[test]
fn the_recourse_bends_the_force_by_its_budget_and_no_more() {
    let state = paper_like_motion().state(10.0);
    let lock = LockedJoints::new(&[1]).unwrap();
    let pose = pose_of(&Ssrms, &state, lock);
    let wanted = SVector::from_fn(|i, _| 20.0 - 7.0 * i as f64);
    let mut last = f64::INFINITY;
    for budget in [f64::NAN, -1.0, 0.0, 1.0, 3.0, f64::INFINITY] {
        let u = OnLine::recourse(&pose, &wanted, budget);
        assert_eq!(u[1], 0.0);
        let bent = pose.null_space.static_wrench(&u).norm();
        let allowed = budget.max(0.0);
        assert!(bent <= allowed + 1e-9, "{budget}: {bent}");
        let left = lock.without(&(wanted - u)).norm();
        assert!(left <= last + 1e-12, "{budget}: {left}");
        last = left;
    }
    assert!(last < 1e-9, "{last}");
}

#[test]
fn whatever_the_pose_and_the_numbers_it_is_finite_and_bounded() {
    fn check<const N: usize>(chain: &SerialChain<N>, name: &str) {
        let most: Vec<usize> = (0..N - 1).collect();
        let all: Vec<usize> = (0..N).collect();
        let sets = [&[][..], &[0], &most, &all].map(|set| LockedJoints::<N>::new(set).unwrap());
        let absurd = [0.0, 1e9, 1e300].map(|size| JointState {
            q: SVector::from_fn(|i, _| size * (1.0 + i as f64)),
            qd: SVector::repeat(0.3),
            qdd: SVector::repeat(-0.2),
        });
        for state in states(chain, 1).chain(absurd) {
            for locked in sets {
                let pose = pose_of(chain, &state, locked);
                for weighting in [0.0, 1.0, f64::NAN, f64::INFINITY, -1.0]
                    .map(|floor| Weighting::Relative { floor })
                    .into_iter()
                    .chain([Weighting::Absolute])
                {
                    for damping in [0.0, 0.1, 1e200, f64::NAN] {
                        for weight in [0.0, 1e-300, 1e300, -1.0, f64::NAN, f64::INFINITY] {
                            let law = OnLine {
                                weights: SVector::repeat(weight),
                                weighting,
                                damping,
                                force_budget: 0.0,
                            };
                            let u = law.compensation(chain, &state, &pose, locked);
                            assert!(u.iter().all(|x| x.is_finite()), "{name}: {law:?}");
                            let no_risk = !(weight > 0.0 && weight.is_finite());
                            if no_risk || locked.len() >= N - 1 || N == 2 {
                                assert_eq!(u, SVector::<f64, N>::zeros(), "{name}: {law:?}");
                            }
                            for joint in locked.iter() {
                                assert_eq!(u[joint], 0.0);
                            }
                        }
                    }
                }
                let law = OnLine {
                    weighting: Weighting::Absolute,
                    damping: 0.01,
                    ..OnLine::equal()
                };
                let held = locked.hold(&state);
                let squares: f64 = locked
                    .healthy()
                    .map(|k| {
                        let step = step(chain, &held, LockedJoints::new(&[k]).unwrap());
                        locked.without(&step).norm_squared()
                    })
                    .sum();
                let u = law.compensation(chain, &state, &pose, locked).norm();
                assert!(u <= squares.sqrt() / 0.02 * (1.0 + 1e-9), "{name}: {u}");
            }
        }
    }
    on_every_arm!(check);
}

/// Three parallel joints and a wrist: one direction of null space, in which a joint has no part where the two others are in line with the tool.
#[test]
fn where_a_lock_leaves_no_recourse_its_joint_is_let_go_without_a_jump() {
    let locked = LockedJoints::new(&[0, 1, 6]).unwrap();
    let at = |elbow: f64| {
        let mut state = paper_like_motion().state(10.0);
        state.q[4] = elbow;
        let pose = pose_of(&Ssrms, &state, locked);
        let share = |k| pose.null_space.project(&only(k)).norm();
        let of = |k| known(k).compensation(&Ssrms, &state, &pose, locked);
        // The wrist alone moves the tool out of the plane.
        assert!(share(5) < 1e-12 && of(5).amax() == 0.0);
        (pose.conditioning, share(2), of(2))
    };
    // Where joint 3 has the least part, to the last digits.
    let nearest = (0..600)
        .map(|i| -3.0 + 1e-2 * f64::from(i))
        .filter(|elbow| at(*elbow).0 > 0.05)
        .min_by(|a, b| at(*a).1.total_cmp(&at(*b).1))
        .unwrap();
    let (mut from, mut to) = (nearest - 1e-2, nearest + 1e-2);
    while to - from > 1e-14 {
        let (a, b) = (from + (to - from) / 3.0, to - (to - from) / 3.0);
        (from, to) = if at(a).1 < at(b).1 {
            (from, b)
        } else {
            (a, to)
        };
    }
    let (conditioning, share, u) = at(from);
    assert!(
        conditioning > 0.01 && share < 1e-6,
        "{conditioning} {share}"
    );
    assert_eq!(u, SVector::<f64, 7>::zeros());
    let far = at(from + 0.1);
    assert!(far.1 > 0.01 && far.2.amax() > 0.1, "{}, {}", far.1, far.2);
    let mut last = u;
    for i in 1..=100 {
        let u = at(from + 1e-3 * f64::from(i)).2;
        assert!((u - last).amax() < 0.2 * far.2.amax(), "{i}: {u}");
        last = u;
    }
}

/// The SSRMS without the offsets of its joints, stretched out: singular.
#[test]
fn at_a_singular_pose_it_is_exactly_zero_and_it_gets_there_without_a_jump() {
    let mut arm = chain::<7>("ssrms");
    for joint in &mut arm.joints {
        joint.d = 0.0;
    }
    let of = |bend: f64| {
        let state = JointState {
            q: SVector::from([0.3, -0.8, 0.4, bend, 0.7, 0.9, -0.2]),
            qd: SVector::repeat(0.1),
            qdd: SVector::repeat(0.02),
        };
        OnLine::equal().compensation(&arm, &state, &pose_of(&arm, &state, NONE), NONE)
    };
    assert_eq!(of(0.0), SVector::<f64, 7>::zeros());
    let away = of(0.3).amax();
    assert!(away > 0.1, "{away}");
    let mut last = of(-2e-3);
    for i in 1..=24 {
        let u = of(-2e-3 + 4e-3 * f64::from(i) / 24.0);
        assert!((u - last).amax() < 0.2 * away, "{}", (u - last).amax());
        last = u;
    }
}
