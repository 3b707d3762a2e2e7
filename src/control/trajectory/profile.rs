//! [`Profile`]: how far along a path of length 1, from rest to rest.

use super::TrajectoryError;

/// How the speed rises within a blend; it falls likewise, mirrored.
///
/// All shapes need the same time for the same way: within a blend of length T they are symmetric about its middle,
/// and cover half of what the cruise speed would.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ProfileShape {
    /// Constant acceleration, so that the position is a parabola
    /// (Craig, Introduction to Robotics, 3rd ed., 7.3: linear function with parabolic blends). The acceleration jumps.
    #[default]
    Trapezoid,
    /// The speed rises as 10x³ − 15x⁴ + 6x⁵ of x = t/T, the fifth-order time scaling
    /// (Lynch and Park, Modern Robotics, 9.2.2) of the speed instead of the position. Acceleration and jerk are continuous.
    ///
    /// A quintic of the *position* that meets the cruise in speed and acceleration would be x³ − x⁴/2 of degree 4 here,
    /// and leave the jerk to jump as the S-curve does.
    Quintic,
    /// Constant jerk, constant acceleration, constant negative jerk: with the cruise and the other blend, seven segments
    /// (Lynch and Park, 9.2.2: S-curve; Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines and Robots: double S).
    /// The acceleration is continuous, the jerk jumps.
    SCurve {
        /// How long the acceleration takes to rise, and again to fall, s: at most half of the blend.
        jerk_time: f64,
    },
}

impl ProfileShape {
    /// The S-curve without constant acceleration: the jerk takes half of the `blend`, s. Of all its jerk is the least.
    pub fn s_curve(blend: f64) -> Self {
        Self::SCurve {
            jerk_time: 0.5 * blend,
        }
    }
}

/// How far along a path of length 1: rest to rest, constant speed between two blends of some [`ProfileShape`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    duration: f64,
    blend: f64,
    shape: ProfileShape,
}

/// On which side of a time where the acceleration jumps.
#[derive(Clone, Copy)]
enum Side {
    Before,
    After,
}

/// The largest of d(10x³ − 15x⁴ + 6x⁵)/dx = 30x²(1 − x)², at x = 1/2.
const QUINTIC_ACCELERATION: f64 = 1.875;
/// The largest of 60x(1 − x)(1 − 2x), its derivative, 10/√3, and where it is, (3 − √3)/6.
const QUINTIC_JERK: f64 = 5.773_502_691_896_258;
const QUINTIC_JERK_AT: f64 = 0.211_324_865_405_187_1;

impl Profile {
    /// The least share of a blend that a jerk may take: below it, the acceleration may as well jump.
    const LEAST_JERK_SHARE: f64 = 1e-6;

    /// The profile of a motion of `duration`, with a blend of `blend` at each end, s.
    ///
    /// # Errors
    /// A duration that is not above 0, two blends that do not fit into it, or two jerk times that do not fit into the blend.
    pub fn new(duration: f64, blend: f64, shape: ProfileShape) -> Result<Self, TrajectoryError> {
        if !(duration.is_finite() && duration > 0.0) {
            return Err(TrajectoryError::Duration(duration));
        }
        let fits = blend > 0.0 && 2.0 * blend <= duration;
        if !fits {
            return Err(TrajectoryError::Blend { blend, duration });
        }
        if let ProfileShape::SCurve { jerk_time } = shape {
            let fits = jerk_time >= Self::LEAST_JERK_SHARE * blend && 2.0 * jerk_time <= blend;
            if !fits {
                return Err(TrajectoryError::JerkTime { jerk_time, blend });
            }
        }
        Ok(Self {
            duration,
            blend,
            shape,
        })
    }

    /// How long the motion lasts, s.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// How long each blend lasts, s.
    pub fn blend(&self) -> f64 {
        self.blend
    }

    /// How the speed rises in it.
    pub fn shape(&self) -> ProfileShape {
        self.shape
    }

    /// The speed between the blends, 1/s.
    pub fn cruise_speed(&self) -> f64 {
        1.0 / (self.duration - self.blend)
    }

    /// The largest acceleration, 1/s².
    pub fn peak_acceleration(&self) -> f64 {
        let speed = self.cruise_speed();
        match self.shape {
            ProfileShape::Trapezoid => speed / self.blend,
            ProfileShape::Quintic => QUINTIC_ACCELERATION * speed / self.blend,
            ProfileShape::SCurve { jerk_time } => speed / (self.blend - jerk_time),
        }
    }

