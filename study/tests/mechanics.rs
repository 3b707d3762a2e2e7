//! What a lock does to the structure, how many torques leave the tool alone, and what can be done after the lock only.

use std::path::Path;

use nalgebra::SVector;
use ulna::control::failure::{Failure, LockedJoints, impact_torque_of};
use ulna::{Arm, JointKind, SerialChain, Trajectory};
use ulna_generated::{Oblique6, Planar2r, Ssrms};
use ulna_study::Scenario;
use ulna_study::experiment::{
    ExperimentRunner, LockMechanics, StructureLoad, after_only, lock_mechanics,
};
use ulna_study::scenario::KnownArm;
use ulna_study::search::{Operation, OperationOptions};

const KNOWN: &[KnownArm] = &[
    KnownArm {
        name: "ssrms",
        joints: &Ssrms::CHAIN.joints,
        joint_names: &Ssrms::JOINT_NAMES,
    },
    KnownArm {
        name: "planar_2r",
        joints: &Planar2r::CHAIN.joints,
        joint_names: &Planar2r::JOINT_NAMES,
    },
    KnownArm {
        name: "oblique_6",
        joints: &Oblique6::CHAIN.joints,
        joint_names: &Oblique6::JOINT_NAMES,
    },
];

fn parse(text: &str) -> Scenario {
    Scenario::parse(text, "test.toml", Path::new("scenarios"), KNOWN).unwrap()
}

fn paper_like() -> Scenario {
    parse(include_str!("../../scenarios/paper_like.toml"))
}

/// A short motion of another arm, one joint locking half way.
fn short(arm: &str, joints: usize, failed: usize) -> Scenario {
    let start: Vec<f64> = (0..joints).map(|i| 0.2 + 0.15 * i as f64).collect();
    let goal: Vec<f64> = start.iter().map(|q| q + 0.4).collect();
    parse(&format!(
        "name = \"short\"\narm = \"{arm}\"\nangle_unit = \"rad\"\n[motion]\nkind = \"joint\"\nangles = \"q\"\n\
         start = {start:?}\ngoal = {goal:?}\nduration = 2.0\nblend = 0.8\n[failure]\njoints = [{failed}]\ntimes = [0.6]\n\
         [control]\ncycle = 0.1\n[search]\nstart = 0.0\nstep = 1.0\n[[experiment]]\nsection = \"a\"\n\
         force = [1.0, 2.0, 3.0]\nrated_torque = \"none\"\n"
    ))
}

fn mechanics<const N: usize>(chain: &SerialChain<N>, scenario: &Scenario) -> Vec<LockMechanics> {
    lock_mechanics(chain, chain, scenario).unwrap()
}

/// Along the axes the loads are the torque step that inverse dynamics gives, for revolute and sliding joints.
#[test]
fn what_the_motors_feel_of_the_loads_is_the_torque_step() {
    fn check<const N: usize>(arm: &dyn Arm<N>, chain: &SerialChain<N>, scenario: &Scenario) {
        let motion = scenario.motion().plan(arm, 0.02).unwrap();
        for lock in mechanics(chain, scenario) {
            let joints = LockedJoints::new(&lock.failed_joints).unwrap();
            let state = motion.state(lock.failure_time);
            let step = -impact_torque_of(arm, &state, joints, &nalgebra::zero());
            let along: Vec<_> = lock.loads.iter().map(StructureLoad::along_axis).collect();
            let along = SVector::<f64, N>::from_column_slice(&along);
            assert!((along - step).norm() < 1e-9 * step.norm(), "{along} {step}");
        }
    }
    check(&Ssrms, &Ssrms::CHAIN, &paper_like());
    let oblique = short("oblique_6", 6, 2);
    check(&Oblique6, &Oblique6::CHAIN, &oblique);
    let kinds = mechanics(&Oblique6::CHAIN, &oblique)[0]
        .loads
        .iter()
        .map(|load| load.kind)
        .collect::<Vec<_>>();
    assert!(kinds.contains(&JointKind::Prismatic));
}

