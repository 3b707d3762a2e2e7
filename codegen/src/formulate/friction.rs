//! Friction in the joints.

use ulna::Friction;

use super::chain::Chain;
use crate::graph::Expr;

/// What `of` makes of each joint's number, rate and friction.
fn of_each<'g>(
    chain: &Chain<'g>,
    qd: &[Expr<'g>],
    of: impl Fn(usize, Expr<'g>, Friction) -> Expr<'g>,
) -> Vec<Expr<'g>> {
    let joints = chain.joints.iter().zip(qd).enumerate();
    joints
        .map(|(i, (joint, rate))| of(i, *rate, joint.friction))
        .collect()
}

/// The torque of each joint at the rates `qd`: `q̇ (viscous + coulomb / √(q̇² + smoothing²))`, a product fewer than a term each.
pub(crate) fn friction<'g>(chain: &Chain<'g>, qd: &[Expr<'g>]) -> Vec<Expr<'g>> {
    of_each(chain, qd, |i, rate, friction| {
        let smoothing = rate.of(friction.smoothing);
        let speed = (rate * rate + smoothing * smoothing).sqrt();
        speed.named("speed", &[i]);
        let torque = rate * (rate.of(friction.viscous) + rate.of(friction.coulomb) / speed);
        torque.named("friction", &[i])
    })
}

/// Its slope by the joint's own rate: `viscous + coulomb ε² / (q̇² + ε²)^(3/2)`, ε the smoothing.
pub(crate) fn friction_slope<'g>(chain: &Chain<'g>, qd: &[Expr<'g>]) -> Vec<Expr<'g>> {
    of_each(chain, qd, |i, rate, friction| {
        let squared = rate.of(friction.smoothing) * rate.of(friction.smoothing);
        let speed_squared = (rate * rate + squared).named("speed2", &[i]);
        let speed = speed_squared.sqrt().named("speed", &[i]);
        let viscous = rate.of(friction.viscous);
        let coulomb = rate.of(friction.coulomb) * squared / (speed_squared * speed);
        (viscous + coulomb).named("slope", &[i])
    })
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
