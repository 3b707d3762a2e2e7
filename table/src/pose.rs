//! [`Pose`]: where an arm of any number of joints is, and what gravity asks of its joints there.
//!
//! For what is said of a table: [`SerialChain`](ulna::SerialChain), whose number of joints is a type's, is the specification.

use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Vector3};

use crate::Model;
use ulna::internal::coordinate;
use ulna::{Joint, JointKind, Placement};

/// Where everything is at one configuration of an arm, in world axes.
#[derive(Clone, Debug)]
pub struct Pose<'m> {
    joints: &'m [Joint],
    links: Vec<IsometryMatrix3<f64>>,
    tool: IsometryMatrix3<f64>,
}

impl Model {
    /// Where everything is at the coordinates `q`, rad (m for a prismatic joint). Those that are left out at the end are 0.
    pub fn pose(&self, q: &[f64]) -> Pose<'_> {
        Pose::of_chain(self.joints(), self.base(), self.tool(), q)
    }
}

impl<'m> Pose<'m> {
    pub(crate) fn of_chain(
        joints: &'m [Joint],
        base: &Placement,
        tool: &Placement,
        q: &[f64],
    ) -> Self {
        let mut frame = base.isometry();
        let coordinates = q.iter().copied().chain(std::iter::repeat(0.0));
        let links = joints.iter().zip(coordinates).map(|(joint, q)| {
            frame *= step(joint, coordinate(joint.kind, q));
            frame
        });
        let links: Vec<_> = links.collect();
        Self {
            tool: links.last().unwrap_or(&base.isometry()) * tool.isometry(),
            joints,
            links,
        }
    }

    /// `world_from_frame_i`, base first.
    pub fn links(&self) -> &[IsometryMatrix3<f64>] {
        &self.links
    }

    /// `world_from_tool`.
    pub fn tool(&self) -> &IsometryMatrix3<f64> {
        &self.tool
    }

    /// The torque of each joint, N·m (N), that holds the links against `gravity`, m/s², world axes; what the tool carries does not count.
    pub fn gravity_torque(&self, gravity: [f64; 3]) -> Vec<f64> {
        let gravity = Vector3::from(gravity);
        // From the tool inwards: the weight of all links so far, and its moment about the world's origin.
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        let mut torques = Vec::new();
        for (joint, frame) in self.joints.iter().zip(&self.links).rev() {
            let weight = gravity * joint.link.mass;
            let com = frame * nalgebra::Point3::from(joint.link.com);
            force += weight;
            moment += com.coords.cross(&weight);
            let (axis, origin) = (frame.rotation * Vector3::z(), frame.translation.vector);
            torques.push(-match joint.kind {
                JointKind::Revolute => axis.dot(&(moment - origin.cross(&force))),
                JointKind::Prismatic => axis.dot(&force),
            });
        }
        torques.reverse();
        torques
    }

    /// The columns of the geometric Jacobian of the tool point, linear rows first.
    pub(crate) fn jacobian(&self) -> Vec<[f64; 6]> {
        let tool = self.tool.translation.vector;
        let columns = self.joints.iter().zip(&self.links).map(|(joint, frame)| {
            let axis = frame.rotation * Vector3::z();
            let (v, w) = match joint.kind {
                JointKind::Revolute => (axis.cross(&(tool - frame.translation.vector)), axis),
                JointKind::Prismatic => (axis, Vector3::zeros()),
            };
            [v.x, v.y, v.z, w.x, w.y, w.z]
        });
        columns.collect()
    }
}

/// `T_i = Rx(alpha) Tx(a) Rz(theta + q) Tz(d)`, or `Tz(d + q)`: frame i as seen from frame i−1 (Craig, Eq. 3.6).
fn step(joint: &Joint, q: f64) -> IsometryMatrix3<f64> {
    let (sin_alpha, cos_alpha) = joint.alpha.sin_cos();
    let (sin, cos) = joint.theta.sin_cos();
    let (turn, slide) = match joint.kind {
        JointKind::Revolute => (q, 0.0),
        JointKind::Prismatic => (0.0, q),
    };
    let about = |sin: f64, cos: f64| {
        Rotation3::from_matrix_unchecked(nalgebra::Matrix3::new(
            cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0,
        ))
    };
    let twist = Rotation3::from_matrix_unchecked(nalgebra::Matrix3::new(
        1.0, 0.0, 0.0, 0.0, cos_alpha, -sin_alpha, 0.0, sin_alpha, cos_alpha,
    ));
    let (sin_q, cos_q) = turn.sin_cos();
    let d = joint.d + slide;
    IsometryMatrix3::from_parts(
        Translation3::new(joint.a, -sin_alpha * d, cos_alpha * d),
        twist * about(sin, cos) * about(sin_q, cos_q),
    )
}
