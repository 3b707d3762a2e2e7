//! [`TrajectoryError`]: why a motion cannot be executed.

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
    /// A jerk that does not fit into the blend twice.
    #[error(
        "the jerk time must be at least a millionth of the {blend} s of a blend and at most half of it, not {jerk_time} s"
    )]
    JerkTime {
        /// The jerk time asked for, s.
        jerk_time: f64,
        /// The motion's blend, s.
        blend: f64,
    },
    /// A joint would have to go where it cannot.
    #[error("joint {} would be at {value:.6} rad (m) at {time:.3} s; its limits are {lower:.6} and {upper:.6}", joint + 1)]
    Position {
        /// The joint, from 0.
        joint: usize,
        /// When, s.
        time: f64,
        /// `q_i` there, rad (m).
        value: f64,
        /// The least `q_i` allowed, rad (m).
        lower: f64,
        /// The largest `q_i` allowed, rad (m).
        upper: f64,
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
    /// A joint's acceleration would have to change faster than it can.
    #[error("joint {} would need {value:.6} rad/s³ (m/s³) at {time:.3} s; its limit is {limit:.6}", joint + 1)]
    Jerk {
        /// The joint, from 0.
        joint: usize,
        /// When, s.
        time: f64,
        /// |d`q̈_i`/dt| needed, rad/s³ (m/s³); infinite where `q̈_i` jumps.
        value: f64,
        /// |d`q̈_i`/dt| allowed, rad/s³ (m/s³).
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
