//! An arm with rotors and friction that falls: its energy goes into friction, and nowhere else.

use nalgebra::SVector;
use ulna::{Arm, SerialChain};
use ulna_codegen::Interpreter;
use ulna_table::Model;

/// `geared_6` with friction that is smoothed over so wide a range of rates that steps of half a millisecond resolve it.
fn smooth() -> Model {
    let mut description = crate::model("geared_6").description();
    for joint in &mut description.joints {
        joint.friction.smoothing = 2.0;
    }
    Model::new(&description).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Kinetic and potential energy and what friction has taken, by Runge and Kutta's rule.
fn balance(arm: &impl Arm<6>) {
    type Flow = (SVector<f64, 6>, SVector<f64, 6>, f64, f64);
    let free = SVector::zeros();
    let slope = |(q, qd, ..): &Flow| -> Flow {
        let friction = arm.friction_torque(qd).dot(qd);
        let gravity = arm.gravity_torque(q).dot(qd);
        (*qd, arm.forward_dynamics(q, qd, &free), friction, gravity)
    };
    let along = |from: &Flow, by: &Flow, h: f64| {
        (
            from.0 + by.0 * h,
            from.1 + by.1 * h,
            from.2 + by.2 * h,
            from.3 + by.3 * h,
        )
    };
    let kinetic = |(q, qd, ..): &Flow| 0.5 * qd.dot(&(arm.mass_matrix(q) * qd));
    let start = (
        SVector::from([0.3, 0.1, -0.8, 1.1, 0.4, -0.6]),
        SVector::from([1.5, -0.4, 0.9, -2.0, 1.0, 2.5]),
        0.0,
        0.0,
    );
    let (mut now, h) = (start, 5e-4);
    for _ in 0..200 {
        let k1 = slope(&now);
        let k2 = slope(&along(&now, &k1, h / 2.0));
        let k3 = slope(&along(&now, &k2, h / 2.0));
        let k4 = slope(&along(&now, &k3, h));
        for (k, share) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            now = along(&now, &k, share * h / 6.0);
        }
    }
    let taken = kinetic(&start) - kinetic(&now);
    let (friction, potential) = (now.2, now.3);
    assert!(
        friction > 0.1 * kinetic(&start),
        "{friction} J of {} J",
        kinetic(&start)
    );
    let missing = (taken - friction - potential).abs();
    assert!(
        missing < 1e-9 * kinetic(&start),
        "{missing:e} J are missing"
    );
}

#[test]
fn energy_goes_into_friction() {
    let model = smooth();
    balance(&SerialChain::try_from(&model).unwrap_or_else(|error| panic!("{error}")));
    balance(&Interpreter::new(&model).unwrap_or_else(|error| panic!("{error}")));
}

#[test]
fn names_are_those_of_the_table() {
    assert_eq!(
        ulna_generated::Geared6::JOINT_NAMES.as_slice(),
        crate::model("geared_6").joint_names()
    );
    assert_eq!(
        ulna_generated::Planar2r::JOINT_NAMES,
        ["joint 1", "joint 2"]
    );
}
