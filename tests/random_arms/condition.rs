//! How ill-conditioned an arm is at a configuration: what explains an error, or does not.

use nalgebra::{DMatrix, SVector, Vector3};
use ulna::{Arm, JointKind, SerialChain, TaskRow};

/// Condition numbers at one configuration, in doubles: beyond 1e15 they only say "very".
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Conditions {
    /// Of M with rows and columns scaled so that its diagonal is 1: what units cannot mend.
    pub(crate) mass_matrix: f64,
    /// Of the task's rows of J, made dimensionless by the chain's length.
    pub(crate) jacobian: f64,
}

/// The condition numbers of `chain` at `q`.
pub(crate) fn conditions<const N: usize>(
    chain: &SerialChain<N>,
    q: &SVector<f64, N>,
) -> Conditions {
    let mass = chain.mass_matrix(q);
    let scaled = DMatrix::from_fn(N, N, |r, c| {
        mass[(r, c)] / (mass[(r, r)] * mass[(c, c)]).sqrt()
    });

    let length = length(chain, q);
    let jacobian = chain.geometric_jacobian(q);
    let rows: Vec<_> = chain.task.iter().map(TaskRow::index).collect();
    let dimensionless = DMatrix::from_fn(rows.len(), N, |r, c| {
        let across = if rows[r] < 3 { 1.0 / length } else { 1.0 };
        let along = match chain.joints[c].kind {
            JointKind::Revolute => 1.0,
            JointKind::Prismatic => length,
        };
        jacobian[(rows[r], c)] * across * along
    });
    Conditions {
        mass_matrix: condition(&scaled),
        jacobian: condition(&dimensionless),
    }
}

/// The length of the chain from joint to joint to tool, m; 1 if it has none.
fn length<const N: usize>(chain: &SerialChain<N>, q: &SVector<f64, N>) -> f64 {
    let links = chain.joints.iter().zip(q.iter()).map(|(joint, q)| {
        let d = match joint.kind {
            JointKind::Revolute => joint.d,
            JointKind::Prismatic => joint.d + q,
        };
        joint.a.hypot(d)
    });
    match links.sum::<f64>() + Vector3::from(chain.tool.translation).norm() {
        0.0 => 1.0,
        length => length,
    }
}

fn condition(matrix: &DMatrix<f64>) -> f64 {
    let singular = matrix.singular_values();
    // A single row is singular where it is all but 0: beside 1, the size of an axis.
    singular.max().max(1.0) / singular.min()
}
