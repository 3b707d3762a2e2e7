//! Kinetic energy, link by link from the base outward, of the base parameters: `½ q̇ᵀ M q̇` without M.

use ulna::JointKind;

use super::body::Body;
use super::chain::Chain;
use super::kinematics::Twist;
use super::vector::Vec3;
use crate::graph::Expr;

/// The kinetic energy at rates `qd`, of the links and the rotors.
pub(crate) fn kinetic_energy<'g>(chain: &Chain<'g>, qd: &[Expr<'g>]) -> Expr<'g> {
    let mut motion = Twist::none(chain);
    let mut energy = chain.graph.constant(0.0);
    for group in &chain.groups {
        for i in group.joints.clone() {
            let joint = &chain.joints[i];
            let [along, rest] = joint.legs;
            motion.linear = motion.linear + motion.angular.cross(rest);
            let before = |axis: &str| format!("v{axis}_{}_before", i + 1);
            motion.linear.labelled("velocity", before);
            if i == group.joints.start {
                let name = |what| move |axis: &str| format!("{what}{axis}_{}", i + 1);
                motion.linear = group.of_parent_named(motion.linear, "velocity", name("v"));
                motion.angular = group.of_parent_named(motion.angular, "omega", name("w"));
            }
            motion.linear = motion.linear + motion.angular.cross(along);
            let along = chain.axis().scale(qd[i]);
            match joint.kind {
                JointKind::Revolute => motion.angular = motion.angular + along,
                JointKind::Prismatic => motion.linear = motion.linear + along,
            }
            motion
                .linear
                .labelled("velocity", |axis| format!("v{axis}_{}", i + 1));
            motion
                .angular
                .labelled("omega", |axis| format!("w{axis}_{}", i + 1));
            let body = joint.body.turn_z(joint.group_from_own);
            body.labelled("own", &format!("_{}", i + 1));
            energy = (energy + energy_of(&body, &motion, i)).named("e_to", &[i]);
            energy = energy + half(joint.reflected) * (qd[i] * qd[i]);
        }
    }
    energy
}

/// ½ m v² + ω · (½ I ω + h × v) of link i, each product of two components of ω once.
fn energy_of<'g>(body: &Body<'g>, motion: &Twist<'g>, i: usize) -> Expr<'g> {
    let [x, y, z] = motion.angular.0;
    let [xx, yy, zz, xy, xz, yz] = body.inertia.0;
    let turned = Vec3([
        half(xx) * x + xy * y + xz * z,
        half(yy) * y + yz * z,
        half(zz) * z,
    ]);
    let angular = turned + body.moment.cross(motion.linear);
    angular.named("lh", &[i]);
    half(body.mass) * motion.linear.dot(motion.linear) + motion.angular.dot(angular)
}

fn half(x: Expr<'_>) -> Expr<'_> {
    x.of(0.5) * x
}
