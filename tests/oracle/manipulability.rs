//! w_D, its gradient and M⁻¹ against 40 digits (`golden_mpmath.py`).

use serde::Deserialize;
use ulna::Arm;
use ulna::proof::State;

use crate::{Errors, read, states, upper_triangle};

/// A line of `data/<arm>.manipulability.jsonl`.
#[derive(Deserialize)]
struct Manipulability {
    w: f64,
    gradient: Vec<f64>,
    inverse_mass_matrix: Vec<f64>,
    condition: f64,
}

/// What rounding may leave, relative to the largest entry of each quantity.
const TOLERANCE: f64 = 1e-11;

pub(crate) fn agrees<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let exact = read::<Manipulability>(&format!("{name}.manipulability.jsonl"));
    let mut errors = Errors::default();
    let mut worst_condition = 0.0_f64;
    for (State { q, .. }, exact) in states(name).into_iter().zip(exact) {
        let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
        errors.record("w_D", [arm.dynamic_manipulability(&q)], &[exact.w]);
        errors.record("w_D with gradient", [w], &[exact.w]);
        errors.record("grad w_D", gradient.iter().copied(), &exact.gradient);
        errors.record(
            "inverse of M",
            upper_triangle(&arm.inverse_mass_matrix(&q)),
            &exact.inverse_mass_matrix,
        );
        worst_condition = worst_condition.max(exact.condition);
    }
    println!("{backend} {name}: condition of H up to {worst_condition:.0}");
    errors.check(&format!("{backend} {name}"), TOLERANCE);
}
