//! What every implementation of [`Arm`] must do, whatever it is made of.
//!
//! A check takes the arm and its chain; the chain serves as the arm's description only
//! (kinds, lengths, masses, task), never for its formulas. A backend's module is one line:
//! `conformance!(arm, chain);`.

mod differences;
mod exponentials;

use std::f64::consts::PI;

use nalgebra::{Rotation3, SMatrix, SVector};
use ulna::proof::{State, states};
use ulna::{Arm, JointKind, SerialChain, TaskRow};

use differences::{derivative, unit};
use exponentials::Exponentials;

/// One test for each check.
macro_rules! conformance {
    ($arm:expr, $chain:expr) => {
        crate::suite::conformance! { $arm, $chain;
            mass_matrix_is_symmetric_positive_definite
            mass_matrix_has_the_columns_of_inverse_dynamics
            mass_matrix_does_not_depend_on_the_first_joint
            jacobian_is_the_derivative_of_the_kinematics
            jacobian_derivatives_agree_with_differences
            mass_matrix_derivatives_agree_with_differences
            manipulability_gradient_agrees_with_differences
            manipulability_is_that_of_its_own_jacobian_and_mass_matrix
            manipulability_ignores_a_turn_of_the_whole_task
            kinematics_agree_with_exponentials
            dynamics_agree_with_exponentials
            derivatives_agree_with_dual_numbers
            manipulability_agrees_with_dual_numbers
            velocity_products_follow_from_the_mass_matrix
            energy_is_conserved
            forward_dynamics_undo_inverse_dynamics
            single_and_combined_methods_agree
            any_finite_configuration_gives_numbers
            a_full_turn_changes_nothing
        }
    };
    ($arm:expr, $chain:expr; $($check:ident)*) => {
        $(
            #[test]
            fn $check() {
                crate::suite::$check(&$arm, &$chain);
            }
        )*
    };
}
pub(crate) use conformance;

fn at_states<const N: usize>(chain: &SerialChain<N>, check: impl FnMut(State<N>)) {
    states(chain).take(6).for_each(check);
}

/// Fails where two quantities differ by more than `tolerance` times the expected one's largest entry, or `scale` if that is larger.
#[track_caller]
fn near<'a>(
    actual: impl IntoIterator<Item = &'a f64>,
    expected: impl IntoIterator<Item = &'a f64>,
    scale: f64,
    tolerance: f64,
    what: &str,
) {
    let pairs: Vec<_> = actual.into_iter().zip(expected).collect();
    let largest = pairs.iter().fold(scale, |max, (_, e)| max.max(e.abs()));
    for (index, (actual, expected)) in pairs.into_iter().enumerate() {
        let error = (actual - expected).abs() / largest;
        assert!(
            error <= tolerance || actual == expected,
            "{what}, entry {index}: {actual:e} for {expected:e}, {error:.1e} of the largest"
        );
    }
}

pub(crate) fn mass_matrix_is_symmetric_positive_definite<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let m = arm.mass_matrix(&q);
        assert_eq!(m, m.transpose(), "symmetric to the bit");
        assert!(m.cholesky().is_some(), "positive definite: {m}");
    });
}

pub(crate) fn mass_matrix_has_the_columns_of_inverse_dynamics<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let rest = SVector::zeros();
        let columns = SMatrix::<f64, N, N>::from_columns(&core::array::from_fn::<_, N, _>(|j| {
            let unit = unit(j, 1.0);
            arm.inverse_dynamics(&q, &rest, &unit) - arm.gravity_torque(&q)
        }));
        let scale = arm.gravity_torque(&q).amax();
        near(&arm.mass_matrix(&q), &columns, scale, 1e-13, "M");
    });
}

pub(crate) fn mass_matrix_does_not_depend_on_the_first_joint<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, .. }| {
        let m = arm.mass_matrix(&q);
        let first = arm.mass_matrix_derivatives(&q)[0];
        near(
            &first,
            &SMatrix::<f64, N, N>::zeros(),
            m.amax(),
            1e-14,
            "dM/dq_1",
        );
        let mut moved = q;
        moved[0] += qd[0];
        near(&arm.mass_matrix(&moved), &m, 0.0, 1e-14, "M at another q_1");
    });
}

