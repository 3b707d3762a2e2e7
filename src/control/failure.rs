//! Joints that lock: what is left of the arm, and the impact torque of the lock, Eq. 1–12.
//!
//! The paper's recursion is for one revolute joint k. Here any set of joints locks at once, revolute or prismatic:
//! every joint i has a deviation `Δq̇_i`, `Δq̈_i` of its own (Eq. 1), 0 for the joints that go on,
//! and each term that the paper writes for i = k or for i > k is kept for every i.
//!
//! Readings of the paper, each settled by the identity
//! `Δτ = ID(q, q̇, q̈) − ID(q, q̇ − Δq̇, q̈ − Δq̈)`, which the recursion meets to rounding, friction apart:
//! - Δ is *before the lock* minus *after the lock*; the torque step of Eq. 18 is its negative.
//! - Eq. 2–4: the velocity products take the rate of the joint at hand: that before the lock for i = k, `θ̇_i` for i > k.
//!   The printed superscripts drift.
//! - Eq. 5: Δv is nowhere needed, since Eq. 7 to 12 use accelerations only; it is left out.
//! - Eq. 6: the first term takes Δω̇ of frame i−1, as the others do. Linear motions are those of the frames' origins;
//!   Eq. 7 takes the centroid's, which has the same terms over `r_ci`.
//! - Eq. 9 and 10: link k itself already moves differently, so `Δf_ck` and `Δn_ck` count from i = k on in both.
//! - Gravity is the same before and after and drops out.

use core::array::from_fn;

use nalgebra::{IsometryMatrix3, Matrix3, SMatrix, SVector, Vector3, Vector6};

use crate::control::trajectory::{JointState, Trajectory};
use crate::generic::JointLoad;
use crate::{Arm, JointKind, SerialChain};

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
    pub fn healthy(self) -> impl Iterator<Item = usize> {
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
    let loads = link_deviations(chain, &transforms, state, locked);
    let mut impact = joint_deviations(chain, &transforms, &loads, delta_wrench);
    for joint in locked.iter() {
        impact.torque[joint] += chain.joints[joint].motor.reflected_inertia() * state.qdd[joint];
    }
    impact
}

/// The motors' part of the impact torque (Eq. 12) of any arm, as the difference of two calls of its inverse dynamics
/// plus Jᵀ `ΔF_e`: the same as [`impact_torque`]'s, without the structure's part. A locked joint's friction, which ends with its motion, is left out of both.
pub fn impact_torque_of<const N: usize>(
    arm: &(impl Arm<N> + ?Sized),
    state: &JointState<N>,
    locked: LockedJoints<N>,
    delta_wrench: &Vector6<f64>,
) -> SVector<f64, N> {
    let after = locked.hold(state);
    let friction = arm.friction_torque(&state.qd);
    let mut impact = arm.inverse_dynamics(&state.q, &state.qd, &state.qdd)
        - arm.inverse_dynamics(&after.q, &after.qd, &after.qdd)
        + arm.geometric_jacobian(&state.q).tr_mul(delta_wrench);
    for joint in locked.iter() {
        impact[joint] -= friction[joint];
    }
    impact
}

/// A link's motion before the lock, and what the lock takes from it.
#[derive(Clone, Copy)]
struct LinkDeviation {
    velocity: Vector3<f64>,
    delta_velocity: Vector3<f64>,
    delta_acceleration: Vector3<f64>,
    delta_linear_acceleration: Vector3<f64>,
}

impl LinkDeviation {
    /// The deviation of the acceleration of a point at `r` from the origin, fixed to the link: Eq. 6 without the rotation.
    fn point_acceleration(&self, r: &Vector3<f64>) -> Vector3<f64> {
        let (w, dw) = (self.velocity, self.delta_velocity);
        self.delta_linear_acceleration
            + self.delta_acceleration.cross(r)
            + w.cross(&dw.cross(r))
            + dw.cross(&w.cross(r))
            - dw.cross(&dw.cross(r))
    }
}

