//! The steps of the planned torque.

use ulna::{Arm, ProfileShape, Trajectory};
use ulna_generated::Ssrms;
use ulna_study::experiment::{ExperimentError, PlannedTorques, SearchMethod};

use crate::{TIMES, runner, scenario};

fn torques(edits: &[(&str, &str)]) -> Vec<(ProfileShape, PlannedTorques)> {
    let scenario = scenario(edits);
    let found = runner(&scenario).plan_steps(&scenario.experiments()[0]);
    let profiles = found.profiles.into_iter();
    profiles
        .map(|profile| (profile.shape, profile.torques.unwrap()))
        .collect()
}

#[test]
fn blend_ends_of_the_trapezoid_step_ten_times_what_the_lock_does() {
    let found = torques(&[]);
    let (shape, trapezoid) = &found[0];
    assert_eq!(*shape, ProfileShape::Trapezoid);
    let ends: Vec<_> = trapezoid.phase_ends.iter().map(|step| step.time).collect();
    assert_eq!(ends, [0.0, 4.455, 15.545, 20.0]);
    // The figures of an independent recomputation.
    for (step, expected) in [(1, 323.0), (2, 445.0)] {
        let norm = trapezoid.phase_ends[step].norm();
        assert!((norm - expected).abs() < 1.0, "{norm}, not {expected}");
    }
    let largest = trapezoid.largest_of_plan().unwrap();
    let lock = trapezoid.largest_of_locks().unwrap();
    assert!(largest.norm() > 5.0 * lock.norm());
}

/// By another road: the step is M times the jump of q̈.
#[test]
fn a_step_of_the_plan_is_what_the_jump_of_acceleration_takes() {
    let scenario = scenario(&[]);
    let runner = runner(&scenario);
    let motion = runner.motion();
    for step in &torques(&[])[0].1.phase_ends {
        let jump = motion.state(step.time).qdd - motion.state_before(step.time).qdd;
        let mass_matrix = Ssrms.mass_matrix(&motion.state(step.time).q);
        let expected = mass_matrix * jump;
        for (joint, expected) in expected.iter().enumerate() {
            assert!(
                (step.step[joint] - expected).abs() < 1e-9,
                "at {} s",
                step.time
            );
        }
    }
}

#[test]
fn the_other_profiles_make_no_step_and_their_slopes_are_finite() {
    let found = torques(&[]);
    assert_eq!(found.len(), 3);
    for (shape, torques) in &found[1..] {
        for step in &torques.phase_ends {
            assert!(
                step.norm() < 1e-9,
                "{shape:?} at {} s: {}",
                step.time,
                step.norm()
            );
        }
        let largest = torques.steepest.iter().copied().fold(0.0, f64::max);
        assert!(largest <= torques.steepest_norm && torques.steepest_norm.is_finite());
        assert!(
            torques.steepest_norm > found[0].1.steepest_norm,
            "{shape:?}"
        );
    }
}

/// Sampled against a derivative that knows nothing of phases.
#[test]
fn the_steepest_slope_is_met_where_it_is_said_to_be() {
    for (word, own) in [
        ("quintic", ProfileShape::Quintic),
        ("s_curve", ProfileShape::s_curve(4.455)),
    ] {
        let profile = format!("profile = \"{word}\"");
        let edits = [("profile = \"trapezoid\"", profile.as_str())];
        let found = torques(&edits);
        assert_eq!(found[0].0, own);
        let scenario = scenario(&edits);
        let runner = runner(&scenario);
        let wrench = scenario.experiments()[0].force().at(0.0);
        let torque = |time: f64| {
            let state = runner.motion().state(time);
            Ssrms.inverse_dynamics(&state.q, &state.qd, &state.qdd)
                + Ssrms.geometric_jacobian(&state.q).tr_mul(&wrench)
        };
        let mut steepest = 0.0_f64;
        for i in 0..4000 {
            let time = 20.0 * (f64::from(i) + 0.5) / 4000.0;
            let slope = (torque(time + 1e-4) - torque(time - 1e-4)) / 2e-4;
            steepest = steepest.max(slope.norm());
        }
        let said = found[0].1.steepest_norm;
        assert!(
            (steepest / said - 1.0).abs() < 5e-3,
            "{word}: {steepest}, {said}"
        );
    }
}

#[test]
fn locks_are_those_of_the_studies_whatever_the_profile() {
    for word in ["trapezoid", "quintic", "s_curve"] {
        let profile = format!("profile = \"{word}\"");
        let scenario = scenario(&[("profile = \"trapezoid\"", &profile)]);
        let runner = runner(&scenario);
        for experiment in [&scenario.experiments()[0], &scenario.experiments()[2]] {
            let found = runner.plan_steps(experiment);
            let locks = &found.profiles[0].torques.as_ref().unwrap().locks;
            for (time, lock) in TIMES.into_iter().zip(locks) {
                let study = runner.study(experiment, time).unwrap();
                let before = &study.case(SearchMethod::PerJoint).impact_before;
                assert_eq!(lock.time, time);
                for (step, before) in lock.step.iter().zip(before) {
                    assert!((step.abs() - before).abs() < 1e-9);
                }
            }
        }
    }
}

#[test]
fn a_profile_that_a_limit_forbids_says_so() {
    // What the trapezoid needs of joint 3 is 0.063537 rad/s².
    let limit = "blend = 4.455\nmax_acceleration = [1, 1, 0.07, 1, 1, 1, 1]";
    let scenario = scenario(&[("blend = 4.455", limit)]);
    let found = runner(&scenario).plan_steps(&scenario.experiments()[0]);
    assert!(found.profiles[0].torques.is_ok());
    for profile in &found.profiles[1..] {
        let refusal = profile.torques.as_ref().unwrap_err();
        assert!(matches!(refusal, ExperimentError::Motion(_)));
        let text = refusal.to_string();
        assert!(text.contains("joint 3 would need 0.1"), "{text}");
    }
}

#[test]
fn a_tool_path_is_compared_alike() {
    let text = include_str!("../../../scenarios/tool_path.toml")
        .replace("duration = 10.0", "duration = 40.0");
    let known = ulna_study::scenario::KnownArm {
        name: "ssrms",
        joints: &Ssrms::CHAIN.joints,
        joint_names: &Ssrms::JOINT_NAMES,
    };
    let scenario =
        ulna_study::Scenario::parse(&text, "tool.toml", std::path::Path::new(""), &[known])
            .unwrap();
    let found = runner(&scenario).plan_steps(&scenario.experiments()[0]);
    let norms = found.profiles.iter().map(|profile| {
        let torques = profile.torques.as_ref().unwrap();
        (profile.shape, torques.largest_of_plan().unwrap().norm())
    });
    for (shape, norm) in norms {
        assert_eq!(
            norm > 1e-3,
            shape == ProfileShape::Trapezoid,
            "{shape:?}: {norm}"
        );
    }
}
