//! A third road: products of exponentials over any numbers, dual ones for exact derivatives.
//!
//! Neither the link frames of the generic path nor the formulas of the generated code:
//! joints are screws in world axes at q = 0 and every body is moved by the product of the exponentials before it
//! (Lynch and Park, *Modern Robotics*, 4.1); M is the composite-rigid-body algorithm on spatial inertias about
//! the world's origin (Featherstone, *Rigid Body Dynamics Algorithms*, 6.2). It loses a few digits
//! where the origin is far from the last links, which the tolerances allow for.

use nalgebra::{
    Const, Isometry3, Matrix3, SMatrix, SVector, Translation3, UnitQuaternion, Vector3,
};
use num_dual::{DualNum, DualSVec64};
use ulna::{JointKind, Placement, SerialChain, TaskRow};

/// A number or a number with its derivatives.
pub(super) trait Number: DualNum<Primitive = f64, Real = f64> + Copy {}
impl<D: DualNum<Primitive = f64, Real = f64> + Copy> Number for D {}

/// An arm as screws and bodies, in world axes at q = 0.
pub(super) struct Exponentials<const N: usize> {
    screws: [Screw; N],
    bodies: [Body; N],
    /// What rotors behind their gears add to M's diagonal.
    rotors: [f64; N],
    tool: (Matrix3<f64>, Vector3<f64>),
    gravity: Vector3<f64>,
    task: Vec<usize>,
}

/// A unit twist about the world's origin.
#[derive(Clone, Copy)]
struct Screw {
    angular: Vector3<f64>,
    linear: Vector3<f64>,
}

#[derive(Clone, Copy)]
struct Body {
    mass: f64,
    com: Vector3<f64>,
    inertia: Matrix3<f64>,
}

/// A displacement: rotation and translation.
type Motion<D> = (Matrix3<D>, Vector3<D>);

