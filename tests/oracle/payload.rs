//! An arm that carries a payload against Pinocchio's, which has the body as a part of its last link (`golden_payload.py`).

use serde::Deserialize;
use ulna::proof::State;
use ulna::{Arm, Payload, SerialChain};
use ulna_generated::Geared6;

use crate::{Errors, chain, read, states, upper_triangle};

/// A line of `data/<arm>.payload.jsonl`.
#[derive(Deserialize)]
struct Golden {
    mass: [f64; 1],
    com: [f64; 3],
    inertia: [f64; 6],
    mass_matrix: Vec<f64>,
    inverse_dynamics: Vec<f64>,
    gravity_torque: Vec<f64>,
    forward_dynamics: Vec<f64>,
}

/// What rounding may leave, relative to the largest entry of each quantity.
const TOLERANCE: f64 = 1e-12;

fn agrees<A: Arm<N>, const N: usize>(backend: &str, name: &str, carrying: impl Fn(&Payload) -> A) {
    let mut errors = Errors::default();
    let golden = read::<Golden>(&format!("{name}.payload.jsonl"));
    for (state, golden) in states(name).into_iter().zip(golden) {
        let State {
            q, qd, qdd, tau, ..
        } = state;
        let [xx, xy, xz, yy, yz, zz] = golden.inertia;
        let inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let payload = Payload::new(golden.mass[0], golden.com, inertia).unwrap();
        let arm = carrying(&payload);
        errors.record(
            "M",
            upper_triangle(&arm.mass_matrix(&q)),
            &golden.mass_matrix,
        );
        let vectors = [
            (
                "inverse dynamics",
                arm.inverse_dynamics(&q, &qd, &qdd),
                &golden.inverse_dynamics,
            ),
            (
                "gravity torque",
                arm.gravity_torque(&q),
                &golden.gravity_torque,
            ),
            (
                "forward dynamics",
                arm.forward_dynamics(&q, &qd, &tau),
                &golden.forward_dynamics,
            ),
        ];
        for (quantity, actual, expected) in vectors {
            errors.record(quantity, actual.iter().copied(), expected);
        }
    }
    errors.check(&format!("{backend} {name} with payloads"), TOLERANCE);
}

#[test]
fn generic() {
    let chain: SerialChain<6> = chain("geared_6");
    agrees("generic", "geared_6", |payload| chain.carrying(payload));
}

#[test]
fn generated() {
    agrees("generated", "geared_6", |payload| {
        Geared6::carrying(*payload).unwrap()
    });
}
