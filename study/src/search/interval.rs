//! Where the coefficients may lie (Eq. 28).

use nalgebra::SVector;

use super::coefficients::{CoefficientLaw, Maps};
use super::{Operation, SearchError};

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
    pub(super) fn nearest(&self, k: f64) -> f64 {
        k.max(self.lower).min(self.upper)
    }

    pub(super) fn contains(&self, k: f64) -> bool {
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

impl<const N: usize> Maps<'_, N> {
    /// Eq. 28, see [`feasible_interval`].
    pub(super) fn interval(&self, i: usize, k: &SVector<f64, N>) -> Result<Interval, SearchError> {
        let mut interval = Interval::EVERYTHING;
        let others = {
            let mut others = *k;
            others[i] = 0.0;
            others
        };
        for (sample, map) in self.operation.samples().iter().zip(&self.at) {
            for joint in sample.locked.healthy() {
                if self.law == CoefficientLaw::PerJoint && joint != i {
                    continue;
                }
                let rated = self.operation.rated_torque()[joint];
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
