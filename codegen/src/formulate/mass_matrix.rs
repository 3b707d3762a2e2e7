//! The mass matrix by composite rigid bodies (Featherstone, Rigid Body Dynamics Algorithms, section 6.2),
//! entry by entry, group by group.

use ulna::JointKind;

use super::body::Body;
use super::chain::{Chain, ChainJoint};
use super::vector::Vec3;
use crate::graph::Expr;

/// Momentum of the links beyond a joint when that joint alone moves at unit speed;
/// the angular part about the origin at hand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Momentum<'g> {
    /// Linear part.
    pub linear: Vec3<'g>,
    /// Angular part.
    pub angular: Vec3<'g>,
}

impl<'g> Momentum<'g> {
    /// About an origin from which its own lies at `r`.
    pub(super) fn shift(self, r: Vec3<'g>) -> Self {
        Self {
            linear: self.linear,
            angular: self.angular + r.cross(self.linear),
        }
    }

    /// What of it a joint along z feels.
    fn along(&self, kind: JointKind) -> Expr<'g> {
        match kind {
            JointKind::Revolute => self.angular.0[2],
            JointKind::Prismatic => self.linear.0[2],
        }
    }
}

/// What the inward sweep knows at a joint: about the joint's origin, in its group's axes.
#[derive(Clone, Debug)]
pub(crate) struct Station<'g> {
    /// All links beyond the joint as one body.
    pub composite: Body<'g>,
    /// Momenta of this joint and of all beyond it, this one first.
    pub momenta: Vec<Momentum<'g>>,
}

/// The inward sweep: a station for each joint, base first.
pub(crate) fn stations<'g>(chain: &Chain<'g>) -> Vec<Station<'g>> {
    let mut stations: Vec<Station<'g>> = Vec::new();
    let mut beyond: Option<(Body<'g>, Vec<Momentum<'g>>)> = None;
    for group in chain.groups.iter().rev() {
        for i in group.joints.clone().rev() {
            let joint = &chain.joints[i];
            let own = joint.body.turn_z(joint.group_from_own);
            let (composite, passed) = match beyond {
                Some((body, momenta)) => (own.join(body), momenta),
                None => (own, Vec::new()),
            };
            let mut momenta = vec![unit_momentum(joint.kind, &composite)];
            momenta.extend(passed);
            name(i, joint, &own, &composite, &momenta);
            stations.push(Station {
                composite,
                momenta: momenta.clone(),
            });
            let [along, rest] = joint.legs;
            let mut turned = composite.shift(along);
            for momentum in &mut momenta {
                *momentum = momentum.shift(along);
            }
            if i == group.joints.start {
                turned = turned
                    .turn_z(group.turn)
                    .labelled("turned", &format!("_from_{}_z", i + 1))
                    .turn_x(group.alpha)
                    .labelled("turned", &format!("_from_{}_zx", i + 1));
                for (j, momentum) in (i..).zip(&mut momenta) {
                    momentum.linear = group.to_parent_named(momentum.linear, "p", &[i, j]);
                    momentum.angular = group.to_parent_named(momentum.angular, "l", &[i, j]);
                }
            }
            for momentum in &mut momenta {
                *momentum = momentum.shift(rest);
            }
            beyond = Some((turned.shift(rest), momenta));
        }
    }
    stations.reverse();
    stations
}

/// Names what the sweep has at joint `i`; M's entries first, which are among the rest.
fn name(
    i: usize,
    joint: &ChainJoint<'_>,
    own: &Body<'_>,
    composite: &Body<'_>,
    momenta: &[Momentum<'_>],
) {
    for (j, momentum) in (i..).zip(momenta) {
        // A rotor adds to the diagonal.
        if j > i || joint.reflected.is_zero() {
            momentum.along(joint.kind).named("m", &[i, j]);
        }
    }
    composite.labelled("from", &format!("_from_{}", i + 1));
    own.labelled("own", &format!("_{}", i + 1));
    for (j, momentum) in (i..).zip(momenta) {
        momentum.linear.named("p", &[i, j]);
        momentum.angular.named("l", &[i, j]);
    }
}

/// M by rows; full and symmetric. Rotors behind rigid gears add to its diagonal.
pub fn mass_matrix<'g>(chain: &Chain<'g>) -> Vec<Vec<Expr<'g>>> {
    let zero = chain.graph.constant(0.0);
    let mut matrix = vec![vec![zero; chain.joint_count()]; chain.joint_count()];
    for (i, (joint, station)) in chain.joints.iter().zip(stations(chain)).enumerate() {
        for (j, momentum) in (i..).zip(&station.momenta) {
            let entry = momentum.along(joint.kind);
            let entry = if i == j {
                (entry + joint.reflected).named("m", &[i, i])
            } else {
                entry
            };
            matrix[i][j] = entry;
            matrix[j][i] = entry;
        }
    }
    matrix
}

fn unit_momentum<'g>(kind: JointKind, composite: &Body<'g>) -> Momentum<'g> {
    let zero = composite.mass.of(0.0);
    let [hx, hy, _] = composite.moment.0;
    let [_, _, zz, _, xz, yz] = composite.inertia.0;
    let (linear, angular) = match kind {
        JointKind::Revolute => ([-hy, hx, zero], [xz, yz, zz]),
        JointKind::Prismatic => ([zero, zero, composite.mass], [hy, -hx, zero]),
    };
    Momentum {
        linear: Vec3(linear),
        angular: Vec3(angular),
    }
}
