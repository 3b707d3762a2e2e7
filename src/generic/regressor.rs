//! The regressor Y of τ = Y π: torques of unit parameters, link by link.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3, Vector6};

use super::SerialChain;
use super::kinematics::Frames;
use crate::JointKind;
use crate::arm::Parameter;

/// Wrenches on a link that its unit parameters ask for, a column each.
type Wrenches = SMatrix<f64, 6, 10>;

impl<const N: usize> SerialChain<N> {
    /// `Y_i = J_iᵀ A_i`, with the geometric Jacobian J_i at the origin of link i's frame, and A_i the wrenches about that origin that
    /// unit parameters need in the link's motion (the principle of virtual work; Siciliano 7.2.2, linearity in the dynamic parameters).
    pub(super) fn regressor_at(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> [SMatrix<f64, N, 10>; N] {
        let frames = self.frames(&self.inputs(q));
        let velocities = self.angular_velocities(&frames, qd);
        core::array::from_fn(|i| {
            let (jacobian, rate) = self.jacobian_and_rate(&frames, &velocities, i, qd);
            let mut acceleration = jacobian * qdd + rate * qd;
            let gravity = Vector3::from(self.gravity);
            acceleration
                .fixed_rows_mut::<3>(0)
                .zip_apply(&gravity, |a, g| *a -= g);
            let rotation = frames.world_from_frame[i].rotation;
            let wrenches = wrenches(rotation.matrix(), &velocities[i], &acceleration);
            jacobian.tr_mul(&wrenches)
        })
    }

    /// The columns of the base parameters as they are in Y, all others 0. Which they are is found anew at each call.
    pub(super) fn base_regressor_at(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> [SMatrix<f64, N, 10>; N] {
        let mut regressor = self.regressor_at(q, qd, qdd);
        for (block, kept) in regressor.iter_mut().zip(self.base_columns().kept) {
            for (column, _) in kept.iter().enumerate().filter(|(_, kept)| !**kept) {
                block.column_mut(column).fill(0.0);
            }
        }
        regressor
    }

    /// Angular velocity of each link, world axes.
    fn angular_velocities(&self, frames: &Frames<N>, qd: &SVector<f64, N>) -> [Vector3<f64>; N] {
        let mut velocity = Vector3::zeros();
        core::array::from_fn(|i| {
            if self.joints[i].kind == JointKind::Revolute {
                velocity += frames.world_from_frame[i].rotation * Vector3::z() * qd[i];
            }
            velocity
        })
    }

    /// Geometric Jacobian at the origin of link `link`'s frame, and its rate of change: each axis turns with the link that carries it,
    /// and the arm from an axis to the origin changes with the links between them.
    fn jacobian_and_rate(
        &self,
        frames: &Frames<N>,
        velocities: &[Vector3<f64>; N],
        link: usize,
        qd: &SVector<f64, N>,
    ) -> (SMatrix<f64, 6, N>, SMatrix<f64, 6, N>) {
        let jacobian = self.jacobian(frames, link, Vector3::zeros());
        let mut rate = SMatrix::<f64, 6, N>::zeros();
        let (mut arm, mut arm_rate) = (Vector3::zeros(), Vector3::zeros());
        for j in (0..=link).rev() {
            let axis = frames.world_from_frame[j].rotation * Vector3::z();
            let axis_rate = velocities[j].cross(&axis);
            let step = frames.steps[j];
            let carrier = if j > 0 {
                velocities[j - 1]
            } else {
                Vector3::zeros()
            };
            let mut step_rate = carrier.cross(&step);
            match self.joints[j].kind {
                JointKind::Revolute => {
                    let linear = axis_rate.cross(&arm) + axis.cross(&arm_rate);
                    rate.fixed_view_mut::<3, 1>(0, j).copy_from(&linear);
                    rate.fixed_view_mut::<3, 1>(3, j).copy_from(&axis_rate);
                }
                JointKind::Prismatic => {
                    rate.fixed_view_mut::<3, 1>(0, j).copy_from(&axis_rate);
                    step_rate += axis * qd[j];
                }
            }
            arm += step;
            arm_rate += step_rate;
        }
        (jacobian, rate)
    }
}

/// The wrench about the origin of a link's frame, world axes, for each unit parameter of the link:
/// f = m a + ω̇ × h + ω × (ω × h), n = h × a + I ω̇ + ω × I ω, h being m c.
fn wrenches(
    rotation: &Matrix3<f64>,
    velocity: &Vector3<f64>,
    acceleration: &Vector6<f64>,
) -> Wrenches {
    let linear = acceleration.fixed_rows::<3>(0).into_owned();
    let angular = acceleration.fixed_rows::<3>(3).into_owned();
    let mut wrenches = Wrenches::zeros();
    let mut set = |parameter: Parameter, force: Vector3<f64>, moment: Vector3<f64>| {
        let mut column = wrenches.column_mut(parameter.index());
        column.fixed_rows_mut::<3>(0).copy_from(&force);
        column.fixed_rows_mut::<3>(3).copy_from(&moment);
    };
    set(Parameter::Mass, linear, Vector3::zeros());
    for (axis, parameter) in [Parameter::Mx, Parameter::My, Parameter::Mz]
        .into_iter()
        .enumerate()
    {
        let h = rotation.column(axis).into_owned();
        let force = angular.cross(&h) + velocity.cross(&velocity.cross(&h));
        set(parameter, force, h.cross(&linear));
    }
    for (row, column, parameter) in [
        (0, 0, Parameter::Ixx),
        (0, 1, Parameter::Ixy),
        (0, 2, Parameter::Ixz),
        (1, 1, Parameter::Iyy),
        (1, 2, Parameter::Iyz),
        (2, 2, Parameter::Izz),
    ] {
        let mut unit = Matrix3::zeros();
        unit[(row, column)] = 1.0;
        unit[(column, row)] = 1.0;
        let inertia = rotation * unit * rotation.transpose();
        let moment = inertia * angular + velocity.cross(&(inertia * velocity));
        set(parameter, Vector3::zeros(), moment);
    }
    wrenches
}
