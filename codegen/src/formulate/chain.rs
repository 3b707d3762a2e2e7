//! The model on the graph: joints in groups about parallel axes, and the constants of their links.
//!
//! Joints whose axes are parallel (α = 0 from one to the next) form a group. All that happens within a group is
//! written in one set of axes, those of the group's *last* frame: passing from joint to joint then costs no rotation,
//! the links' constants are turned by sums of joint angles instead, and a quantity of joint i
//! depends on the coordinates beyond joint i only, so that its other derivatives vanish while the graph is built.

use std::ops::Range;

use ulna::{Angle, Friction, Joint, JointKind, Motor, Placement, TaskRows};
use ulna_table::Model;

use super::body::{Body, add_to_last, base_parameters};
use super::origins::Origins;
use super::vector::{Turn, Vec3, quarter_turns};
use crate::double_double::DoubleDouble;
use crate::graph::{AngleSum, Expr, Graph, Input};
use crate::label::subscripts;

/// A joint on the graph.
#[derive(Debug)]
pub struct ChainJoint<'g> {
    /// How the joint moves.
    pub kind: JointKind,
    /// From the [origin](super::origins) of the joint before to this one's: in this group's axes or, for the first of a group,
    /// in the axes of the group before (of the base for the very first).
    pub offset: Vec3<'g>,
    /// The same in two legs that take fewer operations one by one, if it leads to another group: along the joint's axis, in its
    /// group's axes, and the rest, as `offset` is. Else the first is 0.
    pub legs: [Vec3<'g>; 2],
    /// `a` of its row: from the origin before along x of the frame before, m.
    pub across: Expr<'g>,
    /// `d` of its row, with the coordinate of a prismatic joint: on from there along the joint's axis, m.
    pub along: Expr<'g>,
    /// The turn that takes a vector of the joint's own frame to the group's axes.
    pub group_from_own: Turn<'g>,
    /// The link's inertial constants, regrouped ([`base_parameters`]), about its joint's origin, in the axes of its frame.
    pub body: Body<'g>,
    /// The same as the table has them.
    pub link: Body<'g>,
    /// What the joint's rotor adds to its entry of M, as far as the link has it not among its constants.
    pub reflected: Expr<'g>,
    /// Its friction.
    pub friction: Friction,
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

    /// As [`to_parent`](Self::to_parent), of a vector that is [called](Vec3::named) so: the turned one has `_z` and `_zx` behind its name.
    pub fn to_parent_named(
        &self,
        v: Vec3<'g>,
        family: &'static str,
        indices: &[usize],
    ) -> Vec3<'g> {
        let text = |turned: &'static str| {
            move |axis: &str| format!("{family}{axis}{}{turned}", subscripts(indices))
        };
        let v = v.turn_z(self.turn).labelled(family, text("_z"));
        v.turn_x(self.alpha).labelled(family, text("_zx"))
    }

    /// As [`of_parent`](Self::of_parent); what is turned about x only is called what `text` makes of x, y or z, with `_before_x` behind it.
    pub fn of_parent_named(
        &self,
        v: Vec3<'g>,
        family: &'static str,
        text: impl Fn(&str) -> String,
    ) -> Vec3<'g> {
        let v = v.turn_x(self.alpha.inverse());
        let v = v.labelled(family, |axis| format!("{}_before_x", text(axis)));
        v.turn_z(self.turn.inverse())
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
    /// The joints' rows, base first.
    pub rows: Vec<Joint>,
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
        let joints = model.joints().iter();
        let mut links: Vec<Body<'g>> = joints
            .map(|joint| Body::of_link(graph, &joint.link))
            .collect();
        let rotors = rotors(graph, model, &mut links);
        let origins = Origins::new(graph, model, &parallel_runs(model));
        origins.take_up(&mut links);
        let (mut bodies, ground) = base_parameters(graph, model, &origins.heights, &links);
        // Regrouping the payload's parameters takes more operations than it saves: they are no numbers yet.
        if model.has_payload() {
            for bodies in [&mut bodies, &mut links] {
                add_to_last(bodies, Body::payload(graph));
            }
        }
        let groups: Vec<Group<'g>> = parallel_runs(model)
            .into_iter()
            .map(|joints| Group {
                alpha: Turn::by_angle(graph, model.joints()[joints.start].alpha),
                turn: sum_of_angles(graph, model.joints(), joints.clone()),
                joints,
            })
            .collect();
        let joints = groups
            .iter()
            .flat_map(|group| group.joints.clone().map(move |i| (group, i)))
            .map(|(group, i)| ChainJoint {
                kind: model.joints()[i].kind,
                offset: offset(graph, model, origins.heights[i], group, i).named("o", &[i]),
                legs: legs(graph, model, origins.heights[i], group, i),
                across: graph.constant(model.joints()[i].a),
                along: graph.constant(model.joints()[i].d) + slide(graph, model, i),
                group_from_own: sum_of_angles(graph, model.joints(), i + 1..group.joints.end)
                    .inverse(),
                body: bodies[i],
                link: links[i],
                reflected: rotors[i],
                friction: model.joints()[i].friction,
            })
            .collect();
        let mut chain = Self {
            graph,
            joints,
            groups,
            rows: model.joints().to_vec(),
            base: *model.base(),
            tool: *model.tool(),
            ground,
            gravity: Vec3::constant(graph, model.gravity()),
            task: model.task(),
        };
        chain.gravity = chain.of_world(chain.gravity);
        chain
    }

    /// How many joints there are.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// The turn by a joint's own angle, about z.
    pub fn own_turn(&self, joint: usize) -> Turn<'g> {
        sum_of_angles(self.graph, &self.rows, joint..joint + 1)
    }

    /// The group of a joint, by index.
    pub fn group_of(&self, joint: usize) -> usize {
        let is_in = |group: &Group<'_>| group.joints.contains(&joint);
        self.groups
            .iter()
            .position(is_in)
            .unwrap_or(self.groups.len())
    }

    /// A vector of world axes, in base axes.
    pub fn of_world(&self, v: Vec3<'g>) -> Vec3<'g> {
        let world_from_base = self.base.rotation;
        v.rotate(std::array::from_fn(|j| {
            std::array::from_fn(|i| world_from_base[i][j])
        }))
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

/// What the rotors add to M's diagonal.
///
/// The first link of an arm turns about one axis only, that of its rotor's gears: a rotor there is one with the link, and costs nothing.
fn rotors<'g>(graph: &'g Graph, model: &Model, links: &mut [Body<'g>]) -> Vec<Expr<'g>> {
    let joints = model.joints().iter();
    let mut rotors: Vec<Expr<'g>> = joints
        .map(|joint| reflected_inertia(graph, &joint.motor))
        .collect();
    if model.joints()[0].kind == JointKind::Revolute {
        let about_axis = &mut links[0].inertia.0[2];
        *about_axis = *about_axis + rotors[0];
        rotors[0] = graph.constant(0.0);
    }
    rotors
}

/// `inertia · ratio²`, rounded once.
fn reflected_inertia<'g>(graph: &'g Graph, motor: &Motor) -> Expr<'g> {
    let ratio = graph.constant(motor.ratio);
    graph.constant(motor.inertia) * ratio * ratio
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

/// How far a joint slides along its axis: its coordinate, or nothing.
fn slide<'g>(graph: &'g Graph, model: &Model, i: usize) -> Expr<'g> {
    match model.joints()[i].kind {
        JointKind::Revolute => graph.constant(0.0),
        JointKind::Prismatic => graph.input(Input::Q(i)),
    }
}

