//! Where the mass is: the first moment of all links, from the tip to the base.
//!
//! Of the base parameters, which leave the moment as it is if what has reached the base is counted too: masses beyond revolute joints
//! have all been counted there, so that a link adds two numbers and an offset nothing.

use super::chain::Chain;
use super::vector::Vec3;
use crate::graph::Expr;

/// `factor` Σ m_i p_i over the centroids p_i, from the base's origin, in base axes; its parts beyond the joints are called `family`.
fn first_moment<'g>(chain: &Chain<'g>, factor: Expr<'g>, family: &'static str) -> Vec3<'g> {
    let mut mass = chain.graph.constant(0.0);
    let mut moment = chain.zero();
    for group in chain.groups.iter().rev() {
        for i in group.joints.clone().rev() {
            let joint = &chain.joints[i];
            mass = mass + joint.body.mass * factor;
            let own = joint.body.moment.scale(factor);
            moment = moment + own.turn_z(joint.group_from_own);
            let [along, rest] = joint.legs;
            moment = moment + along.scale(mass);
            moment.named(family, &[i]);
            if i == group.joints.start {
                moment = group.to_parent_named(moment, family, &[i]);
            }
            moment = moment + rest.scale(mass);
        }
    }
    moment + chain.ground.moment.scale(factor)
}

fn total_mass<'g>(chain: &Chain<'g>) -> Expr<'g> {
    let masses = chain.joints.iter().map(|joint| joint.link.mass);
    masses.fold(chain.graph.constant(0.0), |sum, mass| sum + mass)
}

/// The centre of mass, in world axes from the world's origin.
pub(crate) fn center_of_mass<'g>(chain: &Chain<'g>) -> Vec3<'g> {
    let inverse = chain.graph.constant(1.0) / total_mass(chain);
    let from_base = first_moment(chain, inverse, "c");
    Vec3::constant(chain.graph, chain.base.translation) + from_base.rotate(chain.base.rotation)
}

/// −Σ m_i gᵀ p_i, p_i from the world's origin.
pub(crate) fn potential_energy<'g>(chain: &Chain<'g>) -> Expr<'g> {
    let minus = chain.graph.constant(-1.0);
    let from_base = chain.gravity.dot(first_moment(chain, minus, "mmc"));
    let base = Vec3::constant(chain.graph, chain.base.translation);
    let transposed = std::array::from_fn(|j| std::array::from_fn(|i| chain.base.rotation[i][j]));
    let height = chain.gravity.dot(base.rotate(transposed));
    from_base - height * total_mass(chain)
}
