//! The paper's gradient, Eq. 23–27 with Eq. 25's determinants, beside two other forms of it.

use nalgebra::{DMatrix, SMatrix, SVector};
use ulna::generic::literal;
use ulna::proof::states;
use ulna::{Arm, SerialChain, TaskRow, TaskRows};

use crate::chain;

/// The adjoint form: with G = H Hᵀ and W = G⁻¹ H M⁻¹, `∂w_D/∂q_i = w_D (⟨W, ∂J/∂q_i⟩ − ⟨Hᵀ W, ∂M/∂q_i⟩)`.
fn adjoint<const N: usize>(arm: &SerialChain<N>, q: &SVector<f64, N>) -> SVector<f64, N> {
    let m_inverse = inverse(&dynamic(&arm.mass_matrix(q)));
    let h = of_task(arm.task, &arm.geometric_jacobian(q)) * &m_inverse;
    let w_matrix = inverse(&(&h * h.transpose())) * &h * &m_inverse;
    let by_mass = h.transpose() * &w_matrix;
    let [dj, dm] = [
        arm.jacobian_derivatives(q)
            .map(|dj| w_matrix.dot(&of_task(arm.task, &dj))),
        arm.mass_matrix_derivatives(q)
            .map(|dm| by_mass.dot(&dynamic(&dm))),
    ];
    (SVector::from(dj) - SVector::from(dm)) * arm.dynamic_manipulability(q)
}

/// H's largest singular value over its smallest.
fn condition<const N: usize>(arm: &SerialChain<N>, q: &SVector<f64, N>) -> f64 {
    let h = of_task(arm.task, &arm.geometric_jacobian(q)) * inverse(&dynamic(&arm.mass_matrix(q)));
    let singular_values = h.singular_values();
    singular_values.max() / singular_values.min()
}

fn of_task<const N: usize>(task: TaskRows, j: &SMatrix<f64, 6, N>) -> DMatrix<f64> {
    let rows: Vec<usize> = task.iter().map(TaskRow::index).collect();
    DMatrix::from_fn(rows.len(), N, |r, c| j[(rows[r], c)])
}

fn dynamic<const N: usize>(m: &SMatrix<f64, N, N>) -> DMatrix<f64> {
    DMatrix::from_fn(N, N, |r, c| m[(r, c)])
}

fn inverse(m: &DMatrix<f64>) -> DMatrix<f64> {
    m.clone().try_inverse().expect("not singular here")
}

/// Both forms with `H Hᵀ` lose the square of H's condition number. On `oblique_6`, where that is 4e9, the adjoint form
/// is off by up to 7e-9; Eq. 25's determinants, whose sum cancels besides, by 6e-5.
fn three_forms_agree<const N: usize>(arm: &SerialChain<N>) {
    for state in states(arm).take(6) {
        let q = state.q;
        let condition = condition(arm, &q);
        let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
        let printed = literal::manipulability_gradient(
            arm.task,
            w,
            &arm.geometric_jacobian(&q),
            &arm.mass_matrix(&q),
            &arm.jacobian_derivatives(&q),
            &arm.mass_matrix_derivatives(&q),
        );
        for (form, other) in [("as printed", printed), ("adjoint", adjoint(arm, &q))] {
            let error = (other - gradient).amax() / gradient.amax().max(w);
            assert!(
                error < 2e-12 * condition * condition,
                "{form} is off by {error:.1e} at {q}"
            );
        }
    }
}

#[test]
fn gradient_of_ssrms_in_three_forms() {
    three_forms_agree(&chain::<7>("ssrms"));
}

#[test]
fn gradient_of_table1_literal_in_three_forms() {
    three_forms_agree(&chain::<7>("table1_literal"));
}

#[test]
fn gradient_of_planar_2r_in_three_forms() {
    three_forms_agree(&chain::<2>("planar_2r"));
}

#[test]
fn gradient_of_oblique_6_in_three_forms() {
    three_forms_agree(&chain::<6>("oblique_6"));
}

/// Where w_D is 0, Eq. 23 would divide by it.
#[test]
fn printed_gradient_is_zero_where_w_is() {
    let arm = chain::<2>("planar_2r");
    let q = SVector::zeros();
    let gradient: SVector<f64, 2> = literal::manipulability_gradient(
        arm.task,
        0.0,
        &arm.geometric_jacobian(&q),
        &arm.mass_matrix(&q),
        &arm.jacobian_derivatives(&q),
        &arm.mass_matrix_derivatives(&q),
    );
    assert_eq!(gradient.norm(), 0.0);
}