/// Off the axes, by an independent recomputation.
#[test]
fn the_structure_bears_what_no_motor_feels() {
    let locks = mechanics(&Ssrms::CHAIN, &paper_like());
    let at_10 = &locks[1];
    assert_eq!(at_10.failure_time, 10.0);
    let round = |x: f64| (10.0 * x.abs()).round() / 10.0;
    let fourth = &at_10.loads[3];
    assert_eq!(
        (round(fourth.moment[1]), round(fourth.moment[2])),
        (80.8, 1.2)
    );
    let third = &at_10.loads[2];
    let mut off = [round(third.moment[0]), round(third.moment[1])];
    off.sort_by(f64::total_cmp);
    assert_eq!((off, round(third.moment[2])), ([57.6, 74.0], 23.2));
    assert!((third.off_axis_moment() - third.moment[0].hypot(third.moment[1])).abs() < 1e-12);
}

#[test]
fn the_torques_that_leave_the_tool_alone_are_counted() {
    let free = |lock: &LockMechanics| (lock.task.len(), lock.before.free(), lock.after.free());
    for lock in &mechanics(&Ssrms::CHAIN, &paper_like()) {
        assert_eq!(free(lock), (3, 4, 3));
    }
    // Five rows and six joints: one direction, and none once a joint is locked.
    let lock = &mechanics(&Oblique6::CHAIN, &short("oblique_6", 6, 2))[0];
    assert_eq!(free(lock), (5, 1, 0));
    let lock = &mechanics(&Planar2r::CHAIN, &short("planar_2r", 2, 2))[0];
    assert_eq!(free(lock), (2, 0, 0));
    assert_eq!((lock.after.joints, lock.after.rank), (1, 1));
}

/// The stick figures: links as long as the table says, and a locked joint that stays where it was.
#[test]
fn poses_are_those_of_the_motion() {
    let scenario = short("planar_2r", 2, 2);
    let lock = &mechanics(&Planar2r::CHAIN, &scenario)[0];
    let distance = |a: [f64; 3], b: [f64; 3]| {
        let squared: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
        squared.sqrt()
    };
    for pose in [&lock.start, &lock.failure, &lock.goal, &lock.locked_goal] {
        assert!((distance(pose.joints[0].origin, pose.joints[1].origin) - 1.0).abs() < 1e-12);
        assert!((distance(pose.joints[1].origin, pose.tool) - 1.0).abs() < 1e-12);
    }
    let elbow = |pose: &ulna_study::experiment::ArmPose| distance(pose.base, pose.tool);
    assert!((elbow(&lock.failure) - elbow(&lock.locked_goal)).abs() < 1e-12);
    assert!((elbow(&lock.failure) - elbow(&lock.goal)).abs() > 1e-3);
    assert_eq!(lock.path.last(), Some(&lock.goal.tool));
    assert_eq!(lock.locked_path.last(), Some(&lock.locked_goal.tool));
    assert_eq!(lock.locked_path.first(), Some(&lock.failure.tool));
}

/// By formula, by what the controller's cut assessment says, and by an independent recomputation.
#[test]
fn what_can_be_done_after_the_lock_only() {
    let scenario = paper_like();
    let runner = ExperimentRunner::new(&Ssrms, &scenario).unwrap();
    let joints = LockedJoints::<7>::new(&[1]).unwrap();
    let expected = [(3.0, 32.60), (10.0, 42.22), (18.0, 15.00)];
    for (time, expected) in expected {
        let options = OperationOptions {
            sample_period: 1.0,
            ..OperationOptions::default()
        };
        let wrench = |_| nalgebra::Vector6::new(20.0, 20.0, 20.0, 0.0, 0.0, 0.0);
        let failure = Failure { joints, time };
        let operation =
            Operation::new(&Ssrms, runner.motion(), wrench, &failure, &options).unwrap();
        let assessment = operation.assess(&after_only(&operation));
        let step = joints.without(&operation.step());
        let left = (step - operation.after().pose.project(&step)).norm();
        assert!((assessment.healthy_impact - left).abs() < 1e-9 * left);
        assert!((left - expected).abs() < 0.01, "{left} at {time} s");
        assert!(assessment.max_force_error < 1e-9);
        assert!(left <= step.norm());
    }
}
