//! Section 5 on the paper-like scenario: the numbers that an independent prototype found, and what has to hold for any case.

use std::path::Path;
use std::sync::OnceLock;

use ulna::{SerialChain, Status};
use ulna_generated::{Planar2r, Ssrms};
use ulna_study::Scenario;
use ulna_study::experiment::{
    Case, ExperimentError, ExperimentRunner, Lowerable, SearchMethod, Study, Variant,
};
use ulna_study::scenario::KnownArm;
use ulna_study::search::{EFFORT, SearchError};

const PAPER_LIKE: &str = include_str!("../../scenarios/paper_like.toml");
const KNOWN: &[KnownArm] = &[KnownArm {
    name: "ssrms",
    joints: &Ssrms::CHAIN.joints,
    joint_names: &Ssrms::JOINT_NAMES,
}];
const TIMES: [f64; 3] = [3.0, 10.0, 18.0];

fn scenario(edits: &[(&str, &str)]) -> Scenario {
    let text = edits
        .iter()
        .fold(PAPER_LIKE.to_owned(), |text, (from, to)| {
            assert!(text.contains(from), "the scenario has no {from:?}");
            text.replacen(from, to, 1)
        });
    Scenario::parse(&text, "test.toml", Path::new("scenarios"), KNOWN).unwrap()
}

/// The scenario with longer control cycles: extremes are looked for at fewer times, the rest is the same.
fn studies() -> &'static [Study] {
    static STUDIES: OnceLock<Vec<Study>> = OnceLock::new();
    STUDIES.get_or_init(|| {
        let scenario = scenario(&[("cycle = 0.01", "cycle = 0.05")]);
        ExperimentRunner::new(&Ssrms, &scenario)
            .unwrap()
            .run()
            .unwrap()
    })
}

fn case(section: &str, time: f64, method: SearchMethod) -> &'static Case {
    let mut studies = studies().iter();
    let study = studies.find(|study| study.section == section && study.failure_time == time);
    study.unwrap().case(method)
}

fn assert_close(value: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (value / expected - 1.0).abs() <= tolerance,
        "{what}: {value}, not {expected}"
    );
}

#[test]
fn every_experiment_time_and_method_is_there_in_order() {
    let found: Vec<_> = studies()
        .iter()
        .map(|study| (study.section.as_str(), study.failure_time))
        .collect();
    let expected: Vec<_> = ["5.2", "5.3", "5.4"]
        .into_iter()
        .flat_map(|section| TIMES.map(|time| (section, time)))
        .collect();
    assert_eq!(found, expected);
    for study in studies() {
        let methods: Vec<_> = study.cases.iter().map(|case| case.method).collect();
        assert_eq!(methods, SearchMethod::ALL);
    }
}

#[test]
fn impact_before_is_that_of_the_prototype() {
    let expected = [
        [31.34, 33.02, 11.22, 0.425, 0.174, 1.049],
        [35.97, 61.95, 23.23, 1.237, 0.662, 1.574],
        [7.66, 54.81, 14.28, 0.339, 0.070, 0.574],
    ];
    for (time, expected) in TIMES.into_iter().zip(expected) {
        let before = &case("5.2", time, SearchMethod::PerJoint).impact_before;
        for (joint, expected) in expected.into_iter().enumerate() {
            assert_close(
                before[joint],
                expected,
                5e-3,
                &format!("joint {} at {time} s", joint + 1),
            );
        }
        // The tool point is on joint 7's axis.
        assert!(before[6] < 5e-4);
    }
}

#[test]
fn eq_16_cancels_every_joint_at_the_prototypes_coefficients() {
    for time in TIMES {
        let case = case("5.2", time, SearchMethod::PerJoint);
        for joint in 0..6 {
            let left = case.impact_after[joint] / case.impact_before[joint];
            assert!(left <= 0.01, "joint {} at {time} s: {left}", joint + 1);
        }
        assert!(
            case.suppression_percent()[..6]
                .iter()
                .all(|percent| *percent >= 99.0)
        );
        // The price: the tool force.
        assert!(case.force_error > 5.0 && case.rollout.max_force_error > 100.0);
    }
    let coefficients = &case("5.2", 10.0, SearchMethod::PerJoint).coefficients;
    for (joint, expected) in [5.11e7, -8.07e7, 3.90e7, -3.75e7, 1.08e7, 0.78e7]
        .into_iter()
        .enumerate()
    {
        assert_close(
            coefficients[joint],
            expected,
            1e-2,
            &format!("k_d{}", joint + 1),
        );
    }
    assert_eq!(coefficients[6], 0.0);
}

