//! Torques and accelerations, and how they hang together with M and with energy.

use nalgebra::{SMatrix, SVector};
use ulna::proof::{State, states};
use ulna::{Arm, SerialChain};

use super::differences::unit;
use super::exponentials::{Exponentials, slope};
use super::{at_states, near};

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

pub(crate) fn gravity_torque_is_the_slope_of_the_potential<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, .. }| {
        let expected = slope(&exponentials.potential(&Exponentials::dual(&q)));
        near(&arm.gravity_torque(&q), &expected, 0.0, 1e-12, "g");
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
        let power = qd.dot(&(tau - gravity - arm.friction_torque(&qd)));
        let kinetic = qd.dot(&(m * qdd)) + 0.5 * qd.dot(&(rate * qd));
        let scale = tau.amax();
        near([&power], [&kinetic], scale, 1e-12, "power");
    });
}

/// A fall in which motors do nothing but overcome friction: the sum of kinetic and potential energy stays, by Runge–Kutta's classical rule.
pub(crate) fn energy_is_conserved<const N: usize>(arm: &impl Arm<N>, chain: &SerialChain<N>) {
    let exponentials = Exponentials::new(chain);
    let energies = |q: &SVector<f64, N>, qd: &SVector<f64, N>| {
        let kinetic = 0.5 * qd.dot(&(arm.mass_matrix(q) * qd));
        (kinetic, exponentials.potential(q))
    };
    let State { mut q, mut qd, .. } = states(chain).next().expect("states have no end");
    let (kinetic, potential) = energies(&q, &qd);
    let fall = |q: &SVector<f64, N>, qd: &SVector<f64, N>| {
        arm.forward_dynamics(q, qd, &arm.friction_torque(qd))
    };
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
    at_states(
        chain,
        |State {
             q,
             qd,
             qdd,
             tau,
             wrench,
         }| {
            let torque = arm.inverse_dynamics(&q, &qd, &qdd);
            near(
                &arm.forward_dynamics(&q, &qd, &torque),
                &qdd,
                0.0,
                1e-9,
                "qdd",
            );
            let motion = arm.forward_dynamics(&q, &qd, &tau);
            let scale = arm.bias_force(&q, &qd).amax() + arm.friction_torque(&qd).amax();
            near(
                &arm.inverse_dynamics(&q, &qd, &motion),
                &tau,
                scale,
                1e-11,
                "tau",
            );
            let torque = arm.inverse_dynamics_with_wrench(&q, &qd, &qdd, &wrench);
            near(
                &arm.forward_dynamics_with_wrench(&q, &qd, &torque, &wrench),
                &qdd,
                0.0,
                1e-9,
                "qdd with a wrench",
            );
        },
    );
}

/// Principle of virtual work: what a wrench on the tool takes off the motors' power is its own, F · J q̇ for any rates.
pub(crate) fn a_wrench_does_the_work_of_the_tool<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(
        chain,
        |State {
             q,
             qd,
             qdd,
             tau,
             wrench,
         }| {
            let without = arm.inverse_dynamics(&q, &qd, &qdd);
            let with = arm.inverse_dynamics_with_wrench(&q, &qd, &qdd, &wrench);
            let twist = arm.geometric_jacobian(&q) * tau;
            let (power, expected) = ((without - with).dot(&tau), wrench.dot(&twist));
            let size = without.abs().dot(&tau.abs()) + wrench.abs().dot(&twist.abs());
            assert!(
                (power - expected).abs() <= 1e-13 * size,
                "{power} for {expected}"
            );
        },
    );
}
