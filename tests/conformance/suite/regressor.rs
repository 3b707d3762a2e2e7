//! τ = Y π, and what follows from it.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use ulna::proof::{State, states};
use ulna::{Arm, SerialChain};

use super::differences::unit;
use super::drives::torque_of_drives;
use super::{at_states, near};

type Regressor<const N: usize> = [SMatrix<f64, N, 10>; N];

/// Y π, and the largest that a term of it is.
fn torque<const N: usize>(
    regressor: &Regressor<N>,
    chain: &SerialChain<N>,
) -> (SVector<f64, N>, f64) {
    let (mut torque, mut largest) = (SVector::zeros(), 0.0_f64);
    for (block, joint) in regressor.iter().zip(&chain.joints) {
        for (column, parameter) in block.column_iter().zip(joint.link.parameters()) {
            torque += column * parameter;
            largest = largest.max(column.amax() * parameter.abs());
        }
    }
    (torque, largest)
}

pub(crate) fn regressor_times_parameters_is_the_torque<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, qdd, .. }| {
        let rest = SVector::zeros();
        let torques = [
            (
                qd,
                qdd,
                arm.inverse_dynamics(&q, &qd, &qdd) - torque_of_drives(chain, &qd, &qdd),
                "tau",
            ),
            (qd, rest, arm.bias_force(&q, &qd), "bias force"),
            (rest, rest, arm.gravity_torque(&q), "gravity torque"),
        ];
        for (qd, qdd, expected, what) in torques {
            let (actual, scale) = torque(&arm.regressor(&q, &qd, &qdd), chain);
            near(&actual, &expected, scale, 1e-13, what);
        }
    });
}

/// M e_j is what a unit acceleration adds to the torque of gravity.
pub(crate) fn regressor_has_the_mass_matrix_in_it<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let rest = SVector::zeros();
        let still = arm.regressor(&q, &rest, &rest);
        let mass_matrix = arm.mass_matrix(&q);
        for j in 0..N {
            let moved = arm.regressor(&q, &rest, &unit(j, 1.0));
            let (_, scale) = torque(&moved, chain);
            let added = core::array::from_fn(|i| moved[i] - still[i]);
            let (column, _) = torque(&added, chain);
            let rotor = torque_of_drives(chain, &rest, &unit(j, 1.0));
            let expected = mass_matrix.column(j) - rotor;
            near(&column, &expected, scale, 1e-12, "M");
        }
    });
}

/// No joint carries the links before its own.
pub(crate) fn regressor_is_zero_below_its_link<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, qdd, .. }| {
        for (i, block) in arm.regressor(&q, &qd, &qdd).iter().enumerate() {
            for row in block.row_iter().skip(i + 1) {
                assert!(row.iter().all(|x| *x == 0.0), "link {i}: {row}");
            }
        }
    });
}

/// How many states are stacked.
const STACKED: usize = 20;

/// A regressor at many states, one below the other, N·states × 10N; in units of its columns' lengths.
fn stacked<const N: usize>(
    chain: &SerialChain<N>,
    regressor: impl Fn(&State<N>) -> Regressor<N>,
) -> DMatrix<f64> {
    let mut stacked = DMatrix::zeros(STACKED * N, 10 * N);
    for (index, state) in states(chain).take(STACKED).enumerate() {
        for (link, block) in regressor(&state).iter().enumerate() {
            let place = (index * N, link * 10);
            stacked.view_mut(place, (N, 10)).copy_from(block);
        }
    }
    stacked
}

/// How many independent columns; each is compared with its own length.
fn rank(matrix: &DMatrix<f64>) -> usize {
    let mut matrix = matrix.clone();
    for mut column in matrix.column_iter_mut() {
        let length = column.norm();
        if length > 1e-12 {
            column /= length;
        }
    }
    let values = matrix.singular_values();
    values.iter().filter(|x| **x > 1e-9 * values.max()).count()
}

pub(crate) fn base_columns_are_those_of_the_regressor_and_are_independent<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let full = stacked(chain, |state| {
        arm.regressor(&state.q, &state.qd, &state.qdd)
    });
    let base = stacked(chain, |state| {
        arm.base_regressor(&state.q, &state.qd, &state.qdd)
    });
    let mut count = 0;
    for (column, full) in base.column_iter().zip(full.column_iter()) {
        if column.amax() > 0.0 {
            count += 1;
            near(column.iter(), full.iter(), 0.0, 1e-13, "a base column");
        }
    }
    assert_eq!(count, rank(&base), "base columns depend on each other");
    assert_eq!(count, rank(&full), "others do not depend on them");
}

/// Parameters of the base columns that fit the torques of some motions give the torques of others.
pub(crate) fn base_columns_are_enough_for_every_torque<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let torque_of_links = |q: &SVector<f64, N>, qd: &SVector<f64, N>, qdd: &SVector<f64, N>| {
        arm.inverse_dynamics(q, qd, qdd) - torque_of_drives(chain, qd, qdd)
    };
    let base = stacked(chain, |state| {
        arm.base_regressor(&state.q, &state.qd, &state.qdd)
    });
    let torques = states(chain)
        .take(STACKED)
        .map(|State { q, qd, qdd, .. }| torque_of_links(&q, &qd, &qdd));
    let torques: Vec<f64> = torques
        .flat_map(|tau| tau.iter().copied().collect::<Vec<_>>())
        .collect();
    let decomposed = base.svd(true, true);
    let parameters = decomposed
        .solve(&DVector::from_vec(torques), 1e-9)
        .expect("both factors are there");
    for State { q, qd, qdd, .. } in states(chain).skip(STACKED).take(6) {
        let blocks = arm.base_regressor(&q, &qd, &qdd);
        let fitted = (0..N).map(|link| blocks[link] * parameters.fixed_rows::<10>(link * 10));
        let fitted: SVector<f64, N> = fitted.sum();
        let expected = torque_of_links(&q, &qd, &qdd);
        near(&fitted, &expected, 0.0, 1e-10, "tau");
    }
}
