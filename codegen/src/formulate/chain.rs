//! The model on the graph: joints in groups about parallel axes, and the constants of their links.
//!
//! Joints whose axes are parallel (α = 0 from one to the next) form a group. All that happens within a group is
//! written in one set of axes, those of the group's *last* frame: passing from joint to joint then costs no rotation,
//! the links' constants are turned by sums of joint angles instead, and a quantity of joint i
//! depends on the coordinates beyond joint i only, so that its other derivatives vanish while the graph is built.

use std::ops::Range;

use ulna::{Angle, JointKind, Placement, TaskRows};
use ulna_table::Model;

use super::body::{Body, base_parameters};
use super::vector::{Turn, Vec3, quarter_turns};
use crate::double_double::DoubleDouble;
use crate::graph::{AngleSum, Expr, Graph, Input};

/// A joint on the graph.
#[derive(Debug)]
pub struct ChainJoint<'g> {
    /// How the joint moves.
    pub kind: JointKind,
    /// From the origin of the joint before to this one's: in this group's axes or, for the first of a group,
    /// in the axes of the group before (of the base for the very first).
    pub offset: Vec3<'g>,
    /// `a` of its row: from the origin before along x of the frame before, m.
    pub across: Expr<'g>,
    /// `d` of its row, with the coordinate of a prismatic joint: on from there along the joint's axis, m.
    pub along: Expr<'g>,
    /// The turn that takes a vector of the joint's own frame to the group's axes.
    pub group_from_own: Turn<'g>,
    /// The link's inertial constants, regrouped ([`base_parameters`]), in its own frame.
    pub body: Body<'g>,
    /// The same as the table has them.
    pub link: Body<'g>,
}

/// Joints about parallel axes.
#[derive(Debug)]
pub struct Group<'g> {
    /// Twist from the axes of the group before.
    pub alpha: Turn<'g>,
    /// The group's angles all together.
    pub turn: Turn<'g>,
    /// The joints' indices in the chain.
    pub joints: Range<usize>,
}

impl<'g> Group<'g> {
    /// A vector of this group's axes, in the axes of the group before.
    pub fn to_parent(&self, v: Vec3<'g>) -> Vec3<'g> {
        v.turn_z(self.turn).turn_x(self.alpha)
    }

    /// A vector of the axes of the group before, in this group's.
    pub fn of_parent(&self, v: Vec3<'g>) -> Vec3<'g> {
        v.turn_x(self.alpha.inverse()).turn_z(self.turn.inverse())
    }
}

/// An arm on the graph.
#[derive(Debug)]
pub struct Chain<'g> {
    /// The graph that everything stands on.
    pub graph: &'g Graph,
    /// The joints, base first.
    pub joints: Vec<ChainJoint<'g>>,
    /// Their groups, base first.
    pub groups: Vec<Group<'g>>,
    /// `world_from_base`.
    pub base: Placement,
    /// `frame_N_from_tool`.
    pub tool: Placement,
    /// What of the links' constants has been regrouped to the base, about its origin: no motion changes it.
    pub ground: Body<'g>,
    /// Gravity in base axes, m/s².
    pub gravity: Vec3<'g>,
    /// The rows of J in w_D.
    pub task: TaskRows,
}

impl<'g> Chain<'g> {
    /// Lays the model out on the graph.
    pub fn new(graph: &'g Graph, model: &Model) -> Self {
        let (bodies, ground) = base_parameters(graph, model);
        let groups: Vec<Group<'g>> = parallel_runs(model)
            .into_iter()
            .map(|joints| Group {
                alpha: Turn::by_angle(graph, model.joints()[joints.start].alpha),
                turn: sum_of_angles(graph, model, joints.clone()),
                joints,
            })
            .collect();
        let joints = groups
            .iter()
            .flat_map(|group| group.joints.clone().map(move |i| (group, i)))
            .map(|(group, i)| ChainJoint {
                kind: model.joints()[i].kind,
                offset: offset(graph, model, group, i),
                across: graph.constant(model.joints()[i].a),
                along: along(graph, model, i),
                group_from_own: sum_of_angles(graph, model, i + 1..group.joints.end).inverse(),
                body: bodies[i],
                link: Body::of_link(graph, &model.joints()[i].link),
            })
            .collect();
        let world_from_base = model.base().rotation;
        Self {
            graph,
            joints,
            groups,
            base: *model.base(),
            tool: *model.tool(),
            ground,
            gravity: Vec3::constant(graph, model.gravity()).rotate(std::array::from_fn(|j| {
                std::array::from_fn(|i| world_from_base[i][j])
            })),
            task: model.task(),
        }
    }

