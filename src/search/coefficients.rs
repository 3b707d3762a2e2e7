//! The laws with coefficients k_d: what U is per coefficient, where the coefficients may lie (Eq. 28), and the searches joint by joint.

use std::time::Instant;

use nalgebra::{SMatrix, SVector};

use super::{Operation, Outcome, Sample, SearchError, SolveStatus};
use crate::compensation::Compensation;

/// A coefficient that does less than this much of what the strongest does has no say: it stays 0, or as near to 0 as it may.
pub(super) const NO_SAY: f64 = 1e-9;

/// A law with coefficients k_d.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CoefficientLaw {
    /// Eq. 16. What counts is each joint's own step, the locked one's too.
    PerJoint,
    /// Eq. 20. What counts is the norm of the steps of the healthy joints: they share the coefficients.
    ///
    /// They do not share much. With J' of the locked arm, the null space of J without the locked joint is that of J',
    /// so that P' and P differ, on the healthy joints, by one direction for each locked joint:
    /// one locked joint leaves all coefficients together a single direction of the step to take away.
    Projected,
}

impl CoefficientLaw {
    /// The law with the coefficients `k`.
    pub fn with<const N: usize>(self, k: SVector<f64, N>) -> Compensation<N> {
        match self {
            Self::PerJoint => Compensation::PerJoint(k),
            Self::Projected => Compensation::Projected(k),
        }
    }

    /// ∂U/∂k_d at a sample: U is linear in k_d.
    pub(super) fn map<const N: usize>(self, sample: &Sample<N>) -> SMatrix<f64, N, N> {
        let pose = &sample.pose;
        match self {
            Self::PerJoint => SMatrix::from_diagonal(&pose.project(&pose.gradient)),
            Self::Projected => {
                let mut map = SMatrix::<f64, N, N>::zeros();
                for i in 0..N {
                    let mut weight = SVector::<f64, N>::zeros();
                    weight[i] = pose.gradient[i];
                    map.set_column(i, &pose.project(&weight));
                }
                map
            }
        }
    }
}

/// The maps of a law at every sample of an operation.
pub(super) struct Maps<'a, const N: usize> {
    pub(super) operation: &'a Operation<N>,
    pub(super) law: CoefficientLaw,
    pub(super) at: Vec<SMatrix<f64, N, N>>,
}

impl<'a, const N: usize> Maps<'a, N> {
    pub(super) fn new(operation: &'a Operation<N>, law: CoefficientLaw) -> Self {
        let at = operation.samples.iter().map(|sample| law.map(sample));
        Self {
            operation,
            law,
            at: at.collect(),
        }
    }

    /// ∂Δτ̃/∂k_d.
    pub(super) fn step(&self) -> SMatrix<f64, N, N> {
        self.at[self.operation.lock] - self.at[self.operation.lock - 1]
    }

    /// Eq. 28, see [`feasible_interval`].
    fn interval(&self, i: usize, k: &SVector<f64, N>) -> Result<Interval, SearchError> {
        let mut interval = Interval::EVERYTHING;
        let others = {
            let mut others = *k;
            others[i] = 0.0;
            others
        };
        for (sample, map) in self.operation.samples.iter().zip(&self.at) {
            for joint in sample.locked.healthy() {
                if self.law == CoefficientLaw::PerJoint && joint != i {
                    continue;
                }
                let rated = self.operation.rated_torque[joint];
                let slope = map[(joint, i)];
                let torque = sample.planned[joint] + (map.row(joint) * others).x;
                interval.keep_within(rated, torque, slope, sample.time);
                let within = slope != 0.0 || torque.abs() <= rated;
                if !within || interval.lower > interval.upper {
                    return Err(SearchError::Empty {
                        joint,
                        time: sample.time,
                    });
                }
            }
        }
        Ok(interval)
    }
}