impl<const N: usize> Exponentials<N> {
    pub(super) fn new(chain: &SerialChain<N>) -> Self {
        let mut frame = isometry(&chain.base);
        let placed: [(Screw, Body); N] = core::array::from_fn(|i| {
            let joint = chain.joints[i];
            let x = |angle| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), angle);
            let z = |angle| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
            frame = frame
                * x(joint.alpha.radians)
                * Translation3::new(joint.a, 0.0, 0.0)
                * z(joint.theta.radians)
                * Translation3::new(0.0, 0.0, joint.d);
            let rotation = *frame.rotation.to_rotation_matrix().matrix();
            let axis = rotation.column(2).clone_owned();
            let screw = match joint.kind {
                JointKind::Revolute => Screw {
                    angular: axis,
                    linear: frame.translation.vector.cross(&axis),
                },
                JointKind::Prismatic => Screw {
                    angular: Vector3::zeros(),
                    linear: axis,
                },
            };
            let inertia = Matrix3::from_fn(|r, c| joint.link.inertia[r][c]);
            let body = Body {
                mass: joint.link.mass,
                com: frame.translation.vector + rotation * Vector3::from(joint.link.com),
                inertia: rotation * inertia * rotation.transpose(),
            };
            (screw, body)
        });
        let tool = frame * isometry(&chain.tool);
        Self {
            screws: placed.map(|(screw, _)| screw),
            bodies: placed.map(|(_, body)| body),
            rotors: chain
                .joints
                .map(|joint| joint.motor.inertia * joint.motor.ratio * joint.motor.ratio),
            tool: (
                *tool.rotation.to_rotation_matrix().matrix(),
                tool.translation.vector,
            ),
            gravity: Vector3::from(chain.gravity),
            task: chain.task.iter().map(TaskRow::index).collect(),
        }
    }

    /// q with the unit derivatives by each of its entries.
    pub(super) fn dual(q: &SVector<f64, N>) -> SVector<DualSVec64<N>, N> {
        SVector::from_fn(|i, _| DualSVec64::from_re(q[i]).derivative(i))
    }

    /// What the joints up to each one do to the world at q = 0: `e^[S_1]q_1 … e^[S_i]q_i`.
    fn motions<D: Number>(&self, q: &SVector<D, N>) -> [Motion<D>; N] {
        let mut rotation = lift(Matrix3::identity());
        let mut translation = lift(Vector3::zeros());
        core::array::from_fn(|i| {
            let (turn, shift) = self.screws[i].exponential(q[i]);
            translation += rotation * shift;
            rotation *= turn;
            (rotation, translation)
        })
    }

    /// Rotation and position of the tool.
    pub(super) fn tool<D: Number>(&self, q: &SVector<D, N>) -> Motion<D> {
        let (rotation, translation) = self.motions(q)[N - 1];
        (
            rotation * lift(self.tool.0),
            rotation * lift(self.tool.1) + translation,
        )
    }

    /// Each joint's screw where the joints before have carried it: angular over linear, about the world's origin.
    fn carried<D: Number>(&self, motions: &[Motion<D>; N]) -> [SVector<D, 6>; N] {
        core::array::from_fn(|i| {
            // A screw does not move under its own exponential.
            let (rotation, translation) = motions[i];
            let angular = rotation * lift(self.screws[i].angular);
            let linear = rotation * lift(self.screws[i].linear) + translation.cross(&angular);
            stack(&angular, &linear)
        })
    }

    /// The geometric Jacobian at the tool point.
    pub(super) fn jacobian<D: Number>(&self, q: &SVector<D, N>) -> SMatrix<D, 6, N> {
        let (_, p) = self.tool(q);
        let columns = self.carried(&self.motions(q)).map(|screw| {
            let (angular, linear) = unstack(&screw);
            stack(&(linear + angular.cross(&p)), &angular)
        });
        SMatrix::from_fn(|row, column| columns[column][row])
    }

    /// `M_ij = S_iᵀ I^c_j S_j` for i ≤ j, with the spatial inertia I^c_j of all bodies from j on.
    pub(super) fn mass_matrix<D: Number>(&self, q: &SVector<D, N>) -> SMatrix<D, N, N> {
        let motions = self.motions(q);
        let screws = self.carried(&motions);
        let mut composite = lift(SMatrix::<f64, 6, 6>::zeros());
        let mut mass_matrix = lift(SMatrix::from_diagonal(&SVector::from(self.rotors)));
        for j in (0..N).rev() {
            composite += self.bodies[j].spatial_inertia(&motions[j]);
            let momentum = composite * screws[j];
            for i in 0..=j {
                mass_matrix[(i, j)] += dot(&screws[i], &momentum);
                mass_matrix[(j, i)] = mass_matrix[(i, j)];
            }
        }
        mass_matrix
    }

    /// Potential energy in the field of gravity, J.
    pub(super) fn potential<D: Number>(&self, q: &SVector<D, N>) -> D {
        let motions = self.motions(q);
        let mut sum = D::from(0.0);
        for (body, (rotation, translation)) in self.bodies.iter().zip(motions) {
            let com = rotation * lift(body.com) + translation;
            sum -= dot(&lift(self.gravity), &com) * body.mass;
        }
        sum
    }

    /// w_D: the volume that the rows of `J M⁻¹` span, by Cholesky and Gram–Schmidt.
    pub(super) fn manipulability<D: Number>(&self, q: &SVector<D, N>) -> D {
        let jacobian = self.jacobian(q);
        let factor = cholesky(self.mass_matrix(q));
        let mut rows: Vec<SVector<D, N>> = self
            .task
            .iter()
            .map(|row| solve(&factor, SVector::from_fn(|i, _| jacobian[(*row, i)])))
            .collect();
        let mut volume = D::from(1.0);
        while let Some(row) = rows.pop() {
            let squared = dot(&row, &row);
            volume *= squared.sqrt();
            for other in &mut rows {
                let along = dot(other, &row) / squared;
                *other -= row * along;
            }
        }
        volume
    }
}

impl Screw {
    /// `e^[S]q`: Rodrigues' formula for a turn, a shift for a prismatic joint.
    fn exponential<D: Number>(&self, q: D) -> Motion<D> {
        if self.angular == Vector3::zeros() {
            return (lift(Matrix3::identity()), lift(self.linear) * q);
        }
        let cross = self.angular.cross_matrix();
        let turn = lift(Matrix3::identity())
            + lift(cross) * q.sin()
            + lift(cross * cross) * (D::from(1.0) - q.cos());
        // A pure rotation about a point of the axis: that point stays.
        let point = lift(self.angular.cross(&self.linear));
        (turn, point - turn * point)
    }
}

