//! Kinematics and dynamics against Pinocchio (`golden_pinocchio.py`).

use nalgebra::SMatrix;
use serde::Deserialize;
use ulna::Arm;
use ulna::proof::State;

use crate::{Errors, read, row_by_row, states, upper_triangle};

/// A line of `data/<arm>.jsonl`.
#[derive(Deserialize)]
struct Golden {
    pose: Vec<f64>,
    jacobian: Vec<f64>,
    jacobian_rate: Vec<f64>,
    mass_matrix: Vec<f64>,
    mass_matrix_rate: Vec<f64>,
    inverse_dynamics: Vec<f64>,
    bias_force: Vec<f64>,
    gravity_torque: Vec<f64>,
    forward_dynamics: Vec<f64>,
    /// Of an arm that has friction.
    #[serde(default)]
    friction_torque: Option<Vec<f64>>,
}

/// What rounding may leave, relative to the largest entry of each quantity.
const TOLERANCE: f64 = 1e-12;

pub(crate) fn agrees<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let mut errors = Errors::default();
    let golden = read::<Golden>(&format!("{name}.jsonl"));
    for (state, golden) in states(name).into_iter().zip(golden) {
        let State {
            q, qd, qdd, tau, ..
        } = state;
        let pose = arm.forward_kinematics(&q).to_homogeneous();
        errors.record(
            "pose",
            row_by_row(&pose.fixed_rows::<3>(0).into_owned()),
            &golden.pose,
        );
        errors.record(
            "J",
            row_by_row(&arm.geometric_jacobian(&q)),
            &golden.jacobian,
        );
        let dj = arm.jacobian_derivatives(&q);
        let rate: SMatrix<f64, 6, N> = (0..N).map(|i| dj[i] * qd[i]).sum();
        errors.record("dJ along qd", row_by_row(&rate), &golden.jacobian_rate);
        errors.record(
            "M",
            upper_triangle(&arm.mass_matrix(&q)),
            &golden.mass_matrix,
        );
        let dm = arm.mass_matrix_derivatives(&q);
        let rate: SMatrix<f64, N, N> = (0..N).map(|i| dm[i] * qd[i]).sum();
        errors.record(
            "dM along qd",
            upper_triangle(&rate),
            &golden.mass_matrix_rate,
        );
        let vectors = [
            (
                "inverse dynamics",
                arm.inverse_dynamics(&q, &qd, &qdd),
                &golden.inverse_dynamics,
            ),
            ("bias force", arm.bias_force(&q, &qd), &golden.bias_force),
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
        let friction = arm.friction_torque(&qd);
        let none = vec![0.0; N];
        let expected = golden.friction_torque.as_ref().unwrap_or(&none);
        errors.record("friction torque", friction.iter().copied(), expected);
        for (quantity, actual, expected) in vectors {
            errors.record(quantity, actual.iter().copied(), expected);
        }
    }
    errors.check(&format!("{backend} {name}"), TOLERANCE);
}
