//! ∂M/∂q_i in closed form: fewer operations than differentiating M's formulas needs, less than half with many joints.
//!
//! With s_k the unit twist of joint k, and F_j the momentum of all links beyond joint j at unit speed of it,
//! M_kj = s_k · F_j for k ≤ j. Joint i moves what is beyond it as one body, and leaves the rest:
//!
//! - k < i ≤ j: F_j turns with joint i, s_k does not: ∂M_kj/∂q_i = (s_k × s_i) · F_j;
//! - k ≤ j < i: of F_j, the part of the links beyond joint i turns: ∂M_kj/∂q_i = s_k · Ẋ_i s_j, where Ẋ_i is
//!   the rate of change of their composite inertia at unit speed of joint i;
//! - i ≤ k: nothing changes.
//!
//! (Garofalo, Ott and Albu-Schäffer 2013 have the derivatives of M in this form.) All is taken at joint i,
//! where s_i is a unit vector along z and the products with it are exchanges of components.

use ulna::JointKind;

use super::body::Body;
use super::chain::Chain;
use super::kinematics::Twist;
use super::mass_matrix::{Momentum, stations};
use super::vector::{Sym3, Vec3};
use crate::graph::Expr;

/// ∂M/∂q_i for each i, by rows.
pub(crate) fn mass_matrix_derivatives<'g>(chain: &Chain<'g>) -> Vec<Vec<Vec<Expr<'g>>>> {
    let n = chain.joint_count();
    let zero = chain.graph.constant(0.0);
    let mut derivatives = vec![vec![vec![zero; n]; n]; n];
    let twists = twists_at_joints(chain);
    for (i, station) in stations(chain).iter().enumerate() {
        let mut set = |k: usize, j: usize, value: Expr<'g>| {
            value.named("dm", &[i, k, j]);
            derivatives[i][k][j] = value;
            derivatives[i][j][k] = value;
        };
        let kind = chain.joints[i].kind;
        for (k, twist) in twists[i].iter().enumerate() {
            for (j, momentum) in (i..).zip(&station.momenta) {
                set(k, j, turned_product(kind, twist, momentum));
            }
        }
        let rate = rate_of_change(kind, &station.composite);
        rate.labelled("rate", &format!("_rate_{}", i + 1));
        for (j, twist) in twists[i].iter().enumerate() {
            let change = momentum_of(&rate, twist);
            change.linear.named("dp", &[i, j]);
            change.angular.named("dl", &[i, j]);
            for (k, other) in twists[i][..=j].iter().enumerate() {
                let linear = other.linear.dot(change.linear);
                set(k, j, linear + other.angular.dot(change.angular));
            }
        }
    }
    derivatives
}

/// For each joint, the unit twists of the joints before it: at its origin, in its group's axes.
pub(super) fn twists_at_joints<'g>(chain: &Chain<'g>) -> Vec<Vec<Twist<'g>>> {
    let mut all = Vec::new();
    let mut twists: Vec<Twist<'g>> = Vec::new();
    for group in &chain.groups {
        for i in group.joints.clone() {
            let joint = &chain.joints[i];
            for (k, twist) in twists.iter_mut().enumerate() {
                let [along, rest] = joint.legs;
                twist.linear = twist.linear + twist.angular.cross(rest);
                if i == group.joints.start {
                    let place = |what: &'static str| {
                        move |axis: &str| format!("{what}{axis}_{}_at_{}", k + 1, i + 1)
                    };
                    twist
                        .linear
                        .labelled("twist", |axis| place("v")(axis) + "_before");
                    twist.linear = group.of_parent_named(twist.linear, "twist", place("v"));
                    twist.angular = group.of_parent_named(twist.angular, "twist", place("w"));
                }
                twist.linear = twist.linear + twist.angular.cross(along);
            }
            name_twists(&twists, i);
            all.push(twists.clone());
            twists.push(Twist::unit(chain, joint.kind));
        }
    }
    all
}

/// Names the unit twists of the joints from the first on as joint `i` has them.
pub(super) fn name_twists(twists: &[Twist<'_>], i: usize) {
    for (k, twist) in twists.iter().enumerate() {
        let place =
            |what: &'static str| move |axis: &str| format!("{what}{axis}_{}_at_{}", k + 1, i + 1);
        twist.linear.labelled("twist", place("v"));
        twist.angular.labelled("twist", place("w"));
    }
}

/// (s × s_i) · F, where s_i is the unit twist of a joint of this kind along z.
fn turned_product<'g>(kind: JointKind, s: &Twist<'g>, momentum: &Momentum<'g>) -> Expr<'g> {
    let across = |a: Vec3<'g>, b: Vec3<'g>| a.0[1] * b.0[0] - a.0[0] * b.0[1];
    match kind {
        JointKind::Revolute => {
            across(s.angular, momentum.angular) + across(s.linear, momentum.linear)
        }
        JointKind::Prismatic => across(s.angular, momentum.linear),
    }
}

/// How a body's parameters change when it moves at unit speed about, or along, the z axis.
fn rate_of_change<'g>(kind: JointKind, body: &Body<'g>) -> Body<'g> {
    let zero = body.mass.of(0.0);
    let [hx, hy, hz] = body.moment.0;
    let [xx, yy, _, xy, xz, yz] = body.inertia.0;
    let twice = |x: Expr<'g>| x.of(2.0) * x;
    let (moment, inertia) = match kind {
        JointKind::Revolute => (
            [-hy, hx, zero],
            [-twice(xy), twice(xy), zero, xx - yy, -yz, xz],
        ),
        JointKind::Prismatic => (
            [zero, zero, body.mass],
            [twice(hz), twice(hz), zero, zero, -hx, -hy],
        ),
    };
    Body {
        mass: zero,
        moment: Vec3(moment),
        inertia: Sym3(inertia),
    }
}

/// Momentum of a body that moves with a twist.
pub(super) fn momentum_of<'g>(body: &Body<'g>, twist: &Twist<'g>) -> Momentum<'g> {
    Momentum {
        linear: twist.linear.scale(body.mass) + twist.angular.cross(body.moment),
        angular: body.inertia.times(twist.angular) + body.moment.cross(twist.linear),
    }
}