/// A grid leaves at most half a step; at 10 s that is below 5 % of every joint's impact.
#[test]
fn the_papers_search_comes_within_half_a_step_of_the_exact_one() {
    for time in TIMES {
        let (steps, exact) = (
            case("5.2", time, SearchMethod::StepwisePerJoint),
            case("5.2", time, SearchMethod::PerJoint),
        );
        for joint in 0..6 {
            let (found, best) = (steps.coefficients[joint], exact.coefficients[joint]);
            assert!(
                (found - best).abs() <= 0.5e6 * (1.0 + 1e-9),
                "joint {} at {time} s",
                joint + 1
            );
            let left = steps.impact_after[joint] / steps.impact_before[joint];
            let possible = 0.5e6 / best.abs() * (1.0 + 1e-6);
            assert!(left <= possible.max(1e-9) && left <= 1.0);
            if time == 10.0 {
                assert!(left <= 0.05, "joint {}: {left}", joint + 1);
            }
        }
    }
}

#[test]
fn eq_20_keeps_the_force_and_leaves_what_the_prototype_left() {
    for (time, expected) in TIMES.into_iter().zip([18.97, 9.97, 16.19]) {
        for method in [SearchMethod::Projected, SearchMethod::StepwiseProjected] {
            let case = case("5.2", time, method);
            assert!(case.rollout.max_force_error <= 1e-6);
            let (_, after) = case.healthy_impact();
            assert_close(after, expected, 1e-2, &format!("{method:?} at {time} s"));
        }
    }
}

/// ‖(U, U')‖ of the compensations just before and just after the lock, N m; a brake has none.
fn compensation_at_lock(case: &Case) -> f64 {
    let series = &case.rollout.series;
    let mut times = series.time.iter();
    let lock = times.position(|time| *time == case.failure_time).unwrap();
    let asked = |row: usize, joint: usize| series.torque[row][joint] - series.planned[row][joint];
    let norm = |norm: f64, joint| {
        let after = if case.failed_joints.contains(&joint) {
            0.0
        } else {
            asked(lock + 1, joint)
        };
        norm.hypot(asked(lock, joint)).hypot(after)
    };
    (0..series.torque[lock].len()).fold(0.0, norm)
}

#[test]
fn optimal_is_the_physical_limit_and_never_worse_than_a_law() {
    for (time, expected) in TIMES.into_iter().zip([17.70, 6.59, 14.98]) {
        let case = case("5.2", time, SearchMethod::Optimal);
        assert!(case.rollout.max_force_error <= 1e-6);
        assert_close(
            case.healthy_impact().1,
            expected,
            1e-2,
            &format!("at {time} s"),
        );
    }
    for study in studies() {
        let frontier = &study.tradeoff.as_ref().unwrap().frontier;
        let (exact, optimal) = (
            study.case(SearchMethod::Projected),
            study.case(SearchMethod::Optimal),
        );
        assert!(optimal.healthy_impact().1 <= exact.healthy_impact().1 * (1.0 + 1e-9));
        // It falls, and ends where there is nothing left, long before the force error of Eq. 16.
        assert!(
            frontier
                .windows(2)
                .all(|pair| pair[1].1 <= pair[0].1 + 1e-6 && pair[1].0 >= pair[0].0 - 1e-6)
        );
        let (force, impact) = *frontier.last().unwrap();
        let per_joint = study.case(SearchMethod::PerJoint);
        // All but what is not worth its effort, which is more where the null space drifts in Δt.
        let (before, cancelled) = per_joint.healthy_impact();
        let nothing = if per_joint.step_time > 0.0 {
            5e-3
        } else {
            1e-4
        };
        assert!(force < per_joint.force_error && impact < nothing * before);
        // Eq. 16 is among what is allowed, so that impact and weighed effort together are not above its own.
        let of_eq_16 = cancelled.hypot(EFFORT * compensation_at_lock(per_joint));
        assert!(impact <= of_eq_16 + 1e-6 * before);
    }
}

