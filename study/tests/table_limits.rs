//! What an arm's table says of its joints holds for a scenario's motion.

use std::path::Path;

use ulna::nalgebra::SVector;
use ulna::{JointLimits, Limits, PositionLimits};
use ulna_study::Scenario;
use ulna_study::scenario::{KnownArm, MotionPath, ScenarioErrors};
use ulna_table::{Description, Model};

const PAPER_LIKE: &str = include_str!("../../scenarios/paper_like.toml");
const TOOL_PATH: &str = include_str!("../../scenarios/tool_path.toml");

/// The scenario for the SSRMS with `change` made to its table.
fn parse(text: &str, change: impl FnOnce(&mut Description)) -> Result<Scenario, ScenarioErrors> {
    let mut description = Model::load("../arms/ssrms.toml").unwrap().description();
    change(&mut description);
    let model = Model::new(&description).unwrap_or_else(|errors| panic!("{errors}"));
    let names = model.joint_names().iter();
    let names: Vec<&'static str> = names.map(|name| &*name.clone().leak()).collect();
    let known = [KnownArm {
        name: "ssrms",
        joints: model.joints().to_vec().leak(),
        joint_names: names.leak(),
    }];
    Scenario::parse(
        text,
        "scenarios/bad.toml",
        Path::new("../scenarios"),
        &known,
    )
}

/// The joint numbered from 0 named, and held between two angles, rad.
fn held(arm: &mut Description, joint: usize, name: &str, lower: f64, upper: f64) {
    arm.joint_names = vec![None; arm.joints.len()];
    arm.joint_names[joint] = Some(name.to_owned());
    arm.joints[joint].limits = Limits {
        lower,
        upper,
        ..Limits::NONE
    };
}

#[test]
fn a_start_and_a_goal_beyond_the_limits_are_refused_with_the_joints_name() {
    let narrow = |arm: &mut Description| {
        held(arm, 3, "elbow", -1.0, 1.0);
        arm.joints[4].limits.lower = -3.0;
    };
    let errors = parse(PAPER_LIKE, narrow).expect_err("the scenario should be refused");
    insta::assert_snapshot!(errors.to_string());
    // At the limit to the last digit is within.
    parse(PAPER_LIKE, |arm| held(arm, 3, "elbow", -2.108, -1.835)).unwrap();
}

#[test]
fn the_tables_velocities_limit_the_motion_beside_the_scenarios() {
    let slow = |arm: &mut Description| arm.joints[2].limits.velocity = 0.2;
    let scenario = parse(PAPER_LIKE, slow).unwrap();
    let limits = scenario.motion().max_velocity();
    assert_eq!((limits[1], limits[2]), (f64::INFINITY, 0.2));
    let error = scenario
        .motion()
        .plan(&ulna_generated::Ssrms, 0.1)
        .unwrap_err();
    assert!(
        error.to_string().starts_with("joint 3 would need"),
        "{error}"
    );
}

#[test]
fn a_tools_path_that_takes_a_joint_beyond_its_limits_cannot_be_planned() {
    let scenario = parse(TOOL_PATH, |_| ()).unwrap();
    assert!(matches!(scenario.motion().path(), MotionPath::Tool(_)));
    let arm = &ulna_generated::Ssrms;
    let plan = scenario.motion().plan(arm, 0.1).unwrap();
    let ulna_study::scenario::PlannedMotion::Tool(path) = plan else {
        panic!("a path of the tool");
    };
    let (start, end) = (path.states().next().unwrap(), path.states().last().unwrap());
    assert!((end.0 - scenario.motion().duration()).abs() < 1e-9);
    let travel = end.1.q - start.1.q;
    let joint = travel.icamax();
    let middle = start.1.q[joint] + 0.5 * travel[joint];
    let (lower, upper) = match travel[joint] > 0.0 {
        true => (-10.0, middle),
        false => (middle, 10.0),
    };
    let scenario = parse(TOOL_PATH, |arm| held(arm, joint, "held", lower, upper)).unwrap();
    let error = scenario.motion().plan(arm, 0.1).unwrap_err().to_string();
    assert!(
        error.starts_with(&format!("joint {} would be at", joint + 1)),
        "{error}"
    );
}

#[test]
fn rotors_are_counted_once() {
    let geared = |arm: &mut Description| arm.joints[1].motor.inertia = 1e-4;
    let without = PAPER_LIKE.split_once("\n[servo]").unwrap().0;
    let scenario = parse(without, geared).unwrap();
    assert_eq!(scenario.motors().reflected_inertia(), [0.0; 7]);
    let twice = format!("{without}\n[motors]\nrotor_inertia = 1e-4\n");
    let errors = parse(&twice, geared)
        .expect_err("the scenario should be refused")
        .to_string();
    assert!(
        errors.contains("`rotor_inertia` of [motors] would count rotors twice"),
        "{errors}"
    );
    parse(&twice, |_| ()).unwrap();
}

#[test]
fn limits_of_a_chain_are_those_of_its_table() {
    let chain = ulna_generated::Geared6::CHAIN;
    let (rates, range) = (JointLimits::of(&chain), PositionLimits::of(&chain));
    let velocity = [110_f64.to_radians(), 0.5, 120_f64.to_radians()];
    assert_eq!(rates.velocity.as_slice()[..3], velocity);
    assert_eq!(rates.acceleration.amin(), f64::INFINITY);
    let wrist_has_none = (range.lower[5], range.upper[5]);
    assert_eq!(wrist_has_none, (f64::NEG_INFINITY, f64::INFINITY));

    let mut q = SVector::from([0.0, 0.7, 0.0, 0.0, 0.0, 1e6]);
    assert_eq!(range.admit(&q, 0.0), Ok(()));
    assert_eq!(PositionLimits::none().admit(&(q * 1e9), 0.0), Ok(()));
    (q[0], q[1]) = (3.0, 0.8);
    let error = range.admit(&q, 2.5).unwrap_err().to_string();
    assert_eq!(
        error,
        "joint 2 would be at 0.800000 rad (m) at 2.500 s; its limits are -0.200000 and 0.700000"
    );
    q[3] = f64::NAN;
    let error = range.admit(&q, 2.5).unwrap_err().to_string();
    assert!(error.starts_with("joint 4 would be at NaN"), "{error}");
}
