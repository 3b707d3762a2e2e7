//! Pose of the tool, geometric Jacobian and its derivatives.

use ulna::{JointKind, TaskRow};

use super::chain::Chain;
use super::vector::Vec3;
use crate::graph::Expr;
use crate::label::subscripts;

/// Velocity of the tool point when one joint alone moves at unit speed.
#[derive(Clone, Copy, Debug)]
pub struct Twist<'g> {
    /// Linear part.
    pub linear: Vec3<'g>,
    /// Angular part.
    pub angular: Vec3<'g>,
}

impl<'g> Twist<'g> {
    /// Of a joint at unit speed, at its own origin, in axes whose z is its axis.
    pub fn unit(chain: &Chain<'g>, kind: JointKind) -> Self {
        Self::about(chain, kind, chain.axis())
    }

    /// The same in axes where its axis is `axis`.
    pub(super) fn about(chain: &Chain<'g>, kind: JointKind, axis: Vec3<'g>) -> Self {
        let (linear, angular) = match kind {
            JointKind::Revolute => (chain.zero(), axis),
            JointKind::Prismatic => (axis, chain.zero()),
        };
        Self { linear, angular }
    }

    /// No motion.
    pub(super) fn none(chain: &Chain<'g>) -> Self {
        Self {
            linear: chain.zero(),
            angular: chain.zero(),
        }
    }

    /// The same to both parts.
    pub fn map(self, f: impl Fn(Vec3<'g>) -> Vec3<'g>) -> Self {
        Self {
            linear: f(self.linear),
            angular: f(self.angular),
        }
    }

    /// The same twist, of joint `joint`, its components called after J's rows, x to rz: `j_rx_2` for `j`.
    pub fn named(self, family: &'static str, joint: usize) -> Self {
        for (x, row) in self.components().into_iter().zip(TaskRow::ALL) {
            x.labelled(family, || format!("{family}_{}_{}", row.name(), joint + 1));
        }
        self
    }

    /// The six components, linear first.
    pub fn components(self) -> [Expr<'g>; 6] {
        let ([vx, vy, vz], [wx, wy, wz]) = (self.linear.0, self.angular.0);
        [vx, vy, vz, wx, wy, wz]
    }
}

/// A frame's axes: the columns of its rotation matrix.
pub(crate) type Axes<'g> = [Vec3<'g>; 3];

fn combine<'g>(axes: &Axes<'g>, v: Vec3<'g>) -> Vec3<'g> {
    let [x, y, z] = v.0;
    axes[0].scale(x) + axes[1].scale(y) + axes[2].scale(z)
}

/// From each joint's origin to the tool point, in the axes of the joint's group;
/// and from the base's origin, in base axes.
fn vectors_to_tool<'g>(chain: &Chain<'g>) -> (Vec<Vec3<'g>>, Vec3<'g>) {
    let mut vectors = vec![chain.zero(); chain.joint_count()];
    let mut to_tool = Vec3::constant(chain.graph, chain.tool.translation);
    for group in chain.groups.iter().rev() {
        for i in group.joints.clone().rev() {
            vectors[i] = to_tool.named("r", &[i]);
            if i == group.joints.start {
                to_tool = group.to_parent_named(to_tool, "r", &[i]);
            }
            to_tool = to_tool + chain.joints[i].offset;
        }
    }
    (vectors, to_tool)
}

/// Each joint's twist, in the axes of its own group.
fn own_twists<'g>(chain: &Chain<'g>) -> Vec<Twist<'g>> {
    let (vectors, _) = vectors_to_tool(chain);
    let axis = chain.axis();
    let pairs = chain.joints.iter().zip(vectors);
    pairs
        .map(|(joint, to_tool)| match joint.kind {
            JointKind::Revolute => Twist {
                linear: axis.cross(to_tool),
                angular: axis,
            },
            JointKind::Prismatic => Twist {
                linear: axis,
                angular: chain.zero(),
            },
        })
        .collect()
}

/// A vector of the axes of group `from`, in the axes of group `to`; 0 stands for the base, 1 for the first group.
pub(super) fn express<'g>(chain: &Chain<'g>, v: Vec3<'g>, from: usize, to: usize) -> Vec3<'g> {
    let (down, up) = (to.min(from)..from, from.min(to)..to);
    let lowered = down.rev().fold(v, |v, g| chain.groups[g].to_parent(v));
    up.fold(lowered, |v, g| chain.groups[g].of_parent(v))
}

/// J by columns, in the axes of one group (0: base). A task of whole triplets has the same w_D in all axes.
pub fn jacobian_in_group<'g>(chain: &Chain<'g>, group: usize) -> Vec<Twist<'g>> {
    let columns = own_twists(chain).into_iter().enumerate();
    columns
        .map(|(i, twist)| {
            let own = chain.group_of(i) + 1;
            twist.map(|v| express(chain, v, own, group)).named("jt", i)
        })
        .collect()
}

