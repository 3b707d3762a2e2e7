//! What is decided of a method before any language is: names, expressions, their order; and what is said about it.

mod documentation;
mod expression;
mod header;
mod inline;
mod latency;
mod names;
mod parts;

use std::collections::HashMap;

use ulna::Payload;

pub(super) use documentation::Documentation;
pub(super) use expression::Expression;
pub(super) use header::{header, listed};
pub use latency::Summand;
pub(super) use parts::{Item, Part, Parts, items};

use crate::MethodProgram;
use crate::graph::Input;
use crate::label::Label;
use crate::schedule::{Operand, Output, Program};
use expression::Expressions;
use inline::{inlined, is_plain};
use names::{Names, angle_names};

/// What the arm carries, as an argument.
pub(super) const PAYLOAD: &str = "payload";

/// The numbers that a method returns, as an argument: of languages whose functions return none.
pub(super) const RESULT: &str = "result";

/// What such a function calls det(JJᵀ) over the task's rows.
pub(super) const VOLUME: &str = "volume_squared";

/// A method, ready to be printed.
pub(super) struct Plan<'p> {
    /// What it was made of.
    pub(super) compiled: &'p MethodProgram,
    /// Its arguments in order, and the payload if it reads that.
    pub(super) arguments: Vec<Argument>,
    /// The joints whose coordinates it reads, if [coordinates have names](Coordinates::Named).
    pub(super) coordinates: Vec<usize>,
    /// The angles whose sines and cosines are taken before all else.
    pub(super) angles: Vec<Angle>,
    /// The named values, in the order in which they are computed.
    pub(super) values: Vec<Value<'p>>,
    /// The results.
    pub(super) outputs: Vec<Output<Element<'p>>>,
}

/// How a language reads joint coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coordinates {
    /// As elements of the argument `q`.
    InPlace,
    /// By names, `q_1`, from which the argument has been read before.
    Named,
}

/// An argument of a method.
pub(super) struct Argument {
    /// What it is called.
    pub(super) name: &'static str,
    /// How many numbers it has.
    pub(super) length: usize,
    /// Whether the method reads any of it.
    pub(super) is_read: bool,
}

/// An angle, and what its sine and its cosine are called where they are used.
pub(super) struct Angle {
    /// The name of the sine.
    pub(super) sine: Option<String>,
    /// The name of the cosine.
    pub(super) cosine: Option<String>,
    /// The joints whose coordinates add up to it, from 0.
    pub(super) joints: Vec<usize>,
    /// What is added to them, rad.
    pub(super) offset: f64,
}

/// A named value.
pub(super) struct Value<'p> {
    pub(super) name: String,
    pub(super) expression: Expression,
    label: Option<&'p Label>,
}

/// An element of a result.
pub(super) struct Element<'p> {
    pub(super) expression: Expression,
    /// Its own name, where it is more than another name or the negative of one.
    pub(super) name: Option<String>,
    label: Option<&'p Label>,
}

impl Element<'_> {
    /// Whether it is 0 at all states.
    pub(super) fn is_zero(&self) -> bool {
        matches!(self.expression, Expression::Number(x) if x == 0.0)
    }
}

/// Which summand of each step is fused with it in the code that is emitted. Its product is then no operation of its own.
pub fn fused_summands(program: &Program) -> Vec<Option<Summand>> {
    latency::fused(program, &inlined(program))
}

impl<'p> Plan<'p> {
    /// Decides which steps are named: those that are used more than once, or not short, and results, which are named last.
    ///
    /// A name is the value's own, if the formulas gave it one, or else a number.
    pub(super) fn new(
        compiled: &'p MethodProgram,
        joints: usize,
        coordinates: Coordinates,
    ) -> Self {
        let program = &compiled.program;
        let angle_names = angle_names(&program.angles);
        let mut given = Names::new(program, &angle_names);
        if coordinates == Coordinates::Named {
            given.reserve((0..joints).map(coordinate_name));
            given.reserve([PAYLOAD, RESULT, VOLUME].map(str::to_owned).into_iter());
        }
        let inline = inlined(program);
        let names: Vec<Option<String>> = (0..program.steps.len())
            .map(|step| (!inline[step]).then(|| given.name(step)))
            .collect();
        let mut results = HashMap::new();
        for element in program.outputs.iter().flat_map(|output| &output.elements) {
            if let Operand::Step(step) = *element
                && inline[step]
                && !is_plain(program, &names, step)
            {
                results.insert(step, given.name(step));
            }
        }
        let fused = latency::fused(program, &inline);
        let expressions = Expressions {
            program,
            names: &names,
            fused: &fused,
            angle_names: &angle_names,
            coordinates,
        };
        let label = |step: usize| program.labels[step].as_ref();
        let values = names.iter().enumerate().filter_map(|(step, name)| {
            Some(Value {
                name: name.clone()?,
                expression: expressions.step(step),
                label: label(step),
            })
        });
        let element = |operand: &Operand| {
            let step = match operand {
                Operand::Step(step) => Some(*step),
                _ => None,
            };
            let name = step.and_then(|step| results.get(&step).cloned());
            Element {
                expression: expressions.operand(*operand),
                label: step.filter(|_| name.is_some()).and_then(label),
                name,
            }
        };
        let outputs = program.outputs.iter().map(|output| Output {
            name: output.name,
            shape: output.shape.clone(),
            elements: output.elements.iter().map(element).collect(),
            size: output.size,
        });
        Self {
            compiled,
            arguments: arguments(compiled, joints),
            coordinates: match coordinates {
                Coordinates::InPlace => Vec::new(),
                Coordinates::Named => coordinates_read(program, joints),
            },
            angles: angles(program, &expressions),
            values: values.collect(),
            outputs: outputs.collect(),
        }
    }