    /// How many joints there are.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// The group of a joint, by index.
    pub fn group_of(&self, joint: usize) -> usize {
        let is_in = |group: &Group<'_>| group.joints.contains(&joint);
        self.groups
            .iter()
            .position(is_in)
            .unwrap_or(self.groups.len())
    }

    /// The zero vector.
    pub fn zero(&self) -> Vec3<'g> {
        Vec3::constant(self.graph, [0.0; 3])
    }

    /// The unit vector along a joint's axis, in its group's axes.
    pub fn axis(&self) -> Vec3<'g> {
        Vec3::constant(self.graph, [0.0, 0.0, 1.0])
    }

    /// One expression for each joint.
    pub fn inputs(&self, input: fn(usize) -> Input) -> Vec<Expr<'g>> {
        (0..self.joint_count())
            .map(|i| self.graph.input(input(i)))
            .collect()
    }
}

/// Maximal runs of joints about parallel axes.
fn parallel_runs(model: &Model) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (i, joint) in model.joints().iter().enumerate() {
        match runs.last_mut() {
            Some(run) if joint.alpha.sin_cos() == (0.0, 1.0) => run.end = i + 1,
            _ => runs.push(i..i + 1),
        }
    }
    runs
}

fn along<'g>(graph: &'g Graph, model: &Model, i: usize) -> Expr<'g> {
    let joint = &model.joints()[i];
    match joint.kind {
        JointKind::Revolute => graph.constant(joint.d),
        JointKind::Prismatic => graph.constant(joint.d) + graph.input(Input::Q(i)),
    }
}

fn offset<'g>(graph: &'g Graph, model: &Model, group: &Group<'g>, i: usize) -> Vec3<'g> {
    let joint = &model.joints()[i];
    let along = along(graph, model, i);
    let zero = graph.constant(0.0);
    let across = Vec3([graph.constant(joint.a), zero, zero]);
    let along = Vec3([zero, zero, along]);
    if i == group.joints.start {
        across + along.turn_x(group.alpha)
    } else {
        (across + along).turn_z(sum_of_angles(graph, model, i..group.joints.end).inverse())
    }
}

/// The turn by the angles of some joints together. Quarter turns are taken out, and so stay exact.
fn sum_of_angles<'g>(graph: &'g Graph, model: &Model, range: Range<usize>) -> Turn<'g> {
    let mut quarters = 0;
    let mut sum = AngleSum::default();
    for i in range {
        let (whole, rest) = quarter_turns(model.joints()[i].theta);
        quarters += whole;
        sum.offset = sum.offset + rest;
        if model.joints()[i].kind == JointKind::Revolute {
            sum.joints.push(i);
        }
    }
    let turn = if sum.joints.is_empty() {
        // Angles that add up to a quarter turn are one.
        let (whole, rest) = Angle::from_radians(sum.offset.to_f64()).quarter_turns();
        if rest == 0.0 {
            quarters += whole;
            sum.offset = DoubleDouble::default();
        }
        Turn::by_number(graph, sum.offset)
    } else {
        let (sin, cos) = graph.sin_cos(&sum);
        Turn { sin, cos }
    };
    turn.and_quarters(quarters)
}
