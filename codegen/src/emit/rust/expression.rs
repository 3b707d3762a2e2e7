//! Expressions as Rust.
//!
//! A product that only a sum needs becomes a multiply-add: [`ulna::Real`] fuses it where the target can.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::super::plan::{Expression, Summand};
use super::literal::literal;
use crate::op::Op;
use crate::schedule::Output;

/// Binding strength of an expression's outermost operator.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Sum,
    Product,
    Negation,
    Atom,
}

struct Code {
    tokens: TokenStream,
    level: Level,
}

impl Code {
    fn atom(tokens: TokenStream) -> Self {
        Self {
            tokens,
            level: Level::Atom,
        }
    }

    /// The tokens, in parentheses unless they bind at least as strongly as `level`.
    fn at(&self, level: Level) -> TokenStream {
        let tokens = &self.tokens;
        if self.level >= level {
            quote!(#tokens)
        } else {
            quote!((#tokens))
        }
    }
}

/// An expression.
pub(super) fn tokens(expression: &Expression) -> TokenStream {
    code(expression).tokens
}

/// Elements of an output, given as tokens, as nested arrays.
pub(super) fn nested<T>(output: &Output<T>, element: impl Fn(&T) -> TokenStream) -> TokenStream {
    let mut rows: Vec<TokenStream> = output.elements.iter().map(element).collect();
    for length in output.shape.iter().rev() {
        rows = rows
            .chunks(*length)
            .map(|row| quote!([#(#row),*]))
            .collect();
    }
    quote!(#(#rows)*)
}

fn code(expression: &Expression) -> Code {
    match expression {
        Expression::Number(value) => {
            let value = literal(*value);
            Code::atom(quote!(R::of(#value)))
        }
        Expression::Argument(name, index) => {
            let (name, index) = (format_ident!("{name}"), Literal::usize_unsuffixed(*index));
            Code::atom(quote!(#name[#index]))
        }
        Expression::Name(name) => {
            let name = format_ident!("{name}");
            Code::atom(quote!(#name))
        }
        Expression::Unary(op, a) => operation(*op, a, a),
        Expression::Binary(op, operands, fused) => {
            let [a, b] = &**operands;
            let (product, method, other) = match (fused, op) {
                (None, _) => return operation(*op, a, b),
                (Some(Summand::First), Op::Add) => (a, "mul_add", b),
                (Some(Summand::Second), Op::Add) => (b, "mul_add", a),
                (Some(Summand::First), _) => (a, "mul_sub", b),
                (Some(Summand::Second), _) => (b, "neg_mul_add", a),
            };
            match product {
                Expression::Binary(_, factors, _) => multiply_add(factors, method, other),
                _ => operation(*op, a, b),
            }
        }
    }
}

/// The syntax of the operators, a row each.
fn operation(op: Op, a: &Expression, b: &Expression) -> Code {
    let (level, left, right) = match op {
        Op::Add | Op::Sub => (Level::Sum, Level::Sum, Level::Product),
        Op::Mul | Op::Div => (Level::Product, Level::Product, Level::Negation),
        Op::Neg => (Level::Negation, Level::Negation, Level::Atom),
        Op::Sqrt => (Level::Atom, Level::Atom, Level::Atom),
    };
    let (a, b) = (code(a).at(left), code(b).at(right));
    let tokens = match op {
        Op::Add => quote!(#a + #b),
        Op::Sub => quote!(#a - #b),
        Op::Mul => quote!(#a * #b),
        Op::Div => quote!(#a / #b),
        Op::Neg => quote!(-#a),
        Op::Sqrt => quote!(#a.sqrt()),
    };
    Code { tokens, level }
}

fn multiply_add([a, b]: &[Expression; 2], method: &str, other: &Expression) -> Code {
    // A number reads better as the argument.
    let (a, b) = match a {
        Expression::Number(_) => (b, a),
        _ => (a, b),
    };
    let method = format_ident!("{method}");
    let receiver = code(a).at(Level::Atom);
    let (factor, other) = (tokens(b), tokens(other));
    Code::atom(quote!(#receiver.#method(#factor, #other)))
}
