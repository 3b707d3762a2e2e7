//! Dynamic manipulability w_D and its gradient (Eq. 15 and 22–27), by the adjoint.
//!
//! With H = JM⁻¹, G = HHᵀ and W = G⁻¹HM⁻¹, Eq. 23–27 come down to
//! ∂w_D/∂q_i = w_D (⟨W, ∂J/∂q_i⟩ − ⟨HᵀW, ∂M/∂q_i⟩): one reverse sweep through J and M, seeded with W and HᵀW,
//! gives every component at once.

use super::factorization::factor;
use crate::differentiate::reverse;
use crate::graph::Expr;

/// w_D, its gradient, and what tells how near to singular the task is.
pub struct Manipulability<'g> {
    /// w_D.
    pub value: Expr<'g>,
    /// ∇w_D.
    pub gradient: Vec<Expr<'g>>,
    /// The pivots of G = HHᵀ, each to be judged against the diagonal entry of the same index.
    pub pivots: Vec<Expr<'g>>,
    /// The diagonal of G.
    pub diagonal: Vec<Expr<'g>>,
}

/// w_D and ∇w_D of the task whose Jacobian is `jacobian` (by rows), with the mass matrix `mass`.
pub fn manipulability<'g>(
    jacobian: &[Vec<Expr<'g>>],
    mass: &[Vec<Expr<'g>>],
) -> Manipulability<'g> {
    let joints = mass.len();
    let mass_factors = factor(mass);
    let solve_rows = |rows: &[Vec<Expr<'g>>]| -> Vec<Vec<Expr<'g>>> {
        rows.iter().map(|row| mass_factors.solve(row)).collect()
    };
    let h = solve_rows(jacobian);
    let g: Vec<Vec<Expr<'g>>> = h
        .iter()
        .map(|a| h.iter().map(|b| dot(a, b)).collect())
        .collect();
    let g_factors = factor(&g);
    let determinant = product(&g_factors.pivots);
    let value = determinant.sqrt();

    let columns_of_h: Vec<Vec<Expr<'g>>> = (0..joints)
        .map(|i| g_factors.solve(&h.iter().map(|row| row[i]).collect::<Vec<_>>()))
        .collect();
    let rows: Vec<Vec<Expr<'g>>> = (0..h.len())
        .map(|r| columns_of_h.iter().map(|column| column[r]).collect())
        .collect();
    let w = solve_rows(&rows);
    let graph = value.graph();
    let mut seeded = Vec::new();
    for (j_row, w_row) in jacobian.iter().zip(&w) {
        seeded.extend(j_row.iter().copied().zip(w_row.iter().copied()));
    }
    let outer = |i: usize, j: usize| {
        let terms = h.iter().zip(&w).map(|(h_row, w_row)| h_row[i] * w_row[j]);
        terms.fold(graph.constant(0.0), |sum, term| sum + term)
    };
    for (i, row) in mass.iter().enumerate() {
        seeded.push((row[i], -outer(i, i)));
        for (j, entry) in row.iter().enumerate().skip(i + 1) {
            seeded.push((*entry, -(outer(i, j) + outer(j, i))));
        }
    }
    let logarithmic = reverse(graph, &seeded, joints);
    Manipulability {
        value,
        gradient: logarithmic.into_iter().map(|x| value * x).collect(),
        pivots: g_factors.pivots,
        diagonal: (0..g.len()).map(|r| g[r][r]).collect(),
    }
}

fn dot<'g>(a: &[Expr<'g>], b: &[Expr<'g>]) -> Expr<'g> {
    let terms = a.iter().zip(b).map(|(x, y)| *x * *y);
    terms.reduce(|sum, term| sum + term).unwrap_or(a[0])
}

fn product<'g>(factors: &[Expr<'g>]) -> Expr<'g> {
    factors
        .iter()
        .copied()
        .reduce(|p, x| p * x)
        .unwrap_or(factors[0])
}
