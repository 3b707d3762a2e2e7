//! [`LockMechanics`]: the arm as a mechanism at a lock: how many torques leave its tool alone, what the lock loads its structure with,
//! and where its links are.

use nalgebra::{IsometryMatrix3, SVector, Vector3, Vector6};

use super::{AnyArm, ExperimentError, KNOT_PERIOD};
use crate::scenario::{PlannedMotion, Scenario};
use ulna::control::failure::{Failure, LockedJoints, impact_torque};
use ulna::control::null_space::NullSpace;
use ulna::generic::JointLoad;
use ulna::{JointKind, SerialChain, TaskRow, Trajectory};

/// An arm around the lock at one failure time.
#[derive(Clone, Debug, PartialEq)]
pub struct LockMechanics {
    /// s.
    pub failure_time: f64,
    /// The joints that lock, counted from 0.
    pub failed_joints: Vec<usize>,
    /// The components of the task, as places in `[f; n]`.
    pub task: Vec<usize>,
    /// Just before the lock.
    pub before: Redundancy,
    /// Just after it, of the joints that still move.
    pub after: Redundancy,
    /// What the lock changes at each joint.
    pub loads: Vec<StructureLoad>,
    /// Where the motion starts.
    pub start: ArmPose,
    /// Where the lock falls.
    pub failure: ArmPose,
    /// Where the motion ends if no joint locks.
    pub goal: ArmPose,
    /// Where it ends with the failed joints at rest from the lock on, the others as planned.
    pub locked_goal: ArmPose,
    /// The tool's way if no joint locks, m, world axes.
    pub path: Vec<[f64; 3]>,
    /// The tool's way from the lock on, with the failed joints at rest.
    pub locked_path: Vec<[f64; 3]>,
}

/// What a task leaves of the moving joints in one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Redundancy {
    /// How many joints move.
    pub joints: usize,
    /// How many rows of the task are independent.
    pub rank: usize,
    /// [`NullSpace::conditioning`], 0 to 1.
    pub conditioning: f64,
}

impl Redundancy {
    /// Directions of joint torque that leave the static tool force alone: the dimension of J's null space.
    pub fn free(&self) -> usize {
        self.joints.saturating_sub(self.rank)
    }
}

/// The step of all that a joint transmits (Eq. 8–11), after the lock minus before it, in the joint's frame, whose z is the axis.
/// The motor feels one component of it; the others load bearings and links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StructureLoad {
    /// Which component the motor feels.
    pub kind: JointKind,
    /// About x, y, z, N·m.
    pub moment: [f64; 3],
    /// Along x, y, z, N.
    pub force: [f64; 3],
}

impl StructureLoad {
    /// What the motor feels (Eq. 12): the moment about the axis, N·m, or at a sliding joint the force along it, N.
    pub fn along_axis(&self) -> f64 {
        match self.kind {
            JointKind::Revolute => self.moment[2],
            JointKind::Prismatic => self.force[2],
        }
    }

    /// The norm of the moments that no motor feels, N·m: about x and y, and at a sliding joint about z too.
    pub fn off_axis_moment(&self) -> f64 {
        let [x, y, z] = self.moment;
        match self.kind {
            JointKind::Revolute => x.hypot(y),
            JointKind::Prismatic => Vector3::new(x, y, z).norm(),
        }
    }

    /// The norm of the forces that no motor feels, N: all of it, and at a sliding joint those along x and y.
    pub fn off_axis_force(&self) -> f64 {
        let [x, y, z] = self.force;
        match self.kind {
            JointKind::Revolute => Vector3::new(x, y, z).norm(),
            JointKind::Prismatic => x.hypot(y),
        }
    }

    fn of(kind: JointKind, load: &JointLoad) -> Self {
        // The recursion's Δ is before minus after.
        Self {
            kind,
            moment: (-load.moment).into(),
            force: (-load.force).into(),
        }
    }
}

/// Where the links are: a stick figure.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmPose {
    /// Of the base, m, world axes.
    pub base: [f64; 3],
    /// Of each joint, base first.
    pub joints: Vec<JointFrame>,
    /// The tool point, m.
    pub tool: [f64; 3],
}

