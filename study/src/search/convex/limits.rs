//! Rated torques as linear inequalities on what is searched for.

use nalgebra::{DMatrix, DVector};

use super::pseudo_inverse::stack;
use crate::search::{OperatingPoint, Operation, SearchError};

/// Rated torques on `planned + T x`, both sides of each in turn.
#[derive(Clone)]
pub(super) struct TorqueLimits {
    /// T, and −T below it.
    pub(super) map: DMatrix<f64>,
    pub(super) room: Vec<f64>,
    /// Joint and time of each row of the upper half.
    places: Vec<(usize, f64)>,
}

impl TorqueLimits {
    /// Of the samples with their maps T, for the joints that are not locked and have a limit.
    pub(super) fn new<'a, const N: usize>(
        operation: &Operation<N>,
        samples: impl Iterator<Item = (&'a OperatingPoint<N>, DMatrix<f64>)>,
        variables: usize,
    ) -> Self {
        let mut rows = Vec::new();
        let mut room = (Vec::new(), Vec::new());
        let mut places = Vec::new();
        for (sample, map) in samples {
            for joint in sample.locked.healthy() {
                let rated = operation.rated_torque()[joint];
                if rated.is_finite() {
                    rows.push(map.row(joint).into_owned());
                    room.0.push(rated - sample.planned[joint]);
                    room.1.push(rated + sample.planned[joint]);
                    places.push((joint, sample.time));
                }
            }
        }
        let count = rows.len();
        let map = DMatrix::from_fn(2 * count, variables, |i, j| {
            if i < count {
                rows[i][j]
            } else {
                -rows[i - count][j]
            }
        });
        room.0.append(&mut room.1);
        Self {
            map,
            room: room.0,
            places,
        }
    }

    /// The same over the variables that `basis` spans.
    pub(super) fn within(&self, basis: &DMatrix<f64>) -> Self {
        Self {
            map: &self.map * basis,
            room: self.room.clone(),
            places: self.places.clone(),
        }
    }

    /// These, and `rows x` at most the first `room` and `−rows x` at most the second.
    pub(super) fn and(&self, rows: &DMatrix<f64>, room: &[DVector<f64>; 2]) -> Self {
        let mut both = self.room.clone();
        both.extend(room.iter().flatten());
        Self {
            map: stack(&stack(&self.map, rows), &-rows),
            room: both,
            places: self.places.clone(),
        }
    }

    pub(super) fn admit(&self, x: &DVector<f64>) -> bool {
        let used = &self.map * x;
        used.iter().zip(&self.room).all(|(used, room)| used <= room)
    }

    /// The joint and the time with the least room.
    pub(super) fn tightest(&self) -> SearchError {
        let rows = self.room.iter().take(2 * self.places.len()).enumerate();
        let (row, _) = rows.min_by(|a, b| a.1.total_cmp(b.1)).unwrap_or((0, &0.0));
        match self.places.get(row % self.places.len().max(1)) {
            Some((joint, time)) => SearchError::Empty {
                joint: *joint,
                time: *time,
            },
            None => SearchError::NotSolved("infeasible without limits"),
        }
    }
}
