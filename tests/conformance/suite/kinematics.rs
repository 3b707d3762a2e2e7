//! The pose of the tool, J and its derivatives.

use nalgebra::{SMatrix, SVector};
use ulna::proof::State;
use ulna::{Arm, SerialChain};

use super::differences::derivative;
use super::exponentials::{Exponentials, slopes};
use super::{at_states, near};

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

pub(crate) fn jacobian_derivatives_agree_with_dual_numbers<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let exponentials = Exponentials::new(chain);
    at_states(chain, |State { q, .. }| {
        let expected = slopes(&exponentials.jacobian(&Exponentials::dual(&q)));
        let actual = arm.jacobian_derivatives(&q);
        near(
            actual.iter().flatten(),
            expected.iter().flatten(),
            0.0,
            1e-12,
            "dJ",
        );
    });
}
