//! Inverse dynamics by the recursive Newton–Euler algorithm in link frames.

use nalgebra::{Matrix3, SVector, Vector3};

use super::SerialChain;
use super::kinematics::JointInput;
use crate::JointKind;

/// What the link before exerts on a link at its joint: all of it, not only what the motor bears.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointLoad {
    /// Force, N, in the joint's frame.
    pub force: Vector3<f64>,
    /// Moment about the frame's origin, N·m, in the joint's frame.
    pub moment: Vector3<f64>,
}

impl JointLoad {
    /// What the gears bear: the moment about, or the force along, the joint's axis z. What accelerates the motor's rotor comes on top,
    /// and friction.
    pub fn along_axis(&self, kind: JointKind) -> f64 {
        match kind {
            JointKind::Revolute => self.moment.z,
            JointKind::Prismatic => self.force.z,
        }
    }
}

impl<const N: usize> SerialChain<N> {
    /// What the motors bear of these loads, and what their own rotors take (Siciliano 7.5, the rotors' gyroscopic terms left out).
    pub(super) fn frictionless_torque(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let loads = self.joint_loads(q, qd, qdd);
        SVector::from_fn(|i, _| {
            let joint = &self.joints[i];
            loads[i].along_axis(joint.kind) + joint.motor.reflected_inertia() * qdd[i]
        })
    }

    /// Force and moment at every joint that the motion `(q, q̇, q̈)` needs under gravity, without a tool wrench:
    /// Craig 6.5, Eq. 6.45–6.53; for a prismatic joint the outward step is Eq. 6.33 and 6.35.
    ///
    /// Gravity enters as an upward acceleration of the base.
    pub fn joint_loads(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> [JointLoad; N] {
        self.loads_at(&self.inputs(q), qd, qdd)
    }

    /// τ of the links' motion, of joints that stand at `inputs`.
    pub(super) fn torque_at(
        &self,
        inputs: &[JointInput; N],
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let loads = self.loads_at(inputs, qd, qdd);
        SVector::from_fn(|i, _| loads[i].along_axis(self.joints[i].kind))
    }

    fn loads_at(
        &self,
        inputs: &[JointInput; N],
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> [JointLoad; N] {
        let transforms = self.transforms(inputs);
        let z = Vector3::z();

        // Outward: velocities and accelerations, then the force and moment that each link's inertia asks for.
        let base = self.base.isometry().rotation;
        let mut omega = Vector3::zeros();
        let mut omega_dot = Vector3::zeros();
        let mut v_dot = base.inverse() * -Vector3::from(self.gravity);
        let mut loads = [JointLoad::default(); N];
        for (i, joint) in self.joints.iter().enumerate() {
            let p = transforms[i].translation.vector;
            let link_from_last = transforms[i].rotation.inverse();
            v_dot = link_from_last * (omega_dot.cross(&p) + omega.cross(&omega.cross(&p)) + v_dot);
            omega = link_from_last * omega;
            omega_dot = link_from_last * omega_dot;
            match joint.kind {
                JointKind::Revolute => {
                    omega_dot += omega.cross(&(z * qd[i])) + z * qdd[i];
                    omega += z * qd[i];
                }
                JointKind::Prismatic => {
                    v_dot += 2.0 * omega.cross(&(z * qd[i])) + z * qdd[i];
                }
            }
            let com = Vector3::from(joint.link.com);
            let inertia = Matrix3::from_fn(|r, c| joint.link.inertia[r][c]);
            let v_dot_com = omega_dot.cross(&com) + omega.cross(&omega.cross(&com)) + v_dot;
            let force = v_dot_com * joint.link.mass;
            let moment = inertia * omega_dot + omega.cross(&(inertia * omega));
            loads[i] = JointLoad {
                force,
                moment: moment + com.cross(&force),
            };
        }

        // Inward: each link also carries the ones after it.
        for i in (1..N).rev() {
            let p = transforms[i].translation.vector;
            let force = transforms[i].rotation * loads[i].force;
            let moment = transforms[i].rotation * loads[i].moment;
            loads[i - 1].force += force;
            loads[i - 1].moment += moment + p.cross(&force);
        }
        loads
    }
}