pub(crate) fn jacobian_is_the_derivative_of_the_kinematics<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let here = arm.forward_kinematics(&q).rotation;
        let rows = |q: &SVector<f64, N>| {
            let pose = arm.forward_kinematics(q);
            let rotation = pose.rotation.matrix() * here.matrix().transpose();
            let p = pose.translation.vector;
            // The skew part of R(q + h) R(q)ᵀ: its derivative is [ω×].
            let skew = (rotation - rotation.transpose()) * 0.5;
            SVector::<f64, 6>::new(p.x, p.y, p.z, skew.m32, skew.m13, skew.m21)
        };
        let columns = SMatrix::<f64, 6, N>::from_columns(&derivative(&q, 0.05, rows));
        near(&arm.geometric_jacobian(&q), &columns, 1.0, 1e-11, "J");
    });
}

pub(crate) fn jacobian_derivatives_agree_with_differences<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let expected = derivative(&q, 0.05, |q| arm.geometric_jacobian(q));
        let actual = arm.jacobian_derivatives(&q);
        near(
            actual.iter().flatten(),
            expected.iter().flatten(),
            1.0,
            1e-11,
            "dJ",
        );
    });
}

pub(crate) fn mass_matrix_derivatives_agree_with_differences<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let expected = derivative(&q, 0.05, |q| arm.mass_matrix(q));
        let actual = arm.mass_matrix_derivatives(&q);
        let scale = arm.mass_matrix(&q).amax();
        near(
            actual.iter().flatten(),
            expected.iter().flatten(),
            scale,
            1e-11,
            "dM",
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

/// Eq. 15 by nalgebra's determinant, in units in which M is near 1.
pub(crate) fn manipulability_is_that_of_its_own_jacobian_and_mass_matrix<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let j = arm.geometric_jacobian(&q);
        let m = arm.mass_matrix(&q);
        let rows: Vec<_> = arm.task().iter().map(TaskRow::index).collect();
        let task = nalgebra::DMatrix::from_fn(rows.len(), N, |r, c| j[(rows[r], c)]);
        let m = nalgebra::DMatrix::from_fn(N, N, |r, c| m[(r, c)]);
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

pub(crate) fn kinematics_agree_with_exponentials<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, .. }| {
        let pose = arm.forward_kinematics(&q);
        let (rotation, position) = exponentials.tool(&q);
        near(pose.rotation.matrix(), &rotation, 0.0, 1e-13, "R");
        near(&pose.translation.vector, &position, 1.0, 1e-13, "p");
        let expected = exponentials.jacobian(&q);
        near(&arm.geometric_jacobian(&q), &expected, 0.0, 1e-13, "J");
    });
}

pub(crate) fn dynamics_agree_with_exponentials<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, .. }| {
        near(
            &arm.mass_matrix(&q),
            &exponentials.mass_matrix(&q),
            0.0,
            1e-12,
            "M",
        );
        let slope = exponentials.potential(&Exponentials::dual(&q)).eps;
        let expected = slope.unwrap_generic(nalgebra::Const::<N>, nalgebra::Const::<1>);
        near(&arm.gravity_torque(&q), &expected, 0.0, 1e-12, "g");
    });
}

pub(crate) fn derivatives_agree_with_dual_numbers<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, .. }| {
        let dual = Exponentials::dual(&q);
        let expected = exponentials::slopes(&exponentials.jacobian(&dual));
        let actual = arm.jacobian_derivatives(&q);
        near(
            actual.iter().flatten(),
            expected.iter().flatten(),
            0.0,
            1e-12,
            "dJ",
        );
        let expected = exponentials::slopes(&exponentials.mass_matrix(&dual));
        let actual = arm.mass_matrix_derivatives(&q);
        near(
            actual.iter().flatten(),
            expected.iter().flatten(),
            0.0,
            1e-12,
            "dM",
        );
    });
}

pub(crate) fn manipulability_agrees_with_dual_numbers<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, .. }| {
        let expected = exponentials.manipulability(&Exponentials::dual(&q));
        let slope = expected
            .eps
            .unwrap_generic(nalgebra::Const::<N>, nalgebra::Const::<1>);
        let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
        near([&w], [&expected.re], 0.0, 1e-9, "w_D");
        near(&gradient, &slope, w, 1e-9, "grad w_D");
    });
}

