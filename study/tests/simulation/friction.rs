//! An arm whose table has rotors and friction: controllers know both, and the balances do.

use ulna::nalgebra::SVector;
use ulna::{Compensation, Controller, Friction, Motor, SerialChain};
use ulna_generated::Oblique6;
use ulna_study::simulation::{Brake, Control, Ending, Feedback, Resolution, Simulation};

use crate::{lock, oblique_motion, pushing};

/// The oblique arm with a rotor and friction in every joint.
fn geared() -> SerialChain<6> {
    let mut chain = Oblique6::CHAIN;
    for (joint, size) in chain.joints.iter_mut().zip([5.0, 4.0, 30.0, 1.0, 0.3, 0.1]) {
        joint.motor = Motor {
            inertia: size * 1e-4,
            ratio: 100.0,
        };
        joint.friction = Friction {
            viscous: size,
            coulomb: 2.0 * size,
            smoothing: 0.05,
        };
    }
    chain
}

#[test]
fn friction_takes_work_and_the_plan_is_kept_until_the_lock() {
    let (chain, motion) = (geared(), oblique_motion());
    let simulation = Simulation {
        plant: &chain,
        controller: Controller::new(&chain, Compensation::none())
            .with_rated_torque(SVector::repeat(f64::INFINITY)),
        trajectory: &motion,
        wrench: pushing,
        feedback: Feedback::critical(8.0),
        control: Control::Continuous,
        brake: Brake::new(lock(&[1], 1.2), 0.05),
        reflected_inertia: SVector::zeros(),
    };
    let mut off = 0.0_f64;
    let outcome = simulation
        .run(1.1..1.3, &Resolution::default(), |sample| {
            if sample.elapsed < 0.0 {
                off = off.max((sample.state.q - sample.planned.q).amax());
            }
        })
        .unwrap();
    assert_eq!(outcome.ending, Ending::Complete);
    assert!(off < 1e-9, "off the plan by {off:e}");
    let balance = outcome.balance;
    assert!(balance.work.friction < -0.1, "{:?}", balance.work);
    assert!(balance.energy_error < 1e-8, "{balance:?}");
    assert!(balance.momentum_error < 1e-8, "{balance:?}");
}