#[test]
fn rated_torques_bind_and_are_kept() {
    for section in ["5.3", "5.4"] {
        let mut bound = 0;
        for time in TIMES {
            for method in SearchMethod::ALL {
                let case = case(section, time, method);
                assert!(
                    case.search.is_ok(),
                    "{section} at {time} s, {method:?}: {:?}",
                    case.search
                );
                let rated = case.rated_torque.as_ref().unwrap();
                let executed = case.rollout.max_torque.iter().zip(rated);
                for (torque, rated) in executed.clone() {
                    assert!(
                        *torque <= rated * (1.0 + 1e-12),
                        "{section} at {time} s, {method:?}"
                    );
                }
                bound += executed
                    .filter(|(torque, rated)| **torque >= *rated * (1.0 - 1e-6))
                    .count();
                // Motion and tool force alone leave room.
                assert!(case.rollout.status < Status::Overloaded);
            }
        }
        assert!(bound >= 3, "{section}: {bound}");
    }
    // What binds costs suppression.
    let (free, bound) = (
        case("5.2", 10.0, SearchMethod::PerJoint),
        case("5.3", 10.0, SearchMethod::PerJoint),
    );
    assert!(bound.healthy_impact().1 > 100.0 * free.healthy_impact().1);
}

#[test]
fn the_papers_rated_torque_is_out_of_reach() {
    let scenario = scenario(&[
        ("cycle = 0.01", "cycle = 0.5"),
        (
            "rated_torque = [700.0, 350.0, 400.0, 412.0, 32.0, 38.0, 50.0]",
            "rated_torque = 300.0",
        ),
    ]);
    let runner = ExperimentRunner::new(&Ssrms, &scenario).unwrap();
    let study = runner.study(&scenario.experiments()[1], 10.0).unwrap();
    let case = study.case(SearchMethod::PerJoint);
    assert!(
        matches!(case.search, Err(SearchError::Empty { joint: 3, .. })),
        "{:?}",
        case.search
    );
    assert_eq!(case.rollout.status, Status::Overloaded);
    assert_eq!(case.coefficients, [0.0; 7]);
}

#[test]
fn a_varying_force_does_not_change_the_impact_of_a_lock_in_no_time() {
    let instant = scenario(&[
        ("cycle = 0.01", "cycle = 0.5"),
        ("step_time = 0.01 ", "step_time = 0.0 "),
    ]);
    let runner = ExperimentRunner::new(&Ssrms, &instant).unwrap();
    for time in TIMES {
        let constant = case("5.2", time, SearchMethod::PerJoint);
        let varying = runner.study(&instant.experiments()[2], time).unwrap();
        let varying = varying.case(SearchMethod::PerJoint);
        for (a, b) in constant.impact_before.iter().zip(&varying.impact_before) {
            assert!((a - b).abs() < 1e-9);
        }
        let force = varying.rollout.series.force.last().unwrap();
        assert!((force[0] - 160.0).abs() < 1e-9 && force[3] == 0.0);
    }
}

#[test]
fn series_show_the_lock_from_both_sides() {
    for study in studies() {
        for case in &study.cases {
            let series = &case.rollout.series;
            let lock = series
                .time
                .iter()
                .position(|time| *time == case.failure_time)
                .unwrap();
            assert_eq!(series.time[lock + 1], case.failure_time + case.step_time);
            assert!(series.time.is_sorted());
            let rows = [&series.planned, &series.torque];
            assert!(
                rows.iter()
                    .all(|rows| rows.len() == series.time.len() && rows[0].len() == 7)
            );
            for joint in 0..7 {
                let step = series.torque[lock + 1][joint] - series.torque[lock][joint];
                assert!(
                    (step.abs() - case.impact_after[joint]).abs() < 1e-7,
                    "{:?}",
                    case.method
                );
                let step = series.planned[lock + 1][joint] - series.planned[lock][joint];
                assert!((step.abs() - case.impact_before[joint]).abs() < 1e-7);
            }
        }
    }
}

