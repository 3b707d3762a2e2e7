//! When the values of a program are there at the earliest, and so which product of a sum is fused with it.
//!
//! Where both summands are products, one is a multiplication of its own that must be done before the multiply-add begins. That had better be
//! the one whose factors are there first: a chain of rotations then waits for one operation at each turn, and not for two.

use crate::graph::Input;
use crate::op::Op;
use crate::schedule::{Operand, Program, Step};

/// A summand of a sum or difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Summand {
    /// The first one.
    First,
    /// The second one.
    Second,
}

/// Cycles that pass until a result can be used; the same within a few on current processors.
fn latency(op: Op) -> u32 {
    match op {
        Op::Add | Op::Sub | Op::Mul => 4,
        Op::Div => 14,
        Op::Sqrt => 19,
        Op::Neg => 1,
    }
}

/// Cycles until a sine and a cosine are there, all other arguments being there from the start.
const SINE: u32 = 60;

/// For each step, which of its summands is fused with it: of those that are products which nothing else needs the one
/// that lets the sum be there first; none if there is no such product. Where it makes no difference, the first of a sum
/// and the second of a difference.
///
/// `inline` tells which steps nothing else needs.
pub(super) fn fused(program: &Program, inline: &[bool]) -> Vec<Option<Summand>> {
    let mut ends: Vec<u32> = Vec::with_capacity(program.steps.len());
    let mut fused = Vec::with_capacity(program.steps.len());
    for step in &program.steps {
        let end = |operand: Operand| match operand {
            Operand::Step(index) => ends[index],
            Operand::Input(Input::Sin(_) | Input::Cos(_)) => SINE,
            Operand::Input(_) | Operand::Constant(_) => 0,
        };
        let both = |a: Operand, b: Operand| end(a).max(end(b));
        let fusing = |summand: Summand| {
            let (product, other) = match summand {
                Summand::First => (step.a, step.b),
                Summand::Second => (step.b, step.a),
            };
            let (a, b) = factors(program, inline, product)?;
            Some((both(a, b).max(end(other)), summand))
        };
        let candidates: &[Summand] = match step.op {
            Op::Add => &[Summand::First, Summand::Second],
            Op::Sub => &[Summand::Second, Summand::First],
            _ => &[],
        };
        let candidates = candidates.iter().filter_map(|summand| fusing(*summand));
        let (start, summand) = match candidates.min_by_key(|(start, _)| *start) {
            Some((start, summand)) => (start, Some(summand)),
            None => (both(step.a, step.b), None),
        };
        ends.push(start + latency(step.op));
        fused.push(summand);
    }
    fused
}

/// The factors of an operand that is a product which nothing else needs.
fn factors(program: &Program, inline: &[bool], operand: Operand) -> Option<(Operand, Operand)> {
    match operand {
        Operand::Step(index) if inline[index] => {
            let Step { op, a, b } = program.steps[index];
            (op == Op::Mul).then_some((a, b))
        }
        _ => None,
    }
}
