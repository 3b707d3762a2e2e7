//! Δt of Eq. 18 and ΔF_e of Eq. 8 in a scenario.

use ulna::nalgebra::Vector6;
use ulna_study::experiment::{Campaign, SearchMethod, Variant};
use ulna_study::scenario::Experiment;
use ulna_study::search::Field;

use crate::{TIMES, runner, scenario};
use ulna_generated::Ssrms;

/// Joint 4's step at 18 s without compensation.
fn joint_4(edits: &[(&str, &str)], experiment: usize) -> f64 {
    let scenario = scenario(edits);
    let found = runner(&scenario).plan_steps(&scenario.experiments()[experiment]);
    let torques = found.profiles[0].torques.as_ref().unwrap();
    assert_eq!(torques.locks[2].time, 18.0);
    torques.locks[2].step[3].abs()
}

/// The first two are the figures of an independent recomputation.
#[test]
fn a_varying_force_counts_with_delta_t_only() {
    let with = ("step_time = 0.0 ", "step_time = 0.01 ");
    let without = ("step_time = 0.01 ", "step_time = 0.0 ");
    for (found, expected) in [
        (joint_4(&[], 0), 0.339),
        (joint_4(&[with], 0), 1.025),
        (joint_4(&[without], 2), 0.339),
        (joint_4(&[], 2), 2.202),
    ] {
        assert!((found - expected).abs() < 5e-4, "{found}, not {expected}");
    }
}

#[test]
fn an_experiment_has_the_step_time_of_the_failure_unless_it_has_its_own() {
    let times = |edits: &[(&str, &str)]| {
        let scenario = scenario(edits);
        let experiments = scenario.experiments().iter();
        experiments.map(Experiment::step_time).collect::<Vec<_>>()
    };
    assert_eq!(times(&[]), [0.0, 0.0, 0.01]);
    assert_eq!(
        times(&[("step_time = 0.0 ", "step_time = 0.5 ")]),
        [0.5, 0.5, 0.01]
    );
    assert_eq!(times(&[("step_time = 0.0 ", "")]), [0.0, 0.0, 0.01]);
}

/// Why Section 5.2 has none: the null space drifts in Δt, and without limits a huge compensation makes use of that,
/// so that even a force-exact one cancels a step of which it leaves 9.97 N m in no time. A weight of effort leaves part of it,
/// and still asks for thousands of times the coefficients.
#[test]
fn a_step_time_without_limits_lets_huge_compensations_cancel_everything() {
    let left = |edits: &[(&str, &str)]| {
        let scenario = scenario(edits);
        let runner = runner(&scenario);
        let experiment = &scenario.experiments()[0];
        // In an ablation effort has no weight, in a study it has.
        let ablation = runner.ablation(experiment, 10.0).unwrap();
        let projected = Variant::Projected(Field::DynamicManipulability);
        let mut rows = ablation.rows.iter();
        let free = rows.find(|row| row.variant == projected).unwrap();
        let study = runner.study(experiment, 10.0).unwrap();
        let weighed = study.case(SearchMethod::Projected);
        let largest = weighed
            .coefficients
            .iter()
            .fold(0.0_f64, |largest, k| largest.max(k.abs()));
        (free.outcome.unwrap(), weighed.healthy_impact().1, largest)
    };
    let (free, weighed, largest) = left(&[]);
    assert!(free.healthy_after > 9.97 && free.max_compensation < 100.0);
    assert!((weighed / free.healthy_after - 1.0).abs() < 1e-5);
    assert!(largest < 1e8, "{largest:e}");
    let (free, weighed, largest) = left(&[("step_time = 0.0 ", "step_time = 0.01 ")]);
    assert!(
        free.healthy_after < 1e-2 && free.max_compensation > 1e6,
        "{free:?}"
    );
    assert!(
        weighed > 5.0 && weighed < 8.0 && largest > 1e11,
        "{weighed} {largest:e}"
    );
}

#[test]
fn the_rollout_asks_for_nothing_within_the_step_time() {
    let scenario = scenario(&[("step_time = 0.01 ", "step_time = 0.12 ")]);
    let study = runner(&scenario)
        .study(&scenario.experiments()[2], 10.0)
        .unwrap();
    for case in &study.cases {
        assert_eq!(case.step_time, 0.12);
        let series = &case.rollout.series;
        let lock = series.time.iter().position(|time| *time == 10.0).unwrap();
        assert_eq!(series.time[lock + 1], 10.12);
        assert!((series.time[lock + 2] - 11.0).abs() < 1e-12);
        for joint in 0..7 {
            let step = series.torque[lock + 1][joint] - series.torque[lock][joint];
            assert!(
                (step.abs() - case.impact_after[joint]).abs() < 1e-7,
                "{:?}",
                case.method
            );
        }
    }
}

#[test]
fn a_force_step_enters_the_impact_the_rollout_and_the_campaign() {
    let step = "force_step = [4.0, -3.0, 2.0]\nmoment_step = [0.0, 1.0, 0.0] ";
    let edits = [("force_step = [0.0, 0.0, 0.0] ", step)];
    let scenario = scenario(&edits);
    let delta = Vector6::new(4.0, -3.0, 2.0, 0.0, 1.0, 0.0);
    for time in TIMES {
        let runner = runner(&scenario);
        let experiment = &scenario.experiments()[0];
        assert_eq!(experiment.force().lock_step, delta);
        let study = runner.study(experiment, time).unwrap();
        let state = ulna::Trajectory::state(runner.motion(), time);
        let locked = ulna::LockedJoints::new(&[1]).unwrap();
        let expected = ulna::control::failure::impact_torque(&Ssrms::CHAIN, &state, locked, &delta);
        let case = study.case(SearchMethod::PerJoint);
        for (found, expected) in case.impact_before.iter().zip(&expected.torque) {
            assert!((found - expected.abs()).abs() < 1e-9);
        }
        let series = &case.rollout.series;
        let lock = series.time.iter().position(|found| *found == time).unwrap();
        assert_eq!(series.force[lock], [20.0, 20.0, 20.0, 0.0, 0.0, 0.0]);
        assert_eq!(series.force[lock + 1], [16.0, 23.0, 18.0, 0.0, -1.0, 0.0]);
        assert_eq!(*series.force.last().unwrap(), series.force[lock + 1]);
    }
    let stays = crate::scenario(&[]);
    let of = |scenario| {
        Campaign::new(&Ssrms, scenario)
            .unwrap()
            .case(1)
            .outcome
            .unwrap()
            .before
    };
    assert!((of(&scenario) - of(&stays)).abs() > 1.0);
}
