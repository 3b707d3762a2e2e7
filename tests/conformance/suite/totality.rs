//! Every method beside the others, and at every finite configuration.

use std::f64::consts::PI;

use nalgebra::{SMatrix, SVector};
use ulna::internal::numbers;
use ulna::proof::{State, states};
use ulna::{Arm, JointKind, Method, SerialChain};

use super::{at_states, near};

pub(crate) fn single_and_combined_methods_agree<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, qd, .. }| {
        let rest = SVector::zeros();
        let still = arm.inverse_dynamics(&q, &qd, &rest);
        let bias = arm.bias_force(&q, &qd) + arm.friction_torque(&qd);
        near(&bias, &still, 0.0, 1e-13, "bias force");
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
        for mut state in states(chain).take(2) {
            let q = state.q.map(|x| {
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
            state.q = q;
            for method in Method::ALL {
                numbers(arm, *method, &state, |x| {
                    assert!(!x.is_nan(), "{method} is NaN at q = {q}");
                });
            }
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
