//! Inverse dynamics by Newton and Euler's recursion (Luh, Walker and Paul 1980; Craig, chapter 6), on the base
//! parameters, about the joints' origins, group by group.
//!
//! The motion of a link enters through `Λ = [α]× + [ω]×[ω]×`, which takes a fixed vector of the link to the
//! acceleration that its rotation gives it (Khalil and Kleinfinger 1987).

use ulna::JointKind;

use super::body::Body;
use super::chain::{Chain, Group};
use super::kinematics::express;
use super::vector::Vec3;
use crate::graph::{Expr, Input};

/// Motion of a link.
#[derive(Clone, Copy)]
pub(super) struct Motion<'g> {
    /// Angular velocity.
    pub(super) velocity: Vec3<'g>,
    pub(super) angular_acceleration: Vec3<'g>,
    /// Of the joint's origin, gravity taken off.
    pub(super) acceleration: Vec3<'g>,
}

/// What the link before exerts on a link at its joint, the moment about the joint's origin.
#[derive(Clone, Copy)]
pub(super) struct Wrench<'g> {
    pub(super) force: Vec3<'g>,
    pub(super) moment: Vec3<'g>,
}

impl<'g> Motion<'g> {
    /// Of the base: at rest, but for gravity.
    pub(super) fn of_base(chain: &Chain<'g>) -> Self {
        Self {
            velocity: chain.zero(),
            angular_acceleration: chain.zero(),
            acceleration: -chain.gravity,
        }
    }

    /// Of a link, if this is the motion at its joint's origin of the link before, in axes whose z is the joint's.
    pub(super) fn moved_by(self, kind: JointKind, qd: Expr<'g>, qdd: Expr<'g>) -> Self {
        let [wx, wy, wz] = self.velocity.0;
        let across = |rate: Expr<'g>| Vec3([wy * rate, -(wx * rate), qdd]);
        match kind {
            JointKind::Revolute => Self {
                angular_acceleration: self.angular_acceleration + across(qd),
                velocity: Vec3([wx, wy, wz + qd]),
                ..self
            },
            JointKind::Prismatic => Self {
                acceleration: self.acceleration + across(qd.of(2.0) * qd),
                ..self
            },
        }
    }

    /// The same to all of it.
    pub(super) fn map(self, f: impl Fn(Vec3<'g>) -> Vec3<'g>) -> Self {
        Self {
            velocity: f(self.velocity),
            angular_acceleration: f(self.angular_acceleration),
            acceleration: f(self.acceleration),
        }
    }

    /// Names the motion of link i.
    pub(super) fn named(&self, i: usize) {
        self.velocity
            .labelled("omega", |axis| format!("w{axis}_{}", i + 1));
        self.angular_acceleration.named("al", &[i]);
        self.acceleration.named("a", &[i]);
    }

    /// Names what of this motion of the link before `i` has been turned halfway into the axes of `i`.
    fn name_turned(&self, group: &Group<'g>, i: usize) {
        let Self {
            velocity,
            angular_acceleration,
            acceleration,
        } = self.map(|v| v.turn_x(group.alpha.inverse()));
        acceleration.labelled("a", |axis| format!("a{axis}_{}_before_x", i + 1));
        velocity.labelled("omega", |axis| format!("w{axis}_{}_before_x", i + 1));
        angular_acceleration.labelled("al", |axis| format!("al{axis}_{}_before_x", i + 1));
    }

    /// Names Λ of link i and the products in it, which must be there by now: naming them must not be what makes them.
    pub(super) fn name_lambda(&self, i: usize) {
        let axes = ["x", "y", "z"];
        for (j, row) in axes.into_iter().enumerate() {
            for (k, column) in axes.into_iter().enumerate().skip(j) {
                let product = self.velocity.0[j] * self.velocity.0[k];
                product.labelled("ww", || format!("ww_{row}{column}_{}", i + 1));
            }
        }
        for (row, axis) in self.lambda().iter().zip(axes) {
            row.labelled("lam", |other| format!("lam_{axis}{other}_{}", i + 1));
        }
    }

    /// Λ, by rows.
    pub(super) fn lambda(&self) -> [Vec3<'g>; 3] {
        let ([x, y, z], [ax, ay, az]) = (self.velocity.0, self.angular_acceleration.0);
        let (xx, yy, zz, xy, xz, yz) = (x * x, y * y, z * z, x * y, x * z, y * z);
        [
            Vec3([-(yy + zz), xy - az, xz + ay]),
            Vec3([xy + az, -(xx + zz), yz - ax]),
            Vec3([xz - ay, yz + ax, -(xx + yy)]),
        ]
    }
}

pub(super) fn times<'g>(rows: &[Vec3<'g>; 3], v: Vec3<'g>) -> Vec3<'g> {
    Vec3(rows.map(|row| row.dot(v)))
}

/// τ for velocities `qd` and accelerations `qdd`, without friction; zeros fold, so that gravity alone or bias alone costs what it needs.
pub(crate) fn inverse_dynamics<'g>(
    chain: &Chain<'g>,
    qd: &[Expr<'g>],
    qdd: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    inverse_dynamics_with_load(chain, qd, qdd, unloaded(chain))
}

/// Nothing.
pub(super) fn unloaded<'g>(chain: &Chain<'g>) -> Wrench<'g> {
    Wrench {
        force: chain.zero(),
        moment: chain.zero(),
    }
}

