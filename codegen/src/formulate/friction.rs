//! Friction in the joints.

use ulna::Friction;

use super::chain::Chain;
use crate::graph::Expr;

/// The torque of each joint at the rates `qd`: `q̇ (viscous + coulomb / √(q̇² + smoothing²))`, a product fewer than a term each.
pub(crate) fn friction<'g>(chain: &Chain<'g>, qd: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let joints = chain.joints.iter().zip(qd);
    joints
        .enumerate()
        .map(|(i, (joint, rate))| {
            let Friction {
                viscous,
                coulomb,
                smoothing,
            } = joint.friction;
            let constant = |value: f64| chain.graph.constant(value);
            let smoothing = constant(smoothing);
            let speed = (*rate * *rate + smoothing * smoothing).sqrt();
            speed.named("speed", &[i]);
            let friction = *rate * (constant(viscous) + constant(coulomb) / speed);
            friction.named("friction", &[i])
        })
        .collect()
}

/// Its slope by the joint's own rate: `viscous + coulomb ε² / (q̇² + ε²)^(3/2)`, ε the smoothing.
pub(crate) fn friction_slope<'g>(chain: &Chain<'g>, qd: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let joints = chain.joints.iter().zip(qd);
    joints
        .enumerate()
        .map(|(i, (joint, rate))| {
            let Friction {
                viscous,
                coulomb,
                smoothing,
            } = joint.friction;
            let constant = |value: f64| chain.graph.constant(value);
            let squared = constant(smoothing) * constant(smoothing);
            let speed_squared = (*rate * *rate + squared).named("speed2", &[i]);
            let speed = speed_squared.sqrt().named("speed", &[i]);
            let slope = constant(viscous) + constant(coulomb) * squared / (speed_squared * speed);
            slope.named("slope", &[i])
        })
        .collect()
}

/// The sum of torques, joint by joint.
pub(crate) fn with_friction<'g>(
    chain: &Chain<'g>,
    qd: &[Expr<'g>],
    torques: Vec<Expr<'g>>,
) -> Vec<Expr<'g>> {
    let pairs = torques.into_iter().zip(friction(chain, qd));
    pairs.map(|(torque, friction)| torque + friction).collect()
}
