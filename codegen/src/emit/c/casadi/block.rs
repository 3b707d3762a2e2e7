//! A block of a Jacobian: an output by an input, and which of its entries are not 0 at every state.

use ulna::Method;

use crate::double_double::DoubleDouble;
use crate::schedule::{Operand, Output};
use crate::{Compiled, MethodProgram};

/// A matrix by columns, among the numbers of a method's result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Block {
    /// How many rows it has.
    pub(super) rows: usize,
    /// How many columns.
    pub(super) columns: usize,
    /// Where it begins among the result's numbers.
    pub(super) start: usize,
    /// The places in the block of what the program does not know to be 0, in order.
    pub(super) places: Vec<usize>,
}

impl Block {
    /// The last `rows`×`columns` numbers of a part of a method's result; all of the part if it has no more.
    pub(super) fn of(
        compiled: &Compiled,
        method: Method,
        part: usize,
        rows: usize,
        columns: usize,
    ) -> Option<Self> {
        let outputs = &MethodProgram::of(&compiled.methods, method)?
            .program
            .outputs;
        let length = |output: &Output<Operand>| output.elements.len();
        let (before, output) = (&outputs[..part], &outputs[part]);
        let skipped = length(output).checked_sub(rows * columns)?;
        let elements = &output.elements[skipped..];
        let places = elements
            .iter()
            .enumerate()
            .filter(|(_, element)| **element != Operand::Constant(DoubleDouble::default()));
        Some(Self {
            rows,
            columns,
            start: before.iter().map(length).sum::<usize>() + skipped,
            places: places.map(|(place, _)| place).collect(),
        })
    }

    /// A block of which nothing is known to be 0, computed and not part of a result.
    pub(super) fn full(rows: usize, columns: usize) -> Self {
        Self {
            rows,
            columns,
            start: 0,
            places: (0..rows * columns).collect(),
        }
    }

    /// Its sparsity as CasADi has it: rows, columns, where each column begins among the entries, and their rows; a full one is told by a 1.
    pub(super) fn sparsity(&self) -> Vec<usize> {
        if self.places.len() == self.rows * self.columns {
            return vec![self.rows, self.columns, 1];
        }
        let starts = (0..=self.columns).map(|column| {
            self.places
                .partition_point(|place| *place < column * self.rows)
        });
        let rows = self.places.iter().map(|place| place % self.rows);
        [self.rows, self.columns]
            .into_iter()
            .chain(starts)
            .chain(rows)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sparsity_is_compressed_by_columns() {
        let block = Block {
            rows: 2,
            columns: 3,
            start: 0,
            places: vec![1, 4, 5],
        };
        assert_eq!(block.sparsity(), [2, 3, 0, 1, 1, 3, 1, 0, 1]);
        assert_eq!(Block::full(7, 1).sparsity(), [7, 1, 1]);
        let nothing = Block {
            places: Vec::new(),
            ..block
        };
        assert_eq!(nothing.sparsity(), [2, 3, 0, 0, 0, 0]);
    }
}
