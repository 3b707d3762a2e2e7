//! What the tool feels of the arm: Λ, J̄, and w with its gradient.

use nalgebra::{DMatrix, Matrix6, SVector};
use ulna::proof::State;
use ulna::{Arm, SerialChain, TaskRow};

use super::differences::derivative;
use super::{at_states, near};

/// 1 in the task's rows, 0 elsewhere.
fn identity<const N: usize>(arm: &impl Arm<N>) -> Matrix6<f64> {
    let mut identity = Matrix6::zeros();
    for row in arm.task().iter() {
        identity[(row.index(), row.index())] = 1.0;
    }
    identity
}

/// `Λ J M⁻¹ Jᵀ = 1` and `J J̄ = 1` over the task, `J̄ = M⁻¹ Jᵀ Λ`, and `Λ = J̄ᵀ M J̄`.
pub(crate) fn task_space_inertia_undoes_the_mobility_of_the_tool<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    let identity = identity(arm);
    at_states(chain, |State { q, .. }| {
        let jacobian = identity * arm.geometric_jacobian(&q);
        let inertia = arm.task_space_inertia(&q);
        let inverse = arm.dynamically_consistent_inverse(&q);
        assert_eq!(inertia, inertia.transpose(), "symmetric to the bit");
        assert_eq!(inertia, identity * inertia * identity, "0 outside the task");
        assert_eq!(inverse, inverse * identity, "0 outside the task");

        let mobility = arm.inverse_mass_matrix(&q) * jacobian.transpose();
        let product = inertia * (jacobian * mobility);
        near(&product, &identity, 0.0, 1e-8, "Λ J M⁻¹ Jᵀ");
        near(&(jacobian * inverse), &identity, 0.0, 1e-10, "J J̄");
        near(&inverse, &(mobility * inertia), 0.0, 1e-8, "J̄");
        let energies = inverse.transpose() * arm.mass_matrix(&q) * inverse;
        near(&inertia, &energies, 0.0, 1e-9, "Λ of J̄");
    });
}

pub(crate) fn kinematic_manipulability_is_that_of_its_own_jacobian<const N: usize>(
    arm: &impl Arm<N>,
    chain: &SerialChain<N>,
) {
    at_states(chain, |State { q, .. }| {
        let jacobian = arm.geometric_jacobian(&q);
        let rows: Vec<_> = arm.task().iter().map(TaskRow::index).collect();
        let task = DMatrix::from_fn(rows.len(), N, |r, c| jacobian[(rows[r], c)]);
        let squared = (&task * task.transpose()).determinant();
        let (w, gradient) = arm.manipulability_gradient(&q);
        near([&(w * w)], [&squared], 0.0, 1e-9, "w²");
        let slopes = derivative(&q, 5e-4, |q| {
            SVector::<f64, 1>::new(arm.manipulability_gradient(q).0)
        });
        near(&gradient, slopes.iter().flatten(), w, 1e-7, "grad w");
    });
}
