//! M's factors U and D straight from articulated bodies (Featherstone, Rigid Body Dynamics Algorithms, section 7.2;
//! Rodriguez, Jain and Kreutz-Delgado 1991), without M.
//!
//! Where a light link carries a heavy one, its share in M drowns in the rounding of what it carries, and the pivots of M with it.
//! The inertia that a joint feels when all beyond it are free is, with its rotor's, the pivot itself: what the next joint takes off vanishes
//! along its axis exactly, but for what that joint's rotor holds, and the light link's share is added to what is left. For more operations than factoring M takes. The links' constants are those of the
//! table: regrouped ones count with a light link what a heavy one brings in.

use ulna::JointKind;

use super::body::Body;
use super::chain::Chain;
use super::factorization::Factors;
use super::vector::{Sym3, Turn, Vec3};
use crate::graph::Expr;

/// What a body of free joints opposes to being moved at its origin: force `A v + C ω`, moment `Cᵀ v + I ω`.
#[derive(Clone, Copy)]
struct Articulated<'g> {
    linear: Sym3<'g>,
    /// C by columns.
    mixed: [Vec3<'g>; 3],
    angular: Sym3<'g>,
}

/// A wrench about the origin at hand.
#[derive(Clone, Copy)]
struct Wrench<'g> {
    force: Vec3<'g>,
    moment: Vec3<'g>,
}

impl<'g> Articulated<'g> {
    fn of_body(body: &Body<'g>) -> Self {
        let zero = body.mass.of(0.0);
        let [x, y, z] = body.moment.0;
        Self {
            linear: Sym3([body.mass, body.mass, body.mass, zero, zero, zero]),
            mixed: [
                Vec3([zero, -z, y]),
                Vec3([z, zero, -x]),
                Vec3([-y, x, zero]),
            ],
            angular: body.inertia,
        }
    }

    /// Names the inertia that joint `i` feels.
    fn named(&self, i: usize) {
        let i = i + 1;
        self.linear
            .labelled("articulated", |axes| format!("aa{axes}_{i}"));
        for (column, axis) in self.mixed.iter().zip(["x", "y", "z"]) {
            column.labelled("articulated", |row| format!("ac{row}{axis}_{i}"));
        }
        self.angular
            .labelled("articulated", |axes| format!("ai{axes}_{i}"));
    }

    fn join(self, other: Self) -> Self {
        let [a, b, c] = self.mixed;
        let [x, y, z] = other.mixed;
        Self {
            linear: self.linear + other.linear,
            mixed: [a + x, b + y, c + z],
            angular: self.angular + other.angular,
        }
    }

    /// Turned about z, then about x: R X Rᵀ as it stands. ([`Sym3::turn_z`] takes differences, and what vanishes along an axis
    /// would not be exactly what is left beside it.)
    fn turn(self, z: Turn<'g>, x: Turn<'g>) -> Self {
        let turn = |v: Vec3<'g>| v.turn_z(z).turn_x(x);
        let both_sides =
            |columns: [Vec3<'g>; 3]| transposed(transposed(columns.map(turn)).map(turn));
        let symmetric = |tensor: Sym3<'g>| {
            let [xx, yy, zz, xy, xz, yz] = tensor.0;
            let columns = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(Vec3);
            let [a, b, c] = both_sides(columns).map(|column| column.0);
            Sym3([a[0], b[1], c[2], b[0], c[0], c[1]])
        };
        Self {
            linear: symmetric(self.linear),
            mixed: both_sides(self.mixed),
            angular: symmetric(self.angular),
        }
    }

    /// About an origin from which its own lies at `r`.
    fn shift(self, r: Vec3<'g>) -> Self {
        let zero = r.0[0].of(0.0);
        let one = zero.of(1.0);
        let axes = [
            Vec3([one, zero, zero]),
            Vec3([zero, one, zero]),
            Vec3([zero, zero, one]),
        ];
        // Column j of C − A [r]×.
        let mixed = [0, 1, 2].map(|j| self.mixed[j] - self.linear.times(r.cross(axes[j])));
        let (before, after) = (self.mixed.map(|c| r.cross(c)), mixed.map(|c| r.cross(c)));
        let entry = |i: usize, j: usize| before[i].0[j] + after[j].0[i];
        Self {
            linear: self.linear,
            mixed,
            angular: self.angular
                + Sym3([
                    entry(0, 0),
                    entry(1, 1),
                    entry(2, 2),
                    entry(0, 1),
                    entry(0, 2),
                    entry(1, 2),
                ]),
        }
    }

