//! Motion of the joints over time: how they speed up and slow down, and the way from one position to another.

mod error;
mod limits;
mod point_to_point;
mod positions;
mod profile;

use nalgebra::SVector;

pub use error::TrajectoryError;
pub use limits::JointLimits;
pub use point_to_point::PointToPoint;
pub use positions::PositionLimits;
pub use profile::{Profile, ProfileShape};

/// Where the joints are and how they move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointState<const N: usize> {
    /// Positions q, rad (m).
    pub q: SVector<f64, N>,
    /// Velocities q̇, rad/s (m/s).
    pub qd: SVector<f64, N>,
    /// Accelerations q̈, rad/s² (m/s²).
    pub qdd: SVector<f64, N>,
}

impl<const N: usize> JointState<N> {
    /// At rest in `q`.
    pub fn at_rest(q: SVector<f64, N>) -> Self {
        Self {
            q,
            qd: SVector::zeros(),
            qdd: SVector::zeros(),
        }
    }

    /// Whether every entry is a number.
    pub fn is_finite(&self) -> bool {
        [&self.q, &self.qd, &self.qdd]
            .into_iter()
            .all(|entries| entries.iter().all(|x| x.is_finite()))
    }
}

/// A planned motion from time 0 to [`duration`](Self::duration); at rest before and after.
pub trait Trajectory<const N: usize> {
    /// The time that the motion takes, s.
    fn duration(&self) -> f64;

    /// The planned state at `time`, s.
    fn state(&self, time: f64) -> JointState<N>;
}
