//! The paper's search (Figure 2), coefficient by coefficient in steps.

use std::time::Instant;

use nalgebra::{SMatrix, SVector};

use super::coefficients::{CoefficientLaw, Maps};
use super::{Operation, SearchError, Solution, SolveStatus};

/// The paper's search (Figure 2): from a start value, each coefficient goes up and down in fixed steps
/// within its interval of Eq. 28 as long as the impact shrinks.
///
/// With Eq. 16 each joint is on its own, and one pass finds the best point of the grid. With Eq. 20 the coefficients
/// act together; the passes are repeated until none moves any more.
///
/// A weight of effort ([`OperationOptions::effort`](super::OperationOptions::effort)) counts as in the exact searches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stepwise<const N: usize> {
    /// Where to start.
    pub start: SVector<f64, N>,
    /// Δk_di, above 0.
    pub step: f64,
    /// How often to go on from the best point with a tenth of the step; 0 is the paper's search.
    pub refinements: u32,
    /// The most steps taken.
    pub max_steps: usize,
}

impl<const N: usize> Stepwise<N> {
    /// From 0 in steps of `step`, without refinement.
    pub fn with_step(step: f64) -> Self {
        Self {
            start: SVector::zeros(),
            step,
            refinements: 0,
            max_steps: 1_000_000,
        }
    }

    /// Searches the coefficients of `law`.
    pub fn search(
        &self,
        operation: &Operation<N>,
        law: CoefficientLaw,
    ) -> Result<Solution<N>, SearchError> {
        let clock = Instant::now();
        if !(self.step.is_finite() && self.step > 0.0) {
            return Err(SearchError::Argument {
                name: "step",
                range: "above 0",
                value: self.step,
            });
        }
        if let Some(value) = self.start.iter().find(|k| !k.is_finite()) {
            return Err(SearchError::Argument {
                name: "start value",
                range: "finite",
                value: *value,
            });
        }
        let maps = Maps::new(operation, law);
        let mut walk = Walk {
            slopes: maps.step(),
            impact: operation.step() + maps.step() * self.start,
            k: self.start,
            steps_left: self.max_steps,
            maps,
        };
        let mut step = self.step;
        for _ in 0..=self.refinements {
            while walk.pass(step)? {}
            step /= 10.0;
        }
        let seconds = clock.elapsed().as_secs_f64();
        let compensation = law.with(walk.k);
        Ok(Solution {
            compensation,
            assessment: operation.assess(&compensation),
            status: if walk.steps_left == 0 {
                SolveStatus::StepLimit
            } else {
                SolveStatus::GridOptimum
            },
            gap: None,
            iterations: self.max_steps - walk.steps_left,
            seconds,
        })
    }
}

struct Walk<'a, const N: usize> {
    maps: Maps<'a, N>,
    slopes: SMatrix<f64, N, N>,
    impact: SVector<f64, N>,
    k: SVector<f64, N>,
    steps_left: usize,
}

impl<const N: usize> Walk<'_, N> {
    /// Each coefficient once, up and down. Whether any has moved.
    fn pass(&mut self, step: f64) -> Result<bool, SearchError> {
        let mut moved = false;
        for i in 0..N {
            let interval = self.maps.interval(i, &self.k)?;
            let start = interval.nearest(self.k[i]) - self.k[i];
            if start != 0.0 {
                self.go(i, start);
            }
            if self.maps.law == CoefficientLaw::PerJoint && !self.maps.worth(i) {
                continue;
            }
            for step in [step, -step] {
                while self.steps_left > 0
                    && interval.contains(self.k[i] + step)
                    && self.cost(i, step) < self.cost(i, 0.0)
                {
                    self.go(i, step);
                    self.steps_left -= 1;
                    moved = true;
                }
            }
        }
        Ok(moved && self.steps_left > 0)
    }

    fn go(&mut self, i: usize, step: f64) {
        self.k[i] += step;
        self.impact += self.slopes.column(i) * step;
    }

    /// What coefficient `i` is to make small, `step` away from here.
    fn cost(&self, i: usize, step: f64) -> f64 {
        let impact = self.impact + self.slopes.column(i) * step;
        let (maps, effort) = (&self.maps, self.maps.operation.effort());
        match maps.law {
            CoefficientLaw::PerJoint => impact[i].abs(),
            CoefficientLaw::Projected => {
                let locked = maps.operation.failure().joints;
                let mut k = self.k;
                k[i] += step;
                let spent = (maps.before() * k).norm_squared() + (maps.after() * k).norm_squared();
                locked.without(&impact).norm_squared() + effort * effort * spent
            }
        }
    }
}
