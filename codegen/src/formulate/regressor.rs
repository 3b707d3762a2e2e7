//! The regressor Y of τ = Y π, joint by joint and link by link: the power that a unit twist of joint j takes from the wrenches
//! that the unit parameters of link i need, in the frame of link i.
//!
//! There the wrenches are entries of `Λ = [ω̇]× + [ω]×[ω]×` and of the origin's acceleration, mostly zeros, and the link's own joint is a unit
//! vector. Carrying ten wrenches from link to link, as the recursion of inverse dynamics would, takes 1.4 (ssrms) to 2 times (oblique_6)
//! the operations of carrying the joints' twists outwards: two vectors for a joint instead of fourteen for a link.
//!
//! What a joint's turning cannot change of its link's parameters acts on the joints before like parameters of the link before
//! ([`super::body`]); where the axes are parallel or square, those columns follow from the ones of the link before in fewer operations
//! (1,322 without it and 1,177 with it on ssrms; elsewhere more).

use ulna::{JointKind, Parameter};

use super::chain::Chain;
use super::inverse_dynamics::{Motion, times};
use super::kinematics::Twist;
use super::mass_matrix_derivatives::name_twists;
use super::vector::{Turn, Vec3};
use crate::graph::{Expr, Input};

/// Which columns of the regressor are asked for, a bit for each parameter of each link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Columns([u16; Columns::LINKS]);

impl Default for Columns {
    /// All.
    fn default() -> Self {
        Self([u16::MAX; Self::LINKS])
    }
}

impl Columns {
    /// The most links that an arm has.
    const LINKS: usize = 32;

    /// These columns.
    pub fn of(columns: impl IntoIterator<Item = (usize, Parameter)>) -> Self {
        let mut bits = [0; Self::LINKS];
        for (link, parameter) in columns {
            bits[link] |= 1 << parameter.index();
        }
        Self(bits)
    }

    /// Whether a column is among them.
    pub fn contain(&self, link: usize, parameter: Parameter) -> bool {
        self.0[link] >> parameter.index() & 1 == 1
    }
}

/// Entries of a row of a block: torques of one joint, by parameters of one link in the order of [`Parameter::ALL`].
type Row<'g> = [Expr<'g>; Parameter::COUNT];

/// For each link, for each parameter, the torques of all joints; 0 in columns that are not asked for.
pub(crate) fn regressor_columns<'g>(chain: &Chain<'g>, asked: Columns) -> Vec<Vec<Vec<Expr<'g>>>> {
    let n = chain.joint_count();
    let zero = chain.graph.constant(0.0);
    let mut blocks = Vec::new();
    let mut motion = Motion::of_base(chain);
    let mut twists: Vec<Twist<'g>> = Vec::new();
    let mut before: Vec<Row<'g>> = Vec::new();
    for i in 0..n {
        let step = Step::of(chain, i);
        let (qd, qdd) = (Input::Qd(i), Input::Qdd(i));
        let [qd, qdd] = [qd, qdd].map(|input| chain.graph.input(input));
        motion = step.motion(motion).moved_by(chain.rows[i].kind, qd, qdd);
        motion.named(i);
        for twist in &mut twists {
            *twist = step.twist(*twist);
        }
        name_twists(&twists, i);
        twists.push(Twist::unit(chain, chain.rows[i].kind));
        let wrenches = Wrenches::of(&motion);
        motion.name_lambda(i);
        let mut rows: Vec<Row<'g>> = twists.iter().map(|twist| wrenches.power(twist)).collect();
        for (row, before) in rows.iter_mut().zip(&before) {
            step.inherit(row, before);
        }
        rows.iter().enumerate().for_each(|(j, row)| name(row, j, i));
        let column = |parameter: Parameter| {
            let entry = |j: usize| match rows.get(j) {
                Some(row) if asked.contain(i, parameter) => row[parameter.index()],
                _ => zero,
            };
            (0..n).map(entry).collect()
        };
        blocks.push(Parameter::ALL.map(column).to_vec());
        before = rows;
    }
    blocks
}

/// Names the torques of joint j by the parameters of link i.
fn name(row: &Row<'_>, j: usize, i: usize) {
    for (x, parameter) in row.iter().zip(Parameter::ALL) {
        let parameter = parameter.name().to_lowercase();
        x.labelled("y", || format!("y_{}_{}_{parameter}", j + 1, i + 1));
    }
}

/// From the frame of a link to that of the next.
struct Step<'g> {
    /// From origin to origin, in the axes of the frame before.
    offset: Vec3<'g>,
    alpha: Turn<'g>,
    turn: Turn<'g>,
    /// What the offset is made of: along x, and along the joint's axis.
    a: Expr<'g>,
    d: Expr<'g>,
    inherits: bool,
}

