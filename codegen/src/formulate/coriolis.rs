//! The Coriolis matrix of Christoffel's symbols c_ijk, from ∂M in closed form, as the sum of a symmetric and a skew-symmetric part.
//!
//! ∂M_ab/∂q_c is 0 unless c is beyond one of a and b. Of three joints a < b < c, x = ½ ∂M_ab/∂q_c and y = ½ ∂M_ac/∂q_b are left, and
//!
//! - c_abc = c_acb = x + y,
//! - c_bac = c_bca = x − y = −c_cab = −c_cba,
//!
//! so that x q̇_c is symmetric in (a, b) and x q̇_b skew in (a, c), y the other way round, and (x − y) q̇_a skew in (b, c). Of two joints a < c
//! there are c_aac = −c_caa = ½ ∂M_aa/∂q_c and c_acc = ∂M_ac/∂q_c, while c_cac and c_ccc are 0.
//!
//! Composite bodies with momenta and rates of their own (Echeandia and Wensing 2021) take fewer steps where joints are many. For six or seven
//! they take more operations: three wrenches of each joint would be carried to every joint before it, where ∂M needs one.

use super::chain::Chain;
use super::mass_matrix_derivatives::mass_matrix_derivatives;
use super::outputs::{named, named_rows};
use crate::graph::Expr;

/// C by rows, at rates `qd`.
pub(crate) fn coriolis_matrix<'g>(chain: &Chain<'g>, qd: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
    let n = chain.joint_count();
    let dm = mass_matrix_derivatives(chain);
    let half: Vec<Expr<'g>> = qd.iter().map(|rate| rate.of(0.5) * *rate).collect();
    let half = named(half, "hqd");
    let zeros = vec![vec![chain.graph.constant(0.0); n]; n];
    let (mut symmetric, mut skew) = (zeros.clone(), zeros.clone());
    let add = |part: &mut Vec<Vec<Expr<'g>>>, row: usize, column: usize, term: Expr<'g>| {
        part[row][column] = part[row][column] + term;
    };
    for b in 0..n {
        for c in b + 1..n {
            let own = dm[c][b][b];
            add(&mut symmetric, b, b, own * half[c]);
            add(&mut skew, b, c, own * half[b]);
            for a in 0..b {
                let (x, y) = (dm[c][a][b], dm[b][a][c]);
                add(&mut symmetric, a, b, x * half[c]);
                add(&mut skew, a, b, y * half[c]);
                add(&mut symmetric, a, c, y * half[b]);
                add(&mut skew, a, c, x * half[b]);
                add(&mut skew, b, c, (x - y).named("chr2", &[b, a, c]) * half[a]);
            }
        }
    }
    let symmetric = named_rows(symmetric, "sym");
    let skew = named_rows(skew, "skew");
    let mut matrix = zeros;
    for i in 0..n {
        matrix[i][i] = symmetric[i][i];
        for j in i + 1..n {
            matrix[i][j] = symmetric[i][j] + skew[i][j] + dm[j][i][j] * qd[j];
            matrix[j][i] = symmetric[i][j] - skew[i][j];
        }
    }
    matrix
}
