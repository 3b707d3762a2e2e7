//! [`PointToPoint`]: straight in joint space.

use nalgebra::SVector;

use super::{JointLimits, JointState, Profile, ProfileShape, Trajectory, TrajectoryError};

/// From one position to another in a straight line of joint space, all joints in step along one [`Profile`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointToPoint<const N: usize> {
    start: SVector<f64, N>,
    goal: SVector<f64, N>,
    profile: Profile,
}

impl<const N: usize> PointToPoint<N> {
    /// From `start` to `goal` in `duration` s, with [`ProfileShape::Trapezoid`]: speeding up and slowing down for `blend` s each.
    ///
    /// # Errors
    /// As [`along`](Self::along), and as [`Profile::new`].
    pub fn new(
        start: SVector<f64, N>,
        goal: SVector<f64, N>,
        duration: f64,
        blend: f64,
        limits: &JointLimits<N>,
    ) -> Result<Self, TrajectoryError> {
        finite(&start, &goal)?;
        let profile = Profile::new(duration, blend, ProfileShape::Trapezoid)?;
        Self::along(start, goal, profile, limits)
    }

    /// From `start` to `goal` along `profile`.
    ///
    /// # Errors
    /// What is not finite, and rates beyond `limits` at the profile's peaks.
    pub fn along(
        start: SVector<f64, N>,
        goal: SVector<f64, N>,
        profile: Profile,
        limits: &JointLimits<N>,
    ) -> Result<Self, TrajectoryError> {
        finite(&start, &goal)?;
        let travel = goal - start;
        let rates = JointState {
            q: travel,
            qd: travel * profile.cruise_speed(),
            qdd: travel * profile.peak_acceleration(),
        };
        if !rates.is_finite() {
            return Err(TrajectoryError::NotFinite("rate between start and goal"));
        }
        // A joint that stays where it is has no jerk, even if the others' is infinite.
        let jerk = travel.map(|travel| {
            if travel == 0.0 {
                0.0
            } else {
                travel * profile.peak_jerk()
            }
        });
        limits.admit_velocity(&rates.qd, profile.blend())?;
        limits.admit_acceleration(&rates.qdd, profile.peak_acceleration_time())?;
        limits.admit_jerk(&jerk, profile.peak_jerk_time())?;
        Ok(Self {
            start,
            goal,
            profile,
        })
    }

    /// How the joints speed up and slow down.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The planned state at `time`, s; where q̈ jumps, with its value before the jump.
    pub fn state_before(&self, time: f64) -> JointState<N> {
        self.point(self.profile.just_before(time))
    }

    fn point(&self, (s, speed, acceleration): (f64, f64, f64)) -> JointState<N> {
        let travel = self.goal - self.start;
        JointState {
            q: self.start + travel * s,
            qd: travel * speed,
            qdd: travel * acceleration,
        }
    }
}

fn finite<const N: usize>(
    start: &SVector<f64, N>,
    goal: &SVector<f64, N>,
) -> Result<(), TrajectoryError> {
    for (name, q) in [("start", start), ("goal", goal)] {
        if !JointState::at_rest(*q).is_finite() {
            return Err(TrajectoryError::NotFinite(name));
        }
    }
    Ok(())
}

impl<const N: usize> Trajectory<N> for PointToPoint<N> {
    fn duration(&self) -> f64 {
        self.profile.duration()
    }

    fn state(&self, time: f64) -> JointState<N> {
        self.point(self.profile.at(time))
    }
}