fn offset<'g>(
    graph: &'g Graph,
    model: &Model,
    height: Expr<'g>,
    group: &Group<'g>,
    i: usize,
) -> Vec3<'g> {
    let [along, rest] = legs(graph, model, height, group, i);
    rest + along.turn_x(group.alpha)
}

fn legs<'g>(
    graph: &'g Graph,
    model: &Model,
    height: Expr<'g>,
    group: &Group<'g>,
    i: usize,
) -> [Vec3<'g>; 2] {
    let zero = graph.constant(0.0);
    let nothing = Vec3([zero; 3]);
    let across = Vec3([graph.constant(model.joints()[i].a), zero, zero]);
    let along = Vec3([zero, zero, height + slide(graph, model, i)]);
    if i == group.joints.start {
        [along, across]
    } else {
        let within = sum_of_angles(graph, model.joints(), i..group.joints.end).inverse();
        [nothing, (across + along).turn_z(within)]
    }
}

/// The turn by the angles of some joints together. Quarter turns are taken out, and so stay exact.
fn sum_of_angles<'g>(graph: &'g Graph, joints: &[Joint], range: Range<usize>) -> Turn<'g> {
    let mut quarters = 0;
    let mut sum = AngleSum::default();
    for i in range {
        let (whole, rest) = quarter_turns(joints[i].theta);
        quarters += whole;
        sum.offset = sum.offset + rest;
        if joints[i].kind == JointKind::Revolute {
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