    /// A time at which it is reached, s.
    pub fn peak_acceleration_time(&self) -> f64 {
        0.5 * self.blend
    }

    /// The largest jerk, 1/s³; infinite where the acceleration jumps.
    pub fn peak_jerk(&self) -> f64 {
        match self.shape {
            ProfileShape::Trapezoid => f64::INFINITY,
            ProfileShape::Quintic => QUINTIC_JERK * self.cruise_speed() / (self.blend * self.blend),
            ProfileShape::SCurve { jerk_time } => self.peak_acceleration() / jerk_time,
        }
    }

    /// A time at which it is reached, s.
    pub fn peak_jerk_time(&self) -> f64 {
        match self.shape {
            ProfileShape::Quintic => QUINTIC_JERK_AT * self.blend,
            ProfileShape::Trapezoid | ProfileShape::SCurve { .. } => 0.0,
        }
    }

    /// s, ṡ, s̈ at `time`. Where s̈ jumps, its value after the jump.
    pub fn at(&self, time: f64) -> (f64, f64, f64) {
        self.on(Side::After, time)
    }

    /// s, ṡ, s̈ at `time`. Where s̈ jumps, its value before the jump.
    pub fn just_before(&self, time: f64) -> (f64, f64, f64) {
        self.on(Side::Before, time)
    }

    /// The times from 0 to the duration between which s is a single polynomial, ascending, each once.
    pub fn phase_ends(&self) -> impl Iterator<Item = f64> + use<> {
        let (blend, duration) = (self.blend, self.duration);
        let jerk_time = match self.shape {
            ProfileShape::SCurve { jerk_time } => jerk_time,
            ProfileShape::Trapezoid | ProfileShape::Quintic => 0.0,
        };
        let rise = [0.0, jerk_time, blend - jerk_time, blend];
        let fall = [blend, blend - jerk_time, jerk_time, 0.0].map(|left| duration - left);
        let mut last = f64::NEG_INFINITY;
        rise.into_iter().chain(fall).filter(move |time| {
            let later = *time > last;
            last = last.max(*time);
            later
        })
    }

    fn on(&self, side: Side, time: f64) -> (f64, f64, f64) {
        let reached = |end: f64| match side {
            Side::Before => time > end,
            Side::After => time >= end,
        };
        if !reached(0.0) {
            (0.0, 0.0, 0.0)
        } else if !reached(self.blend) {
            self.rise(time)
        } else if !reached(self.duration - self.blend) {
            let speed = self.cruise_speed();
            (speed * (time - 0.5 * self.blend), speed, 0.0)
        } else if !reached(self.duration) {
            let (left, speed, acceleration) = self.rise(self.duration - time);
            (1.0 - left, speed, -acceleration)
        } else {
            (1.0, 0.0, 0.0)
        }
    }

    /// s, ṡ, s̈ after `time` s of the first blend.
    fn rise(&self, time: f64) -> (f64, f64, f64) {
        let (speed, acceleration) = (self.cruise_speed(), self.peak_acceleration());
        match self.shape {
            ProfileShape::Trapezoid => (
                0.5 * acceleration * time * time,
                acceleration * time,
                acceleration,
            ),
            ProfileShape::Quintic => {
                let x = time / self.blend;
                let (square, rest) = (x * x, 1.0 - x);
                (
                    speed * self.blend * square * square * (2.5 + (x - 3.0) * x),
                    speed * square * x * (10.0 + (6.0 * x - 15.0) * x),
                    speed / self.blend * 30.0 * square * rest * rest,
                )
            }
            ProfileShape::SCurve { jerk_time } => {
                let jerk = acceleration / jerk_time;
                let left = self.blend - time;
                if time < jerk_time {
                    let rate = jerk * time;
                    (rate * time * time / 6.0, 0.5 * rate * time, rate)
                } else if left > jerk_time {
                    let way = 0.5 * time * (time - jerk_time) + jerk_time * jerk_time / 6.0;
                    (
                        acceleration * way,
                        acceleration * (time - 0.5 * jerk_time),
                        acceleration,
                    )
                } else {
                    let rate = jerk * left;
                    (
                        speed * (0.5 * self.blend - left) + rate * left * left / 6.0,
                        speed - 0.5 * rate * left,
                        rate,
                    )
                }
            }
        }
    }
}
