//! What is best once a lock has happened: the compensation that brings the healthy joints' torque nearest to what it was.

use nalgebra::{DMatrix, DVector, SVector, SymmetricEigen, Vector6};

use super::{OperatingPoint, Operation};
use ulna::Law;
use ulna::TaskRow;
use ulna::control::compensation::{FreeTorque, Limits};

/// `min ‖wanted − P' z − J'ᵀ f‖` over the healthy joints with `‖f‖ ≤ budget`, N (with the moments' N·m, if the task has any):
/// z is all of `wanted`, N·m (N), and f solves a trust-region problem (Nocedal and Wright, *Numerical Optimization*, 4.3).
///
/// `wanted` is the torque before the lock minus the planned one after it.
pub fn nearest_torque<const N: usize>(
    after: &OperatingPoint<N>,
    wanted: &SVector<f64, N>,
    budget: f64,
) -> FreeTorque<N> {
    let wanted = after.locked.without(wanted);
    let mut wrench = Vector6::zeros();
    if budget > 0.0 {
        let rows: Vec<usize> = after.pose.task().iter().map(TaskRow::index).collect();
        let map = DMatrix::from_fn(N, rows.len(), |joint, column| {
            let mut unit = Vector6::zeros();
            unit[rows[column]] = 1.0;
            after.pose.static_torque(&unit)[joint]
        });
        let wanted = DVector::from_column_slice(wanted.as_slice());
        let f = within_radius(map.tr_mul(&map), &map.tr_mul(&wanted), budget);
        for (row, value) in rows.iter().zip(&f) {
            wrench[*row] = *value;
        }
    }
    FreeTorque {
        torque: wanted,
        wrench,
    }
}

/// The least `½ fᵀ A f − bᵀ f` with `‖f‖ ≤ radius`, A positive semidefinite: `f = (A + λ)⁻¹ b`, λ ≥ 0 by bisection.
fn within_radius(a: DMatrix<f64>, b: &DVector<f64>, radius: f64) -> DVector<f64> {
    /// Eigenvalues below this part of the largest count as 0.
    const ROUNDING: f64 = 1e-12;
    let eigen = SymmetricEigen::new(a);
    let along = eigen.eigenvectors.tr_mul(b);
    let largest = eigen.eigenvalues.amax();
    let solve = |shift: f64| {
        let f = along.zip_map(&eigen.eigenvalues, |b, value| {
            let value = value.max(0.0) + shift;
            if value > ROUNDING * largest {
                b / value
            } else {
                0.0
            }
        });
        &eigen.eigenvectors * f
    };
    let free = solve(0.0);
    if free.norm() <= radius {
        return free;
    }
    let (mut low, mut high) = (0.0, b.norm() / radius);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if solve(middle).norm() > radius {
            low = middle;
        } else {
            high = middle;
        }
    }
    solve(high)
}

impl<const N: usize> Operation<N> {
    /// The norm of the healthy joints' steps that `after` leaves of a compensation that was `before` until the lock, N·m (N),
    /// both cut at rated torques as a control cycle cuts them.
    pub fn left(&self, before: &SVector<f64, N>, after: &FreeTorque<N>) -> f64 {
        let torque = |point: &OperatingPoint<N>, wanted: &SVector<f64, N>| {
            let limits = Limits {
                rated_torque: *self.rated_torque(),
                locked: point.locked,
            };
            limits.cut(&point.planned, wanted, Law::Optimal).0
        };
        let wanted = self.after().compensation(after);
        let step = torque(self.after(), &wanted) - torque(self.before(), before);
        self.failure().joints.without(&step).norm()
    }

    /// The best that is left after the lock for a compensation that was `before` until then, N·m (N), with a force error
    /// of at most `budget`, N.
    pub fn recourse(&self, before: &SVector<f64, N>, budget: f64) -> FreeTorque<N> {
        nearest_torque(self.after(), &(before - self.step()), budget)
    }
}