/// A joint's frame in world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointFrame {
    /// m.
    pub origin: [f64; 3],
    /// The unit vectors x, y, z; z is the joint's axis.
    pub axes: [[f64; 3]; 3],
}

impl JointFrame {
    fn of(frame: &IsometryMatrix3<f64>) -> Self {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        Self {
            origin: frame.translation.vector.into(),
            axes: axes.map(|axis| (frame.rotation * axis).into()),
        }
    }
}

impl ArmPose {
    fn of<const N: usize>(chain: &SerialChain<N>, q: &SVector<f64, N>) -> Self {
        Self {
            base: chain.base.isometry().translation.vector.into(),
            joints: chain.link_frames(q).iter().map(JointFrame::of).collect(),
            tool: tool(chain, q),
        }
    }
}

fn tool<const N: usize>(chain: &SerialChain<N>, q: &SVector<f64, N>) -> [f64; 3] {
    let last = chain.link_frames(q).last().copied();
    let last = last.unwrap_or_else(|| chain.base.isometry());
    (last * chain.tool.isometry()).translation.vector.into()
}

/// The arm of `scenario` at each of the scenario's failure times; `chain` is the same arm as data, which knows where its links are.
///
/// # Errors
/// When `arm` is not the scenario's, or cannot execute its motion.
pub fn lock_mechanics<const N: usize>(
    arm: &AnyArm<N>,
    chain: &SerialChain<N>,
    scenario: &Scenario,
) -> Result<Vec<LockMechanics>, ExperimentError> {
    let motion = scenario.motion().plan(arm, KNOT_PERIOD)?;
    let failed = scenario.failed_joints();
    let joints = LockedJoints::new(failed).ok_or_else(|| ExperimentError::Joint {
        joint: failed.iter().copied().max().unwrap_or(0),
        joints: N,
    })?;
    let times = scenario.failure_times().iter();
    Ok(times
        .map(|time| {
            let failure = Failure {
                joints,
                time: *time,
            };
            at_lock(arm, chain, &motion, &failure)
        })
        .collect())
}

fn at_lock<const N: usize>(
    arm: &AnyArm<N>,
    chain: &SerialChain<N>,
    motion: &PlannedMotion<N>,
    failure: &Failure<N>,
) -> LockMechanics {
    /// So many pieces make up a drawn path.
    const PIECES: u32 = 100;
    let state = motion.state(failure.time);
    // The tool's wrench is a polynomial of time, and has no step.
    let impact = impact_torque(chain, &state, failure.joints, &Vector6::zeros());
    let loads = chain.joints.iter().zip(&impact.loads);
    let jacobian = arm.geometric_jacobian(&state.q);
    let redundancy = |locked: LockedJoints<N>| {
        let null_space = NullSpace::new(&locked.reduce_jacobian(&jacobian), chain.task);
        Redundancy {
            joints: N - locked.len(),
            rank: null_space.rank(),
            conditioning: null_space.conditioning(),
        }
    };
    let end = motion.duration();
    let locked_end = failure.state(motion, end).q;
    let path = |start: f64, q: &dyn Fn(f64) -> SVector<f64, N>| {
        let times = (0..=PIECES).map(|i| start + (end - start) * f64::from(i) / f64::from(PIECES));
        times.map(|time| tool(chain, &q(time))).collect()
    };
    LockMechanics {
        failure_time: failure.time,
        failed_joints: failure.joints.iter().collect(),
        task: chain.task.iter().map(TaskRow::index).collect(),
        before: redundancy(LockedJoints::NONE),
        after: redundancy(failure.joints),
        loads: loads
            .map(|(joint, load)| StructureLoad::of(joint.kind, load))
            .collect(),
        start: ArmPose::of(chain, &motion.state(0.0).q),
        failure: ArmPose::of(chain, &state.q),
        goal: ArmPose::of(chain, &motion.state(end).q),
        locked_goal: ArmPose::of(chain, &locked_end),
        path: path(0.0, &|time| motion.state(time).q),
        locked_path: path(failure.time, &|time| failure.state(motion, time).q),
    }
}
