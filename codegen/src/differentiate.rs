//! Derivatives by the joint coordinates, built on the graph and so simplified while they are built.

use crate::graph::{Expr, Graph, Id, Input, Node};
use crate::label::{Label, subscripts};

/// The nodes that `outputs` need, arguments first.
pub(crate) fn reachable(graph: &Graph, outputs: impl IntoIterator<Item = Id>) -> Vec<Id> {
    let mut needed = vec![false; graph.len()];
    let mut open: Vec<Id> = outputs.into_iter().collect();
    let mut found = Vec::new();
    while let Some(id) = open.pop() {
        if std::mem::replace(&mut needed[id.index()], true) {
            continue;
        }
        found.push(id);
        if let Node::Apply(_, a, b) = graph.node(id) {
            open.extend([a, b]);
        }
    }
    found.sort_unstable();
    found
}

/// Reverse (adjoint) derivatives: Σ seed · ∂output/∂q_i over all pairs of `seeded`, for each of `joints` joints.
///
/// One sweep gives the whole gradient, at a small multiple of the cost of the outputs themselves
/// (Griewank and Walther, Evaluating Derivatives, chapter 4).
pub fn reverse<'g>(
    graph: &'g Graph,
    seeded: &[(Expr<'g>, Expr<'g>)],
    joints: usize,
) -> Vec<Expr<'g>> {
    let zero = graph.constant(0.0);
    // Of the nodes that there are: those that the sweep adds are no arguments of theirs.
    let mut adjoints = vec![zero; graph.len()];
    let add = |adjoints: &mut [Expr<'g>], id: Id, summand: Expr<'g>| {
        let sum = &mut adjoints[id.index()];
        *sum = *sum + summand;
    };
    for (output, seed) in seeded {
        add(&mut adjoints, output.id(), *seed);
    }
    let mut gradient = vec![zero; joints];
    let mut angles: Vec<(usize, Expr<'g>)> = Vec::new();
    let order = reachable(graph, seeded.iter().map(|(output, _)| output.id()));
    for id in order.into_iter().rev() {
        let adjoint = adjoints[id.index()];
        if adjoint.is_zero() {
            continue;
        }
        if let Some(label) = graph.label(id) {
            let Label { family, text } = label.of_adjoint();
            adjoint.labelled(family, || text);
        }
        match graph.node(id) {
            Node::Constant(_) => {}
            Node::Input(Input::Q(i)) => gradient[i] = gradient[i] + adjoint,
            Node::Input(Input::Sin(a)) => angles.push((a, adjoint * graph.input(Input::Cos(a)))),
            Node::Input(Input::Cos(a)) => angles.push((a, -(adjoint * graph.input(Input::Sin(a))))),
            Node::Input(_) => {}
            Node::Apply(op, a, b) => {
                let row = op.row();
                let [pa, pb] = (row.partials)(graph.expr(a), graph.expr(b), graph.expr(id));
                add(&mut adjoints, a, adjoint * pa);
                if row.arity == 2 {
                    add(&mut adjoints, b, adjoint * pb);
                }
            }
        }
    }
    sum_over_angles(graph, &mut angles, &mut gradient);
    gradient
}

/// Adds each angle's adjoint to the joints that turn it, longest sums first, so that joints share partial sums.
fn sum_over_angles<'g>(
    graph: &'g Graph,
    angles: &mut [(usize, Expr<'g>)],
    gradient: &mut [Expr<'g>],
) {
    let length = |angle: usize| graph.angle(angle).joints.len();
    angles.sort_by_key(|(angle, _)| (std::cmp::Reverse(length(*angle)), *angle));
    for pair in angles.chunk_by(|a, b| a.0 == b.0) {
        let zero = graph.constant(0.0);
        let total = pair.iter().fold(zero, |sum, (_, adjoint)| sum + *adjoint);
        let joints = graph.angle(pair[0].0).joints;
        total.labelled("bar", || format!("angle{}_bar", subscripts(&joints)));
        for joint in joints {
            gradient[joint] = gradient[joint] + total;
        }
    }
}
