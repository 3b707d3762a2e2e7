//! The mass matrix by composite rigid bodies (Featherstone, Rigid Body Dynamics Algorithms, section 6.2),
//! entry by entry, group by group.

use ulna::JointKind;

use super::body::Body;
use super::chain::Chain;
use super::vector::Vec3;
use crate::graph::Expr;

/// Momentum of the links beyond a joint when that joint alone moves at unit speed;
/// the angular part about the origin that is being passed.
struct Momentum<'g> {
    joint: usize,
    linear: Vec3<'g>,
    angular: Vec3<'g>,
}

/// M by rows; full and symmetric.
pub fn mass_matrix<'g>(chain: &Chain<'g>) -> Vec<Vec<Expr<'g>>> {
    let zero = chain.graph.constant(0.0);
    let mut matrix = vec![vec![zero; chain.joint_count()]; chain.joint_count()];
    let mut columns: Vec<Momentum<'g>> = Vec::new();
    let mut beyond: Option<Body<'g>> = None;
    for group in chain.groups.iter().rev() {
        for i in group.joints.clone().rev() {
            let joint = &chain.joints[i];
            let own = Body::constant(chain.graph, &joint.body).turn_z(joint.group_from_own);
            let mut composite = beyond.map_or(own, |body| own.join(body));
            columns.push(unit_momentum(joint.kind, i, &composite));
            for column in &columns {
                let entry = match joint.kind {
                    JointKind::Revolute => column.angular.0[2],
                    JointKind::Prismatic => column.linear.0[2],
                };
                matrix[i][column.joint] = entry;
                matrix[column.joint][i] = entry;
            }
            if i == group.joints.start {
                composite = composite.turn_z(group.turn).turn_x(group.alpha);
                for column in &mut columns {
                    column.linear = group.to_parent(column.linear);
                    column.angular = group.to_parent(column.angular);
                }
            }
            for column in &mut columns {
                column.angular = column.angular + joint.offset.cross(column.linear);
            }
            beyond = Some(composite.shift(joint.offset));
        }
    }
    matrix
}

fn unit_momentum<'g>(kind: JointKind, joint: usize, composite: &Body<'g>) -> Momentum<'g> {
    let zero = composite.mass.of(0.0);
    let [hx, hy, _] = composite.moment.0;
    let [_, _, zz, _, xz, yz] = composite.inertia.0;
    let (linear, angular) = match kind {
        JointKind::Revolute => ([-hy, hx, zero], [xz, yz, zz]),
        JointKind::Prismatic => ([zero, zero, composite.mass], [hy, -hx, zero]),
    };
    Momentum {
        joint,
        linear: Vec3(linear),
        angular: Vec3(angular),
    }
}