/// World axes of the base and of every group, by forward recursion, up to group `last`.
pub(super) fn world_axes<'g>(chain: &Chain<'g>, last: usize) -> Vec<Axes<'g>> {
    let unit = |j| {
        let base = chain.base.rotation;
        Vec3::constant(chain.graph, std::array::from_fn(|i| base[i][j]))
    };
    let mut all = vec![[unit(0), unit(1), unit(2)]];
    for group in &chain.groups[..last] {
        let before = all[all.len() - 1];
        let unit = |j: usize| {
            let mut e = [0.0; 3];
            e[j] = 1.0;
            group.to_parent(Vec3::constant(chain.graph, e))
        };
        // R Rx(alpha) first: one product of constants, then the turn about z mixes two columns.
        let twisted = [
            before[0],
            combine(
                &before,
                Vec3::constant(chain.graph, [0.0, 1.0, 0.0]).turn_x(group.alpha),
            ),
            combine(&before, unit(2)),
        ];
        let number = all.len();
        name_axes(&twisted, &format!("r{number}x"));
        let (s, c) = (group.turn.sin, group.turn.cos);
        let axes = [
            twisted[0].scale(c) + twisted[1].scale(s),
            twisted[1].scale(c) - twisted[0].scale(s),
            twisted[2],
        ];
        name_axes(&axes, &format!("r{number}"));
        all.push(axes);
    }
    all
}

/// Names the entries of a rotation, row first.
fn name_axes(axes: &Axes<'_>, name: &str) {
    for (j, axis) in axes.iter().enumerate() {
        for (i, x) in axis.0.iter().enumerate() {
            x.labelled("axes", || format!("{name}{}", subscripts(&[i, j])));
        }
    }
}

/// J by columns, in world axes; `switch` as for any twists, below.
pub fn jacobian_in_world<'g>(chain: &Chain<'g>, switch: usize) -> Vec<Twist<'g>> {
    in_world(chain, &own_twists(chain), switch, "j")
}

/// A twist of each joint, in the axes of its group, in world axes. Those beyond group `switch` are turned down to it group by group;
/// from there, or from their own group, the group's world axes take them to the world, where they are called `family`.
pub(super) fn in_world<'g>(
    chain: &Chain<'g>,
    twists: &[Twist<'g>],
    switch: usize,
    family: &'static str,
) -> Vec<Twist<'g>> {
    let axes = world_axes(chain, switch);
    let columns = twists.iter().enumerate();
    columns
        .map(|(i, twist)| {
            let own = chain.group_of(i) + 1;
            let at = own.min(switch);
            let twist = twist.map(|v| combine(&axes[at], express(chain, v, own, at)));
            twist.named(family, i)
        })
        .collect()
}

/// `world_from_tool`: the rotation's columns, and the translation.
pub(crate) fn pose<'g>(chain: &Chain<'g>) -> (Axes<'g>, Vec3<'g>) {
    let (_, to_tool) = vectors_to_tool(chain);
    let axes = world_axes(chain, chain.groups.len());
    let tool = |j| {
        Vec3::constant(
            chain.graph,
            std::array::from_fn(|i| chain.tool.rotation[i][j]),
        )
    };
    let rotation = [0, 1, 2].map(|j| combine(&axes[chain.groups.len()], tool(j)));
    let origin = Vec3::constant(chain.graph, chain.base.translation);
    (rotation, origin + to_tool.rotate(chain.base.rotation))
}

/// ∂J/∂q_i for each i, by columns, from the columns of J in the same axes:
/// joint i turns whatever is beyond it, so ∂v_j/∂q_i = ω_min(i,j) × v_max(i,j), and ∂ω_j/∂q_i = ω_i × ω_j for i < j, else 0
/// (Siciliano et al., Robotics, section 3.1.3; the second column of a pair sees only its own part of the tool's motion).
pub(crate) fn jacobian_derivatives<'g>(
    chain: &Chain<'g>,
    columns: &[Twist<'g>],
) -> Vec<Vec<Twist<'g>>> {
    let derivative = |i: usize, j: usize| {
        let (near, far) = (columns[i.min(j)], columns[i.max(j)]);
        Twist {
            linear: near.angular.cross(far.linear),
            angular: if i < j {
                near.angular.cross(far.angular)
            } else {
                chain.zero()
            },
        }
    };
    let joints = 0..columns.len();
    joints
        .clone()
        .map(|i| joints.clone().map(|j| derivative(i, j)).collect())
        .collect()
}
