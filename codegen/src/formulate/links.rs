//! Poses of all links, and the Jacobians at their origins, in world axes from the base outward.
//!
//! All joints of a group have one axis z, and differ by turns about it. What the step to the next origin adds to a link's Jacobian
//! is z × step in every column, so that joints about parallel axes share it; and where the step starts at the group's own frame
//! the product is a multiple of that frame's axes.

use ulna::JointKind;

use super::chain::Chain;
use super::kinematics::{Axes, Twist, world_axes};
use super::vector::Vec3;
use crate::graph::Expr;

/// Where a link's frame is.
pub(crate) struct LinkFrame<'g> {
    /// `world_from_link`, by columns.
    pub axes: Axes<'g>,
    /// Of its origin.
    pub origin: Vec3<'g>,
    /// From the origin before.
    step: Vec3<'g>,
}

/// The links' frames, base first.
pub(crate) fn link_frames<'g>(chain: &Chain<'g>) -> Vec<LinkFrame<'g>> {
    let group_axes = world_axes(chain, chain.groups.len());
    let mut frames: Vec<LinkFrame<'g>> = Vec::new();
    let mut origin = Vec3::constant(chain.graph, chain.base.translation);
    let mut across = group_axes[0][0];
    for (i, joint) in chain.joints.iter().enumerate() {
        let [x, y, z] = group_axes[chain.group_of(i) + 1];
        let (s, c) = (joint.group_from_own.sin, joint.group_from_own.cos);
        let axes = [x.scale(c) + y.scale(s), y.scale(c) - x.scale(s), z];
        let step = across.scale(joint.across) + z.scale(joint.along);
        step.labelled("o_world", |axis| format!("o{axis}_{}_w", i + 1));
        origin = origin + step;
        across = axes[0];
        origin.labelled("origin", |axis| format!("p{axis}_{}", i + 1));
        frames.push(LinkFrame { axes, origin, step });
    }
    frames
}

/// Each link's Jacobian at its origin, by columns; all of them, those beyond the link 0.
pub(crate) fn link_jacobians<'g>(chain: &Chain<'g>) -> Vec<Vec<Twist<'g>>> {
    let frames = link_frames(chain);
    let mut columns = vec![Twist::none(chain); chain.joint_count()];
    let mut all = Vec::new();
    for (i, frame) in frames.iter().enumerate() {
        for (j, column) in columns.iter_mut().enumerate().take(i) {
            if chain.joints[j].kind == JointKind::Revolute {
                column.linear = column.linear + moved_by_step(chain, &frames, j, i);
            }
        }
        columns[i] = Twist::about(chain, chain.joints[i].kind, frame.axes[2]);
        all.push(columns.clone());
    }
    all
}

/// z_j × the step to link i's origin.
fn moved_by_step<'g>(chain: &Chain<'g>, frames: &[LinkFrame<'g>], j: usize, i: usize) -> Vec3<'g> {
    let (before, joint) = (&frames[i - 1], &chain.joints[i]);
    if chain.group_of(j) != chain.group_of(i - 1) {
        return frames[j].axes[2].cross(frames[i].step);
    }
    // z × x = y, and z × z_i = sin α x, since z_i = cos α z − sin α y.
    let [x, y, _] = before.axes;
    let turned = y.scale(joint.across);
    let twist: Option<Expr<'g>> = (chain.group_of(i) != chain.group_of(j))
        .then(|| chain.groups[chain.group_of(i)].alpha.sin * joint.along);
    match twist {
        Some(factor) => turned + x.scale(factor),
        None => turned,
    }
}
