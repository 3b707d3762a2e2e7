//! Values as expressions: no language's, but with all that languages need to know decided.

use super::latency::Summand;
use super::{Coordinates, argument_name, coordinate_name};
use crate::graph::Input;
use crate::op::Op;
use crate::schedule::{Operand, Program, Step};

/// The value of something that is not named where it is used.
pub(in crate::emit) enum Expression {
    /// A number.
    Number(f64),
    /// An element of an argument, counted from 0.
    Argument(&'static str, usize),
    /// A named value, a sine or a cosine.
    Name(String),
    /// An operator over one value.
    Unary(Op, Box<Self>),
    /// An operator over two, and which of them is a product that becomes one operation with it where there are fused multiply-adds.
    Binary(Op, Box<[Self; 2]>, Option<Summand>),
}

impl Expression {
    /// Hands every name and argument in it to `take`, from left to right.
    pub(super) fn each_read<'a>(&'a self, take: &mut impl FnMut(&'a str)) {
        match self {
            Self::Number(_) => {}
            Self::Argument(name, _) => take(name),
            Self::Name(name) => take(name),
            Self::Unary(_, operand) => operand.each_read(take),
            Self::Binary(_, operands, _) => {
                for operand in operands.iter() {
                    operand.each_read(take);
                }
            }
        }
    }
}

/// What expressions are made of.
pub(super) struct Expressions<'a> {
    pub(super) program: &'a Program,
    /// The name of each step that has one.
    pub(super) names: &'a [Option<String>],
    /// Which summand of each step is fused with it.
    pub(super) fused: &'a [Option<Summand>],
    pub(super) angle_names: &'a [String],
    pub(super) coordinates: Coordinates,
}

impl Expressions<'_> {
    /// What a step computes.
    pub(super) fn step(&self, index: usize) -> Expression {
        let Step { op, a, b } = self.program.steps[index];
        match op.row().arity {
            1 => Expression::Unary(op, Box::new(self.operand(a))),
            _ => {
                let operands = Box::new([self.operand(a), self.operand(b)]);
                Expression::Binary(op, operands, self.fused[index])
            }
        }
    }

    /// A value where it is used: its name, if it has one.
    pub(super) fn operand(&self, operand: Operand) -> Expression {
        match operand {
            Operand::Constant(value) => Expression::Number(value.to_f64()),
            Operand::Input(input) => self.input(input),
            Operand::Step(index) => match &self.names[index] {
                Some(name) => Expression::Name(name.clone()),
                None => self.step(index),
            },
        }
    }

    fn input(&self, input: Input) -> Expression {
        match input {
            Input::Q(i) if self.coordinates == Coordinates::Named => {
                Expression::Name(coordinate_name(i))
            }
            Input::Q(i)
            | Input::Qd(i)
            | Input::Qdd(i)
            | Input::Tau(i)
            | Input::Wrench(i)
            | Input::Payload(i) => Expression::Argument(argument_name(input).unwrap_or("q"), i),
            Input::Sin(_) => Expression::Name(self.trigonometric('s', input)),
            Input::Cos(_) => Expression::Name(self.trigonometric('c', input)),
        }
    }

    /// The name of a sine or cosine.
    pub(super) fn trigonometric(&self, prefix: char, input: Input) -> String {
        match input {
            Input::Sin(angle) | Input::Cos(angle) => {
                format!("{prefix}{}", self.angle_names[angle])
            }
            _ => String::new(),
        }
    }
}
