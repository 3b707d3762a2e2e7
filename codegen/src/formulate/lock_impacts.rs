//! The impact torques of all joints' locks, from M and ∂M.
//!
//! If joint k stops dead, Δq̇ = q̇_k e_k and Δq̈ = q̈_k e_k, and as the velocity terms of τ are quadratic, with Christoffel's symbols
//! Γ_i,jl = ½(∂M_ij/∂q_l + ∂M_il/∂q_j − ∂M_jl/∂q_i),
//!
//! Δτ_ik = M_ik q̈_k + 2 Σ_l Γ_i,kl q̇_k q̇_l − Γ_i,kk q̇_k².
//!
//! M_ij does not depend on the coordinates up to joint min(i, j). So three joints a < b < c have two slopes,
//! X = ∂M_ab/∂q_c and Y = ∂M_ac/∂q_b, and
//!
//! 2Γ_a,bc = X + Y, 2Γ_b,ac = X − Y, 2Γ_c,ab = Y − X;
//!
//! two joints a < b have two as well, and Γ_a,bb = ∂M_ab/∂q_b, 2Γ_a,ab = −2Γ_b,aa = ∂M_aa/∂q_b, Γ_b,ab = 0.
//! Each Γ_i,kl q̇_k q̇_l with k ≠ l is a term of two columns, k and l.
//!
//! Every term of column k has a factor q̇_k or q̈_k, so that the column of a joint at rest is 0 and not nearly that.
//! Constant terms on M's diagonal, such as inertias of rotors behind gears, come with M and have no slopes.

use super::chain::Chain;
use super::mass_matrix::mass_matrix;
use super::mass_matrix_derivatives::mass_matrix_derivatives;
use crate::graph::{Expr, Input};

/// Δτ by columns: column k for a lock of joint k.
pub(crate) fn lock_impacts<'g>(chain: &Chain<'g>) -> Vec<Vec<Expr<'g>>> {
    let n = chain.joint_count();
    let (mass, slopes) = (mass_matrix(chain), mass_matrix_derivatives(chain));
    let (qd, qdd) = (chain.inputs(Input::Qd), chain.inputs(Input::Qdd));
    let accelerated = |k: usize| mass[k].iter().map(|m| *m * qdd[k]).collect();
    let mut columns: Vec<Vec<Expr<'g>>> = (0..n).map(accelerated).collect();
    let mut add = |row: usize, column: usize, term: Expr<'g>| {
        columns[column][row] = columns[column][row] + term;
    };
    let slope = |i: usize, j: usize, k: usize| slopes[i][j][k];
    for b in 0..n {
        for a in 0..b {
            let own = slope(b, a, a);
            let rates = |j: usize, k: usize| (qd[j] * qd[k]).named("qqd", &[j, k]);
            let shared = (own * rates(a, b)).named("vel", &[a, a, b]);
            add(a, b, slope(b, a, b) * rates(b, b));
            add(a, b, shared);
            add(a, a, shared);
            add(b, a, -(own * (rates(a, a) * qd[a].of(0.5))));
            for c in b + 1..n {
                let (x, y) = (slope(c, a, b), slope(b, a, c));
                let of_a = ((x + y) * rates(b, c)).named("vel", &[a, b, c]);
                let of_b = ((x - y) * rates(a, c)).named("vel", &[b, a, c]);
                let of_c = ((y - x) * rates(a, b)).named("vel", &[c, a, b]);
                for (row, others, term) in [(a, [b, c], of_a), (b, [a, c], of_b), (c, [a, b], of_c)]
                {
                    for column in others {
                        add(row, column, term);
                    }
                }
            }
        }
    }
    for (k, column) in columns.iter().enumerate() {
        for (i, x) in column.iter().enumerate() {
            x.named("dtau", &[i, k]);
        }
    }
    columns
}
