//! From a graph to a program: dead code out, an order, and a number for every step.
//!
//! After this point there are no graphs and no expressions any more, only straight-line programs.

use std::collections::HashMap;

use crate::differentiate::reachable;
use crate::graph::{AngleSum, Expr, Graph, Id, Input, Node};
use crate::op::Op;

/// Named results of a formulation, of some shape, in row-major order of the shape.
#[derive(Debug)]
pub struct Output<T> {
    /// What it is called in the generated code.
    pub name: &'static str,
    /// Lengths of the nested arrays, outermost first; empty for a number.
    pub shape: Vec<usize>,
    /// The elements.
    pub elements: Vec<T>,
}

/// An argument of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand {
    /// A number.
    Constant(f64),
    /// An argument of the function; angles are counted within the program.
    Input(Input),
    /// The result of an earlier step.
    Step(usize),
}

/// One operation. A unary operator repeats its argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The operator.
    pub op: Op,
    /// First argument.
    pub a: Operand,
    /// Second argument.
    pub b: Operand,
}

/// A straight-line program.
#[derive(Debug)]
pub struct Program {
    /// The angles whose sines and cosines it takes.
    pub angles: Vec<AngleSum>,
    /// Its operations, in order.
    pub steps: Vec<Step>,
    /// Its results.
    pub outputs: Vec<Output<Operand>>,
}

/// Orders the nodes that `outputs` need, each as late as its first use allows (depth first),
/// so that few values are alive at a time.
pub fn schedule(graph: &Graph, outputs: &[Output<Expr<'_>>]) -> Program {
    let mut scheduler = Scheduler {
        graph,
        angles: angles_in_order(graph, outputs),
        steps: Vec::new(),
        places: HashMap::new(),
    };
    let outputs = outputs
        .iter()
        .map(|output| Output {
            name: output.name,
            shape: output.shape.clone(),
            elements: output
                .elements
                .iter()
                .map(|e| scheduler.place(e.id()))
                .collect(),
        })
        .collect();
    Program {
        angles: scheduler.angles.iter().map(|a| graph.angle(*a)).collect(),
        steps: scheduler.steps,
        outputs,
    }
}

/// The angles that `outputs` need, by their number in the graph: by first joint, short sums before long ones.
fn angles_in_order(graph: &Graph, outputs: &[Output<Expr<'_>>]) -> Vec<usize> {
    let roots = outputs
        .iter()
        .flat_map(|output| output.elements.iter().map(|e| e.id()));
    let mut angles: Vec<usize> = reachable(graph, roots)
        .into_iter()
        .filter_map(|id| match graph.node(id) {
            Node::Input(Input::Sin(angle) | Input::Cos(angle)) => Some(angle),
            _ => None,
        })
        .collect();
    angles.sort_by_key(|angle| (graph.angle(*angle).joints, *angle));
    angles.dedup();
    angles
}

struct Scheduler<'g> {
    graph: &'g Graph,
    /// The program's angles, by their number in the graph.
    angles: Vec<usize>,
    steps: Vec<Step>,
    places: HashMap<Id, Operand>,
}

impl Scheduler<'_> {
    /// The operand of a node, scheduling whatever it needs first. A stack of its own: graphs can be deep.
    fn place(&mut self, target: Id) -> Operand {
        let mut stack = vec![target];
        while let Some(&id) = stack.last() {
            if self.places.contains_key(&id) {
                stack.pop();
                continue;
            }
            let operand = match self.graph.node(id) {
                Node::Constant(bits) => Operand::Constant(f64::from_bits(bits)),
                Node::Input(input) => Operand::Input(self.input(input)),
                Node::Apply(op, a, b) => match (self.places.get(&a), self.places.get(&b)) {
                    (Some(&a), Some(&b)) => {
                        self.steps.push(Step { op, a, b });
                        Operand::Step(self.steps.len() - 1)
                    }
                    (Some(_), None) => {
                        stack.push(b);
                        continue;
                    }
                    _ => {
                        stack.push(a);
                        continue;
                    }
                },
            };
            self.places.insert(id, operand);
        }
        self.places[&target]
    }

    fn input(&self, input: Input) -> Input {
        match input {
            Input::Sin(angle) => Input::Sin(self.angle(angle)),
            Input::Cos(angle) => Input::Cos(self.angle(angle)),
            other => other,
        }
    }

    fn angle(&self, angle: usize) -> usize {
        let place = self.angles.iter().position(|a| *a == angle);
        place.unwrap_or(self.angles.len())
    }
}

impl Program {
    /// All results in order, for the given arguments: what the generated code computes, evaluated here.
    pub fn evaluate(&self, input: impl Fn(Input, &[AngleSum]) -> f64) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.steps.len());
        let value = |operand: Operand, values: &[f64]| match operand {
            Operand::Constant(value) => value,
            Operand::Input(argument) => input(argument, &self.angles),
            Operand::Step(step) => values[step],
        };
        for step in &self.steps {
            let result = (step.op.row().value)(value(step.a, &values), value(step.b, &values));
            values.push(result);
        }
        let elements = self.outputs.iter().flat_map(|output| &output.elements);
        elements.map(|operand| value(*operand, &values)).collect()
    }
}
