//! [`PositionLimits`]: where the joints can be.

use nalgebra::SVector;

use super::TrajectoryError;
use crate::{Limits, SerialChain};

/// Where the joints can be; infinite where there is no limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionLimits<const N: usize> {
    /// Least q, rad (m).
    pub lower: SVector<f64, N>,
    /// Largest q, rad (m).
    pub upper: SVector<f64, N>,
}

impl<const N: usize> PositionLimits<N> {
    /// Those of the arm's table.
    pub fn of(chain: &SerialChain<N>) -> Self {
        Self {
            lower: SVector::from_fn(|i, _| chain.joints[i].limits.lower),
            upper: SVector::from_fn(|i, _| chain.joints[i].limits.upper),
        }
    }

    /// No limit on any joint.
    pub fn none() -> Self {
        Self {
            lower: SVector::repeat(f64::NEG_INFINITY),
            upper: SVector::repeat(f64::INFINITY),
        }
    }

    /// Refuses positions beyond the limits; names the joint that is furthest beyond, and `time`.
    ///
    /// # Errors
    /// The position, and the limits that it is beyond.
    pub fn admit(&self, q: &SVector<f64, N>, time: f64) -> Result<(), TrajectoryError> {
        let mut furthest = 0.0;
        let mut found = Ok(());
        for joint in 0..N {
            let (value, lower, upper) = (q[joint], self.lower[joint], self.upper[joint]);
            let limits = Limits {
                lower,
                upper,
                ..Limits::NONE
            };
            let beyond = limits.beyond(value);
            if beyond > furthest {
                furthest = beyond;
                found = Err(TrajectoryError::Position {
                    joint,
                    time,
                    value,
                    lower,
                    upper,
                });
            }
        }
        found
    }
}
