//! The operators of the expression graph, one row each: value, derivative, name in a count.

use ulna::Real;

use crate::graph::Expr;

/// What there is to know of an operator but its value ([`Op::apply`]). A unary operator ignores its second argument.
pub struct Row {
    /// The operator.
    pub op: Op,
    /// Its name in a count of operations.
    pub name: &'static str,
    /// How many arguments it takes: 1 or 2.
    pub arity: usize,
    /// Its partial derivatives by both arguments, given the arguments and the result.
    pub partials: for<'g> fn(Expr<'g>, Expr<'g>, Expr<'g>) -> [Expr<'g>; 2],
}

macro_rules! operators {
    ($($op:ident $doc:literal $name:literal $arity:literal
       value |$a:pat_param, $b:pat_param| $value:expr, partials $partials:expr;)+) => {
        /// An operator of the graph.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Op {
            $(#[doc = $doc] $op,)+
        }

        /// The table of operators, in the order of [`Op`].
        static ROWS: &[Row] = &[
            $(Row { op: Op::$op, name: $name, arity: $arity, partials: $partials }),+
        ];

        impl Op {
            /// Every operator.
            pub const ALL: &[Self] = &[$(Self::$op),+];

            /// Its value, on any scalar.
            pub fn apply<R: Real>(self, a: R, b: R) -> R {
                match self {
                    $(Self::$op => {
                        let ($a, $b) = (a, b);
                        $value
                    })+
                }
            }
        }
    };
}

#[rustfmt::skip]
operators! {
    Add  "`a + b`" "add"  2 value |a, b| a + b,    partials |a, _, _| [a.of(1.0), a.of(1.0)];
    Sub  "`a - b`" "sub"  2 value |a, b| a - b,    partials |a, _, _| [a.of(1.0), a.of(-1.0)];
    Mul  "`a * b`" "mul"  2 value |a, b| a * b,    partials |a, b, _| [b, a];
    Div  "`a / b`" "div"  2 value |a, b| a / b,    partials |a, b, y| [a.of(1.0) / b, -(y / b)];
    Neg  "`-a`"    "neg"  1 value |a, _| -a,       partials |a, _, _| [a.of(-1.0), a.of(0.0)];
    Sqrt "`√a`"    "sqrt" 1 value |a, _| a.sqrt(), partials |a, _, y| [a.of(0.5) / y, a.of(0.0)];
}

impl Op {
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
            assert_eq!(op.row().op, *op);
        }
    }
}
