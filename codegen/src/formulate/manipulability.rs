//! Dynamic manipulability w_D and its gradient (Eq. 15 and 22–27), by the adjoint.
//!
//! With H = JM⁻¹, G = HHᵀ and W = G⁻¹HM⁻¹, Eq. 23–27 come down to
//! ∂w_D/∂q_i = w_D (⟨W, ∂J/∂q_i⟩ − ⟨HᵀW, ∂M/∂q_i⟩): one reverse sweep through J and M, seeded with W and HᵀW,
//! gives every component at once.
//!
//! G itself is never formed: it would square H's condition number. The modified Gram–Schmidt process on H's rows
//! (Golub and Van Loan, Matrix Computations, section 5.2.8) gives w_D as the product of what is left of the rows' lengths,
//! and G⁻¹H as the rows' dual basis, for fewer operations besides. Each row goes through it twice
//! (Giraud, Langou and Rozložník 2005: twice is enough). Once is not: a light last link makes H's rows nearly parallel
//! (its column of H goes as one over its inertia I), and near a singular pose they are so anyway; once leaves an error that grows
//! as 1/I², and 1e-9 at 1e-6 rad from a stretched elbow, twice leaves rounding. A third time is for arms whose inertias differ so much
//! (1e12) that what is left along a light joint must be exact by itself, M⁻¹ multiplying it once more.
//!
//! Nor is the order of the rows free where H's columns differ by orders of magnitude: a row without a light joint's large entry, taken
//! off a row with one, leaves rounding of that entry's size in all others. The generator tries the order in which H's rows
//! are longest first (Cox and Higham 1998 on row-wise stability).
//!
//! det(JJᵀ), by which the task is judged to be singular or not (`ulna::arm::singular`), needs J's rows made orthogonal too,
//! once: only its size counts.

use super::factorization::{Factors, factor};
use crate::differentiate::reverse;
use crate::graph::Expr;

type Row<'g> = Vec<Expr<'g>>;

/// w_D, its gradient, and what tells whether the task is singular.
pub(crate) struct Manipulability<'g> {
    /// w_D.
    pub value: Expr<'g>,
    /// ∇w_D.
    pub gradient: Vec<Expr<'g>>,
    /// det(JJᵀ).
    pub volume_squared: Expr<'g>,
}

impl<'g> Manipulability<'g> {
    /// What a task has that is singular in every configuration.
    pub(crate) fn zero(zero: Expr<'g>, joints: usize) -> Self {
        Self {
            value: zero,
            gradient: vec![zero; joints],
            volume_squared: zero,
        }
    }
}

/// det(JJᵀ), the squared volume that J's rows span.
pub(crate) fn volume_squared<'g>(jacobian: &[Row<'g>]) -> Expr<'g> {
    let volume = product(&orthogonalise(jacobian, 1, &OF_J).pivots);
    volume.labelled("volume", || "det_jjt".into())
}

/// Names rows: `family_r_j` for the entry of row r at joint j.
fn named<'g>(rows: Vec<Row<'g>>, family: &'static str) -> Vec<Row<'g>> {
    for (r, row) in rows.iter().enumerate() {
        for (j, x) in row.iter().enumerate() {
            x.named(family, &[r, j]);
        }
    }
    rows
}

/// How w_D depends on J and M: δ ln w_D = ⟨W, δJ⟩ − ⟨HᵀW, δM⟩.
pub(crate) struct Sensitivity<'g> {
    /// w_D.
    value: Expr<'g>,
    /// W, by rows: as many as J has.
    pub by_jacobian: Vec<Row<'g>>,
    /// HᵀW, by rows.
    pub by_mass: Vec<Row<'g>>,
}

