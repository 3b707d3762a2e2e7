//! Which values are written where they are used, and so need no name.

use crate::op::Op;
use crate::schedule::{Operand, Program, Step};

/// The most operations that an unnamed value may have in it.
const INLINE: usize = 5;

/// Whether a step is no more than the negative of something that has a name, and so needs none.
pub(super) fn is_plain(program: &Program, names: &[Option<String>], step: usize) -> bool {
    let Step { op, a, .. } = program.steps[step];
    let unnamed = matches!(a, Operand::Step(step) if names[step].is_none());
    op == Op::Neg && !unnamed
}

/// Which steps are written where they are used: those used once and short, and products that a sum can fuse.
pub(super) fn inlined(program: &Program) -> Vec<bool> {
    let mut uses = vec![0_usize; program.steps.len()];
    let mut summed = vec![false; program.steps.len()];
    let mut count = |operand: Operand, in_sum: bool| {
        if let Operand::Step(index) = operand {
            uses[index] += 1;
            summed[index] |= in_sum;
        }
    };
    for step in &program.steps {
        let in_sum = matches!(step.op, Op::Add | Op::Sub);
        count(step.a, in_sum);
        if step.op.row().arity == 2 {
            count(step.b, in_sum);
        }
    }
    for element in program.outputs.iter().flat_map(|output| &output.elements) {
        count(*element, false);
    }
    let mut sizes: Vec<usize> = Vec::with_capacity(program.steps.len());
    let mut inline = Vec::with_capacity(program.steps.len());
    for (index, step) in program.steps.iter().enumerate() {
        let size = |operand: Operand| match operand {
            Operand::Step(index) if inline[index] => sizes[index],
            _ => 0,
        };
        let own = match step.op.row().arity {
            1 => 1 + size(step.a),
            _ => 1 + size(step.a) + size(step.b),
        };
        let fusible = step.op == Op::Mul && summed[index];
        sizes.push(own);
        inline.push(uses[index] == 1 && (own <= INLINE || fusible));
    }
    inline
}
