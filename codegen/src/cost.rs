//! Counts of operations.

use crate::op::Op;
use crate::schedule::Program;

/// Operations of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Each operator's name and how often it stands in the program, in the order of [`Op::ALL`].
    pub operations: Vec<(&'static str, usize)>,
    /// All of them together; sines and cosines not counted.
    pub total: usize,
    /// Sines and cosines: a pair of the same angle counts once.
    pub sin_cos: usize,
}

impl Counts {
    /// Counts a program's operations.
    pub fn of(program: &Program) -> Self {
        let count = |op: Op| program.steps.iter().filter(|step| step.op == op).count();
        Self {
            operations: Op::ALL
                .iter()
                .map(|op| (op.row().name, count(*op)))
                .collect(),
            total: program.steps.len(),
            sin_cos: program.angles.len(),
        }
    }
}
