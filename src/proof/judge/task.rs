//! Rules for what the tool feels of the arm: Λ, J̄, and w with its gradient.
//!
//! An entry's error is measured beside what it changes by, at worst and to first order, where J's entries change by ε of their sizes
//! s_r (the chain's length for v, 1 for ω), and M's by ε of theirs, m_i m_j:
//!
//! - δΛ = J̄ᵀ δM J̄ − Λ δJ J̄ − (Λ δJ J̄)ᵀ,
//! - δJ̄ = B (δJᵀ Λ − δM J̄) − J̄ δJ J̄, where B = M⁻¹ − J̄ J M⁻¹ has no entry larger than √(M⁻¹_ii M⁻¹_jj),
//! - δ ln w = ⟨W, δJ⟩, where W is J's pseudoinverse transposed.

use nalgebra::{Matrix6, SMatrix, SVector, Vector6};

use super::{Judge, Vector, Verdict};
use crate::generic::{ThinQr, task_columns};
use crate::proof::{relative, rounding, worse};
use crate::{Real, TaskRow};

/// What is made of Λ and J̄ where J and M change.
struct Change<const N: usize> {
    /// |Λ| s, by rows.
    by_jacobian: Vector6<f64>,
    /// The columns of |J̄|, added up.
    joint_rates: Vector6<f64>,
    /// |J̄|ᵀ m.
    by_mass: Vector6<f64>,
    /// |J̄|.
    inverse: SMatrix<f64, N, 6>,
    /// Λ's change relative to its diagonal, at most.
    condition: f64,
}

/// The sizes of J's rows.
fn row_sizes(length: f64) -> Vector6<f64> {
    Vector6::from_fn(|row, _| {
        if row < TaskRow::Rx.index() {
            length
        } else {
            1.0
        }
    })
}

/// The largest entry relative to its size.
fn largest<const R: usize, const C: usize>(
    difference: &SMatrix<f64, R, C>,
    size: impl Fn(usize, usize) -> f64,
) -> f64 {
    let entries = (0..R).flat_map(|r| (0..C).map(move |c| (r, c)));
    entries.fold(0.0, |worst, (r, c)| {
        worse(worst, relative(difference[(r, c)], size(r, c)))
    })
}

/// `factor` times what a condition number makes of rounding.
/// Where that leaves less than two digits, first-order theory says no more.
fn conditioned<const N: usize>(factor: f64, condition: f64) -> f64 {
    let tolerance = factor * rounding(N) * condition;
    if tolerance > 1e-2 {
        f64::INFINITY
    } else {
        tolerance
    }
}

impl<const N: usize> Judge<'_, N> {
    pub(in crate::proof) fn task_inertia(
        &self,
        found: Matrix6<f64>,
        expected: impl FnOnce() -> Matrix6<f64>,
    ) -> Verdict {
        let expected = expected();
        let inverse = self.reference.dynamically_consistent_inverse(&self.state.q);
        let change = self.change(&expected, &inverse);
        let error = largest(&(found - expected), |r, c| change.of_inertia(r, c));
        (error, change.allowed())
    }

    pub(in crate::proof) fn task_inverse(
        &self,
        found: SMatrix<f64, N, 6>,
        expected: impl FnOnce() -> SMatrix<f64, N, 6>,
    ) -> Verdict {
        let expected = expected();
        let change = self.change(&self.reference.task_space_inertia(&self.state.q), &expected);
        let mobility = self.reference.inverse_mass_matrix(&self.state.q);
        let mobility = SVector::<f64, N>::from_fn(|i, _| Real::sqrt(mobility[(i, i)]));
        let (of_rates, of_forces) = (mobility.sum(), mobility.dot(&self.scale.inertia));
        let lengths = change.inverse * row_sizes(self.scale.length);
        let error = largest(&(found - expected), |i, c| {
            let forces = of_rates * change.by_jacobian[c] + of_forces * change.by_mass[c];
            mobility[i] * forces + lengths[i] * change.joint_rates[c]
        });
        (error, change.allowed())
    }

    /// As for w_D, with the condition number of w.
    pub(in crate::proof) fn kinematic_gradient(
        &self,
        (value, slopes): (f64, Vector<N>),
        expected: impl FnOnce() -> (f64, Vector<N>),
    ) -> Verdict {
        let (expected, gradient) = expected();
        let largest = gradient.amax().max(expected);
        let difference = slopes - gradient;
        let slopes = (0..N).map(|i| relative(difference[i] * self.unit(i), largest));
        let error = slopes.fold(relative(value - expected, expected), worse);
        let condition = if expected == 0.0 {
            0.0
        } else {
            self.condition_of_volume()
        };
        (error, conditioned::<N>(4.0, condition))
    }

    /// Σ |W_rj| s_r.
    fn condition_of_volume(&self) -> f64 {
        let task = self.reference.task();
        let rows = task_columns(task, &self.reference.geometric_jacobian(&self.state.q));
        let duals = ThinQr::new(rows, task.len()).duals();
        let sizes = row_sizes(self.scale.length);
        let columns = task.iter().enumerate();
        columns
            .map(|(column, row)| duals.column(column).abs().sum() * sizes[row.index()])
            .sum()
    }

    fn change(&self, inertia: &Matrix6<f64>, inverse: &SMatrix<f64, N, 6>) -> Change<N> {
        let inverse = inverse.abs();
        let mut change = Change {
            by_jacobian: inertia.abs() * row_sizes(self.scale.length),
            joint_rates: inverse.row_sum().transpose(),
            by_mass: inverse.tr_mul(&self.scale.inertia),
            inverse,
            condition: 0.0,
        };
        change.condition = (0..6).fold(0.0, |worst, row| {
            let share = relative(change.of_inertia(row, row), inertia[(row, row)]);
            worse(worst, share)
        });
        change
    }
}

impl<const N: usize> Change<N> {
    /// Of an entry of Λ.
    fn of_inertia(&self, row: usize, column: usize) -> f64 {
        self.by_mass[row] * self.by_mass[column]
            + self.by_jacobian[row] * self.joint_rates[column]
            + self.joint_rates[row] * self.by_jacobian[column]
    }

    /// Errors are relative to changes already; the condition tells whether those mean anything.
    fn allowed(&self) -> f64 {
        if conditioned::<N>(1.0, self.condition).is_infinite() {
            f64::INFINITY
        } else {
            rounding(N)
        }
    }
}
