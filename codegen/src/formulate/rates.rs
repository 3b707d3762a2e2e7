//! The tool while the joints move at constant rates: J̇, and the acceleration J̇ q̇.
//!
//! Both are built from the tool inward, of what an observer on each link sees of the tool: its place r, its velocity u and its
//! acceleration b. A joint adds to them in the plane across its axis alone. (Outward, every quantity of every link would be asked for
//! in full.)

use ulna::JointKind;

use super::chain::Chain;
use super::kinematics::{Twist, in_world};
use super::vector::Vec3;
use crate::graph::Expr;

/// z × v, in a group's axes.
fn across<'g>(chain: &Chain<'g>, v: Vec3<'g>) -> Vec3<'g> {
    chain.axis().cross(v)
}

/// J̇ by columns, in world axes; `switch` as in [`in_world`].
///
/// Of a revolute joint: d/dt (z × r) = ω × (z × r) + z × u, with ω the link's angular velocity, and ω × z.
pub(crate) fn jacobian_rate<'g>(
    chain: &Chain<'g>,
    qd: &[Expr<'g>],
    switch: usize,
) -> Vec<Twist<'g>> {
    let spins = angular_velocities(chain, qd);
    let mut rates = Vec::new();
    let mut place = Vec3::constant(chain.graph, chain.tool.translation);
    let mut velocity = chain.zero();
    for group in chain.groups.iter().rev() {
        for i in group.joints.clone().rev() {
            let joint = &chain.joints[i];
            let turned = spins[i].cross(chain.axis());
            place.named("r", &[i]);
            velocity.named("vt", &[i]);
            rates.push(match joint.kind {
                JointKind::Revolute => Twist {
                    linear: spins[i].cross(across(chain, place)) + across(chain, velocity),
                    angular: turned,
                },
                JointKind::Prismatic => Twist {
                    linear: turned,
                    angular: chain.zero(),
                },
            });
            velocity = velocity + moved(chain, i, place, qd[i]);
            if i == group.joints.start {
                place = group.to_parent_named(place, "r", &[i]);
                velocity = velocity.named("vj", &[i]);
                velocity = group.to_parent_named(velocity, "vj", &[i]);
            }
            place = place + joint.offset;
        }
    }
    rates.reverse();
    in_world(chain, &rates, switch, "jd")
}

/// J̇ q̇ in world axes.
pub(crate) fn bias_acceleration<'g>(chain: &Chain<'g>, qd: &[Expr<'g>]) -> Twist<'g> {
    let mut place = Vec3::constant(chain.graph, chain.tool.translation);
    let (mut velocity, mut spin) = (chain.zero(), chain.zero());
    let mut acceleration = Twist::none(chain);
    for group in chain.groups.iter().rev() {
        for i in group.joints.clone().rev() {
            let joint = &chain.joints[i];
            place.named("r", &[i]);
            velocity.named("vt", &[i]);
            spin.named("wt", &[i]);
            acceleration.linear.named("at", &[i]);
            acceleration.angular.named("alt", &[i]);
            let moved = moved(chain, i, place, qd[i]);
            if joint.kind == JointKind::Revolute {
                // q̇ z × (q̇ z × r) + 2 q̇ z × u.
                let both = across(chain, velocity + velocity + moved);
                acceleration.linear = acceleration.linear + both.scale(qd[i]);
                let turned = across(chain, spin).scale(qd[i]);
                acceleration.angular = acceleration.angular + turned;
                spin = spin + chain.axis().scale(qd[i]);
            }
            velocity = velocity + moved;
            if i == group.joints.start {
                let to_parent = |v: Vec3<'g>, family| {
                    group.to_parent_named(v.named(family, &[i]), family, &[i])
                };
                place = group.to_parent_named(place, "r", &[i]);
                velocity = to_parent(velocity, "vj");
                spin = to_parent(spin, "wj");
                acceleration.linear = to_parent(acceleration.linear, "aj");
                acceleration.angular = to_parent(acceleration.angular, "alj");
            }
            place = place + joint.offset;
        }
    }
    acceleration.map(|v| v.rotate(chain.base.rotation))
}

/// The velocity that a joint gives a point at `place`.
fn moved<'g>(chain: &Chain<'g>, joint: usize, place: Vec3<'g>, rate: Expr<'g>) -> Vec3<'g> {
    let velocity = match chain.joints[joint].kind {
        JointKind::Revolute => across(chain, place).scale(rate),
        JointKind::Prismatic => chain.axis().scale(rate),
    };
    velocity.labelled("given", |axis| format!("v{axis}_by_{}", joint + 1))
}

/// The links' angular velocities, base first, in the axes of their groups.
fn angular_velocities<'g>(chain: &Chain<'g>, qd: &[Expr<'g>]) -> Vec<Vec3<'g>> {
    let mut spin = chain.zero();
    let mut spins = Vec::new();
    for group in &chain.groups {
        let i = group.joints.start;
        spin = group.of_parent_named(spin, "omega", |axis| format!("w{axis}_{}", i + 1));
        for i in group.joints.clone() {
            if chain.joints[i].kind == JointKind::Revolute {
                spin = spin + chain.axis().scale(qd[i]);
            }
            spins.push(spin.labelled("omega", |axis| format!("w{axis}_{}", i + 1)));
        }
    }
    spins
}
