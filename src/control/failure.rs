//! Joints that lock: what is left of the arm, and the impact torque of the lock, Eq. 1–12.
//!
//! The paper's recursion stands in the textbook, `generic/lock.rs`, with the readings of it that are settled there.
//! Here any set of joints locks at once, revolute or prismatic; what a lock of each joint alone does is
//! [`Arm::lock_impacts`].

use nalgebra::{SMatrix, SVector, Vector6};

use crate::control::trajectory::{JointState, Trajectory};
use crate::generic::JointLoad;
use crate::{Arm, SerialChain};

/// A set of locked joints, of an arm of at most 64.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LockedJoints<const N: usize>(u64);

impl<const N: usize> LockedJoints<N> {
    /// No joint is locked.
    pub const NONE: Self = Self(0);

    /// The set of `joints`, counted from 0; `None` if one of them is not below N.
    pub const fn new(joints: &[usize]) -> Option<Self> {
        let mut bits = 0;
        let mut i = 0;
        while i < joints.len() {
            if joints[i] >= N {
                return None;
            }
            bits |= 1 << joints[i];
            i += 1;
        }
        Some(Self(bits))
    }

    /// Whether `joint`, counted from 0, is locked.
    pub const fn contains(self, joint: usize) -> bool {
        const { assert!(N <= 64, "LockedJoints holds at most 64 joints") };
        joint < N && self.0 & (1 << joint) != 0
    }

    /// Whether no joint is locked.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many joints are locked.
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// The joints that are locked in this set and not in `other`.
    #[must_use]
    pub const fn difference(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// The joints that are locked in this set or in `other`.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The locked joints, counted from 0.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        (0..N).filter(move |joint| self.contains(*joint))
    }

    /// The joints that still move, counted from 0.
    pub fn healthy(self) -> impl Iterator<Item = usize> + Clone {
        (0..N).filter(move |joint| !self.contains(*joint))
    }

    /// `vector` with the locked joints' entries set to 0.
    pub fn without(self, vector: &SVector<f64, N>) -> SVector<f64, N> {
        SVector::from_fn(|joint, _| {
            if self.contains(joint) {
                0.0
            } else {
                vector[joint]
            }
        })
    }

    /// The same positions with the locked joints at rest.
    pub fn hold(self, state: &JointState<N>) -> JointState<N> {
        JointState {
            q: state.q,
            qd: self.without(&state.qd),
            qdd: self.without(&state.qdd),
        }
    }

    /// The locked arm's Jacobian: the locked joints' columns are 0.
    pub fn reduce_jacobian(self, jacobian: &SMatrix<f64, 6, N>) -> SMatrix<f64, 6, N> {
        let mut reduced = *jacobian;
        for joint in self.iter() {
            reduced.column_mut(joint).fill(0.0);
        }
        reduced
    }

    /// The locked arm's mass matrix: the locked joints' rows and columns are 0 but for the diagonal,
    /// which stays, so that the inverse's healthy block is the inverse of the healthy block.
    pub fn reduce_mass_matrix(self, mass_matrix: &SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
        SMatrix::from_fn(|row, column| {
            if row != column && (self.contains(row) || self.contains(column)) {
                0.0
            } else {
                mass_matrix[(row, column)]
            }
        })
    }
}

/// Joints that lock at one time and stay locked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure<const N: usize> {
    /// The joints that lock.
    pub joints: LockedJoints<N>,
    /// When, `t_f`, s.
    pub time: f64,
}

impl<const N: usize> Failure<N> {
    /// The locked joints after the failure, none before.
    pub fn locked_at(&self, time: f64) -> LockedJoints<N> {
        if time < self.time {
            LockedJoints::NONE
        } else {
            self.joints
        }
    }

    /// The state at `time` if the healthy joints keep to `trajectory` and the locked ones stop dead, as the paper assumes:
    /// from `t_f` on, they rest where they were then.
    pub fn state(&self, trajectory: &impl Trajectory<N>, time: f64) -> JointState<N> {
        let planned = trajectory.state(time);
        let locked = self.locked_at(time);
        if locked.is_empty() {
            return planned;
        }
        let at_failure = trajectory.state(self.time).q;
        let mut held = locked.hold(&planned);
        for joint in locked.iter() {
            held.q[joint] = at_failure[joint];
        }
        held
    }
}

/// What a lock changes in the joints, *before* minus *after*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactTorque<const N: usize> {
    /// `Δf_i` and `Δn_i` with all three components (Eq. 9–11). What [`torque`](Self::torque) does not take of them loads
    /// the structure: of a revolute joint the moments about x and y, and the force.
    pub loads: [JointLoad; N],
    /// Δτ, what the motors feel (Eq. 12): the moment along z of a revolute joint, N·m, the force along z of a prismatic one, N;
    /// and of a joint that locks what has accelerated its rotor.
    pub torque: SVector<f64, N>,
}

/// The impact torque of `locked` joints that stop in `state`, by the paper's recursion.
///
/// `delta_wrench` is `ΔF_e`, the wrench `[f; n]` that the tool exerts on its surroundings, before minus after,
/// world axes, at the tool point; 0 if it stays (Eq. 8).
pub fn impact_torque<const N: usize>(
    chain: &SerialChain<N>,
    state: &JointState<N>,
    locked: LockedJoints<N>,
    delta_wrench: &Vector6<f64>,
) -> ImpactTorque<N> {
    let transforms = chain.link_transforms(&state.q);
    let healthy = locked.hold(state);
    let delta = [state.qd - healthy.qd, state.qdd - healthy.qdd];
    let delta_tool = chain.in_tool_frame(&transforms, delta_wrench);
    let loads = chain.load_deviations(&transforms, &state.qd, &delta, delta_tool);
    ImpactTorque {
        loads,
        torque: chain.along_axes(&loads) + chain.reflected_inertias().component_mul(&delta[1]),
    }
}

/// The motors' part of the impact torque (Eq. 12) of any arm, as the difference of two calls of its inverse dynamics
/// plus Jᵀ `ΔF_e`: the same as [`impact_torque`]'s, without the structure's part. A locked joint's friction, which ends with its motion, is left out of both.
pub fn impact_torque_of<const N: usize>(
    arm: &(impl Arm<N> + ?Sized),
    state: &JointState<N>,
    locked: LockedJoints<N>,
    delta_wrench: &Vector6<f64>,
) -> SVector<f64, N> {
    impact_of_motion(arm, state, locked) + arm.geometric_jacobian(&state.q).tr_mul(delta_wrench)
}

/// The same without a change of the tool's wrench.
#[inline]
pub(crate) fn impact_of_motion<const N: usize>(
    arm: &(impl Arm<N> + ?Sized),
    state: &JointState<N>,
    locked: LockedJoints<N>,
) -> SVector<f64, N> {
    let after = locked.hold(state);
    let friction = arm.friction_torque(&state.qd);
    let mut impact = arm.inverse_dynamics(&state.q, &state.qd, &state.qdd)
        - arm.inverse_dynamics(&after.q, &after.qd, &after.qdd);
    for joint in locked.iter() {
        impact[joint] -= friction[joint];
    }
    impact
}