/// w_D's dependence on J, by rows, and M.
pub(crate) fn sensitivity<'g>(
    jacobian: &[Row<'g>],
    mass: &[Row<'g>],
    passes: usize,
) -> Sensitivity<'g> {
    let mass_factors = factor(mass);
    let solved = |rows: &[Row<'g>]| -> (Vec<Row<'g>>, Vec<Row<'g>>) {
        let solved = rows.iter().map(|row| mass_factors.solve_in_steps(row));
        solved.unzip()
    };
    let (turned, h) = solved(jacobian);
    let h = named(h, "h");
    named(turned, "hu");
    let basis = orthogonalise(&h, passes, &OF_H);
    let value = product(&basis.pivots)
        .sqrt()
        .labelled("w_d", || "w_d".into());
    let (turned, w) = solved(&basis.duals());
    let w = named(w, "w");
    named(turned, "wu");
    // Σ over the rows of h_i w_j: the entry (i, j) of HᵀW.
    let outer = |i: usize, j: usize| {
        let terms = h.iter().zip(&w).map(|(h, w)| h[i] * w[j]);
        sum(terms).unwrap_or(value)
    };
    let joints = 0..mass.len();
    let row = |i: usize| joints.clone().map(|j| outer(i, j)).collect();
    Sensitivity {
        value,
        by_mass: joints.clone().map(row).collect(),
        by_jacobian: w,
    }
}

/// w_D and ∇w_D of the task whose Jacobian is `jacobian` (by rows), with the mass matrix `mass`;
/// H's rows are made orthogonal `passes` times.
pub(crate) fn manipulability<'g>(
    jacobian: &[Row<'g>],
    mass: &[Row<'g>],
    passes: usize,
) -> Manipulability<'g> {
    let Sensitivity {
        value,
        by_jacobian,
        by_mass,
    } = sensitivity(jacobian, mass, passes);
    let mut seeded = Vec::new();
    for (i, row) in mass.iter().enumerate() {
        seeded.push((row[i], -by_mass[i][i]));
        for (j, entry) in row.iter().enumerate().skip(i + 1) {
            seeded.push((*entry, -(by_mass[i][j] + by_mass[j][i])));
        }
    }
    by_adjoint(value, jacobian, &by_jacobian, seeded)
}

/// The same from the factors of M = U D Uᵀ, which stay exact where M's rounding swallows a light link ([`super::articulated`]).
///
/// With M's change written as that of its factors, ⟨HᵀW, dM⟩ is Σ_k (HU)_k·(WU)_k dD_k + Σ_ik D_k (H_i·(WU)_k + W_i·(HU)_k) dU_ik,
/// where X_k is the k-th column of X: no difference of large numbers where a pivot is small.
pub(crate) fn manipulability_by_factors<'g>(
    jacobian: &[Row<'g>],
    mass_factors: &Factors<'g>,
    passes: usize,
) -> Manipulability<'g> {
    let solved = |rows: &[Row<'g>]| -> (Vec<Row<'g>>, Vec<Row<'g>>) {
        rows.iter()
            .map(|row| mass_factors.solve_in_steps(row))
            .unzip()
    };
    let (h_turned, h) = solved(jacobian);
    let (h, h_turned) = (named(h, "h"), named(h_turned, "hu"));
    let basis = orthogonalise(&h, passes, &OF_H);
    let value = product(&basis.pivots)
        .sqrt()
        .labelled("w_d", || "w_d".into());
    let (w_turned, w) = solved(&basis.duals());
    let (w, w_turned) = (named(w, "w"), named(w_turned, "wu"));
    let mut seeded = Vec::new();
    let columns = |a: &[Row<'g>], i: usize, b: &[Row<'g>], k: usize| {
        sum(a.iter().zip(b).map(|(a, b)| a[i] * b[k])).unwrap_or(value)
    };
    for (k, pivot) in mass_factors.pivots.iter().enumerate() {
        seeded.push((*pivot, -columns(&h_turned, k, &w_turned, k)));
        for (i, row) in mass_factors.upper.iter().enumerate().take(k) {
            let both = columns(&h, i, &w_turned, k) + columns(&w, i, &h_turned, k);
            seeded.push((row[k], -(*pivot * both)));
        }
    }
    by_adjoint(value, jacobian, &w, seeded)
}

