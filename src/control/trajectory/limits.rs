//! [`JointLimits`]: what the joints can do.

use nalgebra::SVector;

use super::TrajectoryError;
use crate::SerialChain;

/// What the joints can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits<const N: usize> {
    /// Largest |`q̇_i`|, rad/s (m/s).
    pub velocity: SVector<f64, N>,
    /// Largest |`q̈_i`|, rad/s² (m/s²).
    pub acceleration: SVector<f64, N>,
    /// Largest |d`q̈_i`/dt|, rad/s³ (m/s³).
    pub jerk: SVector<f64, N>,
}

impl<const N: usize> JointLimits<N> {
    /// Those of the arm's table, which knows velocities; accelerations and jerks have no limit.
    pub fn of(chain: &SerialChain<N>) -> Self {
        Self {
            velocity: SVector::from_fn(|i, _| chain.joints[i].limits.velocity),
            ..Self::none()
        }
    }

    /// No limit on any joint.
    pub fn none() -> Self {
        Self {
            velocity: SVector::repeat(f64::INFINITY),
            acceleration: SVector::repeat(f64::INFINITY),
            jerk: SVector::repeat(f64::INFINITY),
        }
    }

    /// Refuses velocities beyond the limits; names the joint that is furthest beyond, and `time`.
    ///
    /// # Errors
    /// The velocity, and the limit that it is beyond.
    pub fn admit_velocity(&self, qd: &SVector<f64, N>, time: f64) -> Result<(), TrajectoryError> {
        match furthest_beyond(qd, &self.velocity) {
            None => Ok(()),
            Some((joint, value, limit)) => Err(TrajectoryError::Velocity {
                joint,
                time,
                value,
                limit,
            }),
        }
    }

    /// Likewise accelerations.
    ///
    /// # Errors
    /// The acceleration, and the limit that it is beyond.
    pub fn admit_acceleration(
        &self,
        qdd: &SVector<f64, N>,
        time: f64,
    ) -> Result<(), TrajectoryError> {
        match furthest_beyond(qdd, &self.acceleration) {
            None => Ok(()),
            Some((joint, value, limit)) => Err(TrajectoryError::Acceleration {
                joint,
                time,
                value,
                limit,
            }),
        }
    }

    /// Likewise jerks; an acceleration that jumps has an infinite one.
    ///
    /// # Errors
    /// The jerk, and the limit that it is beyond.
    pub fn admit_jerk(&self, jerk: &SVector<f64, N>, time: f64) -> Result<(), TrajectoryError> {
        match furthest_beyond(jerk, &self.jerk) {
            None => Ok(()),
            Some((joint, value, limit)) => Err(TrajectoryError::Jerk {
                joint,
                time,
                value,
                limit,
            }),
        }
    }
}

/// The joint with the largest `|values| - limits` above zero, its value and its limit.
/// A limit that is no number admits nothing.
fn furthest_beyond<const N: usize>(
    values: &SVector<f64, N>,
    limits: &SVector<f64, N>,
) -> Option<(usize, f64, f64)> {
    let mut worst: Option<(usize, f64, f64)> = None;
    for joint in 0..N {
        let (value, limit) = (values[joint].abs(), limits[joint]);
        let within = value <= limit;
        if !within && worst.is_none_or(|(_, v, l)| value - limit > v - l) {
            worst = Some((joint, value, limit));
        }
    }
    worst
}
