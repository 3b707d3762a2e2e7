//! A simulated arm in the place of a real one: the table's links, rotors and friction, and a brake on every joint.

use ulna::nalgebra::{SMatrix, SVector};
use ulna::{Arm, LockedJoints};

use my_crate::N;

/// A brake that takes its joint to rest at a constant rate.
struct Brake {
    joint: usize,
    acceleration: f64,
    /// s.
    left: f64,
}

/// The arm and where it is.
pub struct Plant<'a> {
    arm: &'a dyn Arm<N>,
    /// rad (m), and rad/s (m/s).
    pub q: SVector<f64, N>,
    pub qd: SVector<f64, N>,
    brake: Option<Brake>,
}

impl<'a> Plant<'a> {
    /// At rest in `q`.
    pub fn new(arm: &'a dyn Arm<N>, q: SVector<f64, N>) -> Self {
        Self {
            arm,
            q,
            qd: SVector::zeros(),
            brake: None,
        }
    }

    /// From now on the brake takes `joint` to rest within `duration` s, and holds it.
    pub fn close_brake(&mut self, joint: usize, duration: f64) {
        self.brake = Some(Brake {
            joint,
            acceleration: -self.qd[joint] / duration,
            left: duration,
        });
    }

    /// The joints whose brakes hold them.
    pub fn locked(&self) -> LockedJoints<N> {
        match &self.brake {
            Some(brake) if brake.left <= 0.0 => joint(brake),
            _ => LockedJoints::NONE,
        }
    }

    /// One cycle of `dt` s under constant torques: linearly implicit in the friction, which is steep where a joint turns back.
    /// A braked joint's acceleration is given, and the others' equations are solved with it.
    pub fn advance(&mut self, torque: &SVector<f64, N>, dt: f64) {
        /// Of the difference that gives the slope of the friction, rad/s (m/s).
        const SMALL: f64 = 1e-4;

        let (arm, q, qd) = (self.arm, self.q, self.qd);
        let faster = arm.friction_torque(&qd.add_scalar(SMALL));
        let slope = (faster - arm.friction_torque(&qd.add_scalar(-SMALL))) / (2.0 * SMALL);
        let mass_matrix = arm.mass_matrix(&q) + SMatrix::from_diagonal(&(slope * dt));
        let braked = self.brake.as_ref().map_or(LockedJoints::NONE, joint);
        let mut acceleration = SVector::zeros();
        if let Some(brake) = &self.brake {
            acceleration[brake.joint] = brake.acceleration;
        }
        let free = torque
            - arm.bias_force(&q, &qd)
            - arm.friction_torque(&qd)
            - mass_matrix * acceleration;
        // M is positive definite, and so is what is left of it.
        if let Some(factor) = braked.reduce_mass_matrix(&mass_matrix).cholesky() {
            acceleration += braked.without(&factor.solve(&braked.without(&free)));
        }
        self.q += (qd + acceleration * (0.5 * dt)) * dt;
        self.qd += acceleration * dt;

        if let Some(brake) = &mut self.brake {
            brake.left -= dt;
            if brake.left < 0.5 * dt {
                (brake.acceleration, brake.left) = (0.0, 0.0);
                self.qd[brake.joint] = 0.0;
            }
        }
    }
}

fn joint(brake: &Brake) -> LockedJoints<N> {
    LockedJoints::new(&[brake.joint]).unwrap_or(LockedJoints::NONE)
}