impl Body {
    /// About the world's origin, angular over linear (Featherstone, Eq. 2.63).
    fn spatial_inertia<D: Number>(&self, (rotation, translation): &Motion<D>) -> SMatrix<D, 6, 6> {
        let c = rotation * lift(self.com) + translation;
        let zero = D::from(0.0);
        let cross = Matrix3::new(zero, -c.z, c.y, c.z, zero, -c.x, -c.y, c.x, zero);
        let angular = rotation * lift(self.inertia) * rotation.transpose()
            + cross * cross.transpose() * D::from(self.mass);
        let moment = cross * D::from(self.mass);
        let mut spatial = lift(SMatrix::<f64, 6, 6>::zeros());
        spatial.fixed_view_mut::<3, 3>(0, 0).copy_from(&angular);
        spatial.fixed_view_mut::<3, 3>(0, 3).copy_from(&moment);
        spatial
            .fixed_view_mut::<3, 3>(3, 0)
            .copy_from(&moment.transpose());
        spatial
            .fixed_view_mut::<3, 3>(3, 3)
            .copy_from(&lift(Matrix3::identity() * self.mass));
        spatial
    }
}

/// The derivatives by each q_i.
pub(super) fn slope<const N: usize>(number: &DualSVec64<N>) -> SVector<f64, N> {
    number.eps.unwrap_generic(Const::<N>, Const::<1>)
}

/// The derivatives of every entry, one matrix for each q_i.
pub(super) fn slopes<const N: usize, const R: usize, const C: usize>(
    matrix: &SMatrix<DualSVec64<N>, R, C>,
) -> [SMatrix<f64, R, C>; N] {
    core::array::from_fn(|i| matrix.map(|entry| slope(&entry)[i]))
}

fn isometry(placement: &Placement) -> Isometry3<f64> {
    let pose = placement.isometry();
    Isometry3::from_parts(
        pose.translation,
        UnitQuaternion::from_rotation_matrix(&pose.rotation),
    )
}

fn lift<D: Number, const R: usize, const C: usize>(matrix: SMatrix<f64, R, C>) -> SMatrix<D, R, C> {
    matrix.map(D::from)
}

fn stack<D: Number>(upper: &Vector3<D>, lower: &Vector3<D>) -> SVector<D, 6> {
    SVector::from_fn(|i, _| if i < 3 { upper[i] } else { lower[i - 3] })
}

fn unstack<D: Number>(both: &SVector<D, 6>) -> (Vector3<D>, Vector3<D>) {
    (
        Vector3::new(both[0], both[1], both[2]),
        Vector3::new(both[3], both[4], both[5]),
    )
}

fn dot<D: Number, const R: usize>(a: &SVector<D, R>, b: &SVector<D, R>) -> D {
    a.iter()
        .zip(b)
        .fold(D::from(0.0), |sum, (a, b)| sum + *a * *b)
}

/// The lower factor of a positive definite matrix.
fn cholesky<D: Number, const N: usize>(mut m: SMatrix<D, N, N>) -> SMatrix<D, N, N> {
    for j in 0..N {
        for i in j..N {
            for k in 0..j {
                let product = m[(i, k)] * m[(j, k)];
                m[(i, j)] -= product;
            }
        }
        let root = m[(j, j)].sqrt();
        for i in j..N {
            m[(i, j)] /= root;
        }
    }
    m
}

/// The solution of `L Lᵀ x = b`.
fn solve<D: Number, const N: usize>(l: &SMatrix<D, N, N>, mut b: SVector<D, N>) -> SVector<D, N> {
    for i in 0..N {
        for k in 0..i {
            let product = l[(i, k)] * b[k];
            b[i] -= product;
        }
        b[i] /= l[(i, i)];
    }
    for i in (0..N).rev() {
        for k in i + 1..N {
            let product = l[(k, i)] * b[k];
            b[i] -= product;
        }
        b[i] /= l[(i, i)];
    }
    b
}
