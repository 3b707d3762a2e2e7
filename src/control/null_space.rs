//! [`NullSpace`]: the task's rows of J taken apart once, for every product that the pseudoinverse appears in.

use nalgebra::{SMatrix, SVector, Vector6};

use crate::{Real, TaskRow, TaskRows};

/// Below this [`NullSpace::conditioning`] a row of J counts as dependent on the others, and the task as singular.
pub const SINGULAR: f64 = 1e-6;

/// Below this [`NullSpace::conditioning`] a pose counts as near-singular.
pub const NEAR_SINGULAR: f64 = 1e-2;

/// The rows of a task's Jacobian J (m×N, m ≤ 6) as `J = L Qᵀ`: Q orthonormal (N×rank), L triangular in the order of the pivots.
///
/// Gram–Schmidt on the rows, the longest remainder first (Golub and Van Loan, 5.2 and 5.4.2), in time bounded by m²N.
/// Linear and angular rows are each divided by the length of the longest of their kind beforehand,
/// so that no unit decides on a rank.
///
/// Rank rule: a row whose remainder is below [`SINGULAR`] is dependent; it is left out of Q.
/// Forces and velocities along dropped rows come out as 0.
#[derive(Clone, Copy, Debug)]
pub struct NullSpace<const N: usize> {
    /// Columns of Q; `rank` of them are set.
    basis: [SVector<f64, N>; 6],
    /// `factor[i][j]`: the scaled row `order[i]` along `basis[j]`, j ≤ i.
    factor: [[f64; 6]; 6],
    /// Pivot order: the Jacobian's row taken i-th.
    order: [usize; 6],
    /// What each row of J was multiplied by.
    scale: [f64; 6],
    rank: usize,
    conditioning: f64,
}

impl<const N: usize> NullSpace<N> {
    /// The null space of the rows `task` of `jacobian`.
    #[inline]
    pub fn new(jacobian: &SMatrix<f64, 6, N>, task: TaskRows) -> Self {
        let mut rest = [SVector::zeros(); 6];
        let mut order = [0; 6];
        let mut count = 0;
        for row in task.iter() {
            order[count] = row.index();
            rest[count] = jacobian.row(row.index()).transpose();
            count += 1;
        }
        let scale = row_scales(&rest[..count], &order[..count]);
        for (row, index) in rest.iter_mut().zip(order).take(count) {
            *row *= scale[index];
        }

        let mut factor = [[0.0; 6]; 6];
        let mut rank = 0;
        let mut conditioning = 1.0;
        while rank < count {
            let (pivot, length) = longest(&rest[rank..count]);
            conditioning = length.min(conditioning);
            if conditioning < SINGULAR {
                break;
            }
            rest.swap(rank, rank + pivot);
            order.swap(rank, rank + pivot);
            factor.swap(rank, rank + pivot);
            factor[rank][rank] = length;
            let (done, open) = rest[..count].split_at_mut(rank + 1);
            let direction = &mut done[rank];
            *direction /= length;
            for (i, row) in open.iter_mut().enumerate() {
                let along = direction.dot(row);
                factor[rank + 1 + i][rank] = along;
                row.axpy(-along, direction, 1.0);
            }
            rank += 1;
        }
        Self {
            basis: rest,
            factor,
            order,
            scale,
            rank,
            conditioning,
        }
    }

    /// How independent the rows are, 0 to 1: the shortest remainder of a row (each kind's longest row has length 1)
    /// after its part along the rows taken before it is removed. 0 at a singular pose.
    pub fn conditioning(&self) -> f64 {
        self.conditioning
    }

    /// The number of independent rows.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// `(I − J†J) x`: the part of `x` in the null space of J.
    #[inline]
    pub fn project(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        let mut projected = *x;
        for direction in &self.basis[..self.rank] {
            projected.axpy(-direction.dot(&projected), direction, 1.0);
        }
        projected
    }

    /// `(Jᵀ)† tau`: the static tool wrench that the joint torques `tau` hold, in the least-squares sense; 0 outside the task.
    #[inline]
    pub fn static_wrench(&self, tau: &SVector<f64, N>) -> Vector6<f64> {
        // Lᵀ F = Qᵀ tau, from the last pivot up.
        let mut wrench = Vector6::zeros();
        let mut solution = [0.0; 6];
        for i in (0..self.rank).rev() {
            let mut right = self.basis[i].dot(tau);
            for (row, known) in self.factor.iter().zip(&solution).skip(i + 1) {
                right -= row[i] * known;
            }
            solution[i] = right / self.factor[i][i];
            wrench[self.order[i]] = solution[i] * self.scale[self.order[i]];
        }
        wrench
    }

    /// `J† v`: the least joint velocity that gives the task's rows of the twist `v`.
    pub fn resolve(&self, twist: &Vector6<f64>) -> SVector<f64, N> {
        // L y = v, from the first pivot down; q̇ = Q y.
        let mut velocity = SVector::<f64, N>::zeros();
        let mut solution = [0.0; 6];
        for i in 0..self.rank {
            let row = self.order[i];
            let mut right = twist[row] * self.scale[row];
            for (along, y) in self.factor[i].iter().zip(&solution).take(i) {
                right -= along * y;
            }
            solution[i] = right / self.factor[i][i];
            velocity.axpy(solution[i], &self.basis[i], 1.0);
        }
        velocity
    }
}

/// For each row of the Jacobian, one over the length of the longest row of its kind; 1 where all of them vanish.
fn row_scales<const N: usize>(rows: &[SVector<f64, N>], order: &[usize]) -> [f64; 6] {
    let is_angular = |index: usize| index >= TaskRow::Rx.index();
    let mut longest = [0.0_f64; 2];
    for (row, index) in rows.iter().zip(order) {
        let kind = usize::from(is_angular(*index));
        longest[kind] = longest[kind].max(row.norm_squared());
    }
    let scale = longest.map(|squared| {
        if squared > 0.0 {
            1.0 / Real::sqrt(squared)
        } else {
            1.0
        }
    });
    core::array::from_fn(|index| scale[usize::from(is_angular(index))])
}

/// The longest of `rows` and its length.
fn longest<const N: usize>(rows: &[SVector<f64, N>]) -> (usize, f64) {
    let mut best = (0, 0.0);
    for (i, row) in rows.iter().enumerate() {
        let squared = row.norm_squared();
        if squared > best.1 {
            best = (i, squared);
        }
    }
    (best.0, Real::sqrt(best.1))
}