#[test]
fn the_generic_path_finds_the_same() {
    let scenario = scenario(&[("cycle = 0.01", "cycle = 0.5")]);
    let experiment = &scenario.experiments()[0];
    let chain: SerialChain<7> = Ssrms::CHAIN;
    let generated = ExperimentRunner::new(&Ssrms, &scenario).unwrap();
    let generic = ExperimentRunner::new(&chain, &scenario).unwrap();
    let [generated, generic] = [
        generated.study(experiment, 10.0).unwrap(),
        generic.study(experiment, 10.0).unwrap(),
    ];
    for (a, b) in generated.cases.iter().zip(&generic.cases) {
        let pairs = a.impact_after.iter().zip(&b.impact_after);
        // The generic gradient comes from differences.
        let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-4, "{:?}: {worst}", a.method);
    }
}

/// What the paper's claims come from: not from ∇w_D, and not from acting after the lock.
#[test]
fn ablations_take_one_thing_at_a_time_away() {
    let scenario = scenario(&[("cycle = 0.01", "cycle = 0.2")]);
    let runner = ExperimentRunner::new(&Ssrms, &scenario).unwrap();
    let expected = [
        (18.9707, [17.7014, 17.7014, 32.60]),
        (9.9728, [6.5913, 6.5913, 42.22]),
        (16.1903, [14.9775, 14.9775, 15.00]),
    ];
    for (time, (projected, optimum)) in TIMES.into_iter().zip(expected) {
        let ablation = runner.ablation(&scenario.experiments()[0], time).unwrap();
        let variants: Vec<_> = ablation.rows.iter().map(|row| row.variant).collect();
        assert_eq!(variants, Variant::all().collect::<Vec<_>>());
        let mut optima = optimum.into_iter();
        let mut errors = Vec::new();
        for row in &ablation.rows {
            let found = row.outcome.unwrap();
            match row.variant {
                Variant::PerJoint(_) => {
                    assert!(found.healthy_after < 1e-3, "{row:?}");
                    assert!(found.max_force_error >= found.force_error);
                    errors.push(found.force_error);
                }
                Variant::Projected(_) => {
                    assert!((found.healthy_after - projected).abs() < 6e-5, "{row:?}");
                    assert!(found.max_force_error < 1e-6);
                }
                Variant::Optimal(_) => {
                    let expected = optima.next().unwrap();
                    assert_close(found.healthy_after, expected, 5e-4, "optimum");
                    assert!(found.max_force_error < 1e-6);
                    assert!(found.worst_joint.unwrap().1 > 1.0);
                }
            }
            assert!(found.max_compensation > 0.0);
        }
        if time == 18.0 {
            assert_close(errors[0], 9.297, 1e-3, "with w_D");
            assert_close(errors[1], 99.79, 1e-3, "with the kinematic manipulability");
        }
    }
}

/// Norms are never told without the joints that pay for them.
#[test]
fn keeping_the_force_makes_joints_worse_and_a_certificate_says_why() {
    for (time, margin) in TIMES.into_iter().zip([0.3237, 0.5564, 0.3534]) {
        let worse = |method| case("5.2", time, method).worse_joints();
        assert_eq!(worse(SearchMethod::PerJoint), []);
        for method in [SearchMethod::Projected, SearchMethod::Optimal] {
            assert!(!worse(method).is_empty(), "{method:?} at {time} s");
            // The one that locks is told by its own column.
            assert!(worse(method).iter().all(|joint| joint.joint != 1));
        }
        let mut studies = studies().iter();
        let study = studies.find(|study| study.section == "5.2" && study.failure_time == time);
        let kept = &study.unwrap().force_kept;
        let Ok(Lowerable::None {
            joints,
            margin: found,
            ..
        }) = &kept.all
        else {
            panic!("{:?}", kept.all);
        };
        assert_eq!(joints[..], [0, 1, 2, 3, 4, 5]);
        assert!((found - margin).abs() < 5e-5);
        let Ok(Lowerable::All { worst_ratio }) = kept.healthy else {
            panic!("{:?}", kept.healthy);
        };
        assert!(worst_ratio > 0.95 && worst_ratio < 1.0);
        let (before, _) = case("5.2", time, SearchMethod::Optimal).healthy_impact();
        let fair = *kept.no_healthy_joint_worse.as_ref().unwrap();
        assert!(fair > 0.9 * before && fair < before);
        let nothing = *kept.no_joint_worse.as_ref().unwrap();
        assert!((nothing / before - 1.0).abs() < 1e-9);
    }
}

