//! What joints that stop dead change in the loads of all joints: the paper's recursion, Eq. 1–12.
//!
//! The paper's is for one revolute joint k. Here every joint i has a deviation `Δq̇_i`, `Δq̈_i` of its own (Eq. 1),
//! 0 for the joints that go on, and each term that the paper writes for i = k or for i > k is kept for every i.
//!
//! Readings of the paper, each settled by the identity
//! `Δτ = ID(q, q̇, q̈) − ID(q, q̇ − Δq̇, q̈ − Δq̈)`, which the recursion meets to rounding:
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

use super::{JointLoad, SerialChain};
use crate::JointKind;

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

impl<const N: usize> SerialChain<N> {
    /// Δτ by columns: column k if joint k alone stops, the tool wrench staying what it is.
    pub(super) fn impacts_of_each_lock(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SMatrix<f64, N, N> {
        let transforms = self.link_transforms(q);
        let mut impacts = SMatrix::<f64, N, N>::zeros();
        for k in 0..N {
            let delta = [qd, qdd].map(|motion| {
                let mut stopped = SVector::<f64, N>::zeros();
                stopped[k] = motion[k];
                stopped
            });
            let loads = self.load_deviations(&transforms, qd, &delta, JointLoad::default());
            // The rotors stop with their joints.
            let of_rotors = self.reflected_inertias().component_mul(&delta[1]);
            impacts.set_column(k, &(self.along_axes(&loads) + of_rotors));
        }
        impacts
    }

    /// `Δf_i` and `Δn_i` of every joint (Eq. 9–11) for the deviations `delta` = `[Δq̇, Δq̈]` of the joints.
    ///
    /// `delta_tool` is `ΔF_e`, what the tool exerts on its surroundings, before minus after, in its own frame:
    /// [`in_tool_frame`](Self::in_tool_frame).
    pub(crate) fn load_deviations(
        &self,
        transforms: &[IsometryMatrix3<f64>; N],
        qd: &SVector<f64, N>,
        delta: &[SVector<f64, N>; 2],
        delta_tool: JointLoad,
    ) -> [JointLoad; N] {
        let loads = self.link_deviations(transforms, qd, delta);
        self.joint_deviations(transforms, &loads, delta_tool)
    }

    /// A wrench `[f; n]` of world axes, at the tool point, in the tool's frame.
    pub(crate) fn in_tool_frame(
        &self,
        transforms: &[IsometryMatrix3<f64>; N],
        wrench: &Vector6<f64>,
    ) -> JointLoad {
        let world_from_tool = transforms
            .iter()
            .fold(self.base.isometry(), |world_from_last, transform| {
                world_from_last * transform
            })
            .rotation
            * self.tool.isometry().rotation;
        let tool_from_world = world_from_tool.inverse();
        JointLoad {
            force: tool_from_world * wrench.fixed_rows::<3>(0).into_owned(),
            moment: tool_from_world * wrench.fixed_rows::<3>(3).into_owned(),
        }
    }

    /// What the motors bear of `loads` (Eq. 12).
    pub(crate) fn along_axes(&self, loads: &[JointLoad; N]) -> SVector<f64, N> {
        SVector::from_fn(|i, _| loads[i].along_axis(self.joints[i].kind))
    }

    /// Base to tip, Eq. 1–7: `Δf_c` and `Δn_c`, at each link's centroid, in its frame.
    fn link_deviations(
        &self,
        transforms: &[IsometryMatrix3<f64>; N],
        qd: &SVector<f64, N>,
        [delta_qd, delta_qdd]: &[SVector<f64, N>; 2],
    ) -> [JointLoad; N] {
        let z = Vector3::z();
        let mut last = LinkDeviation {
            velocity: Vector3::zeros(),
            delta_velocity: Vector3::zeros(),
            delta_acceleration: Vector3::zeros(),
            delta_linear_acceleration: Vector3::zeros(),
        };
        from_fn(|i| {
            let joint = &self.joints[i];
            let rate = z * qd[i];
            let (delta_rate, delta_joint_acceleration) = (z * delta_qd[i], z * delta_qdd[i]); // Eq. 1
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
                    link.delta_linear_acceleration +=
                        delta_product * 2.0 + delta_joint_acceleration;
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

    /// Tip to base: Eq. 8–11.
    fn joint_deviations(
        &self,
        transforms: &[IsometryMatrix3<f64>; N],
        loads: &[JointLoad; N],
        delta_tool: JointLoad,
    ) -> [JointLoad; N] {
        let mut deviations = [JointLoad::default(); N];
        // The tool stands for frame N+1.
        let (mut next, mut from_next) = (delta_tool, self.tool.isometry());
        for i in (0..N).rev() {
            let com = Vector3::from(self.joints[i].link.com);
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
        deviations
    }
}
