//! Inertial parameters: of a link, and of all links beyond a joint together.

use ulna::{Joint, JointKind, Link, Parameter};
use ulna_table::Model;

use super::vector::{Sym3, Turn, Vec3};
use crate::graph::{Expr, Graph, Input};

/// The ten inertial parameters of a rigid body about the origin of its frame.
#[derive(Clone, Copy, Debug)]
pub struct Body<'g> {
    /// Mass, kg.
    pub mass: Expr<'g>,
    /// First moment, mass times centroid, kg·m.
    pub moment: Vec3<'g>,
    /// Inertia about the origin, kg·m².
    pub inertia: Sym3<'g>,
}

/// Joins a body to the last link.
pub(crate) fn add_to_last<'g>(bodies: &mut [Body<'g>], body: Body<'g>) {
    if let Some(last) = bodies.last_mut() {
        *last = last.join(body);
    }
}

/// The links' parameters, regrouped to the base (minimal) parameters of each joint
/// (Gautier and Khalil 1990; Khalil and Dombre, Modeling, Identification and Control of Robots, section 9.4).
///
/// What a revolute joint's turning cannot change (mass, first moment along the axis, and as much of the inertia
/// as is round about it) is counted with the link before; likewise the whole inertia tensor behind a prismatic joint.
/// M and τ stay the same, and many constants become zero. The links' origins are `heights` apart along the joints' axes. What reaches the base, which neither feels, is the second result,
/// about the base's origin.
pub(crate) fn base_parameters<'g>(
    graph: &'g Graph,
    model: &Model,
    heights: &[Expr<'g>],
    links: &[Body<'g>],
) -> (Vec<Body<'g>>, Body<'g>) {
    let mut bodies = links.to_vec();
    let mut ground = Body::none(graph);
    for (i, joint) in model.joints().iter().enumerate().rev() {
        let passed = indifferent_part(joint, &bodies[i]);
        bodies[i] = bodies[i].join(passed.scale(graph.constant(-1.0)));
        let before = match i {
            0 => &mut ground,
            _ => &mut bodies[i - 1],
        };
        *before = before.join(seen_from_link_before(graph, joint, heights[i], passed));
    }
    (bodies, ground)
}

/// A body of a joint's link in the frame of the link before, the joint at rest, the origins `height` apart along its axis.
pub(crate) fn seen_from_link_before<'g>(
    graph: &'g Graph,
    joint: &Joint,
    height: Expr<'g>,
    body: Body<'g>,
) -> Body<'g> {
    let (alpha, theta) = (
        Turn::by_angle(graph, joint.alpha),
        Turn::by_angle(graph, joint.theta),
    );
    let zero = graph.constant(0.0);
    let along = Vec3([zero, zero, height]);
    let origin = Vec3([graph.constant(joint.a), zero, zero]) + along.turn_x(alpha);
    body.turn_z(theta).turn_x(alpha).shift(origin)
}

/// The part of a link's parameters that looks the same from the link before however the joint stands.
pub(crate) fn indifferent_part<'g>(joint: &Joint, body: &Body<'g>) -> Body<'g> {
    let zero = body.mass.of(0.0);
    match joint.kind {
        JointKind::Revolute => {
            let round = body.inertia.0[1];
            Body {
                mass: body.mass,
                moment: Vec3([zero, zero, body.moment.0[2]]),
                inertia: Sym3([round, round, zero, zero, zero, zero]),
            }
        }
        JointKind::Prismatic => Body {
            mass: zero,
            moment: Vec3([zero; 3]),
            inertia: body.inertia,
        },
    }
}

impl<'g> Body<'g> {
    /// Nothing.
    fn none(graph: &'g Graph) -> Self {
        let zero = graph.constant(0.0);
        Self {
            mass: zero,
            moment: Vec3([zero; 3]),
            inertia: Sym3([zero; 6]),
        }
    }

    /// A link's parameters.
    pub fn of_link(graph: &'g Graph, link: &Link) -> Self {
        let zero = graph.constant(0.0);
        let at_centroid = Self {
            mass: graph.constant(link.mass),
            moment: Vec3([zero; 3]),
            inertia: Sym3::constant(graph, &link.inertia),
        };
        at_centroid.shift(Vec3::constant(graph, link.com))
    }

    /// The same body: its first moment called `mcx`, `mcy`, `mcz`, and its inertia `ixx`, `iyy`, ..., each with `suffix`.
    pub fn labelled(self, family: &'static str, suffix: &str) -> Self {
        self.moment
            .labelled(family, |axis| format!("mc{axis}{suffix}"));
        self.inertia
            .labelled(family, |axes| format!("i{axes}{suffix}"));
        self
    }

    /// The payload that is an argument, about the origin of the last link's frame.
    pub fn payload(graph: &'g Graph) -> Self {
        Self::of_parameters(std::array::from_fn(|i| graph.input(Input::Payload(i))))
    }

    /// The body whose parameters, in the order of [`Parameter::ALL`], are these numbers.
    pub fn of_parameters(parameters: [Expr<'g>; Parameter::COUNT]) -> Self {
        let [mass, mx, my, mz, xx, xy, xz, yy, yz, zz] = parameters;
        Self {
            mass,
            moment: Vec3([mx, my, mz]),
            inertia: Sym3([xx, yy, zz, xy, xz, yz]),
        }
    }

    /// Its parameters, in the order of [`Parameter::ALL`].
    pub fn parameters(self) -> [Expr<'g>; Parameter::COUNT] {
        let ([mx, my, mz], [xx, yy, zz, xy, xz, yz]) = (self.moment.0, self.inertia.0);
        [self.mass, mx, my, mz, xx, xy, xz, yy, yz, zz]
    }

    /// Every parameter times `factor`.
    pub fn scale(self, factor: Expr<'g>) -> Self {
        Self {
            mass: self.mass * factor,
            moment: self.moment.scale(factor),
            inertia: Sym3(self.inertia.0.map(|x| x * factor)),
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
