//! A simulated arm: direct drives, a tool that presses on something fixed, a brake.

use crate::BenchArm;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{Arm, JointState, LockedJoints};

/// A brake that takes its joint to rest at a constant rate.
pub struct Brake {
    joint: usize,
    deceleration: f64,
    left: f64,
}

/// The arm and where it is.
pub struct Plant<'a> {
    arm: &'a BenchArm,
    pub state: JointState<7>,
    /// What the tool exerts on its surroundings.
    wrench: Vector6<f64>,
    pub brake: Option<Brake>,
}

impl<'a> Plant<'a> {
    pub fn new(arm: &'a BenchArm, state: JointState<7>, wrench: Vector6<f64>) -> Self {
        Self {
            arm,
            state,
            wrench,
            brake: None,
        }
    }

    /// From now on the brake takes `joint` to rest within `duration` s.
    pub fn close_brake(&mut self, joint: usize, duration: f64) {
        self.brake = Some(Brake {
            joint,
            deceleration: -self.state.qd[joint] / duration,
            left: duration,
        });
    }

    /// One cycle under constant torques: the classical Runge-Kutta method.
    pub fn advance(&mut self, torque: &SVector<f64, 7>, dt: f64) {
        let (q, qd) = (self.state.q, self.state.qd);
        let a1 = self.acceleration(&q, &qd, torque);
        let v2 = qd + a1 * (dt / 2.0);
        let a2 = self.acceleration(&(q + qd * (dt / 2.0)), &v2, torque);
        let v3 = qd + a2 * (dt / 2.0);
        let a3 = self.acceleration(&(q + v2 * (dt / 2.0)), &v3, torque);
        let v4 = qd + a3 * dt;
        let a4 = self.acceleration(&(q + v3 * dt), &v4, torque);
        self.state.q += (qd + (v2 + v3) * 2.0 + v4) * (dt / 6.0);
        self.state.qd += (a1 + (a2 + a3) * 2.0 + a4) * (dt / 6.0);
        if let Some(brake) = &mut self.brake {
            brake.left -= dt;
            if brake.left < 0.5 * dt {
                brake.deceleration = 0.0;
                self.state.qd[brake.joint] = 0.0;
            }
        }
    }

    /// Of a braked joint it is given, and the others' equations are solved with it.
    fn acceleration(
        &self,
        q: &SVector<f64, 7>,
        qd: &SVector<f64, 7>,
        torque: &SVector<f64, 7>,
    ) -> SVector<f64, 7> {
        let torque = torque - self.arm.geometric_jacobian(q).tr_mul(&self.wrench);
        let Some(brake) = &self.brake else {
            return self.arm.forward_dynamics(q, qd, &torque);
        };
        let locked = LockedJoints::new(&[brake.joint]).unwrap_or(LockedJoints::NONE);
        let mut given = SVector::zeros();
        given[brake.joint] = brake.deceleration;
        let mass_matrix = self.arm.mass_matrix(q);
        let bias = self.arm.bias_force(q, qd) + self.arm.friction_torque(qd);
        let free = torque - bias - mass_matrix * given;
        let reduced = locked.reduce_mass_matrix(&mass_matrix);
        match reduced.cholesky() {
            Some(factor) => locked.without(&factor.solve(&locked.without(&free))) + given,
            None => given,
        }
    }
}
