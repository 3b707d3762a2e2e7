//! Inertial parameters: of a link, as numbers, and of all links beyond a joint together, as expressions.

use nalgebra::{Matrix3, Vector3};
use ulna::{Joint, JointKind, Link, Model};

use super::vector::{Sym3, Turn, Vec3};
use crate::graph::{Expr, Graph};

/// The ten inertial parameters of a rigid body about the origin of its frame, as numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ConstantBody {
    /// Mass, kg.
    pub mass: f64,
    /// First moment, mass times centroid, kg·m.
    pub moment: Vector3<f64>,
    /// Inertia about the frame's origin, kg·m².
    pub inertia: Matrix3<f64>,
}

impl ConstantBody {
    fn of_link(link: &Link) -> Self {
        let at_centroid = Self {
            mass: link.mass,
            moment: Vector3::zeros(),
            inertia: Matrix3::from_fn(|i, j| link.inertia[i][j]),
        };
        at_centroid.seen_from(&Matrix3::identity(), &Vector3::from(link.com))
    }

    /// The body as seen from a frame in which its own has the given rotation and origin.
    fn seen_from(&self, rotation: &Matrix3<f64>, origin: &Vector3<f64>) -> Self {
        let moment = rotation * self.moment;
        let shifted = moment + self.mass * origin;
        let steiner = -(origin.cross_matrix() * shifted.cross_matrix())
            - moment.cross_matrix() * origin.cross_matrix();
        Self {
            mass: self.mass,
            moment: shifted,
            inertia: rotation * self.inertia * rotation.transpose() + steiner,
        }
    }

    fn plus(&self, other: &Self, sign: f64) -> Self {
        Self {
            mass: self.mass + sign * other.mass,
            moment: self.moment + sign * other.moment,
            inertia: self.inertia + sign * other.inertia,
        }
    }
}

/// The links' parameters, regrouped to the base (minimal) parameters of each joint
/// (Gautier and Khalil 1990; Khalil and Dombre, Modeling, Identification and Control of Robots, section 9.4).
///
/// What a revolute joint's turning cannot change (mass, first moment along the axis, and as much of the inertia
/// as is round about it) is counted with the link before; likewise the whole inertia tensor behind a prismatic joint.
/// M and τ stay the same, and many constants become zero. What reaches the base is dropped.
pub fn base_parameters(model: &Model) -> Vec<ConstantBody> {
    let links = model.joints.iter().map(|joint| &joint.link);
    let mut bodies: Vec<ConstantBody> = links.map(ConstantBody::of_link).collect();
    for (i, joint) in model.joints.iter().enumerate().rev() {
        let passed = indifferent_part(joint, &bodies[i]);
        bodies[i] = bodies[i].plus(&passed, -1.0);
        if i > 0 {
            let (rotation, origin) = fixed_part(joint);
            bodies[i - 1] = bodies[i - 1].plus(&passed.seen_from(&rotation, &origin), 1.0);
        }
    }
    bodies
}

/// The part of a link's parameters that looks the same from the link before however the joint stands.
fn indifferent_part(joint: &Joint, body: &ConstantBody) -> ConstantBody {
    match joint.kind {
        JointKind::Revolute => {
            let round = body.inertia[(1, 1)];
            ConstantBody {
                mass: body.mass,
                moment: Vector3::new(0.0, 0.0, body.moment.z),
                inertia: Matrix3::from_diagonal(&Vector3::new(round, round, 0.0)),
            }
        }
        JointKind::Prismatic => ConstantBody {
            inertia: body.inertia,
            ..ConstantBody::default()
        },
    }
}

/// Rotation and origin of the joint's frame at q = 0, seen from the frame before.
fn fixed_part(joint: &Joint) -> (Matrix3<f64>, Vector3<f64>) {
    let ((sa, ca), (st, ct)) = (joint.alpha.sin_cos(), joint.theta.sin_cos());
    let twist = Matrix3::new(1.0, 0.0, 0.0, 0.0, ca, -sa, 0.0, sa, ca);
    let turn = Matrix3::new(ct, -st, 0.0, st, ct, 0.0, 0.0, 0.0, 1.0);
    let origin = Vector3::new(joint.a, -sa * joint.d, ca * joint.d);
    (twist * turn, origin)
}

/// Inertial parameters as expressions.
#[derive(Clone, Copy, Debug)]
pub struct Body<'g> {
    /// Mass.
    pub mass: Expr<'g>,
    /// First moment.
    pub moment: Vec3<'g>,
    /// Inertia about the origin.
    pub inertia: Sym3<'g>,
}

impl<'g> Body<'g> {
    /// A link's parameters.
    pub fn constant(graph: &'g Graph, body: &ConstantBody) -> Self {
        let inertia = std::array::from_fn(|i| std::array::from_fn(|j| body.inertia[(i, j)]));
        Self {
            mass: graph.constant(body.mass),
            moment: Vec3::constant(graph, body.moment.into()),
            inertia: Sym3::constant(graph, &inertia),
        }
    }

    /// The body turned about z.
    pub fn turn_z(self, turn: Turn<'g>) -> Self {
        Self {
            mass: self.mass,
            moment: self.moment.turn_z(turn),
            inertia: self.inertia.turn_z(turn),
        }
    }

    /// The body turned about x.
    pub fn turn_x(self, turn: Turn<'g>) -> Self {
        Self {
            mass: self.mass,
            moment: self.moment.turn_x(turn),
            inertia: self.inertia.turn_x(turn),
        }
    }

    /// The body about an origin from which its own lies at `r` (Huygens and Steiner).
    pub fn shift(self, r: Vec3<'g>) -> Self {
        let moment = self.moment + r.scale(self.mass);
        let ([x, y, z], [hx, hy, hz], [kx, ky, kz]) = (r.0, self.moment.0, moment.0);
        let steiner = Sym3([
            y * (hy + ky) + z * (hz + kz),
            z * (hz + kz) + x * (hx + kx),
            x * (hx + kx) + y * (hy + ky),
            -(x * ky + y * hx),
            -(x * kz + z * hx),
            -(y * kz + z * hy),
        ]);
        Self {
            mass: self.mass,
            moment,
            inertia: self.inertia + steiner,
        }
    }

    /// Both bodies as one.
    pub fn join(self, other: Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            moment: self.moment + other.moment,
            inertia: self.inertia + other.inertia,
        }
    }
}