/// `c(q, q̇)_i = Σ_jk (∂M_ij/∂q_k − ½ ∂M_jk/∂q_i) q̇_j q̇_k` (Siciliano, Eq. 7.44), and with it
/// the power balance `d/dt(½ q̇ᵀ M q̇) = q̇ᵀ(τ − g)`.
pub(crate) fn velocity_products_follow_from_the_mass_matrix<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, qdd, .. }| {
        let m = arm.mass_matrix(&q);
        let dm = arm.mass_matrix_derivatives(&q);
        let gravity = arm.gravity_torque(&q);
        let rate: SMatrix<f64, N, N> = (0..N).map(|k| dm[k] * qd[k]).sum();
        let products = rate * qd - SVector::from_fn(|i, _| 0.5 * qd.dot(&(dm[i] * qd)));
        let scale = gravity.amax();
        let actual = arm.bias_force(&q, &qd) - gravity;
        near(&actual, &products, scale, 1e-12, "bias force");

        let tau = arm.inverse_dynamics(&q, &qd, &qdd);
        let power = qd.dot(&(tau - gravity));
        let kinetic = qd.dot(&(m * qdd)) + 0.5 * qd.dot(&(rate * qd));
        let scale = tau.amax();
        near([&power], [&kinetic], scale, 1e-12, "power");
    });
}

/// A fall without torques: the sum of kinetic and potential energy stays, by Runge–Kutta's classical rule.
pub(crate) fn energy_is_conserved<const N: usize>(arm: &impl Arm<N>, chain: &SerialChain<N>) {
    let exponentials = Exponentials::new(chain);
    let energies = |q: &SVector<f64, N>, qd: &SVector<f64, N>| {
        let kinetic = 0.5 * qd.dot(&(arm.mass_matrix(q) * qd));
        (kinetic, exponentials.potential(q))
    };
    let State { mut q, mut qd, .. } = states(chain).next().expect("states have no end");
    let (kinetic, potential) = energies(&q, &qd);
    let free = SVector::zeros();
    let fall = |q: &SVector<f64, N>, qd: &SVector<f64, N>| arm.forward_dynamics(q, qd, &free);
    let h = 5e-4;
    let mut exchanged = 0.0_f64;
    for _ in 0..200 {
        let (v1, a1) = (qd, fall(&q, &qd));
        let (v2, a2) = (
            qd + a1 * (h / 2.0),
            fall(&(q + v1 * (h / 2.0)), &(qd + a1 * (h / 2.0))),
        );
        let (v3, a3) = (
            qd + a2 * (h / 2.0),
            fall(&(q + v2 * (h / 2.0)), &(qd + a2 * (h / 2.0))),
        );
        let (v4, a4) = (qd + a3 * h, fall(&(q + v3 * h), &(qd + a3 * h)));
        q += (v1 + v2 * 2.0 + v3 * 2.0 + v4) * (h / 6.0);
        qd += (a1 + a2 * 2.0 + a3 * 2.0 + a4) * (h / 6.0);
        exchanged = exchanged.max((energies(&q, &qd).0 - kinetic).abs());
    }
    let (now_kinetic, now_potential) = energies(&q, &qd);
    let drift = (now_kinetic + now_potential - kinetic - potential).abs();
    let scale = kinetic.max(exchanged);
    assert!(
        drift < 1e-9 * scale,
        "energy drifts by {:e} of {scale:e} J",
        drift / scale
    );
}

pub(crate) fn forward_dynamics_undo_inverse_dynamics<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, qdd, tau }| {
        let torque = arm.inverse_dynamics(&q, &qd, &qdd);
        near(
            &arm.forward_dynamics(&q, &qd, &torque),
            &qdd,
            0.0,
            1e-9,
            "qdd",
        );
        let motion = arm.forward_dynamics(&q, &qd, &tau);
        let scale = arm.bias_force(&q, &qd).amax();
        near(
            &arm.inverse_dynamics(&q, &qd, &motion),
            &tau,
            scale,
            1e-11,
            "tau",
        );
    });
}

