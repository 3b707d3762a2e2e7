//! The operators of the expression graph, one row each: value, derivative, Rust tokens, name in a count.

use proc_macro2::TokenStream;
use quote::quote;

use crate::graph::Expr;

/// An operator of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Op {
    /// `a + b`
    Add,
    /// `a - b`
    Sub,
    /// `a * b`
    Mul,
    /// `a / b`
    Div,
    /// `-a`
    Neg,
    /// `√a`
    Sqrt,
}

/// What there is to know of an operator. A unary operator ignores its second argument.
pub struct Row {
    /// The operator.
    pub op: Op,
    /// Its name in a count of operations.
    pub name: &'static str,
    /// How many arguments it takes: 1 or 2.
    pub arity: usize,
    /// Its value.
    pub value: fn(f64, f64) -> f64,
    /// Its partial derivatives by both arguments, given the arguments and the result.
    pub partials: for<'g> fn(Expr<'g>, Expr<'g>, Expr<'g>) -> [Expr<'g>; 2],
    /// Its tokens over those of its arguments, each an operand that needs no parentheses.
    pub tokens: fn(&TokenStream, &TokenStream) -> TokenStream,
}

/// The table of operators, in the order of [`Op`].
#[rustfmt::skip]
static ROWS: [Row; 6] = [
    Row { op: Op::Add,  name: "add",  arity: 2, value: |a, b| a + b,    partials: |a, _, _| [a.of(1.0), a.of(1.0)],        tokens: |a, b| quote!(#a + #b) },
    Row { op: Op::Sub,  name: "sub",  arity: 2, value: |a, b| a - b,    partials: |a, _, _| [a.of(1.0), a.of(-1.0)],       tokens: |a, b| quote!(#a - #b) },
    Row { op: Op::Mul,  name: "mul",  arity: 2, value: |a, b| a * b,    partials: |a, b, _| [b, a],                        tokens: |a, b| quote!(#a * #b) },
    Row { op: Op::Div,  name: "div",  arity: 2, value: |a, b| a / b,    partials: |a, b, y| [a.of(1.0) / b, -(y / b)],     tokens: |a, b| quote!(#a / #b) },
    Row { op: Op::Neg,  name: "neg",  arity: 1, value: |a, _| -a,       partials: |a, _, _| [a.of(-1.0), a.of(0.0)],       tokens: |a, _| quote!(-#a) },
    Row { op: Op::Sqrt, name: "sqrt", arity: 1, value: |a, _| a.sqrt(), partials: |a, _, y| [a.of(0.5) / y, a.of(0.0)],    tokens: |a, _| quote!(#a.sqrt()) },
];

impl Op {
    /// Every operator.
    pub const ALL: [Self; 6] = [
        Self::Add,
        Self::Sub,
        Self::Mul,
        Self::Div,
        Self::Neg,
        Self::Sqrt,
    ];

    /// The operator's row.
    pub fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_operator_finds_its_own_row() {
        for op in Op::ALL {
            assert_eq!(op.row().op, op);
        }
    }
}
