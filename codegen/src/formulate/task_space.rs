//! Task-space inertia Λ and the dynamically consistent inverse J̄ (Khatib 1987), from J's rows made orthogonal.
//!
//! With M = U D Uᵀ and Y = J U⁻ᵀ, Λ⁻¹ = J M⁻¹ Jᵀ is Y D⁻¹ Yᵀ. It is not formed, which would square Y's condition number: the modified
//! Gram–Schmidt process in the product x D⁻¹ y writes Y = S R, R's rows orthogonal with squared lengths P, S unit triangular, and then
//!
//! - Λ = S⁻ᵀ P⁻¹ S⁻¹,
//! - J̄ = U⁻ᵀ D⁻¹ Rᵀ P⁻¹ S⁻¹: U⁻ᵀ times the rows' dual basis.
//!
//! D⁻¹ within the product saves the square roots that Cholesky's factor of M would take.
//!
//! S and P are as exact as Y's rounding lets them be after one pass (Björck 1967), so Λ has a pass less than J̄, whose R must be
//! orthogonal too: with one, J̄ of oblique_6 has 1e-9 where 1e-11 can be had, at 1e-4 from a singular pose.

use super::chain::Chain;
use super::factorization::Factors;
use super::manipulability::{OF_TASK, Orthogonal, orthogonalise_in, volume_squared};
use super::outputs::named_rows;
use super::task::{number, task_rows_in_world};
use super::{Choices, Outputs, factors};
use crate::graph::Expr;
use crate::schedule::{Output, Size};

/// What both results are made of.
struct Foundations<'g> {
    rows: Vec<Vec<Expr<'g>>>,
    /// Of each of `rows`, its place in J.
    places: Vec<usize>,
    factors: Factors<'g>,
    basis: Orthogonal<'g>,
}

fn foundations<'g>(chain: &Chain<'g>, choices: Choices, passes: usize) -> Foundations<'g> {
    let (places, rows): (Vec<usize>, Vec<_>) =
        task_rows_in_world(chain, choices).into_iter().unzip();
    let factors = factors(chain, choices);
    let halfway: Vec<_> = rows.iter().map(|row| factors.solve_upper(row)).collect();
    let halfway = named_rows(halfway, "ty");
    let basis = orthogonalise_in(&halfway, Some(&factors.inverse_pivots), passes, &OF_TASK);
    Foundations {
        rows,
        places,
        factors,
        basis,
    }
}

/// Λ by columns, 0 outside the task, and det(JJᵀ) over the task's rows.
pub(super) fn task_space_inertia<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let zero = chain.graph.constant(0.0);
    let mut inertia = vec![vec![zero; 6]; 6];
    let mut volume = zero;
    if !choices.singular {
        let found = foundations(chain, choices, choices.passes - 1);
        let inverse_shares = found.basis.inverse_shares();
        for (r, row) in found.places.iter().enumerate() {
            for (c, column) in found.places.iter().enumerate().skip(r) {
                // S⁻¹ is lower triangular: its columns r and c meet from row c on.
                let terms = (c..found.places.len()).map(|k| {
                    inverse_shares[k][r] * inverse_shares[k][c] * found.basis.inverse_pivot(k)
                });
                let entry = terms.fold(zero, |sum, x| sum + x);
                entry.labelled("lambda", || format!("lambda_{}_{}", row + 1, column + 1));
                inertia[*row][*column] = entry;
                inertia[*column][*row] = entry;
            }
        }
        volume = volume_squared(&found.rows);
    }
    vec![
        Output::new("inertia", &[6, 6], inertia.concat()),
        number("volume", volume).relative_to(Size::Any),
    ]
}

/// J̄ by columns, 0 outside the task, and det(JJᵀ) over the task's rows.
pub(super) fn dynamically_consistent_inverse<'g>(
    chain: &Chain<'g>,
    choices: Choices,
) -> Outputs<'g> {
    let zero = chain.graph.constant(0.0);
    let mut columns = vec![vec![zero; chain.joint_count()]; 6];
    let mut volume = zero;
    if !choices.singular {
        let found = foundations(chain, choices, choices.passes);
        for (place, dual) in found.places.iter().zip(found.basis.duals()) {
            columns[*place] = found.factors.solve_upper_transposed(&dual);
        }
        volume = volume_squared(&found.rows);
    }
    vec![
        Output::new("inverse", &[6, chain.joint_count()], columns.concat()),
        number("volume", volume).relative_to(Size::Any),
    ]
}