    /// Whether it reads what the arm carries.
    pub(super) fn reads_payload(&self) -> bool {
        let payload = |argument: &Argument| argument.name == PAYLOAD;
        self.arguments.iter().any(payload)
    }

    /// The results that have a name of their own, in order.
    pub(super) fn named_results(&self) -> impl Iterator<Item = (&str, &Expression)> {
        let elements = self.outputs.iter().flat_map(|output| &output.elements);
        elements.filter_map(|element| Some((element.name.as_deref()?, &element.expression)))
    }

    /// The labels of what is named, results among it if they are `with_results`.
    fn labels(&self, with_results: bool) -> impl Iterator<Item = &'p Label> {
        let values = self.values.iter().map(|value| value.label);
        let elements = self.outputs.iter().flat_map(|output| &output.elements);
        let elements = elements.map(|element| element.label);
        values
            .chain(elements.filter(move |_| with_results))
            .flatten()
    }
}

/// What the coordinate of a joint is called, joints counted from 0.
pub(super) fn coordinate_name(joint: usize) -> String {
    format!("q_{}", joint + 1)
}

fn arguments(compiled: &MethodProgram, joints: usize) -> Vec<Argument> {
    let program = &compiled.program;
    let is_read = |name: &str| {
        let reads = |operand| matches!(operand, Operand::Input(input) if argument_name(input) == Some(name));
        any_operand(program, reads) || (name == "q" && !program.angles.is_empty())
    };
    let of_method = compiled.method.arguments().iter();
    let of_method = of_method.map(|argument| Argument {
        name: argument.name(),
        length: argument.length(joints),
        is_read: is_read(argument.name()),
    });
    let payload = is_read(PAYLOAD).then_some(Argument {
        name: PAYLOAD,
        length: Payload::PARAMETERS,
        is_read: true,
    });
    of_method.chain(payload).collect()
}

/// The argument that an input is an element of; none for sines and cosines.
fn argument_name(input: Input) -> Option<&'static str> {
    match input {
        Input::Q(_) => Some("q"),
        Input::Qd(_) => Some("qd"),
        Input::Qdd(_) => Some("qdd"),
        Input::Tau(_) => Some("tau"),
        Input::Wrench(_) => Some("wrench"),
        Input::Payload(_) => Some(PAYLOAD),
        Input::Sin(_) | Input::Cos(_) => None,
    }
}

fn any_operand(program: &Program, is: impl Fn(Operand) -> bool) -> bool {
    let outputs = program.outputs.iter();
    let mut steps = program.steps.iter();
    steps.any(|step| is(step.a) || is(step.b))
        || outputs.flat_map(|output| &output.elements).any(|e| is(*e))
}

fn angles(program: &Program, expressions: &Expressions<'_>) -> Vec<Angle> {
    let name = |input: Input, prefix| {
        let is_used = any_operand(program, |operand| operand == Operand::Input(input));
        is_used.then(|| expressions.trigonometric(prefix, input))
    };
    let angles = program.angles.iter().enumerate();
    angles
        .map(|(index, angle)| Angle {
            sine: name(Input::Sin(index), 's'),
            cosine: name(Input::Cos(index), 'c'),
            joints: angle.joints.clone(),
            offset: angle.offset.to_f64(),
        })
        .collect()
}

/// The joints whose coordinates are read, as they are or in an angle.
fn coordinates_read(program: &Program, joints: usize) -> Vec<usize> {
    let in_angle = |joint| {
        let mut angles = program.angles.iter();
        angles.any(|angle| angle.joints.contains(&joint))
    };
    let alone = |joint| any_operand(program, |o| o == Operand::Input(Input::Q(joint)));
    (0..joints)
        .filter(|joint| in_angle(*joint) || alone(*joint))
        .collect()
}
