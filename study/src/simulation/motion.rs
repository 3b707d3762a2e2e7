//! The equations of motion with brakes: what moves the arm at one instant.

use nalgebra::{Cholesky, SMatrix, SVector, Vector6};

use super::flow::{Flow, Work};
use super::{Sample, Simulation};
use ulna::control::failure::LockedJoints;
use ulna::control::trajectory::{JointState, Trajectory};
use ulna::{Arm, Cycle};

/// What holds between two events.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Phase<const N: usize> {
    pub(super) stage: Stage<N>,
    /// The joints that the controller counts as locked.
    pub(super) known: LockedJoints<N>,
    /// What the motors hold; `None` under continuous control.
    pub(super) command: Option<Command<N>>,
}

/// A control cycle and the motors' torques that it made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Command<const N: usize> {
    pub(super) cycle: Cycle<N>,
    /// 0 for joints known as locked: their motors are off.
    pub(super) motor: SVector<f64, N>,
}

/// What the brakes do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stage<const N: usize> {
    Free,
    /// The brakes slow their joints down from these rates.
    Braking(SVector<f64, N>),
    Locked,
}

/// Everything at one instant.
pub(super) struct Instant<const N: usize> {
    command: Command<N>,
    brake: SVector<f64, N>,
    /// What goes into accelerating the rotors.
    rotor: SVector<f64, N>,
    qdd: SVector<f64, N>,
    pub(super) slope: Flow<N>,
}

impl<const N: usize> Instant<N> {
    /// What each joint transmits, and what its brake gives.
    pub(super) fn loads(&self) -> (SVector<f64, N>, SVector<f64, N>) {
        (self.command.motor + self.brake - self.rotor, self.brake)
    }
}

impl<P, A, T, W, const N: usize> Simulation<'_, P, A, T, W, N>
where
    P: Arm<N> + ?Sized,
    A: Arm<N> + ?Sized,
    T: Trajectory<N>,
    W: Fn(f64) -> Vector6<f64>,
{
    /// The instant `elapsed` s after the failure.
    ///
    /// `(M + R) q̈ + c + g + f + Jᵀ F_e = τ_motor + τ_brake`, in which a braked joint's q̈ is given and its `τ_brake` asked for.
    pub(super) fn instant(&self, elapsed: f64, flow: &Flow<N>, phase: &Phase<N>) -> Instant<N> {
        let wrench = (self.wrench)(self.brake.failure.time + elapsed);
        let command = match phase.command {
            Some(held) => held,
            None => self.command(elapsed, flow, phase.known),
        };
        let motor = command.motor;

        let (q, qd) = (&flow.q, &flow.qd);
        let (mass_matrix, derivatives) = self.plant.mass_matrix_and_derivatives(q);
        let mass_matrix = mass_matrix + SMatrix::from_diagonal(&self.reflected_inertia);
        let gravity = self.plant.gravity_torque(q);
        let tool = self.plant.geometric_jacobian(q).tr_mul(&-wrench);
        let friction = self.plant.friction_torque(qd);
        let applied = motor + tool - self.plant.bias_force(q, qd) - friction;

        let (braked, given) = self.braked(elapsed, phase);
        let free = braked.without(&(applied - mass_matrix * given));
        let qdd = match Cholesky::new(braked.reduce_mass_matrix(&mass_matrix)) {
            Some(factor) => factor.solve(&free) + given,
            None => SVector::repeat(f64::NAN),
        };
        let missing = mass_matrix * qdd - applied;
        let brake = missing - braked.without(&missing);

        // Hamilton: d((M + R) q̇)/dt = generalized forces + ∂T/∂q, from ∂M/∂q instead of c(q, q̇).
        let kinetic_gradient = SVector::from_fn(|i, _| 0.5 * (derivatives[i] * qd).dot(qd));
        Instant {
            command,
            brake,
            rotor: self.reflected_inertia.component_mul(&qdd),
            qdd,
            slope: Flow {
                q: *qd,
                qd: qdd,
                momentum: motor + brake + tool - gravity - friction + kinetic_gradient,
                brake_impulse: brake,
                work: Work {
                    motors: motor.dot(qd),
                    brakes: brake.dot(qd),
                    tool: tool.dot(qd),
                    gravity: -gravity.dot(qd),
                    friction: -friction.dot(qd),
                },
            },
        }
    }

    /// What the controller makes of the measured state: computed torque along the planned motion, and the compensation.
    /// What the rotors take to accelerate as they should is given to them besides.
    pub(super) fn command(
        &self,
        elapsed: f64,
        flow: &Flow<N>,
        known: LockedJoints<N>,
    ) -> Command<N> {
        let time = self.brake.failure.time + elapsed;
        let planned = self.trajectory.state(time);
        let state = JointState {
            q: flow.q,
            qd: flow.qd,
            qdd: planned.qdd
                + (planned.qd - flow.qd) * self.feedback.rate
                + (planned.q - flow.q) * self.feedback.position,
        };
        let cycle = self.controller.cycle(&state, &(self.wrench)(time), known);
        let rotor = self.reflected_inertia.component_mul(&state.qdd);
        Command {
            cycle,
            motor: known.without(&(cycle.torque + rotor)),
        }
    }

    /// The joints whose acceleration the brakes dictate, and that acceleration.
    fn braked(&self, elapsed: f64, phase: &Phase<N>) -> (LockedJoints<N>, SVector<f64, N>) {
        let joints = self.brake.failure.joints;
        match phase.stage {
            Stage::Free => (LockedJoints::NONE, SVector::zeros()),
            Stage::Locked => (joints, SVector::zeros()),
            Stage::Braking(from) => {
                let duration = self.brake.duration;
                let slope = self.brake.profile.slope(elapsed / duration) / duration;
                (joints, (from - joints.without(&from)) * slope)
            }
        }
    }

    pub(super) fn sample(&self, elapsed: f64, flow: &Flow<N>, phase: &Phase<N>) -> Sample<N> {
        let instant = self.instant(elapsed, flow, phase);
        let time = self.brake.failure.time + elapsed;
        let planned = match phase.stage {
            Stage::Free => self.trajectory.state(time),
            Stage::Braking(_) | Stage::Locked => self.brake.failure.state(self.trajectory, time),
        };
        Sample {
            time,
            elapsed,
            state: JointState {
                q: flow.q,
                qd: flow.qd,
                qdd: instant.qdd,
            },
            planned,
            motor: instant.command.motor,
            brake: instant.brake,
            rotor: instant.rotor,
            control: instant.command.cycle,
        }
    }
}
