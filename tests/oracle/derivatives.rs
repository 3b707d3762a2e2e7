//! Derivatives of inverse and forward dynamics against Pinocchio (`golden_derivatives.py`).

use nalgebra::{DMatrix, SMatrix};
use serde::Deserialize;
use ulna::Arm;
use ulna::proof::State;

use crate::{Errors, read, row_by_row, states, upper_triangle};

/// A line of `data/<arm>.derivatives.jsonl`.
#[derive(Deserialize)]
struct Golden {
    inverse_dynamics_by_q: Vec<f64>,
    inverse_dynamics_by_qd: Vec<f64>,
    forward_dynamics_by_q: Vec<f64>,
    forward_dynamics_by_qd: Vec<f64>,
    forward_dynamics_by_tau: Vec<f64>,
}

/// What rounding may leave of ∂τ, relative to the largest entry.
const TOLERANCE: f64 = 1e-12;
/// Of ∂q̈, relative to the largest entry and to the condition number of M: on both sides it is solved for with an M that is rounded.
/// Pinocchio's M⁻¹ is that of articulated bodies, and as far off as M's condition says, whatever the units.
const CONDITIONED: f64 = 1e-15;

pub(crate) fn agrees<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let (mut torques, mut accelerations) = (Errors::default(), Errors::default());
    let mut largest = 0.0_f64;
    let golden = read::<Golden>(&format!("{name}.derivatives.jsonl"));
    for (state, golden) in states(name).into_iter().zip(golden) {
        let State {
            q, qd, qdd, tau, ..
        } = state;
        let (by_q, by_qd) = arm.inverse_dynamics_derivatives(&q, &qd, &qdd);
        torques.record("dtau/dq", row_by_row(&by_q), &golden.inverse_dynamics_by_q);
        torques.record(
            "dtau/dqd",
            row_by_row(&by_qd),
            &golden.inverse_dynamics_by_qd,
        );
        let (by_q, by_qd, by_tau) = arm.forward_dynamics_derivatives(&q, &qd, &tau);
        let condition = condition(&arm.mass_matrix(&q));
        largest = largest.max(condition);
        let quantities = [
            (
                "dqdd/dq / cond M",
                row_by_row(&by_q),
                golden.forward_dynamics_by_q,
            ),
            (
                "dqdd/dqd / cond M",
                row_by_row(&by_qd),
                golden.forward_dynamics_by_qd,
            ),
            (
                "dqdd/dtau / cond M",
                upper_triangle(&by_tau),
                golden.forward_dynamics_by_tau,
            ),
        ];
        for (quantity, actual, expected) in quantities {
            accelerations.record_conditioned(quantity, actual, &expected, condition);
        }
    }
    println!("{backend} {name}: condition of M up to {largest:.0}");
    let arm = format!("{backend} {name}");
    torques.check(&arm, TOLERANCE);
    accelerations.check(&arm, CONDITIONED);
}

/// The condition number of M.
fn condition<const N: usize>(mass: &SMatrix<f64, N, N>) -> f64 {
    let values = DMatrix::from_iterator(N, N, mass.iter().copied()).symmetric_eigenvalues();
    values.max() / values.min()
}