/// One reverse sweep from J, seeded with W, and from what stands for M with its own seeds.
fn by_adjoint<'g>(
    value: Expr<'g>,
    jacobian: &[Row<'g>],
    w: &[Row<'g>],
    of_mass: Vec<(Expr<'g>, Expr<'g>)>,
) -> Manipulability<'g> {
    let pairs = jacobian.iter().flatten().zip(w.iter().flatten());
    let mut seeded: Vec<_> = pairs.map(|(entry, seed)| (*entry, *seed)).collect();
    seeded.extend(of_mass);
    let joints = jacobian.first().map_or(0, Vec::len);
    let logarithmic = reverse(value.graph(), &seeded, joints);
    let gradient = logarithmic.into_iter().enumerate().map(|(i, x)| {
        x.named("dlnw", &[i]);
        (value * x).named("dw", &[i])
    });
    Manipulability {
        value,
        gradient: gradient.collect(),
        volume_squared: volume_squared(jacobian),
    }
}

/// The squared lengths of H's rows.
pub(crate) fn squared_lengths<'g>(jacobian: &[Row<'g>], mass: &[Row<'g>]) -> Vec<Expr<'g>> {
    let mass_factors = factor(mass);
    let h = jacobian.iter().map(|row| mass_factors.solve(row));
    h.map(|row| dot(&row, &row)).collect()
}

/// Rows made orthogonal one after another: row s = reduced s + Σ_r coefficient(s, r) · reduced r, over r < s.
pub(super) struct Orthogonal<'g> {
    reduced: Vec<Row<'g>>,
    /// The same times the weights of the product.
    weighted: Vec<Row<'g>>,
    /// Squared lengths of the reduced rows.
    pub(super) pivots: Vec<Expr<'g>>,
    /// For each row and each before it, the coefficient.
    shares: Vec<Vec<Expr<'g>>>,
    names: Names,
}

/// What rows made orthogonal are called, and their squared lengths, one over these, their shares, and the dual basis.
#[derive(Clone, Copy)]
pub(super) struct Names([&'static str; 5]);

/// Of J's rows in the product of M⁻¹.
pub(super) const OF_TASK: Names = Names(["te", "tee", "tee_inv", "tmu", "ted"]);
const OF_H: Names = Names(["e", "ee", "ee_inv", "mu", "ed"]);
pub(super) const OF_J: Names = Names(["je", "jee", "jee_inv", "jmu", "jed"]);

/// The modified Gram–Schmidt process, each row going through it `passes` times.
pub(super) fn orthogonalise<'g>(rows: &[Row<'g>], passes: usize, names: &Names) -> Orthogonal<'g> {
    orthogonalise_in(rows, None, passes, names)
}