/// Where a coefficient may lie (Eq. 28), and the times that bound it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// k_di^down; −∞ if nothing bounds it.
    pub lower: f64,
    /// The time that bounds it below, s.
    pub lower_time: Option<f64>,
    /// k_di^up; ∞ if nothing bounds it.
    pub upper: f64,
    /// The time that bounds it above, s.
    pub upper_time: Option<f64>,
}

impl Interval {
    const EVERYTHING: Self = Self {
        lower: f64::NEG_INFINITY,
        lower_time: None,
        upper: f64::INFINITY,
        upper_time: None,
    };

    /// Keeps `|torque + slope k| ≤ rated`.
    fn keep_within(&mut self, rated: f64, torque: f64, slope: f64, time: f64) {
        if slope == 0.0 || rated == f64::INFINITY {
            return;
        }
        let ends = [(-rated - torque) / slope, (rated - torque) / slope];
        let (lower, upper) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        if lower > self.lower {
            (self.lower, self.lower_time) = (lower, Some(time));
        }
        if upper < self.upper {
            (self.upper, self.upper_time) = (upper, Some(time));
        }
    }

    /// The admissible value nearest to `k`.
    fn nearest(&self, k: f64) -> f64 {
        k.max(self.lower).min(self.upper)
    }

    fn contains(&self, k: f64) -> bool {
        self.lower <= k && k <= self.upper
    }
}

/// Where the coefficient of joint `i` (from 0) may lie for the torques to stay within the rated ones
/// over the whole operation (Eq. 28 with Section 5.3's τ^v in it), with the other coefficients as in `k`.
///
/// Fails if the interval is empty, and names the joint and the time that empty it.
pub fn feasible_interval<const N: usize>(
    operation: &Operation<N>,
    law: CoefficientLaw,
    i: usize,
    k: &SVector<f64, N>,
) -> Result<Interval, SearchError> {
    if i >= N {
        return Err(SearchError::Argument {
            name: "joint's index",
            range: "below the number of joints",
            value: i as f64,
        });
    }
    Maps::new(operation, law).interval(i, k)
}

/// Eq. 16 exactly: `k_di = −step_i / ∂Δτ̃_i/∂k_di` cancels each joint's step; where a rated torque forbids it,
/// the nearest value that Eq. 28 allows leaves the least, since |Δτ̃_i| is convex in k_di.
pub fn cancel_per_joint<const N: usize>(
    operation: &Operation<N>,
) -> Result<Outcome<N>, SearchError> {
    let clock = Instant::now();
    let maps = Maps::new(operation, CoefficientLaw::PerJoint);
    let slopes = maps.step().diagonal();
    let step = operation.step();
    let mut k = SVector::zeros();
    for i in 0..N {
        let wish = if slopes[i].abs() > NO_SAY * slopes.amax() {
            -step[i] / slopes[i]
        } else {
            0.0
        };
        k[i] = maps.interval(i, &k)?.nearest(wish);
    }
    let seconds = clock.elapsed().as_secs_f64();
    let compensation = Compensation::PerJoint(k);
    Ok(Outcome {
        compensation,
        assessment: operation.assess(&compensation),
        status: SolveStatus::ClosedForm,
        gap: Some(0.0),
        iterations: 0,
        seconds,
    })
}

/// The paper's search (Figure 2): from a start value, each coefficient goes up and down in fixed steps
/// within its interval of Eq. 28 as long as the impact shrinks.
///
/// With Eq. 16 each joint is on its own, and one pass finds the best point of the grid. With Eq. 20 the coefficients
/// act together; the passes are repeated until none moves any more.
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
    ) -> Result<Outcome<N>, SearchError> {
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
        Ok(Outcome {
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
        match self.maps.law {
            CoefficientLaw::PerJoint => impact[i].abs(),
            CoefficientLaw::Projected => {
                let locked = self.maps.operation.failure.joints;
                locked.without(&impact).norm_squared()
            }
        }
    }
}
