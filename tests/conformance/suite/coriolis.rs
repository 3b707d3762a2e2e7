//! The Coriolis matrix: C q̇ is what the bias force has beside gravity, and Ṁ − 2C is skew, whatever the rates.

use nalgebra::{SMatrix, SVector};
use ulna::proof::State;
use ulna::{Arm, SerialChain};

use super::{at_states, near};

pub(crate) fn the_coriolis_matrix_makes_the_bias_force<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, .. }| {
        let gravity = arm.gravity_torque(&q);
        let actual = arm.coriolis_matrix(&q, &qd) * qd + gravity;
        let scale = gravity.amax();
        near(
            &actual,
            &arm.bias_force(&q, &qd),
            scale,
            1e-12,
            "bias force",
        );
    });
}

/// Many matrices make the bias force; of Christoffel's symbols is the one that is linear in q̇, with `c_ijk = c_ikj`
/// (so that `C(q̇) q̈ = C(q̈) q̇`), and has `C + Cᵀ = Ṁ`.
pub(crate) fn the_coriolis_matrix_is_of_christoffels_symbols<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, qdd, .. }| {
        let coriolis = arm.coriolis_matrix(&q, &qd);
        let slopes = arm.mass_matrix_derivatives(&q);
        let rate: SMatrix<f64, N, N> = (0..N).map(|i| slopes[i] * qd[i]).sum();
        let scale = coriolis.amax();
        let skew = rate - coriolis * 2.0;
        near(
            &(skew + skew.transpose()),
            &SMatrix::<f64, N, N>::zeros(),
            scale,
            1e-13,
            "Ṁ − 2C",
        );

        let other = arm.coriolis_matrix(&q, &qdd);
        near(&(coriolis * qdd), &(other * qd), scale, 1e-12, "C(q̇) q̈");
        let both = arm.coriolis_matrix(&q, &(qd * 0.5 + qdd));
        near(&both, &(coriolis * 0.5 + other), scale, 1e-13, "C of a sum");
        let none = arm.coriolis_matrix(&q, &SVector::zeros());
        near(&none, &SMatrix::<f64, N, N>::zeros(), 1.0, 0.0, "C at rest");
    });
}
