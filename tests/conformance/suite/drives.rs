//! Rotors and friction: where they count, and where they do not.

use nalgebra::{SMatrix, SVector};
use ulna::proof::State;
use ulna::{Arm, Friction, Motor, SerialChain};

use super::differences::derivative;
use super::{at_states, near};

/// The same arm without rotors and without friction.
fn bare<const N: usize>(chain: &SerialChain<N>) -> SerialChain<N> {
    let mut bare = *chain;
    for joint in &mut bare.joints {
        (joint.motor, joint.friction) = (Motor::NONE, Friction::NONE);
    }
    bare
}

/// What of the inverse dynamics is not the links': the rotors' and friction's share, N·m (N).
pub(super) fn torque_of_drives<const N: usize>(
    chain: &SerialChain<N>,
    qd: &SVector<f64, N>,
    qdd: &SVector<f64, N>,
) -> SVector<f64, N> {
    rotors(chain).component_mul(qdd) + friction(chain, qd)
}

/// Friction's closed form.
fn friction<const N: usize>(chain: &SerialChain<N>, qd: &SVector<f64, N>) -> SVector<f64, N> {
    SVector::from_fn(|i, _| {
        let Friction {
            viscous,
            coulomb,
            smoothing,
        } = chain.joints[i].friction;
        viscous * qd[i] + coulomb * qd[i] / qd[i].hypot(smoothing)
    })
}

/// Its slope by each joint's own rate: `viscous + coulomb ε² / (q̇² + ε²)^(3/2)`.
pub(super) fn friction_slope<const N: usize>(
    chain: &SerialChain<N>,
    qd: &SVector<f64, N>,
) -> SMatrix<f64, N, N> {
    SMatrix::from_diagonal(&SVector::from_fn(|i, _| {
        let Friction {
            viscous,
            coulomb,
            smoothing,
        } = chain.joints[i].friction;
        viscous + coulomb * smoothing.powi(2) / qd[i].hypot(smoothing).powi(3)
    }))
}

/// Inverse dynamics have friction's slope in their derivative by the rates: where Coulomb's friction turns, and far from there.
pub(crate) fn friction_has_its_slope<const N: usize>(arm: &impl Arm<N>, chain: &SerialChain<N>) {
    let bare = bare(chain);
    at_states(chain, |State { q, qd, qdd, .. }| {
        for size in [0.0, 1e-3, 1.0] {
            let qd = qd * size;
            let (_, by_qd) = arm.inverse_dynamics_derivatives(&q, &qd, &qdd);
            let (_, of_links) = bare.inverse_dynamics_derivatives(&q, &qd, &qdd);
            let expected = of_links + friction_slope(chain, &qd);
            near(&by_qd, &expected, 0.0, 1e-13, "dtau/dqd");
            // A step that resolves Coulomb's friction.
            let columns = derivative(&qd, 1e-4, |qd| arm.friction_torque(qd));
            let slope = friction_slope(chain, &qd);
            near(columns.iter().flatten(), &slope, 0.0, 1e-4, "df/dqd");
        }
    });
}

fn rotors<const N: usize>(chain: &SerialChain<N>) -> SVector<f64, N> {
    SVector::from_fn(|i, _| {
        let Motor { inertia, ratio } = chain.joints[i].motor;
        inertia * ratio.powi(2)
    })
}

pub(crate) fn rotors_add_to_the_diagonal_of_the_mass_matrix<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let (bare, rotors) = (bare(chain), SMatrix::from_diagonal(&rotors(chain)));
    at_states(chain, |State { q, .. }| {
        let expected = bare.mass_matrix(&q) + rotors;
        near(&arm.mass_matrix(&q), &expected, 0.0, 1e-13, "M");
        let inverse = arm.inverse_mass_matrix(&q) * expected;
        near(
            &inverse,
            &SMatrix::<f64, N, N>::identity(),
            0.0,
            1e-8,
            "M^-1 M",
        );
        let (found, expected) = (
            arm.mass_matrix_derivatives(&q),
            bare.mass_matrix_derivatives(&q),
        );
        let (found, expected) = (found.iter().flatten(), expected.iter().flatten());
        near(found, expected, bare.mass_matrix(&q).amax(), 1e-13, "dM");
    });
}

pub(crate) fn friction_is_its_closed_form<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let rest = SVector::<f64, N>::zeros();
    assert_eq!(arm.friction_torque(&rest), rest);
    at_states(chain, |State { qd, .. }| {
        for size in [1e-4, 1.0, 1e3, 1e100] {
            let qd = qd * size;
            let expected = friction(chain, &qd);
            let found = arm.friction_torque(&qd);
            near(&found, &expected, 0.0, 1e-14, "friction");
            assert!(found.component_mul(&qd).min() >= 0.0, "it takes power");
            assert_eq!(arm.friction_torque(&-qd), -found, "either way the same");
        }
    });
}

pub(crate) fn nothing_else_sees_rotors_and_friction<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let (bare, rotors) = (bare(chain), rotors(chain));
    at_states(chain, |State { q, qd, qdd, .. }| {
        let pairs = [
            (arm.bias_force(&q, &qd), bare.bias_force(&q, &qd)),
            (arm.gravity_torque(&q), bare.gravity_torque(&q)),
            (
                arm.inverse_dynamics(&q, &qd, &qdd),
                bare.inverse_dynamics(&q, &qd, &qdd)
                    + rotors.component_mul(&qdd)
                    + arm.friction_torque(&qd),
            ),
        ];
        for (found, expected) in pairs {
            near(&found, &expected, 0.0, 1e-12, "torque");
        }
        let (found, expected) = (arm.geometric_jacobian(&q), bare.geometric_jacobian(&q));
        near(&found, &expected, 0.0, 1e-13, "J");
    });
}