impl<'g> Step<'g> {
    fn of(chain: &Chain<'g>, i: usize) -> Self {
        let (graph, row) = (chain.graph, &chain.rows[i]);
        let alpha = Turn::by_angle(graph, row.alpha);
        let zero = graph.constant(0.0);
        let d = match row.kind {
            JointKind::Revolute => graph.constant(row.d),
            JointKind::Prismatic => graph.constant(row.d) + graph.input(Input::Q(i)),
        };
        let a = graph.constant(row.a);
        let square = alpha.sin.is_zero() || alpha.cos.is_zero();
        Self {
            offset: Vec3([a, zero, zero]) + Vec3([zero, zero, d]).turn_x(alpha),
            alpha,
            turn: chain.own_turn(i),
            a,
            d,
            inherits: square && row.kind == JointKind::Revolute,
        }
    }

    /// A motion at the origin before, at the one after.
    fn motion(&self, motion: Motion<'g>) -> Motion<'g> {
        let acceleration = motion.acceleration + times(&motion.lambda(), self.offset);
        let motion = Motion {
            acceleration,
            ..motion
        };
        motion.map(|v| v.turn_x(self.alpha.inverse()).turn_z(self.turn.inverse()))
    }

    /// A twist at the origin before, at the one after: moved along x, turned about it, moved along z, turned about it.
    /// Moves along an axis take fewer operations than one move along both.
    fn twist(&self, Twist { linear, angular }: Twist<'g>) -> Twist<'g> {
        let (zero, back) = (self.a.of(0.0), self.alpha.inverse());
        let linear = (linear + angular.cross(Vec3([self.a, zero, zero]))).turn_x(back);
        let angular = angular.turn_x(back);
        let linear = linear + angular.cross(Vec3([zero, zero, self.d]));
        Twist { linear, angular }.map(|v| v.turn_z(self.turn.inverse()))
    }

    /// Entries of a row that follow from those of the link before. With u the joint's axis and p = a x + d u the offset, both as the link
    /// before sees them, a mass is there a mass at p; a first moment along u is one at p; and Ixx + Iyy an inertia 1 − uuᵀ.
    /// A mass at a p that is along neither costs more than the power of one force.
    fn inherit(&self, row: &mut Row<'g>, before: &Row<'g>) {
        if !self.inherits {
            return;
        }
        let at = |parameter: Parameter| before[parameter.index()];
        let (a, d) = (self.a, self.d);
        let (uy, uz) = (-self.alpha.sin, self.alpha.cos);
        let round =
            at(Parameter::Ixx) + uz * uz * at(Parameter::Iyy) + uy * uy * at(Parameter::Izz)
                - uy * uz * at(Parameter::Iyz);
        let along = uy * (at(Parameter::My) - a * at(Parameter::Ixy))
            + uz * (at(Parameter::Mz) - a * at(Parameter::Ixz));
        let moved = d * round;
        row[Parameter::Iyy.index()] = round - row[Parameter::Ixx.index()];
        row[Parameter::Mz.index()] = along + moved + moved;
        if a.is_zero() || d.is_zero() {
            row[Parameter::Mass.index()] = at(Parameter::Mass)
                + a * (at(Parameter::Mx) + a * (at(Parameter::Iyy) + at(Parameter::Izz)))
                + d * (along + moved);
        }
    }
}

/// The wrenches about a link's origin that its unit parameters need.
struct Wrenches<'g> {
    /// Of the mass: a force.
    acceleration: Vec3<'g>,
    /// Of the first moments: Λ's columns are the forces, the moments are e × a.
    lambda: [Vec3<'g>; 3],
    /// Of the inertia, in the order of [`Parameter::ALL`]: moments.
    moments: [Vec3<'g>; 6],
}

impl<'g> Wrenches<'g> {
    fn of(motion: &Motion<'g>) -> Self {
        let lambda @ [
            Vec3([lxx, lxy, lxz]),
            Vec3([lyx, lyy, lyz]),
            Vec3([lzx, lzy, lzz]),
        ] = motion.lambda();
        let ([x, y, z], [ax, ay, az]) = (motion.velocity.0, motion.angular_acceleration.0);
        let (xy, xz, yz) = (x * y, x * z, y * z);
        Self {
            acceleration: motion.acceleration,
            lambda,
            moments: [
                Vec3([ax, xz, -xy]),
                Vec3([-lzx, lzy, lxx - lyy]),
                Vec3([lyx, lzz - lxx, -lyz]),
                Vec3([-yz, ay, xy]),
                Vec3([lyy - lzz, -lxy, lxz]),
                Vec3([yz, -xz, az]),
            ],
        }
    }

    /// The power that each takes from a unit twist.
    fn power(&self, twist: &Twist<'g>) -> Row<'g> {
        let Twist { linear, angular } = *twist;
        let [x, y, z] = self.lambda;
        let [vx, vy, vz] = linear.0;
        let forces = x.scale(vx) + y.scale(vy) + z.scale(vz);
        let [mx, my, mz] = (forces + self.acceleration.cross(angular)).0;
        let [xx, xy, xz, yy, yz, zz] = self.moments.map(|moment| angular.dot(moment));
        let mass = linear.dot(self.acceleration);
        [mass, mx, my, mz, xx, xy, xz, yy, yz, zz]
    }
}
