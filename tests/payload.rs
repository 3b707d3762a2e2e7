//! A payload at run time: the arm is the one whose last link has the body in it, and no other; nonsense is refused.
//!
//! `oracle` has numbers from outside.

use ulna::proof::{self, compare_with, states};
use ulna::{Arm, Payload, PayloadError, SerialChain, Unrolled as _};
use ulna_codegen::Interpreter;
use ulna_generated::Geared6;
use ulna_table::{Convention, Model};

const INERTIA: [[f64; 3]; 3] = [
    [0.09, 0.02, -0.01],
    [0.02, 0.08, 0.015],
    [-0.01, 0.015, 0.07],
];

fn payload() -> Payload {
    Payload::new(7.5, [0.12, -0.07, 0.2], INERTIA).unwrap()
}

fn model() -> Model {
    Model::load("../arms/geared_6.toml").unwrap_or_else(|errors| panic!("{errors}"))
}

/// The arm of a table whose last link is that of `chain`, without a payload of its own.
fn fixed(chain: &SerialChain<6>) -> Model {
    let mut description = model().description();
    assert_eq!(description.convention, Convention::Modified);
    description.payload = false;
    description.joints = chain.joints.to_vec();
    Model::new(&description).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn an_arm_that_carries_is_the_arm_with_that_body_in_its_last_link() {
    for payload in [Payload::NONE, payload(), proof::payload(&Geared6::CHAIN)] {
        let arm = Geared6::carrying(payload).unwrap();
        let chain = arm.chain();
        assert_eq!(chain, Geared6::CHAIN.carrying(&payload));
        let fixed = Interpreter::new(&fixed(&chain)).unwrap();
        let report = compare_with(&arm, &fixed, &chain, states(&chain).take(50));
        assert!(report.passes(), "{report}");
        let carrying = Interpreter::<6>::new(&model()).unwrap().carrying(&payload);
        let report = compare_with(&carrying, &fixed, &chain, states(&chain).take(10));
        assert!(report.passes(), "{report}");
    }
}

/// The comparison sees a payload that is left out.
#[test]
fn a_payload_makes_a_difference() {
    let chain = Geared6::CHAIN.carrying(&payload());
    let report = proof::compare(&Geared6::default(), &chain, states(&chain).take(5));
    let wrong = report.deviations().iter().filter(|line| !line.passes());
    let wrong: Vec<_> = wrong.map(|line| line.method).collect();
    for method in [
        "mass_matrix",
        "inverse_dynamics",
        "gravity_torque",
        "inverse_mass_matrix",
    ] {
        assert!(wrong.contains(&method), "{method} is right: {report}");
    }
    for method in ["forward_kinematics", "geometric_jacobian"] {
        assert!(!wrong.contains(&method), "{method} is wrong: {report}");
    }
}

#[test]
fn a_payload_may_change_between_two_calls() {
    let mut arm = Geared6::default();
    let state = states(&Geared6::CHAIN).next().unwrap();
    let empty = arm.gravity_torque(&state.q);
    arm.set_payload(payload()).unwrap();
    assert_eq!(arm.payload(), payload());
    let full = arm.gravity_torque(&state.q);
    assert!((full - empty).amax() > 1.0);
    arm.set_payload(Payload::NONE).unwrap();
    assert_eq!(arm.gravity_torque(&state.q), empty);
    assert_eq!(arm, Geared6::default());
}

#[test]
fn what_no_body_can_have_is_refused() {
    let none = [[0.0; 3]; 3];
    let diagonal = |x, y, z| [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    for mass in [-1.0, f64::NAN, f64::INFINITY, 2e6] {
        let refused = Payload::new(mass, [0.0; 3], none).unwrap_err();
        assert!(matches!(refused, PayloadError::Mass(_)), "{refused}");
    }
    for x in [f64::NAN, f64::NEG_INFINITY, 101.0] {
        let refused = Payload::new(1.0, [0.0, x, 0.0], none).unwrap_err();
        assert!(matches!(refused, PayloadError::Centroid(_)), "{refused}");
    }
    let lopsided = [[1.0, 0.1, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let refused = Payload::new(1.0, [0.0; 3], lopsided).unwrap_err();
    assert!(matches!(refused, PayloadError::Unsymmetric(_)), "{refused}");
    for inertia in [
        diagonal(-1.0, 1.0, 1.0),
        diagonal(1.0, 1.0, 2.1),
        diagonal(f64::NAN, 1.0, 1.0),
        diagonal(1e10, 1e10, 1e10),
    ] {
        let refused = Payload::new(1.0, [0.0; 3], inertia).unwrap_err();
        assert!(matches!(refused, PayloadError::Inertia(_)), "{refused}");
    }
    // An inertia without a mass.
    let refused = Payload::new(0.0, [0.0; 3], INERTIA).unwrap_err();
    assert!(matches!(refused, PayloadError::Inertia(_)), "{refused}");
    // A point, a thin rod and a plate are bodies.
    for inertia in [none, diagonal(1.0, 1.0, 0.0), diagonal(1.0, 1.0, 2.0)] {
        Payload::new(1.0, [0.1, 0.0, 0.0], inertia).unwrap();
    }
}

/// A link of 1e-8 kg·m² about its axis is lost beside a million kilograms; the arm goes on with what it had.
#[test]
fn what_drowns_a_link_is_refused() {
    let heavy = Payload::new(1e6, [90.0, 0.0, 0.0], [[0.0; 3]; 3]).unwrap();
    let mut chain = Geared6::CHAIN;
    chain.joints[4].link.mass = 1e-6;
    chain.joints[4].link.com = [0.0; 3];
    chain.joints[4].link.inertia = [[1e-9, 0.0, 0.0], [0.0, 1e-9, 0.0], [0.0, 0.0, 1e-9]];
    assert_eq!(
        chain.admit(&heavy),
        Err(PayloadError::TooHeavy { joint: 5 })
    );
    assert_eq!(chain.admit(&payload()), Ok(()));
}