/// The same where the last link also bears `load`, about its joint's origin, in its group's axes.
pub(super) fn inverse_dynamics_with_load<'g>(
    chain: &Chain<'g>,
    qd: &[Expr<'g>],
    qdd: &[Expr<'g>],
    load: Wrench<'g>,
) -> Vec<Expr<'g>> {
    let wrenches = inward(chain, &outward(chain, qd, qdd), load);
    let joints = chain.joints.iter().zip(wrenches).zip(qdd);
    joints
        .map(|((joint, wrench), qdd)| {
            let along = match joint.kind {
                JointKind::Revolute => wrench.moment.0[2],
                JointKind::Prismatic => wrench.force.0[2],
            };
            along + joint.reflected * *qdd
        })
        .collect()
}

/// What the motions of all links beyond a joint take there, base first, each in its group's axes; the last link also bears `load`.
pub(super) fn inward<'g>(
    chain: &Chain<'g>,
    motions: &[Motion<'g>],
    load: Wrench<'g>,
) -> Vec<Wrench<'g>> {
    let Wrench {
        mut force,
        mut moment,
    } = load;
    let mut wrenches = Vec::new();
    for group in chain.groups.iter().rev() {
        for i in group.joints.clone().rev() {
            let joint = &chain.joints[i];
            let body = joint.body.turn_z(joint.group_from_own);
            body.labelled("own", &format!("_{}", i + 1));
            let own = wrench(&body, &motions[i]);
            own.force
                .labelled("own_wrench", |axis| format!("f{axis}_own_{}", i + 1));
            own.moment
                .labelled("own_wrench", |axis| format!("n{axis}_own_{}", i + 1));
            motions[i].name_lambda(i);
            force = force + own.force;
            moment = moment + own.moment;
            // What the joint itself feels is for the caller to name.
            let ([fx, fy, fz], [nx, ny, nz]) = (force.0, moment.0);
            let zero = chain.graph.constant(0.0);
            let (f, n) = match joint.kind {
                JointKind::Revolute => ([fx, fy, fz], [nx, ny, zero]),
                JointKind::Prismatic => ([fx, fy, zero], [nx, ny, nz]),
            };
            Vec3(f).named("f", &[i]);
            Vec3(n).named("n", &[i]);
            wrenches.push(Wrench { force, moment });
            let [along, rest] = joint.legs;
            moment = moment + along.cross(force);
            if i == group.joints.start {
                force = group.to_parent_named(force, "f", &[i]);
                moment = group.to_parent_named(moment, "n", &[i]);
            }
            moment = moment + rest.cross(force);
        }
    }
    wrenches.reverse();
    wrenches
}

/// What the last link bears because the argument `wrench` acts on the tool: about the last joint's origin, in its group's axes.
pub(super) fn load_of_wrench<'g>(chain: &Chain<'g>) -> Wrench<'g> {
    let [fx, fy, fz, nx, ny, nz] = std::array::from_fn(|i| -chain.graph.input(Input::Wrench(i)));
    let groups = chain.groups.len();
    let in_last = |v: Vec3<'g>| express(chain, chain.of_world(v), 0, groups);
    let (force, moment) = (in_last(Vec3([fx, fy, fz])), in_last(Vec3([nx, ny, nz])));
    let to_tool = Vec3::constant(chain.graph, chain.tool.translation);
    Wrench {
        force,
        moment: moment + to_tool.cross(force),
    }
}

/// The links' motions, base first, each in its group's axes.
pub(super) fn outward<'g>(chain: &Chain<'g>, qd: &[Expr<'g>], qdd: &[Expr<'g>]) -> Vec<Motion<'g>> {
    let mut motion = Motion::of_base(chain);
    let mut motions = Vec::new();
    for group in &chain.groups {
        for i in group.joints.clone() {
            let joint = &chain.joints[i];
            let [along, rest] = joint.legs;
            motion.acceleration = motion.acceleration + times(&motion.lambda(), rest);
            motion
                .acceleration
                .labelled("a", |axis| format!("a{axis}_{}_before", i + 1));
            if i == group.joints.start {
                let before = motion;
                motion = motion.map(|v| group.of_parent(v));
                before.name_turned(group, i);
            }
            motion = motion.moved_by(joint.kind, qd[i], qdd[i]);
            // Points of the axis move with both links alike; this one's products are asked for anyway.
            motion.acceleration = motion.acceleration + times(&motion.lambda(), along);
            motion.named(i);
            motions.push(motion);
        }
    }
    motions
}

/// Force and moment about the origin that a body's motion takes:
/// f = m a + Λ h, n = I α + ω × I ω + h × a; the middle terms of n written with the products that Λ has already.
fn wrench<'g>(body: &Body<'g>, motion: &Motion<'g>) -> Wrench<'g> {
    let lambda @ [
        Vec3([lxx, lxy, lxz]),
        Vec3([lyx, lyy, lyz]),
        Vec3([lzx, lzy, lzz]),
    ] = motion.lambda();
    let ([x, y, z], [ax, ay, az]) = (motion.velocity.0, motion.angular_acceleration.0);
    let [ixx, iyy, izz, ixy, ixz, iyz] = body.inertia.0;
    let spin = Vec3([
        ixx * ax + (izz - iyy) * (y * z) - ixy * lzx + ixz * lyx + iyz * (lyy - lzz),
        iyy * ay + (ixx - izz) * (x * z) - iyz * lxy + ixy * lzy + ixz * (lzz - lxx),
        izz * az + (iyy - ixx) * (x * y) - ixz * lyz + iyz * lxz + ixy * (lxx - lyy),
    ]);
    let force = motion.acceleration.scale(body.mass) + times(&lambda, body.moment);
    Wrench {
        force,
        moment: spin + body.moment.cross(motion.acceleration),
    }
}
