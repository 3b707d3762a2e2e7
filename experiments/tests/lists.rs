//! What goes through lists is what goes through vectors; and lists of another length are refused.

use ulna::control::failure::impact_torque;
use ulna::nalgebra::{Vector2, Vector6};
use ulna::{JointState, LockedJoints, Profile, ProfileShape, SerialChain};
use ulna_experiments::{
    Law, Locking, Search, Servo, Settings, Span, StateList, Subject, by_table, state_at,
};
use ulna_study::experiment::ExperimentError;
use ulna_study::scenario::{Motion, MotionPath, ToolForce};
use ulna_study::simulation::{BrakeProfile, Ending, Resolution};
use ulna_table::Model;

fn model() -> Model {
    Model::load("../arms/planar_2r.toml").unwrap()
}

fn subject() -> Box<dyn Subject> {
    let made = by_table(&model()).unwrap();
    assert!(made.no_code.is_none(), "{:?}", made.no_code);
    made.subject
}

fn motion(goal: Vec<f64>) -> Motion {
    let profile = Profile::new(10.0, 2.0, ProfileShape::Trapezoid).unwrap();
    let path = MotionPath::Joint(goal);
    Motion::new(model().joints(), vec![0.2, 0.4], path, profile)
}

#[test]
fn the_impact_is_that_of_the_library() {
    let (arm, chain) = (subject(), SerialChain::<2>::try_from(&model()).unwrap());
    let state = JointState {
        q: Vector2::new(0.3, -0.7),
        qd: Vector2::new(0.1, 0.2),
        qdd: Vector2::new(-0.3, 0.4),
    };
    let lists = StateList {
        q: vec![0.3, -0.7],
        qd: vec![0.1, 0.2],
        qdd: vec![-0.3, 0.4],
    };
    let locked = LockedJoints::new(&[1]).unwrap();
    let expected = impact_torque(&chain, &state, locked, &Vector6::zeros());
    let found = arm.lock_impact(&lists, &[1], &[0.0; 6]).unwrap();
    assert_eq!(found.torque, expected.torque.as_slice());
    assert_eq!(
        found.loads[0].force,
        <[f64; 3]>::from(expected.loads[0].force)
    );
}

/// One motion through plan, search, controller and simulation.
#[test]
fn a_motion_of_ones_own_goes_all_the_way() {
    let arm = subject();
    let plan = arm.plan(&motion(vec![0.8, 1.2])).unwrap();
    assert_eq!((plan.joints(), plan.duration()), (2, 10.0));
    let end = state_at(&*plan, 10.0);
    assert!((end.q[0] - 0.8).abs() < 1e-12 && (end.q[1] - 1.2).abs() < 1e-12);

    let force = ToolForce::constant(&Vector6::new(1.0, 2.0, 0.0, 0.0, 0.0, 0.0));
    let locking = Locking::new(&[1], 5.0, force);
    let operation = arm.operation(&*plan, &locking).unwrap();
    let found = operation.search(&Search::PerJoint).unwrap();
    let assessed = operation.assess(&found.law).unwrap();
    assert_eq!(assessed, found.assessed);

    let at = state_at(&*plan, 5.0);
    let settings = Settings::default();
    let cycle = |locked: &[usize]| {
        let wrench = [1.0, 2.0, 0.0, 0.0, 0.0, 0.0];
        arm.cycle(&Law::None, &settings, &at, &wrench, locked)
            .unwrap()
    };
    let (before, after) = (cycle(&[]), cycle(&[1]));
    for (joint, step) in operation.step().iter().enumerate() {
        let cycles = after.planned[joint] - before.planned[joint];
        assert!((cycles - step).abs() < 1e-9, "{cycles} {step}");
    }

    let servo = Servo {
        gain: 5.0,
        cycle: Some(0.01),
        brake_time: 0.1,
        brake_profile: BrakeProfile::Constant,
        detection: 0.0,
        reflected_inertia: None,
    };
    let span = Span {
        start: 4.5,
        end: 6.0,
        resolution: Resolution::default(),
    };
    let run = arm
        .simulate(&*plan, &locking, &Law::None, &servo, &span)
        .unwrap();
    assert_eq!(run.ending, Ending::Complete);
    let last = run.samples.last().unwrap();
    assert!(last.state.qd[1].abs() < 1e-12, "{last:?}");
    assert!(run.energy_error < 1e-6, "{}", run.energy_error);
    assert_eq!(run.impact.unwrap().brake_impulse[0], 0.0);
}

#[test]
fn lists_of_another_length_are_refused() {
    let arm = subject();
    let wrong = |error: ExperimentError| {
        let text = error.to_string();
        assert!(text.contains("3 joints") && text.contains('2'), "{text}");
    };
    wrong(arm.plan(&motion(vec![0.8, 1.2, 0.1])).err().unwrap());
    let short = StateList {
        q: vec![0.0; 3],
        qd: vec![0.0; 2],
        qdd: vec![0.0; 2],
    };
    wrong(arm.lock_impact(&short, &[1], &[0.0; 6]).err().unwrap());
    let plan = arm.plan(&motion(vec![0.8, 1.2])).unwrap();
    let locking = Locking::new(&[2], 5.0, ToolForce::constant(&Vector6::zeros()));
    let refused = arm.operation(&*plan, &locking).err().unwrap();
    assert_eq!(
        refused,
        ExperimentError::Joint {
            joint: 2,
            joints: 2
        }
    );
}

#[test]
fn more_joints_than_are_compiled_are_refused() {
    let link = "[[joint]]\ntheta = 0.0\nd = 0.0\na = 1.0\nalpha = 0.0\n[joint.link]\nmass = 1.0\n\
                com = [0.5, 0.0, 0.0]\ninertia = { xx = 0.1, yy = 0.1, zz = 0.1 }\n";
    let head = "name = \"long\"\nconvention = \"modified\"\nangle_unit = \"deg\"\n[task]\nrows = [\"x\", \"y\"]\n";
    let model = Model::parse(&(head.to_owned() + &link.repeat(13)), "long.toml").unwrap();
    let error = by_table(&model).err().unwrap();
    assert_eq!((error.joints, error.expected), (13, 12));
}
