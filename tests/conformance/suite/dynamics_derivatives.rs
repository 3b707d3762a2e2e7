//! Derivatives of torques and accelerations, and how they hang together with M, its derivatives and gravity.

use nalgebra::{SMatrix, SVector};
use ulna::proof::State;
use ulna::{Arm, SerialChain};

use super::differences::derivative;
use super::drives::friction_slope;
use super::exponentials::{Exponentials, slope, slopes};
use super::{at_states, near};

pub(crate) fn torque_derivatives_agree_with_differences<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, qdd, .. }| {
        let (by_q, by_qd) = arm.inverse_dynamics_derivatives(&q, &qd, &qdd);
        let scale = arm.inverse_dynamics(&q, &qd, &qdd).amax();
        let columns = derivative(&q, 0.05, |q| arm.inverse_dynamics(q, &qd, &qdd));
        near(&by_q, columns.iter().flatten(), scale, 1e-10, "dtau/dq");
        // Without friction, which such a step does not resolve.
        let of_links =
            |qd: &SVector<f64, N>| arm.inverse_dynamics(&q, qd, &qdd) - arm.friction_torque(qd);
        let columns = derivative(&qd, 0.5, of_links);
        let found = by_qd - friction_slope(chain, &qd);
        near(&found, columns.iter().flatten(), scale, 1e-12, "dtau/dqd");
    });
}

/// `τ = M q̈ + Σ_jk (∂M_ij/∂q_k − ½ ∂M_jk/∂q_i) q̇_j q̇_k + ∂V/∂q` (Siciliano, Eq. 7.44), M and V by exponentials,
/// their first derivatives by dual numbers.
pub(crate) fn torque_derivatives_agree_with_exponentials<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, qd, qdd, .. }| {
        let torque = |q: &SVector<f64, N>| {
            let dual = Exponentials::dual(q);
            let dm = slopes(&exponentials.mass_matrix(&dual));
            let rate: SMatrix<f64, N, N> = (0..N).map(|k| dm[k] * qd[k]).sum();
            let products = rate * qd - SVector::from_fn(|i, _| 0.5 * qd.dot(&(dm[i] * qd)));
            exponentials.mass_matrix(q) * qdd + products + slope(&exponentials.potential(&dual))
        };
        let (by_q, _) = arm.inverse_dynamics_derivatives(&q, &qd, &qdd);
        let columns = derivative(&q, 0.05, torque);
        let scale = torque(&q).amax();
        near(&by_q, columns.iter().flatten(), scale, 1e-10, "dtau/dq");
    });
}

/// At rest `∂τ/∂q_j = ∂M/∂q_j q̈ + ∂g/∂q_j`, and ∂g/∂q, the second derivative of the potential, is symmetric.
pub(crate) fn torque_derivatives_at_rest_are_those_of_the_mass_matrix_and_of_gravity<
    const N: usize,
>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qdd, .. }| {
        let rest = SVector::zeros();
        let (by_q, by_qd) = arm.inverse_dynamics_derivatives(&q, &rest, &qdd);
        let (stiffness, _) = arm.inverse_dynamics_derivatives(&q, &rest, &rest);
        let dm = arm.mass_matrix_derivatives(&q);
        let columns = core::array::from_fn::<_, N, _>(|j| dm[j] * qdd);
        let scale = stiffness.amax();
        let expected = SMatrix::from_columns(&columns) + stiffness;
        near(&by_q, &expected, scale, 1e-12, "dtau/dq at rest");
        near(&stiffness, &stiffness.transpose(), 0.0, 1e-12, "dg/dq");
        let friction = friction_slope(chain, &rest);
        near(&by_qd, &friction, 0.0, 1e-15, "dtau/dqd at rest");
    });
}

/// `∂τ_i/∂q̇_j = Σ_k (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i) q̇_k`, twice the Coriolis matrix of Christoffel's symbols:
/// its symmetric part is dM/dt. Friction apart.
pub(crate) fn torque_derivatives_by_rates_are_twice_the_coriolis_matrix<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, qd, qdd, .. }| {
        let (_, by_qd) = arm.inverse_dynamics_derivatives(&q, &qd, &qdd);
        let by_qd = by_qd - friction_slope(chain, &qd);
        let dm = slopes(&exponentials.mass_matrix(&Exponentials::dual(&q)));
        let rate: SMatrix<f64, N, N> = (0..N).map(|k| dm[k] * qd[k]).sum();
        let turned = SMatrix::<f64, N, N>::from_fn(|i, j| (dm[j] * qd)[i] - (dm[i] * qd)[j]);
        let scale = rate.amax();
        near(&by_qd, &(rate + turned), scale, 1e-12, "dtau/dqd");
        let symmetric = (by_qd + by_qd.transpose()) * 0.5;
        near(&symmetric, &rate, 0.0, 1e-12, "dM/dt");
    });
}

pub(crate) fn acceleration_derivatives_agree_with_differences<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, tau, .. }| {
        let (by_q, by_qd, by_tau) = arm.forward_dynamics_derivatives(&q, &qd, &tau);
        let scale = arm.forward_dynamics(&q, &qd, &tau).amax();
        let columns = derivative(&q, 0.01, |q| arm.forward_dynamics(q, &qd, &tau));
        near(&by_q, columns.iter().flatten(), scale, 1e-7, "dqdd/dq");
        // Without friction, which such a step does not resolve.
        let of_links =
            |qd: &SVector<f64, N>| arm.forward_dynamics(&q, qd, &(tau + arm.friction_torque(qd)));
        let columns = derivative(&qd, 0.5, of_links);
        let found = by_qd + by_tau * friction_slope(chain, &qd);
        near(&found, columns.iter().flatten(), scale, 1e-9, "dqdd/dqd");
        let columns = derivative(&tau, 0.5, |tau| arm.forward_dynamics(&q, &qd, tau));
        near(&by_tau, columns.iter().flatten(), scale, 1e-9, "dqdd/dtau");
    });
}

/// `∂q̈/∂τ M = 1`, and `M ∂q̈ = −∂τ` by coordinates and by rates, ∂τ at the accelerations that the torques make.
pub(crate) fn acceleration_derivatives_undo_torque_derivatives<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, tau, .. }| {
        let (by_q, by_qd, by_tau) = arm.forward_dynamics_derivatives(&q, &qd, &tau);
        let m = arm.mass_matrix(&q);
        let motion = arm.forward_dynamics(&q, &qd, &tau);
        let (torque_by_q, torque_by_qd) = arm.inverse_dynamics_derivatives(&q, &qd, &motion);
        near(
            &(by_tau * m),
            &SMatrix::<f64, N, N>::identity(),
            0.0,
            1e-9,
            "unity",
        );
        near(
            &by_tau,
            &arm.inverse_mass_matrix(&q),
            0.0,
            1e-13,
            "inverse of M",
        );
        let scale = |slopes: &SMatrix<f64, N, N>| 1e-3 * m.amax() * slopes.amax();
        near(&(m * by_q), &-torque_by_q, scale(&by_q), 1e-11, "M dqdd/dq");
        near(
            &(m * by_qd),
            &-torque_by_qd,
            scale(&by_qd),
            1e-11,
            "M dqdd/dqd",
        );
    });
}
