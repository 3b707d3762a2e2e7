//! M and its derivatives.

use nalgebra::SMatrix;
use ulna::proof::State;
use ulna::{Arm, SerialChain};

use super::differences::derivative;
use super::exponentials::{Exponentials, slopes};
use super::{at_states, near};

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

pub(crate) fn mass_matrix_agrees_with_exponentials<const N: usize>(
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
    });
}

pub(crate) fn mass_matrix_derivatives_agree_with_dual_numbers<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, .. }| {
        let expected = slopes(&exponentials.mass_matrix(&Exponentials::dual(&q)));
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
