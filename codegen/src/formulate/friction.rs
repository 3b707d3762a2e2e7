//! Friction in the joints.

use ulna::Friction;

use super::chain::Chain;
use crate::graph::Expr;

/// The torque of each joint at the rates `qd`: `q̇ (viscous + coulomb / √(q̇² + smoothing²))`, a product fewer than a term each.
pub(crate) fn friction<'g>(chain: &Chain<'g>, qd: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let joints = chain.joints.iter().zip(qd);
    joints
        .map(|(joint, rate)| {
            let Friction {
                viscous,
                coulomb,
                smoothing,
            } = joint.friction;
            let constant = |value: f64| chain.graph.constant(value);
            let smoothing = constant(smoothing);
            let speed = (*rate * *rate + smoothing * smoothing).sqrt();
            *rate * (constant(viscous) + constant(coulomb) / speed)
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