/// Base to tip, Eq. 1–7: `Δf_c` and `Δn_c`, at each link's centroid, in its frame.
fn link_deviations<const N: usize>(
    chain: &SerialChain<N>,
    transforms: &[IsometryMatrix3<f64>; N],
    state: &JointState<N>,
    locked: LockedJoints<N>,
) -> [JointLoad; N] {
    let z = Vector3::z();
    let mut last = LinkDeviation {
        velocity: Vector3::zeros(),
        delta_velocity: Vector3::zeros(),
        delta_acceleration: Vector3::zeros(),
        delta_linear_acceleration: Vector3::zeros(),
    };
    from_fn(|i| {
        let joint = &chain.joints[i];
        let (rate, acceleration) = (z * state.qd[i], z * state.qdd[i]);
        let (delta_rate, delta_joint_acceleration) = if locked.contains(i) {
            (rate, acceleration) // Eq. 1
        } else {
            (Vector3::zeros(), Vector3::zeros())
        };
        let rotation = transforms[i].rotation.inverse();
        let velocity = rotation * last.velocity;
        let delta_velocity = rotation * last.delta_velocity;
        // Deviation of ω_{i-1} × z q̇_i, of which both factors may change.
        let delta_product = delta_velocity.cross(&rate) + velocity.cross(&delta_rate)
            - delta_velocity.cross(&delta_rate);
        let mut link = LinkDeviation {
            velocity,
            delta_velocity,
            delta_acceleration: rotation * last.delta_acceleration,
            delta_linear_acceleration: rotation
                * last.point_acceleration(&transforms[i].translation.vector), // Eq. 6
        };
        match joint.kind {
            JointKind::Revolute => {
                link.velocity += rate;
                link.delta_velocity += delta_rate; // Eq. 3
                link.delta_acceleration += delta_product + delta_joint_acceleration; // Eq. 4
            }
            JointKind::Prismatic => {
                link.delta_linear_acceleration += delta_product * 2.0 + delta_joint_acceleration;
            }
        }
        last = link;
        let inertia = Matrix3::from_fn(|row, column| joint.link.inertia[row][column]);
        let (w, dw) = (link.velocity, link.delta_velocity);
        JointLoad {
            force: link.point_acceleration(&Vector3::from(joint.link.com)) * joint.link.mass,
            moment: inertia * link.delta_acceleration
                + w.cross(&(inertia * dw))
                + dw.cross(&(inertia * w))
                - dw.cross(&(inertia * dw)),
        }
    })
}

/// Tip to base: Eq. 8–12.
fn joint_deviations<const N: usize>(
    chain: &SerialChain<N>,
    transforms: &[IsometryMatrix3<f64>; N],
    loads: &[JointLoad; N],
    delta_wrench: &Vector6<f64>,
) -> ImpactTorque<N> {
    let mut deviations = [JointLoad::default(); N];
    // The tool stands for frame N+1.
    let tool = chain.tool.isometry();
    let tool_from_world = transforms
        .iter()
        .fold(chain.base.isometry(), |world_from_last, transform| {
            world_from_last * transform
        })
        .rotation
        * tool.rotation;
    let tool_from_world = tool_from_world.inverse();
    let mut next = JointLoad {
        force: tool_from_world * delta_wrench.fixed_rows::<3>(0).into_owned(),
        moment: tool_from_world * delta_wrench.fixed_rows::<3>(3).into_owned(),
    };
    let mut from_next = tool;
    for i in (0..N).rev() {
        let com = Vector3::from(chain.joints[i].link.com);
        let force = from_next.rotation * next.force;
        next = JointLoad {
            force: force + loads[i].force,
            moment: from_next.rotation * next.moment
                + from_next.translation.vector.cross(&force)
                + loads[i].moment
                + com.cross(&loads[i].force),
        };
        deviations[i] = next;
        from_next = transforms[i];
    }
    ImpactTorque {
        loads: deviations,
        torque: SVector::from_fn(|i, _| deviations[i].along_axis(chain.joints[i].kind)),
    }
}
