//! What a free compensation does at the lock, as linear maps of few variables.

use nalgebra::{DMatrix, DVector, SVector, Vector6};

use super::pseudo_inverse::column_space;
use crate::search::OperatingPoint;
use ulna::TaskRow;
use ulna::control::compensation::FreeTorque;

/// `U = P z + Jᵀ f` at one sample as a map of few variables: P's range and the task's rows of f.
pub(super) struct FreeMap {
    /// U, N × variables.
    pub(super) torque: DMatrix<f64>,
    /// h, task rows × variables.
    pub(super) force: DMatrix<f64>,
    /// z of each of the first variables, N × rank of P.
    pub(super) null: DMatrix<f64>,
    /// The rows of f of the other variables.
    rows: Vec<usize>,
}

impl FreeMap {
    pub(super) fn new<const N: usize>(sample: &OperatingPoint<N>) -> Self {
        let pose = &sample.pose;
        let unit = |i: usize| SVector::<f64, N>::from_fn(|j, _| f64::from(u8::from(i == j)));
        let mut projector = DMatrix::zeros(N, N);
        for i in 0..N {
            projector.set_column(i, &pose.project(&unit(i)));
        }
        let null = column_space(&projector.transpose(), 1.0);
        let rows = task_rows(sample);
        let lifted = DMatrix::from_fn(N, rows.len(), |joint, column| {
            let mut wrench = Vector6::zeros();
            wrench[rows[column]] = 1.0;
            pose.static_torque(&wrench)[joint]
        });
        let mut torque = (&projector * &null).resize_horizontally(null.ncols() + rows.len(), 0.0);
        torque
            .columns_mut(null.ncols(), rows.len())
            .copy_from(&lifted);
        let force = DMatrix::from_fn(rows.len(), torque.ncols(), |row, column| {
            let torque = SVector::from_fn(|joint, _| torque[(joint, column)]);
            pose.null_space.static_wrench(&torque)[rows[row]]
        });
        Self {
            torque,
            force,
            null,
            rows,
        }
    }

    /// Of a compensation that does not act at the sample: without variables.
    pub(super) fn idle<const N: usize>(sample: &OperatingPoint<N>) -> Self {
        Self {
            torque: DMatrix::zeros(N, 0),
            force: DMatrix::zeros(task_rows(sample).len(), 0),
            null: DMatrix::zeros(N, 0),
            rows: Vec::new(),
        }
    }

    /// Without the variables of f, if the force is to be `exact`.
    pub(super) fn kept(mut self, exact: bool) -> Self {
        if exact {
            let null = self.null.ncols();
            self.torque = self.torque.columns(0, null).into_owned();
            self.force = self.force.columns(0, null).into_owned();
            self.rows.clear();
        }
        self
    }

    pub(super) fn parameters<const N: usize>(&self, x: &[f64]) -> FreeTorque<N> {
        let (null, forces) = x.split_at(self.null.ncols());
        let torque = &self.null * DVector::from_column_slice(null);
        let mut wrench = Vector6::zeros();
        for (row, force) in self.rows.iter().zip(forces) {
            wrench[*row] = *force;
        }
        FreeTorque {
            torque: SVector::from_fn(|joint, _| torque[joint]),
            wrench,
        }
    }
}

/// The rows of the six that make up the task.
pub(super) fn task_rows<const N: usize>(sample: &OperatingPoint<N>) -> Vec<usize> {
    sample.pose.task().iter().map(TaskRow::index).collect()
}