/// The same in the product Σ x_i y_i `weights`_i.
pub(super) fn orthogonalise_in<'g>(
    rows: &[Row<'g>],
    weights: Option<&[Expr<'g>]>,
    passes: usize,
    names: &Names,
) -> Orthogonal<'g> {
    let Names([family, squared, inverse, share, _]) = *names;
    let mut basis = Orthogonal {
        reduced: Vec::new(),
        weighted: Vec::new(),
        pivots: Vec::new(),
        shares: Vec::new(),
        names: *names,
    };
    for row in rows {
        let number = basis.reduced.len();
        let mut reduced = row.clone();
        let mut shares: Vec<Expr<'g>> = Vec::new();
        for pass in 1..=passes {
            for (r, pivot) in basis.pivots.iter().enumerate() {
                let inner = dot(&reduced, &basis.weighted[r]);
                let coefficient = inner * (inner.of(1.0) / *pivot).named(inverse, &[r]);
                subtract(&mut reduced, coefficient, &basis.reduced[r]);
                let (row, other) = (number + 1, r + 1);
                // Of one pass it is the share itself.
                if passes > 1 {
                    coefficient.labelled(share, || format!("{share}_{row}_{other}_p{pass}"));
                }
                // The last time, it is the row that remains.
                if pass < passes || r + 1 < number {
                    for (j, x) in (1..).zip(&reduced) {
                        x.labelled(family, || format!("{family}_{row}_{j}_p{pass}_{other}"));
                    }
                }
                match shares.get_mut(r) {
                    Some(share) => *share = *share + coefficient,
                    None => shares.push(coefficient),
                }
            }
        }
        for (j, x) in reduced.iter().enumerate() {
            x.named(family, &[number, j]);
        }
        for (r, x) in shares.iter().enumerate() {
            x.named(share, &[number, r]);
        }
        let weighted = match weights {
            Some(weights) => reduced.iter().zip(weights).map(|(x, w)| *x * *w).collect(),
            None => reduced.clone(),
        };
        for (j, x) in weighted.iter().enumerate() {
            x.named("te_over_d", &[number, j]);
        }
        let pivot = dot(&reduced, &weighted).named(squared, &[number]);
        basis.pivots.push(pivot);
        basis.weighted.push(weighted);
        basis.reduced.push(reduced);
        basis.shares.push(shares);
    }
    basis
}

impl<'g> Orthogonal<'g> {
    /// One over a reduced row's squared length.
    pub(super) fn inverse_pivot(&self, row: usize) -> Expr<'g> {
        let Names([_, _, inverse, ..]) = self.names;
        let pivot = self.pivots[row];
        (pivot.of(1.0) / pivot).named(inverse, &[row])
    }

    /// The inverse of the unit lower triangular matrix that makes the rows of the reduced ones.
    pub(super) fn inverse_shares(&self) -> Vec<Row<'g>> {
        let (zero, one) = (self.pivots[0].of(0.0), self.pivots[0].of(1.0));
        let mut inverse: Vec<Row<'g>> = Vec::new();
        for (s, shares) in self.shares.iter().enumerate() {
            let below = (0..s).map(|column| {
                let terms = (column..s).map(|r| shares[r] * inverse[r][column]);
                -terms.fold(zero, |sum, x| sum + x)
            });
            let mut row: Row<'g> = below.chain([one]).collect();
            for (r, x) in row.iter().enumerate() {
                x.named("ts", &[s, r]);
            }
            row.resize(self.shares.len(), zero);
            inverse.push(row);
        }
        inverse
    }

    /// G⁻¹H: the rows' dual basis.
    pub(super) fn duals(&self) -> Vec<Row<'g>> {
        let scaled = |(r, row): (usize, &Row<'g>)| {
            let inverse = self.inverse_pivot(r);
            row.iter().map(|x| *x * inverse).collect()
        };
        let rows = self.weighted.iter().enumerate();
        let mut duals: Vec<Row<'g>> = rows.map(scaled).collect();
        for s in (0..duals.len()).rev() {
            let dual = duals[s].clone();
            for (r, coefficient) in self.shares[s].iter().enumerate() {
                subtract(&mut duals[r], *coefficient, &dual);
            }
        }
        let Names([.., dual]) = self.names;
        named(duals, dual)
    }
}

fn subtract<'g>(row: &mut Row<'g>, coefficient: Expr<'g>, other: &Row<'g>) {
    for (x, y) in row.iter_mut().zip(other) {
        *x = *x - coefficient * *y;
    }
}

fn sum<'g>(terms: impl Iterator<Item = Expr<'g>>) -> Option<Expr<'g>> {
    terms.reduce(|sum, term| sum + term)
}

fn dot<'g>(a: &Row<'g>, b: &Row<'g>) -> Expr<'g> {
    sum(a.iter().zip(b).map(|(x, y)| *x * *y)).unwrap_or(a[0])
}

pub(super) fn product<'g>(factors: &[Expr<'g>]) -> Expr<'g> {
    factors
        .iter()
        .copied()
        .reduce(|p, x| p * x)
        .unwrap_or(factors[0])
}
