//! Motion of the joints over time: the trapezoid with parabolic blends.

use nalgebra::SVector;

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

/// What the joints can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits<const N: usize> {
    /// Largest |`q̇_i`|, rad/s (m/s).
    pub velocity: SVector<f64, N>,
    /// Largest |`q̈_i`|, rad/s² (m/s²).
    pub acceleration: SVector<f64, N>,
}

impl<const N: usize> JointLimits<N> {
    /// No limit on any joint.
    pub fn none() -> Self {
        Self {
            velocity: SVector::repeat(f64::INFINITY),
            acceleration: SVector::repeat(f64::INFINITY),
        }
    }

    /// Refuses rates beyond the limits; names the joint that is furthest beyond, and `time`.
    ///
    /// # Errors
    /// The rate, and the limit that it is beyond.
    pub fn admit(
        &self,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
        time: f64,
    ) -> Result<(), TrajectoryError> {
        if let Some((joint, value, limit)) = furthest_beyond(qd, &self.velocity) {
            return Err(TrajectoryError::Velocity {
                joint,
                time,
                value,
                limit,
            });
        }
        if let Some((joint, value, limit)) = furthest_beyond(qdd, &self.acceleration) {
            return Err(TrajectoryError::Acceleration {
                joint,
                time,
                value,
                limit,
            });
        }
        Ok(())
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

/// Why a motion cannot be executed. Joints count from 0 in the fields and from 1 in the messages.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrajectoryError {
    /// An argument is infinite or no number.
    #[error("the {0} must be finite")]
    NotFinite(&'static str),
    /// A duration that is not above zero.
    #[error("the duration must be above 0 s, not {0} s")]
    Duration(f64),
    /// A time between two knots that is not above zero, or below a millionth of the motion.
    #[error("the knot period must be above 0 s and at least a millionth of the motion, not {0} s")]
    KnotPeriod(f64),
    /// A blend that does not fit into the motion twice.
    #[error(
        "the blend must last more than 0 s and at most half of the {duration} s, not {blend} s"
    )]
    Blend {
        /// The blend asked for, s.
        blend: f64,
        /// The motion's duration, s.
        duration: f64,
    },
    /// A joint would have to be faster than it can.
    #[error("joint {} would need {value:.6} rad/s (m/s) at {time:.3} s; its limit is {limit:.6}", joint + 1)]
    Velocity {
        /// The joint, from 0.
        joint: usize,
        /// When, s.
        time: f64,
        /// |`q̇_i`| needed, rad/s (m/s).
        value: f64,
        /// |`q̇_i`| allowed, rad/s (m/s).
        limit: f64,
    },
    /// A joint would have to accelerate harder than it can.
    #[error("joint {} would need {value:.6} rad/s² (m/s²) at {time:.3} s; its limit is {limit:.6}", joint + 1)]
    Acceleration {
        /// The joint, from 0.
        joint: usize,
        /// When, s.
        time: f64,
        /// |`q̈_i`| needed, rad/s² (m/s²).
        value: f64,
        /// |`q̈_i`| allowed, rad/s² (m/s²).
        limit: f64,
    },
    /// The path leads to a pose where the task's rows of J are nearly dependent.
    #[error(
        "the path comes too near a singular pose at {time:.3} s (conditioning {conditioning:.2e})"
    )]
    NearSingular {
        /// When, s.
        time: f64,
        /// [`NullSpace::conditioning`](crate::control::null_space::NullSpace::conditioning) there.
        conditioning: f64,
    },
}

/// How far along a path of length 1: rest to rest, constant acceleration in the blends, constant speed between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrapezoidProfile {
    duration: f64,
    blend: f64,
}

impl TrapezoidProfile {
    /// The profile of a motion of `duration`, with a blend of `blend` at each end, s.
    ///
    /// # Errors
    /// A duration that is not above 0, or two blends that do not fit into it.
    pub fn new(duration: f64, blend: f64) -> Result<Self, TrajectoryError> {
        if !(duration.is_finite() && duration > 0.0) {
            return Err(TrajectoryError::Duration(duration));
        }
        let fits = blend > 0.0 && 2.0 * blend <= duration;
        if !fits {
            return Err(TrajectoryError::Blend { blend, duration });
        }
        Ok(Self { duration, blend })
    }

    /// How long the motion lasts, s.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// The speed between the blends, 1/s.
    pub fn cruise_speed(&self) -> f64 {
        1.0 / (self.duration - self.blend)
    }

    /// The acceleration of the first blend, 1/s².
    pub fn acceleration(&self) -> f64 {
        self.cruise_speed() / self.blend
    }

    /// s, ṡ, s̈ at `time`. Where s̈ jumps, its value after the jump.
    pub fn at(&self, time: f64) -> (f64, f64, f64) {
        let (speed, acceleration) = (self.cruise_speed(), self.acceleration());
        let left = self.duration - time;
        if time < 0.0 {
            (0.0, 0.0, 0.0)
        } else if time < self.blend {
            (
                0.5 * acceleration * time * time,
                acceleration * time,
                acceleration,
            )
        } else if left > self.blend {
            (speed * (time - 0.5 * self.blend), speed, 0.0)
        } else if left > 0.0 {
            (
                1.0 - 0.5 * acceleration * left * left,
                acceleration * left,
                -acceleration,
            )
        } else {
            (1.0, 0.0, 0.0)
        }
    }
}

/// Trapezoidal velocity with parabolic blends in joint space, all joints in step
/// (Craig, Introduction to Robotics, 3rd ed., 7.3: linear function with parabolic blends).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trapezoid<const N: usize> {
    start: SVector<f64, N>,
    goal: SVector<f64, N>,
    profile: TrapezoidProfile,
}

impl<const N: usize> Trapezoid<N> {
    /// From `start` to `goal` in `duration` s, speeding up and slowing down for `blend` s each.
    ///
    /// Refuses what is not finite, a duration or a blend that makes no motion, and rates beyond `limits`.
    pub fn new(
        start: SVector<f64, N>,
        goal: SVector<f64, N>,
        duration: f64,
        blend: f64,
        limits: &JointLimits<N>,
    ) -> Result<Self, TrajectoryError> {
        if !JointState::at_rest(start).is_finite() {
            return Err(TrajectoryError::NotFinite("start"));
        }
        if !JointState::at_rest(goal).is_finite() {
            return Err(TrajectoryError::NotFinite("goal"));
        }
        let profile = TrapezoidProfile::new(duration, blend)?;
        let travel = goal - start;
        let rates = JointState {
            q: travel,
            qd: travel * profile.cruise_speed(),
            qdd: travel * profile.acceleration(),
        };
        if !rates.is_finite() {
            return Err(TrajectoryError::NotFinite("rate between start and goal"));
        }
        limits.admit(&rates.qd, &rates.qdd, blend)?;
        Ok(Self {
            start,
            goal,
            profile,
        })
    }
}

impl<const N: usize> Trajectory<N> for Trapezoid<N> {
    fn duration(&self) -> f64 {
        self.profile.duration
    }

    fn state(&self, time: f64) -> JointState<N> {
        let (s, speed, acceleration) = self.profile.at(time);
        let travel = self.goal - self.start;
        JointState {
            q: self.start + travel * s,
            qd: travel * speed,
            qdd: travel * acceleration,
        }
    }
}