/// Its rated torques are no limits of this arm.
#[test]
fn an_experiment_of_another_arm_is_refused() {
    const PLANAR: &str = r#"
        name = "planar"
        arm = "planar_2r"
        angle_unit = "deg"
        motion = { kind = "joint", angles = "q", start = [10, 60], goal = [20, 80], duration = 2, blend = 0.5 }
        failure = { joints = [2], times = [1.0] }
        control.cycle = 0.1
        search = { start = 0, step = 1e-3 }
        experiment = [{ section = "a", force = [1, 0, 0], rated_torque = 40 }]
    "#;
    let planar = KnownArm {
        name: "planar_2r",
        joints: &Planar2r::CHAIN.joints,
        joint_names: &Planar2r::JOINT_NAMES,
    };
    let planar = Scenario::parse(PLANAR, "planar.toml", Path::new(""), &[planar]).unwrap();
    let paper_like = scenario(&[]);
    let runner = ExperimentRunner::new(&Ssrms, &paper_like).unwrap();
    let refusals = [
        runner.study(&planar.experiments()[0], 1.0).unwrap_err(),
        runner
            .simulated_lock(&planar.experiments()[0], 1.0)
            .unwrap_err(),
    ];
    for refusal in refusals {
        let expected = "the experiment is for 2 joints, the arm has 7";
        assert_eq!(refusal.to_string(), expected);
    }
}

#[test]
fn another_arm_and_an_impossible_motion_are_refused() {
    let paper_like = scenario(&[]);
    let planar = Planar2r;
    let refusal = ExperimentRunner::new(&planar, &paper_like).unwrap_err();
    assert_eq!(
        refusal.to_string(),
        "the motion cannot be executed: the motion is for 7 joints, the arm has 2"
    );
    let fast = scenario(&[(
        "blend = 4.455",
        "blend = 4.455\nmax_velocity = [1, 1, 0.2, 1, 1, 1, 1]",
    )]);
    let refusal = ExperimentRunner::new(&Ssrms, &fast).unwrap_err();
    assert!(matches!(refusal, ExperimentError::Motion(_)));
    assert!(
        refusal.to_string().contains("joint 3 would need 0.283"),
        "{refusal}"
    );
}

#[test]
fn the_simulated_lock_balances_and_tends_to_the_ideal_one() {
    let scenario = scenario(&[]);
    let runner = ExperimentRunner::new(&Ssrms, &scenario).unwrap();
    let simulated = runner
        .simulated_lock(&scenario.experiments()[0], 10.0)
        .unwrap();
    let mut last = f64::INFINITY;
    for point in &simulated.convergence {
        assert!(
            point.energy_error < 1e-8 && point.momentum_error < 1e-8,
            "{point:?}"
        );
        assert!(point.relative_difference < last, "{point:?}");
        last = point.relative_difference;
    }
    assert!(last < 1e-3, "{last}");
    assert_eq!(simulated.runs.len(), 4);
    let without = &simulated.runs[0];
    assert_eq!(without.method, None);
    for run in &simulated.runs {
        assert!(run.energy_error < 1e-8);
        assert_eq!(run.time.len(), run.torque.len());
        assert_eq!(run.time.len(), run.predicted_torque.len());
    }
    let before = &case("5.2", 10.0, SearchMethod::PerJoint).impact_before;
    for (predicted, before) in without.predicted_step.iter().zip(before) {
        assert!((predicted.abs() - before).abs() < 1e-9);
    }
    // The brake bears far more than the paper's impact torque.
    assert!(without.peak_torque[1] > 10.0 * before[1]);
}
