//! From a graph to a program: dead code out, an order, and a number for every step.
//!
//! After this point there are no graphs and no expressions any more, only straight-line programs.

use ulna::Real;

use crate::differentiate::reachable;
use crate::double_double::DoubleDouble;
use crate::graph::{AngleSum, Expr, Graph, Id, Input, Node};
use crate::label::{Label, subscripts};
use crate::op::Op;

/// What the rounding errors of an output are relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// Its largest entry.
    Largest,
    /// That, or the largest entry of the output before it if that is larger: a gradient beside its function.
    LargestOrBefore,
    /// That, or the length of the chain: a position near the origin is as far off as the chain is long.
    LargestOrLength,
    /// Nothing: only its size counts.
    Any,
}

/// Named results of a formulation, of some shape, in row-major order of the shape.
#[derive(Clone, Debug)]
pub struct Output<T> {
    /// What it is called in the generated code.
    pub name: &'static str,
    /// Lengths of the nested arrays, outermost first; empty for a number.
    pub shape: Vec<usize>,
    /// The elements.
    pub elements: Vec<T>,
    /// What their rounding errors are relative to.
    pub size: Size,
}

impl<T> Output<T> {
    /// Results whose errors are relative to the largest of them.
    pub fn new(name: &'static str, shape: &[usize], elements: Vec<T>) -> Self {
        Self {
            name,
            shape: shape.to_vec(),
            elements,
            size: Size::Largest,
        }
    }

    /// The indices of the element at `index` in row-major order, outermost first.
    pub(crate) fn places(&self, mut index: usize) -> Vec<usize> {
        let from_last = self.shape.iter().rev().map(|length| {
            let own = index % length;
            index /= length;
            own
        });
        let mut places: Vec<usize> = from_last.collect();
        places.reverse();
        places
    }

    /// Their errors being relative to `size`.
    pub fn relative_to(self, size: Size) -> Self {
        Self { size, ..self }
    }
}

/// An argument of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand {
    /// A number.
    Constant(DoubleDouble),
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
#[derive(Clone, Debug)]
pub struct Program {
    /// The angles whose sines and cosines it takes.
    pub angles: Vec<AngleSum>,
    /// Its operations, in order.
    pub steps: Vec<Step>,
    /// What the result of each operation is called, where it has a name. Names may repeat.
    pub labels: Vec<Option<Label>>,
    /// Its results.
    pub outputs: Vec<Output<Operand>>,
}

/// Numbers the nodes that `outputs` need, in the order in which they were formulated.
///
/// Measured against two other orders: each step as late as its first use allows (depth first, so that few values are
/// alive at a time), and the longest path to a result first (list scheduling). Both the compiler and the processor
/// reorder again; of the three this one made the fastest code on arms without special geometry, and came within
/// a few percent of the best on the others.
pub fn schedule(graph: &Graph, outputs: &[Output<Expr<'_>>]) -> Program {
    let roots = outputs
        .iter()
        .flat_map(|output| output.elements.iter().map(|e| e.id()));
    let needed = reachable(graph, roots);
    let angles = angles_in_order(graph, &needed);
    let (mut steps, mut labels) = (Vec::new(), Vec::new());
    // By places in the graph; of what is not needed nothing is read.
    let mut operands = vec![Operand::Constant(DoubleDouble::default()); graph.len()];
    for id in needed {
        let operand = match graph.node(id) {
            Node::Constant(bits) => Operand::Constant(DoubleDouble::from_bits(bits)),
            Node::Input(input) => Operand::Input(renumbered(input, &angles)),
            Node::Apply(op, a, b) => {
                let (a, b) = (operands[a.index()], operands[b.index()]);
                steps.push(Step { op, a, b });
                labels.push(graph.label(id));
                Operand::Step(steps.len() - 1)
            }
        };
        operands[id.index()] = operand;
    }
    let outputs: Vec<_> = outputs
        .iter()
        .map(|output| Output {
            name: output.name,
            shape: output.shape.clone(),
            elements: output
                .elements
                .iter()
                .map(|e| operands[e.id().index()])
                .collect(),
            size: output.size,
        })
        .collect();
    if graph.has_labels() {
        outputs
            .iter()
            .for_each(|output| name_results(output, &mut labels));
    }
    Program {
        angles: angles.into_iter().map(|angle| graph.angle(angle)).collect(),
        steps,
        labels,
        outputs,
    }
}

/// Names the elements of a result that have no name, by the result's and their places in it.
fn name_results(output: &Output<Operand>, labels: &mut [Option<Label>]) {
    for (index, element) in output.elements.iter().enumerate() {
        if let Operand::Step(step) = element {
            labels[*step].get_or_insert_with(|| Label {
                family: output.name,
                text: format!("{}{}", output.name, subscripts(&output.places(index))),
            });
        }
    }
}

/// The angles among the nodes, by their number in the graph: by first joint, short sums before long ones.
fn angles_in_order(graph: &Graph, needed: &[Id]) -> Vec<usize> {
    let mut angles: Vec<usize> = needed
        .iter()
        .filter_map(|id| match graph.node(*id) {
            Node::Input(Input::Sin(angle) | Input::Cos(angle)) => Some(angle),
            _ => None,
        })
        .collect();
    angles.sort_by_key(|angle| (graph.angle(*angle).joints, *angle));
    angles.dedup();
    angles
}

/// An input, its angle counted within the program.
fn renumbered(input: Input, angles: &[usize]) -> Input {
    let place = |angle| angles.iter().position(|a| *a == angle);
    match input {
        Input::Sin(angle) => Input::Sin(place(angle).unwrap_or(angle)),
        Input::Cos(angle) => Input::Cos(place(angle).unwrap_or(angle)),
        other => other,
    }
}

impl Program {
    /// All results in order, on the scalars `R`: `number` makes one of a constant, `input` of an argument.
    pub fn evaluate<R: Real>(
        &self,
        number: impl Fn(DoubleDouble) -> R,
        input: impl Fn(Input, &[AngleSum]) -> R,
    ) -> Vec<R> {
        let mut values = Vec::with_capacity(self.steps.len());
        let value = |operand: Operand, values: &[R]| match operand {
            Operand::Constant(value) => number(value),
            Operand::Input(argument) => input(argument, &self.angles),
            Operand::Step(step) => values[step],
        };
        for step in &self.steps {
            let result = step
                .op
                .apply(value(step.a, &values), value(step.b, &values));
            values.push(result);
        }
        let elements = self.outputs.iter().flat_map(|output| &output.elements);
        elements.map(|operand| value(*operand, &values)).collect()
    }
}
