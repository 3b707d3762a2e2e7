//! w_D and its gradient.

use nalgebra::{DMatrix, Rotation3, SVector};
use ulna::proof::State;
use ulna::{Arm, SerialChain, TaskRow};

use super::differences::derivative;
use super::exponentials::{Exponentials, slope};
use super::{at_states, near};

/// Eq. 15 by nalgebra's determinant, in units in which M is near 1.
pub(crate) fn manipulability_is_that_of_its_own_jacobian_and_mass_matrix<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let j = arm.geometric_jacobian(&q);
        let m = arm.mass_matrix(&q);
        let rows: Vec<_> = arm.task().iter().map(TaskRow::index).collect();
        let task = DMatrix::from_fn(rows.len(), N, |r, c| j[(rows[r], c)]);
        let m = DMatrix::from_fn(N, N, |r, c| m[(r, c)]);
        let h = task * m.try_inverse().expect("M has an inverse");
        let product: f64 = h.singular_values().iter().product();
        near(
            [&arm.dynamic_manipulability(&q)],
            [&product],
            0.0,
            1e-9,
            "w_D",
        );
    });
}

pub(crate) fn manipulability_gradient_agrees_with_differences<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
        let slopes = derivative(&q, 5e-4, |q| {
            SVector::<f64, 1>::new(arm.dynamic_manipulability(q))
        });
        near(&gradient, slopes.iter().flatten(), w, 1e-7, "grad w_D");
    });
}

pub(crate) fn manipulability_agrees_with_dual_numbers<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, .. }| {
        let expected = exponentials.manipulability(&Exponentials::dual(&q));
        let expected_gradient = slope(&expected);
        let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
        near([&w], [&expected.re], 0.0, 1e-9, "w_D");
        near(&gradient, &expected_gradient, w, 1e-9, "grad w_D");
    });
}

/// w_D does not depend on q_1 if turning the world about joint 1 mixes the task's rows among themselves only.
pub(crate) fn manipulability_ignores_a_turn_of_the_whole_task<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let axis = arm
        .geometric_jacobian(&SVector::zeros())
        .column(0)
        .fixed_rows::<3>(3)
        .clone_owned();
    let turn = Rotation3::new(axis * 1.2);
    let in_task = |row: usize| arm.task().contains(TaskRow::ALL[row]);
    let keeps_the_task = (0..3).all(|row| {
        (0..3).all(|column| {
            let mixed = turn.matrix()[(row, column)].abs() > 1e-9;
            !mixed
                || [0, 3]
                    .iter()
                    .all(|block| in_task(block + row) == in_task(block + column))
        })
    });
    at_states(chain, |State { q, qd, .. }| {
        let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
        let mut moved = q;
        moved[0] += qd[0];
        let change = (arm.dynamic_manipulability(&moved) - w).abs() / w;
        let slope = gradient[0].abs() / gradient.amax();
        if keeps_the_task {
            assert!(slope < 1e-10, "dw_D/dq_1 is {slope:e} of the gradient");
            assert!(change < 1e-10, "w_D changes with q_1 by {change:e}");
        } else {
            assert!(
                slope > 1e-10,
                "the task's rows turn, so w_D must change with q_1"
            );
        }
    });
}
