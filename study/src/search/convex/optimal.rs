//! The best compensation there is, and the frontier of force error against impact.

use std::time::Instant;

use nalgebra::{DMatrix, DVector};

use super::certificate::wrench_maps;
use super::fairness::{Acts, Fairness};
use super::free_map::FreeMap;
use super::limits::TorqueLimits;
use super::problem::Problem;
use crate::search::{Operation, SearchError, Solution};
use ulna::control::compensation::Compensation;

/// How [`optimal()`] weighs the tool force against the impact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ForcePriority {
    /// The static tool force stays as it is, before and after the lock.
    #[default]
    Exact,
    /// Its error has at most this norm just before and just after the lock, N (with the moments' N·m, if the task has any):
    /// at least 0, or ∞. Of all compensations with the least impact, the one with the least error is taken.
    AtMost(f64),
    /// Least `‖Δτ̃‖² + ρ² (‖h‖² + ‖h'‖²)`: a newton of force error before (h) or after (h') the lock weighs as ρ N·m of impact. Above 0.
    Weight(f64),
}

/// What is asked of the best compensation: free torques before and after the lock, the rated torques kept on both sides of it.
/// Elsewhere a control cycle keeps them by scaling.
///
/// Any compensation is of its form at the lock, so that at equal force error no law leaves less.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Optimum {
    /// The tool force against the impact.
    pub priority: ForcePriority,
    /// One joint's impact against another's.
    pub fairness: Fairness,
    /// When it acts.
    pub acts: Acts,
}

/// A point of the frontier of force error against impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontierPoint<const N: usize> {
    /// The force error allowed, N.
    pub allowed: f64,
    /// The best compensation within it.
    pub solution: Solution<N>,
}

impl Optimum {
    /// The best compensation for `operation`.
    pub fn solve<const N: usize>(
        &self,
        operation: &Operation<N>,
    ) -> Result<Solution<N>, SearchError> {
        let clock = Instant::now();
        let maps = FreeMaps::new(operation, self.acts);
        let minimum = maps
            .problem(operation)
            .solve(self.fairness, self.priority)?;
        let seconds = clock.elapsed().as_secs_f64();
        Ok(minimum.solution(operation, maps.compensation(&minimum.x), seconds))
    }
}

/// The best compensation there is: the healthy joints' impact least in the norm, by `priority`. [`Optimum`] asks for others.
pub fn optimal<const N: usize>(
    operation: &Operation<N>,
    priority: ForcePriority,
) -> Result<Solution<N>, SearchError> {
    Optimum {
        priority,
        ..Optimum::default()
    }
    .solve(operation)
}

/// The least impact over the healthy joints for each force error allowed, N: from all of the tool force kept (0) to any price.
pub fn frontier<const N: usize>(
    operation: &Operation<N>,
    allowed: &[f64],
) -> Result<Vec<FrontierPoint<N>>, SearchError> {
    let point = |allowed: &f64| {
        let solution = optimal(operation, ForcePriority::AtMost(*allowed))?;
        Ok(FrontierPoint {
            allowed: *allowed,
            solution,
        })
    };
    allowed.iter().map(point).collect()
}

/// The free torques just before and just after the lock.
pub(super) struct FreeMaps {
    before: FreeMap,
    after: FreeMap,
}

impl FreeMaps {
    pub(super) fn new<const N: usize>(operation: &Operation<N>, acts: Acts) -> Self {
        let (before, after) = (operation.before(), operation.after());
        Self {
            before: match acts {
                Acts::Both | Acts::Before => FreeMap::new(before),
                Acts::After => FreeMap::idle(before),
            },
            after: match acts {
                Acts::Both | Acts::After => FreeMap::new(after),
                Acts::Before => FreeMap::idle(after),
            },
        }
    }

    pub(super) fn problem<const N: usize>(&self, operation: &Operation<N>) -> Problem {
        let first = self.before.torque.ncols();
        let variables = first + self.after.torque.ncols();
        let from_all = |map: &DMatrix<f64>, first: usize| {
            let mut wide = DMatrix::zeros(map.nrows(), variables);
            wide.columns_mut(first, map.ncols()).copy_from(map);
            wide
        };
        let side_by_side =
            |before: &DMatrix<f64>, after| [from_all(before, 0), from_all(after, first)];
        let torques = side_by_side(&self.before.torque, &self.after.torque);
        let (before, after) = (operation.before(), operation.after());
        let samples = [before, after].into_iter().zip(torques.iter().cloned());
        let [wrench, jacobian] = wrench_maps(operation);
        Problem {
            limits: TorqueLimits::new(operation, samples, variables),
            forces: side_by_side(&self.before.force, &self.after.force),
            torques,
            wrench,
            jacobian,
            step: DVector::from_column_slice(operation.step().as_slice()),
            healthy: operation.healthy().collect(),
            largest: before.planned.amax().max(after.planned.amax()),
            effort: operation.effort(),
        }
    }

    pub(super) fn compensation<const N: usize>(&self, x: &DVector<f64>) -> Compensation<N> {
        let (before, after) = x.as_slice().split_at(self.before.torque.ncols());
        Compensation::Optimal {
            before: self.before.parameters(before),
            after: self.after.parameters(after),
        }
    }
}