    /// The wrench that a joint along z alone needs at unit acceleration.
    fn column(&self, kind: JointKind) -> Wrench<'g> {
        let [_, _, azz, _, axz, ayz] = self.linear.0;
        let [_, _, izz, _, ixz, iyz] = self.angular.0;
        match kind {
            JointKind::Revolute => Wrench {
                force: self.mixed[2],
                moment: Vec3([ixz, iyz, izz]),
            },
            JointKind::Prismatic => Wrench {
                force: Vec3([axz, ayz, azz]),
                moment: Vec3(self.mixed.map(|column| column.0[2])),
            },
        }
    }

    /// What is left when the joint is free. Along it that is `share` of what there was, exactly: nothing where the joint has no rotor,
    /// for x − x x / x = 0; and with a rotor of inertia r, x − x y / (x + r) = y r / (x + r), without a difference.
    fn freed(
        self,
        kind: JointKind,
        column: &Wrench<'g>,
        unit: &Wrench<'g>,
        share: Expr<'g>,
    ) -> Self {
        let (f, n) = (column.force.0, column.moment.0);
        let (g, m) = (unit.force.0, unit.moment.0);
        let [axx, ayy, azz, axy, axz, ayz] = self.linear.0;
        let [ixx, iyy, izz, ixy, ixz, iyz] = self.angular.0;
        let (revolute, sliding) = (kind == JointKind::Revolute, kind == JointKind::Prismatic);
        // Each what there was, and what the joint takes off unless it lies along the joint.
        let left = |along: bool, was: Expr<'g>, off: Expr<'g>| {
            if along { was * share } else { was - off }
        };
        let column_of = |j: usize| {
            Vec3([0, 1, 2].map(|i| {
                let along = (revolute && j == 2) || (sliding && i == 2);
                left(along, self.mixed[j].0[i], f[i] * m[j])
            }))
        };
        Self {
            linear: Sym3([
                axx - f[0] * g[0],
                ayy - f[1] * g[1],
                left(sliding, azz, f[2] * g[2]),
                axy - f[0] * g[1],
                left(sliding, axz, f[0] * g[2]),
                left(sliding, ayz, f[1] * g[2]),
            ]),
            mixed: [0, 1, 2].map(column_of),
            angular: Sym3([
                ixx - n[0] * m[0],
                iyy - n[1] * m[1],
                left(revolute, izz, n[2] * m[2]),
                ixy - n[0] * m[1],
                left(revolute, ixz, n[0] * m[2]),
                left(revolute, iyz, n[1] * m[2]),
            ]),
        }
    }
}

fn transposed<'g>(columns: [Vec3<'g>; 3]) -> [Vec3<'g>; 3] {
    [0, 1, 2].map(|i| Vec3(columns.map(|column| column.0[i])))
}

/// The factors of M, from the tip to the base.
pub(crate) fn factors<'g>(chain: &Chain<'g>) -> Factors<'g> {
    let joints = chain.joint_count();
    let zero = chain.graph.constant(0.0);
    let one = chain.graph.constant(1.0);
    let mut upper = vec![vec![zero; joints]; joints];
    let (mut pivots, mut inverse_pivots) = (vec![one; joints], vec![one; joints]);
    let mut beyond: Option<Articulated<'g>> = None;
    // Of each joint beyond, the wrench of its column over its pivot.
    let mut wrenches: Vec<Wrench<'g>> = Vec::new();
    for group in chain.groups.iter().rev() {
        for i in group.joints.clone().rev() {
            let joint = &chain.joints[i];
            let own = Articulated::of_body(&joint.link.turn_z(joint.group_from_own));
            let all = match beyond {
                Some(body) => own.join(body),
                None => own,
            };
            for (k, wrench) in (i + 1..).zip(&wrenches) {
                upper[i][k] = along(joint.kind, wrench).named("u", &[i, k]);
            }
            let column = all.column(joint.kind);
            let pivot = (along(joint.kind, &column) + joint.reflected).named("d", &[i]);
            let inverse = (one / pivot).named("d_inv", &[i]);
            all.named(i);
            let unit = Wrench {
                force: column.force.scale(inverse),
                moment: column.moment.scale(inverse),
            };
            (pivots[i], inverse_pivots[i]) = (pivot, inverse);
            wrenches.insert(0, unit);
            let mut freed = all.freed(joint.kind, &column, &unit, joint.reflected * inverse);
            if i == group.joints.start {
                freed = freed.turn(group.turn, group.alpha);
                for wrench in &mut wrenches {
                    wrench.force = group.to_parent(wrench.force);
                    wrench.moment = group.to_parent(wrench.moment);
                }
            }
            for wrench in &mut wrenches {
                wrench.moment = wrench.moment + joint.offset.cross(wrench.force);
            }
            beyond = Some(freed.shift(joint.offset));
        }
    }
    Factors {
        upper,
        pivots,
        inverse_pivots,
    }
}

/// What of a wrench a joint along z feels.
fn along<'g>(kind: JointKind, wrench: &Wrench<'g>) -> Expr<'g> {
    match kind {
        JointKind::Revolute => wrench.moment.0[2],
        JointKind::Prismatic => wrench.force.0[2],
    }
}
