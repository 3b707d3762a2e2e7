//! Expressions as C.
//!
//! Wherever two different operators meet there are parentheses: nobody need know which binds more strongly. Products and sums are written
//! apart, so that the compiler's `-ffp-contract` decides whether they are fused.

use super::super::plan::Expression;
use super::target::Target;
use crate::op::Op;

/// An expression's outermost operator.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Level {
    Sum,
    Product,
    Negation,
    Atom,
}

/// An expression; `name` is how a named value is written where it is read.
pub(super) fn text(
    target: &Target<'_>,
    expression: &Expression,
    name: &dyn Fn(&str) -> String,
) -> String {
    Writer { target, name }.code(expression).0
}

struct Writer<'a> {
    target: &'a Target<'a>,
    name: &'a dyn Fn(&str) -> String,
}

impl Writer<'_> {
    fn code(&self, expression: &Expression) -> (String, Level) {
        match expression {
            Expression::Number(value) if value.is_sign_negative() => {
                (self.target.number(*value), Level::Negation)
            }
            Expression::Number(value) => (self.target.number(*value), Level::Atom),
            Expression::Argument(name, index) => (format!("{name}[{index}]"), Level::Atom),
            Expression::Name(name) => ((self.name)(name), Level::Atom),
            Expression::Unary(op, a) => self.operation(*op, a, a),
            Expression::Binary(op, operands, _) => self.operation(*op, &operands[0], &operands[1]),
        }
    }

    /// The syntax of the operators, a row each.
    fn operation(&self, op: Op, a: &Expression, b: &Expression) -> (String, Level) {
        use Level::{Atom, Negation, Product, Sum};
        let sum = |sign| {
            let (a, b) = (
                self.operand(a, &[Sum, Negation, Atom]),
                self.operand(b, &[Atom]),
            );
            (format!("{a} {sign} {b}"), Sum)
        };
        let product = |sign| {
            let a = self.operand(a, &[Product, Negation, Atom]);
            let b = self.operand(b, &[Negation, Atom]);
            (format!("{a} {sign} {b}"), Product)
        };
        match op {
            Op::Add => sum('+'),
            Op::Sub => sum('-'),
            Op::Mul => product('*'),
            Op::Div => product('/'),
            Op::Neg => (format!("-{}", self.operand(a, &[Atom])), Negation),
            Op::Sqrt => (
                format!("{}({})", self.target.math("sqrt"), self.code(a).0),
                Atom,
            ),
        }
    }

    /// An operand, in parentheses unless it is one of those.
    fn operand(&self, expression: &Expression, plain: &[Level]) -> String {
        let (text, level) = self.code(expression);
        if plain.contains(&level) {
            text
        } else {
            format!("({text})")
        }
    }
}
