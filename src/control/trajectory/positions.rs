//! [`PositionLimits`]: where the joints can be.

use nalgebra::SVector;

use super::TrajectoryError;
use crate::SerialChain;

/// Where the joints can be; infinite where there is no limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionLimits<const N: usize> {
    /// Least q, rad (m).
    pub lower: SVector<f64, N>,
    /// Largest q, rad (m).
    pub upper: SVector<f64, N>,
}

/// What counts as rounding beyond a limit, rad (m).
const ROUNDING: f64 = 1e-9;

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
        let mut furthest = ROUNDING;
        let mut found = Ok(());
        for joint in 0..N {
            let (value, lower, upper) = (q[joint], self.lower[joint], self.upper[joint]);
            // A limit or a position that is no number is beyond all.
            let beyond = if lower <= value && value <= upper {
                0.0
            } else if value > upper {
                value - upper
            } else if value < lower {
                lower - value
            } else {
                f64::INFINITY
            };
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
