//! The folding rules: what `+`, `-`, `*`, `/` and negation of expressions become. The first rule that fits is taken.

use std::ops;

use ulna::Real;

use crate::double_double::DoubleDouble;
use crate::graph::{Expr, Node};
use crate::op::Op;

impl ops::Neg for Expr<'_> {
    type Output = Self;

    fn neg(self) -> Self {
        if let Some(value) = self.value() {
            return self.of(-value);
        }
        if let Some(x) = self.negated() {
            return x;
        }
        self.node(Op::Neg, self)
    }
}

impl ops::Add for Expr<'_> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        match (self.value(), other.value()) {
            (Some(a), Some(b)) => return self.of(a + b),
            (Some(a), _) if a == 0.0 => return other,
            (_, Some(b)) if b == 0.0 => return self,
            (Some(a), _) if a < 0.0 => return other - self.of(-a),
            (_, Some(b)) if b < 0.0 => return self - self.of(-b),
            _ => {}
        }
        match (self.negated(), other.negated()) {
            (Some(a), Some(b)) => return -(a + b),
            (Some(a), None) => return other - a,
            (None, Some(b)) => return self - b,
            _ => {}
        }
        if let Some(combined) = combine(self, other, |c, d| c + d) {
            return combined;
        }
        // (c + x) + (d + y) = (c + d) + (x + y)
        if let (Some((c, x)), Some((d, y))) = (self.raised(), other.raised()) {
            return self.of(c + d) + (x + y);
        }
        let (a, b) = self.sorted(other);
        a.node(Op::Add, b)
    }
}

impl ops::Sub for Expr<'_> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        match (self.value(), other.value()) {
            (Some(a), Some(b)) => return self.of(a - b),
            (Some(a), _) if a == 0.0 => return -other,
            (_, Some(b)) if b == 0.0 => return self,
            (_, Some(b)) if b < 0.0 => return self + self.of(-b),
            _ => {}
        }
        match (self.negated(), other.negated()) {
            (Some(a), Some(b)) => return b - a,
            (Some(a), None) => return -(a + other),
            (None, Some(b)) => return self + b,
            _ => {}
        }
        if let Some(combined) = combine(self, other, |c, d| c - d) {
            return combined;
        }
        // (c + x) - (d + y) = (c - d) + (x - y)
        if let (Some((c, x)), Some((d, y))) = (self.raised(), other.raised()) {
            return self.of(c - d) + (x - y);
        }
        // One of a - b and b - a is enough.
        if let Some(reversed) = self
            .graph()
            .find(Node::Apply(Op::Sub, other.id(), self.id()))
        {
            return -reversed;
        }
        self.node(Op::Sub, other)
    }
}

/// `c x ± d x = (c ± d) x` for numbers `c` and `d`.
fn combine<'g>(
    a: Expr<'g>,
    b: Expr<'g>,
    sum: fn(DoubleDouble, DoubleDouble) -> DoubleDouble,
) -> Option<Expr<'g>> {
    let one = DoubleDouble::of(1.0);
    let (c, x) = a.scaled().unwrap_or((one, a));
    let (d, y) = b.scaled().unwrap_or((one, b));
    (x == y).then(|| a.of(sum(c, d)) * x)
}

impl ops::Mul for Expr<'_> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        match (self.value(), other.value()) {
            (Some(a), Some(b)) => return self.of(a * b),
            (Some(a), _) | (_, Some(a)) if a == 0.0 => return self.of(0.0),
            (Some(a), _) if a == 1.0 => return other,
            (_, Some(b)) if b == 1.0 => return self,
            (Some(a), _) if a < 0.0 => return -(self.of(-a) * other),
            (_, Some(b)) if b < 0.0 => return -(self * other.of(-b)),
            _ => {}
        }
        match (self.negated(), other.negated()) {
            (Some(a), Some(b)) => return a * b,
            (Some(a), None) => return -(a * other),
            (None, Some(b)) => return -(self * b),
            _ => {}
        }
        // c (d x) = (c d) x
        match (self.value(), other.value(), self.scaled(), other.scaled()) {
            (Some(c), _, _, Some((d, x))) | (_, Some(c), Some((d, x)), _) => {
                return self.of(c * d) * x;
            }
            _ => {}
        }
        let (a, b) = self.sorted(other);
        a.node(Op::Mul, b)
    }
}

impl ops::Div for Expr<'_> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        match (self.value(), other.value()) {
            (Some(a), Some(b)) => return self.of(a / b),
            (Some(a), _) if a == 0.0 => return self,
            (_, Some(b)) => return self * self.of(DoubleDouble::of(1.0) / b),
            (Some(a), _) if a < 0.0 => return -(self.of(-a) / other),
            _ => {}
        }
        match (self.negated(), other.negated()) {
            (Some(a), Some(b)) => return a / b,
            (Some(a), None) => return -(a / other),
            (None, Some(b)) => return -(self / b),
            _ => {}
        }
        self.node(Op::Div, other)
    }
}
