//! [`Motion`]: the planned motion of a scenario, for an arm of any number of joints.

use nalgebra::{SVector, Vector6};

use super::CampaignSettings;
use crate::tool_path::{StraightLine, ToolPath};
use ulna::control::trajectory::TrajectoryError;
use ulna::proof::random::SplitMix64;
use ulna::{
    Arm, Joint, JointLimits, JointState, PointToPoint, PositionLimits, Profile, ProfileShape,
    TaskRows, Trajectory,
};

/// A planned motion from rest to rest. Its lists have one entry for each joint of the same arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    pub(super) start: Vec<f64>,
    pub(super) path: Path,
    pub(super) profile: Profile,
    pub(super) max_velocity: Vec<f64>,
    pub(super) max_acceleration: Vec<f64>,
    pub(super) max_jerk: Vec<f64>,
    /// The least and the largest q of each joint, by the arm's table.
    pub(super) range: Vec<(f64, f64)>,
}

/// What moves in a straight line.
#[derive(Clone, Debug, PartialEq)]
pub enum Path {
    /// The joints, to q.
    Joint(Vec<f64>),
    /// The tool, by `[translation; rotation vector]`, world axes, m and rad.
    Tool(Vector6<f64>),
}

impl Motion {
    /// From `start` (q, rad, m) along `path`, as `profile` says, by an arm with `joints`, whose velocities and positions the limits of its
    /// table bound. Whether it can be executed is seen where it is planned.
    pub fn new(joints: &[Joint], start: Vec<f64>, path: Path, profile: Profile) -> Self {
        Self {
            start,
            path,
            profile,
            max_velocity: joints.iter().map(|joint| joint.limits.velocity).collect(),
            max_acceleration: vec![f64::INFINITY; joints.len()],
            max_jerk: vec![f64::INFINITY; joints.len()],
            range: range(joints),
        }
    }

    /// The same within further limits, where there are any: |q̇_i|, rad/s (m/s), beside the table's; |q̈_i|, rad/s² (m/s²);
    /// |d`q̈_i`/dt|, rad/s³ (m/s³). One that is negative or no number counts as 0.
    #[must_use]
    pub fn within(
        mut self,
        velocity: Option<&[f64]>,
        acceleration: Option<&[f64]>,
        jerk: Option<&[f64]>,
    ) -> Self {
        let sound = |limits: &[f64]| limits.iter().map(|limit| limit.max(0.0)).collect();
        if let Some(limits) = velocity {
            // A list of another length is left as it is, and refused where the motion is planned.
            let mut velocity: Vec<f64> = sound(limits);
            let table = self.max_velocity.iter();
            velocity
                .iter_mut()
                .zip(table)
                .for_each(|(own, table)| *own = own.min(*table));
            self.max_velocity = velocity;
        }
        if let Some(limits) = acceleration {
            self.max_acceleration = sound(limits);
        }
        if let Some(limits) = jerk {
            self.max_jerk = sound(limits);
        }
        self
    }

    /// Where it starts: q, rad (m).
    pub fn start(&self) -> &[f64] {
        &self.start
    }

    /// How it goes on.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The whole motion, s.
    pub fn duration(&self) -> f64 {
        self.profile.duration()
    }

    /// Speeding up and slowing down, s each: above 0, and twice it is no more than the duration.
    pub fn blend(&self) -> f64 {
        self.profile.blend()
    }

    /// How the joints, or the tool, speed up and slow down.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The same motion in the same time, with blends of another shape.
    ///
    /// # Errors
    /// When that shape does not fit into the blend.
    pub fn with_shape(mut self, shape: ProfileShape) -> Result<Self, TrajectoryError> {
        self.profile = Profile::new(self.duration(), self.blend(), shape)?;
        Ok(self)
    }

    /// Largest |q̇_i|, rad/s (m/s), the less of the scenario's and the arm's table's; infinite where there is no limit.
    pub fn max_velocity(&self) -> &[f64] {
        &self.max_velocity
    }

    /// Largest |q̈_i|, rad/s² (m/s²); infinite where there is no limit.
    pub fn max_acceleration(&self) -> &[f64] {
        &self.max_acceleration
    }

    /// Largest |d`q̈_i`/dt|, rad/s³ (m/s³); infinite where there is no limit.
    pub fn max_jerk(&self) -> &[f64] {
        &self.max_jerk
    }

