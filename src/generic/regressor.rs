//! The regressor Y of τ = Y π: torques of unit parameters, link by link; and which of its columns are a base.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3, Vector6};

use super::SerialChain;
use super::kinematics::Frames;
use crate::arm::Parameter;
use crate::{JointKind, Real};

/// Wrenches on a link that its unit parameters ask for, a column each.
type Wrenches = SMatrix<f64, 6, 10>;

/// States at which columns are compared: no block of a revolute joint has more than seven independent columns.
const STATES: usize = 12;
/// What is left of a column that depends on others, relative to what its terms can amount to, at most.
const DEPENDENT: f64 = 1e-9;

/// What is left of a column that depends on others where none of those is nearly dependent.
const CLEARLY_DEPENDENT: f64 = 1e-12;
/// What is left, at least, of one that is not even nearly dependent.
const CLEARLY_INDEPENDENT: f64 = 1e-5;

/// The columns of Y that are those of base parameters.
pub(crate) struct BaseColumns<const N: usize> {
    /// Of each link, in the order of the regressor's columns.
    pub(crate) kept: [[bool; Parameter::COUNT]; N],
    /// Whether doubles are enough to tell.
    pub(crate) are_clear: bool,
}

/// A column of Y at all states, one below the other.
type Column<const N: usize> = [[f64; N]; STATES];

impl<const N: usize> SerialChain<N> {
    /// `Y_i = J_iᵀ A_i`, with the geometric Jacobian J_i at the origin of link i's frame, and A_i the wrenches about that origin that
    /// unit parameters need in the link's motion (the principle of virtual work; Siciliano 7.2.1 and Eq. 7.42).
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

    /// Which columns of Y are those of base parameters: the ones that depend on none before them in the order of
    /// [`Parameter::BASE_ORDER`], by orthogonalising Y stacked over states, column after column (Gautier 1991).
    ///
    /// Decided in doubles: of an arm that is nearly but not quite special (axes a millionth of a degree from parallel),
    /// others may be kept than those that the exact numbers tell. It is clear which where no column is left as small as that.
    pub(crate) fn base_columns(&self) -> BaseColumns<N> {
        let mut columns = self.stacked();
        let mut kept = [[false; Parameter::COUNT]; N];
        let mut are_clear = true;
        for i in 0..N {
            for (place, parameter) in Parameter::BASE_ORDER.into_iter().enumerate() {
                let mut column = columns[i][parameter.index()];
                // Twice is enough (Parlett).
                for _ in 0..2 {
                    for (link, is_kept) in kept.iter().enumerate().take(i + 1) {
                        let earlier = if link < i { Parameter::COUNT } else { place };
                        for other in &Parameter::BASE_ORDER[..earlier] {
                            if is_kept[other.index()] {
                                let direction = &columns[link][other.index()];
                                let along = dot(direction, &column);
                                let pairs = column.as_flattened_mut().iter_mut();
                                let pairs = pairs.zip(direction.as_flattened());
                                pairs.for_each(|(x, unit)| *x -= along * unit);
                            }
                        }
                    }
                }
                let length = Real::sqrt(dot(&column, &column));
                are_clear &= length < CLEARLY_DEPENDENT || length > CLEARLY_INDEPENDENT;
                if length > DEPENDENT {
                    kept[i][parameter.index()] = true;
                    columns[i][parameter.index()] = column.map(|row| row.map(|x| x / length));
                }
            }
        }
        BaseColumns { kept, are_clear }
    }

    /// Y's columns at all states, one below the other, relative to what their terms can amount to.
    fn stacked(&self) -> [[Column<N>; Parameter::COUNT]; N] {
        let mut columns = [[[[0.0; N]; STATES]; Parameter::COUNT]; N];
        let gravity = Vector3::from(self.gravity).norm();
        let mut reach = [0.0; N];
        let mut length = 0.0;
        for (reach, joint) in reach.iter_mut().zip(&self.joints) {
            length += joint.a.abs() + joint.d.abs();
            if joint.kind == JointKind::Prismatic {
                length += 1.0;
            }
            *reach = length;
        }
        for state in 0..STATES {
            let vector =
                |which: usize| SVector::from_fn(|i, _| spread((state * 3 + which) * N + i));
            let (q, qd, qdd) = (vector(0) * 3.0, vector(1), vector(2));
            let regressor = self.regressor_at(&q, &qd, &qdd);
            for (i, block) in regressor.iter().enumerate() {
                let field = gravity + reach[i];
                let sizes = [reach[i] * field, reach[i] + field, 1.0];
                for parameter in Parameter::ALL {
                    let size = sizes[parameter.degree()];
                    let column = block.column(parameter.index());
                    columns[i][parameter.index()][state] = core::array::from_fn(|j| {
                        let unit = match self.joints[j].kind {
                            JointKind::Revolute => 1.0,
                            JointKind::Prismatic => reach[j],
                        };
                        if size > 0.0 {
                            column[j] * unit / size
                        } else {
                            0.0
                        }
                    });
                }
            }
        }
        columns
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

fn dot<const N: usize>(a: &Column<N>, b: &Column<N>) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| a * b).sum()
}

/// The terms of a sequence that fills [−1, 1] evenly (Weyl: the squares times an irrational number, modulo 1).
fn spread(index: usize) -> f64 {
    let index = (index + 1) as f64;
    2.0 * ((index * index * core::f64::consts::SQRT_2) % 1.0) - 1.0
}
