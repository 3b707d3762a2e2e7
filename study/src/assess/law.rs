//! [`AssessedLaw`]: a law, how it was tuned, and what it does at any time of the motion.

use nalgebra::SVector;

use crate::search::{OperatingPoint, Operation};
use ulna::control::compensation::{Compensation, FreeTorque};

/// The laws that are assessed.
pub use crate::laws::LawName as Law;

/// The lock that a law was tuned for.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuning {
    /// The joints that lock, counted from 0.
    pub joints: Vec<usize>,
    /// When, s.
    pub time: f64,
}

/// A law, ready to meet any failure.
#[derive(Clone, Debug, PartialEq)]
pub struct AssessedLaw<const N: usize> {
    /// Which.
    pub law: Law,
    /// What it was tuned for, if it was tuned for one lock.
    pub tuned: Option<Tuning>,
    /// How far it may bend the static tool force, N, if it has a budget.
    pub force_budget: Option<f64>,
    /// What it does.
    pub tactic: Tactic<N>,
    /// What its search says of itself: how it ended, its gap, its time; empty where nothing was searched.
    pub note: String,
}

/// What a law does, told in torques.
#[derive(Clone, Debug, PartialEq)]
pub enum Tactic<const N: usize> {
    /// The same parameters at all times.
    Constant(Compensation<N>),
    /// The same, with the gradient of the kinematic manipulability.
    Kinematic(Compensation<N>),
    /// A plan before the lock, the nearest torque after it.
    Planned(Plan<N>),
    /// The best for each failure.
    Known,
}

/// A compensation over time until a lock, and what follows a lock.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan<const N: usize> {
    /// From one sample to the next, s; the first is at 0.
    pub period: f64,
    /// U₀ at each sample; between them what is linear between them, in the null space of the pose at hand. Empty for none.
    pub samples: Vec<FreeTorque<N>>,
    /// What was planned to follow each lock at each time of the grid, by time and then by lock: it counts where rated torques are in
    /// the way of the torque nearest to that before.
    pub recourses: Vec<Vec<FreeTorque<N>>>,
    /// How far the recourse may bend the static tool force, N.
    pub force_budget: f64,
    /// How long the recourse takes to fade out, s.
    pub ramp: f64,
}

impl<const N: usize> Plan<N> {
    /// Nothing before the lock.
    pub fn nothing(ramp: f64) -> Self {
        Self {
            period: 1.0,
            samples: Vec::new(),
            recourses: Vec::new(),
            force_budget: 0.0,
            ramp,
        }
    }

    /// U₀ at `time`, s.
    pub fn at(&self, time: f64) -> FreeTorque<N> {
        let position = (time / self.period).max(0.0);
        let index = position as usize;
        match (self.samples.get(index), self.samples.get(index + 1)) {
            (Some(here), Some(next)) => {
                let share = position - index as f64;
                FreeTorque {
                    torque: here.torque + (next.torque - here.torque) * share,
                    wrench: here.wrench + (next.wrench - here.wrench) * share,
                }
            }
            _ => self
                .samples
                .last()
                .copied()
                .unwrap_or_else(FreeTorque::none),
        }
    }

    /// U before the lock at an operating point, N·m (N).
    pub fn before(&self, point: &OperatingPoint<N>) -> SVector<f64, N> {
        point.compensation(&self.at(point.time))
    }

    /// What follows the lock of an operation, number `lock` of the grid at its time number `time`: what leaves less of the step.
    pub fn recourse(
        &self,
        operation: &Operation<N>,
        (lock, time): (usize, usize),
    ) -> FreeTorque<N> {
        let before = self.before(operation.before());
        let nearest = operation.recourse(&before, self.force_budget);
        let planned = self.recourses.get(time).and_then(|locks| locks.get(lock));
        let left = |after: &FreeTorque<N>| operation.left(&before, after);
        match planned {
            Some(planned) if left(planned) < left(&nearest) => *planned,
            _ => nearest,
        }
    }

    /// What is left of a recourse `since` s after the lock: from 1 to 0 along `1 − 3s² + 2s³`.
    pub fn fade(&self, since: f64) -> f64 {
        let share = (since / self.ramp).clamp(0.0, 1.0);
        1.0 - share * share * (3.0 - 2.0 * share)
    }
}