    /// The motion as `campaign` varies it: another start, and another goal, for a tool in the components of `task`.
    pub(crate) fn varied(
        &self,
        campaign: &CampaignSettings,
        task: TaskRows,
        random: &mut SplitMix64,
    ) -> Self {
        let mut motion = self.clone();
        for start in &mut motion.start {
            *start += campaign.start_spread * random.symmetric();
        }
        match &mut motion.path {
            Path::Joint(goal) => {
                for goal in goal {
                    *goal += campaign.goal_spread * random.symmetric();
                }
            }
            Path::Tool(displacement) => {
                for row in task.iter() {
                    displacement[row.index()] += campaign.goal_spread * random.symmetric();
                }
            }
        }
        motion
    }

    /// The motion for `arm`; the knots of a tool path are `knot_period` s apart.
    ///
    /// # Errors
    /// When the motion cannot be executed: it is that of another arm, too fast or too far for a joint, or leads through a singular pose.
    pub fn plan<const N: usize>(
        &self,
        arm: &(impl Arm<N> + ?Sized),
        knot_period: f64,
    ) -> Result<PlannedMotion<N>, PlanError> {
        let start = for_each_joint(&self.start)?;
        let limits = JointLimits {
            velocity: for_each_joint(&self.max_velocity)?,
            acceleration: for_each_joint(&self.max_acceleration)?,
            jerk: for_each_joint(&self.max_jerk)?,
        };
        let (lower, upper): (Vec<f64>, Vec<f64>) = self.range.iter().copied().unzip();
        let range = PositionLimits {
            lower: for_each_joint(&lower)?,
            upper: for_each_joint(&upper)?,
        };
        range.admit(&start, 0.0)?;
        Ok(match &self.path {
            Path::Joint(goal) => {
                let goal = for_each_joint(goal)?;
                range.admit(&goal, self.duration())?;
                let motion = PointToPoint::along(start, goal, self.profile, &limits)?;
                PlannedMotion::Joint(motion)
            }
            Path::Tool(displacement) => {
                let line = StraightLine {
                    displacement: *displacement,
                    profile: self.profile,
                    knot_period,
                };
                let path = ToolPath::straight(arm, &start, &line, &limits)?;
                path.states()
                    .try_for_each(|(time, state)| range.admit(&state.q, time))?;
                PlannedMotion::Tool(path)
            }
        })
    }
}

/// The least and the largest q of each joint.
pub(super) fn range(joints: &[Joint]) -> Vec<(f64, f64)> {
    let limits = joints.iter().map(|joint| joint.limits);
    limits.map(|limits| (limits.lower, limits.upper)).collect()
}

fn for_each_joint<const N: usize>(numbers: &[f64]) -> Result<SVector<f64, N>, PlanError> {
    let numbers: [f64; N] = numbers.try_into().map_err(|_| PlanError::Joints {
        motion: numbers.len(),
        arm: N,
    })?;
    Ok(numbers.into())
}

/// Why a [`Motion`] cannot be executed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// The motion is for another number of joints.
    #[error("the motion is for {motion} joints, the arm has {arm}")]
    Joints {
        /// The joints of the motion.
        motion: usize,
        /// The joints of the arm.
        arm: usize,
    },
    /// Too fast for a joint, or through a singular pose.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
}

/// A [`Motion`] that an arm can execute.
#[derive(Clone, Debug, PartialEq)]
pub enum PlannedMotion<const N: usize> {
    /// Straight in joint space.
    Joint(PointToPoint<N>),
    /// Straight in space.
    Tool(ToolPath<N>),
}

impl<const N: usize> PlannedMotion<N> {
    /// How the joints, or the tool, speed up and slow down.
    pub fn profile(&self) -> &Profile {
        match self {
            Self::Joint(motion) => motion.profile(),
            Self::Tool(motion) => motion.profile(),
        }
    }

    /// The planned state at `time`, s; where q̈ jumps, with its value before the jump.
    pub fn state_before(&self, time: f64) -> JointState<N> {
        match self {
            Self::Joint(motion) => motion.state_before(time),
            Self::Tool(motion) => motion.state_before(time),
        }
    }
}

impl<const N: usize> Trajectory<N> for PlannedMotion<N> {
    fn duration(&self) -> f64 {
        match self {
            Self::Joint(motion) => motion.duration(),
            Self::Tool(motion) => motion.duration(),
        }
    }

    fn state(&self, time: f64) -> JointState<N> {
        match self {
            Self::Joint(motion) => motion.state(time),
            Self::Tool(motion) => motion.state(time),
        }
    }
}
