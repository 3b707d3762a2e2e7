//! Section 5.3: what the rated torques cut, and Table 3.

use ulna::{Arm, Trajectory};
use ulna_generated::Ssrms;
use ulna_study::experiment::{BoundSide, SearchMethod};

use crate::{TIMES, runner, scenario};

const CYCLE: (&str, &str) = ("cycle = 1", "cycle = 0.1");

#[test]
fn joints_4_and_6_are_cut_as_far_as_the_papers_and_joints_1_to_3_are_not() {
    let scenario = scenario(&[CYCLE]);
    let runner = runner(&scenario);
    let joints = |time| {
        let found = runner.limited(&scenario.experiments()[1], time).unwrap();
        found.unwrap().joints
    };
    for (time, expected) in TIMES.into_iter().zip([&[6][..], &[4, 6], &[]]) {
        let joints = joints(time);
        let cut = (1..=7).filter(|joint| joints[joint - 1].bound.is_some());
        assert_eq!(cut.collect::<Vec<_>>(), expected, "at {time} s");
    }
    for (joint, paper) in [(3, 78.35), (5, 52.11)] {
        let found = joints(10.0)[joint].limited_percent();
        assert!((found - paper).abs() < 3.0, "joint {}: {found}", joint + 1);
    }
}

/// Joint 5 can not be cut by a limit that leaves room for the plan: its compensation unloads it.
#[test]
fn a_limit_that_cuts_joint_5_is_below_what_the_plan_needs() {
    let of = |rated: &str| {
        let limits = format!("412.0, {rated}, 38.0");
        let scenario = scenario(&[CYCLE, ("412.0, 32.0, 38.0", &limits)]);
        let found = runner(&scenario).limited(&scenario.experiments()[1], 10.0);
        found.unwrap().unwrap().joints[4]
    };
    assert!(of("29.1").bound.is_none());
    let cut = of("27.0");
    assert!(
        (cut.limited_percent() - 53.5).abs() < 1.0,
        "{}",
        cut.limited_percent()
    );
    // And what the plan needs is above that.
    let scenario = scenario(&[CYCLE]);
    let runner = runner(&scenario);
    let wrench = scenario.experiments()[1].force().at(0.0);
    let needed = (0..200).map(|i| {
        let state = runner.motion().state(0.1 * f64::from(i));
        let torque = Ssrms.inverse_dynamics(&state.q, &state.qd, &state.qdd)
            + Ssrms.geometric_jacobian(&state.q).tr_mul(&wrench);
        torque[4].abs()
    });
    let needed = needed.fold(0.0, f64::max);
    assert!((29.1..32.0).contains(&needed), "{needed}");
}

/// The end of an interval is where the joint's torque comes to its rated one, and the sides are where they are said to be.
#[test]
fn a_bound_is_where_the_torque_comes_to_its_limit() {
    let scenario = scenario(&[CYCLE]);
    let experiment = &scenario.experiments()[1];
    let rated = experiment.rated_torque().unwrap();
    let mut seen = 0;
    for time in [10.0] {
        let study = runner(&scenario).study(experiment, time).unwrap();
        let case = study.case(SearchMethod::PerJoint);
        for (joint, bound) in case.bounds.iter().enumerate() {
            let Some(bound) = bound else {
                assert!(case.suppression_percent()[joint] > 99.9 || joint == 6);
                continue;
            };
            seen += 1;
            assert_eq!(case.coefficients[joint], bound.limit);
            assert_eq!(bound.wanted > bound.limit, bound.side == BoundSide::Upper);
            // Eq. 16 is linear in the coefficient: what is suppressed is the share that is left of it.
            let share = 100.0 * bound.limit / bound.wanted;
            assert!((case.suppression_percent()[joint] - share).abs() < 1e-6);
            let peak = case.rollout.max_torque[joint];
            assert!((peak / rated[joint] - 1.0).abs() < 1e-3, "{peak}");
            assert!((0.0..=20.0).contains(&bound.time));
        }
        let others = [SearchMethod::Projected, SearchMethod::Optimal];
        assert!(
            others
                .iter()
                .all(|method| study.case(*method).bounds == [None; 7])
        );
    }
    assert!(seen == 2, "{seen}");
}

#[test]
fn table_3_is_that_of_the_studies_with_and_without_limits() {
    let scenario = scenario(&[]);
    let (free, limited) = (&scenario.experiments()[0], &scenario.experiments()[1]);
    let runner = runner(&scenario);
    assert!(runner.limited(free, 10.0).unwrap().is_none());
    for time in TIMES {
        let table = runner.limited(limited, time).unwrap().unwrap();
        let [free, limited] =
            [free, limited].map(|experiment| runner.study(experiment, time).unwrap());
        let (free, limited) = (
            free.case(SearchMethod::PerJoint),
            limited.case(SearchMethod::PerJoint),
        );
        for (i, joint) in table.joints.iter().enumerate() {
            assert!((joint.impact_before - free.impact_before[i]).abs() < 1e-9);
            assert!((joint.impact_free - free.impact_after[i]).abs() < 1e-7);
            assert!((joint.impact_limited - limited.impact_after[i]).abs() < 1e-9);
            assert!((joint.limited_percent() - limited.suppression_percent()[i]).abs() < 1e-6);
            // U is linear in k_d.
            if free.coefficients[i] != 0.0 {
                let share = 100.0 * (1.0 - limited.coefficients[i] / free.coefficients[i]);
                let decrease = joint.compensation_decrease_percent();
                assert!(
                    (decrease - share).abs() < 1e-6,
                    "joint {}: {decrease}",
                    i + 1
                );
            }
            assert!(joint.mean_room > 0.0 && joint.mean_room < joint.rated_torque + 1e-9);
        }
    }
}

/// Without a tool force all torque is τ^v, and its mean is that of the series.
#[test]
fn the_mean_room_is_what_the_motion_leaves() {
    let scenario = scenario(&[
        ("rated_torque = \"none\"", "rated_torque = 500.0"),
        ("force = [20.0, 20.0, 20.0]", "force = [0.0, 0.0, 0.0]"),
    ]);
    let experiment = &scenario.experiments()[0];
    let runner = runner(&scenario);
    let table = runner.limited(experiment, 10.0).unwrap().unwrap();
    let study = runner.study(experiment, 10.0).unwrap();
    let series = &study.case(SearchMethod::PerJoint).rollout.series;
    for (i, joint) in table.joints.iter().enumerate() {
        let pairs = series.time.windows(2).zip(series.planned.windows(2));
        let area: f64 = pairs
            .map(|(time, rows)| 0.5 * (time[1] - time[0]) * (rows[0][i].abs() + rows[1][i].abs()))
            .sum();
        let expected = 500.0 - area / 20.0;
        assert!(
            (joint.mean_room - expected).abs() < 0.2,
            "{} {expected}",
            joint.mean_room
        );
    }
}