pub(crate) fn single_and_combined_methods_agree<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, .. }| {
        let rest = SVector::zeros();
        let bias = arm.inverse_dynamics(&q, &qd, &rest);
        near(&arm.bias_force(&q, &qd), &bias, 0.0, 1e-13, "bias force");
        let gravity = arm.bias_force(&q, &rest);
        near(
            &arm.gravity_torque(&q),
            &gravity,
            0.0,
            1e-13,
            "gravity torque",
        );

        let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
        near(
            [&w],
            [&arm.dynamic_manipulability(&q)],
            0.0,
            1e-10,
            "w_D beside its gradient",
        );
        let (j, w_beside, gradient_beside) = arm.jacobian_and_gradient(&q);
        near(
            &j,
            &arm.geometric_jacobian(&q),
            0.0,
            1e-14,
            "J beside the gradient",
        );
        near([&w_beside], [&w], 0.0, 1e-10, "w_D beside J");
        near(&gradient_beside, &gradient, w, 1e-10, "gradient beside J");

        let (m, dm) = arm.mass_matrix_and_derivatives(&q);
        near(&m, &arm.mass_matrix(&q), 0.0, 1e-14, "M beside dM");
        let expected = arm.mass_matrix_derivatives(&q);
        near(
            dm.iter().flatten(),
            expected.iter().flatten(),
            0.0,
            1e-14,
            "dM beside M",
        );
    });
}

/// No NaN at any finite q, and sines that are still sines: rotations stay rotations.
pub(crate) fn any_finite_configuration_gives_numbers<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    for size in [0.0, 1e-300, 1e6, 1e10, 1e22, 1e300, f64::MAX] {
        for State { q, qd, qdd, tau } in states(chain).take(2) {
            let q = q.map(|x| {
                if size == f64::MAX {
                    size.copysign(x)
                } else {
                    x / PI * size
                }
            });
            let pose = arm.forward_kinematics(&q);
            let rotation = pose.rotation.matrix();
            near(
                &(rotation * rotation.transpose()),
                &SMatrix::<f64, 3, 3>::identity(),
                0.0,
                1e-12,
                "R Rᵀ",
            );
            let (m, dm) = arm.mass_matrix_and_derivatives(&q);
            let (j, w, gradient) = arm.jacobian_and_gradient(&q);
            let (w_beside, gradient_beside) = arm.dynamic_manipulability_gradient(&q);
            let numbers = [w, w_beside, arm.dynamic_manipulability(&q)]
                .into_iter()
                .chain(pose.to_homogeneous().iter().copied())
                .chain(j.iter().copied())
                .chain(arm.geometric_jacobian(&q).iter().copied())
                .chain(arm.jacobian_derivatives(&q).iter().flatten().copied())
                .chain(m.iter().copied())
                .chain(arm.mass_matrix(&q).iter().copied())
                .chain(dm.iter().flatten().copied())
                .chain(arm.mass_matrix_derivatives(&q).iter().flatten().copied())
                .chain(gradient.iter().copied())
                .chain(gradient_beside.iter().copied())
                .chain(arm.inverse_dynamics(&q, &qd, &qdd).iter().copied())
                .chain(arm.bias_force(&q, &qd).iter().copied())
                .chain(arm.gravity_torque(&q).iter().copied())
                .chain(arm.forward_dynamics(&q, &qd, &tau).iter().copied())
                .collect::<Vec<_>>();
            assert!(
                numbers.iter().all(|x| !x.is_nan()),
                "NaN at q = {q}: {numbers:?}"
            );
        }
    }
}

pub(crate) fn a_full_turn_changes_nothing<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let turned = SVector::from_fn(|i, _| match chain.joints[i].kind {
            JointKind::Revolute => q[i] - 2.0 * PI * q[i].signum(),
            JointKind::Prismatic => q[i],
        });
        near(
            &arm.geometric_jacobian(&turned),
            &arm.geometric_jacobian(&q),
            1.0,
            1e-14,
            "J",
        );
        near(
            &arm.mass_matrix(&turned),
            &arm.mass_matrix(&q),
            0.0,
            1e-14,
            "M",
        );
    });
}
