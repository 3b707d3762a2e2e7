//! [`Work`]: a method at many states, in blocks, on one thread or on many; without Python.

use std::mem;

use pyo3::exceptions::PyRuntimeError;
use pyo3::{PyErr, PyResult};
use rayon::prelude::*;
use ulna::Method;

use crate::parts::{Kind, POSE, Part, parts};
use crate::threads::pool;
use ulna_jit::{AnyJit, CallError};

/// States that are computed and laid out together: results that stay in the nearest cache meanwhile, and enough of them that handing
/// a block to a thread costs nothing beside it.
const BLOCK: usize = 256;
/// The fewest that are worth a thread of their own.
const LEAST: usize = 32;

/// An argument's numbers.
#[derive(Clone, Copy)]
pub(crate) enum Numbers<'a> {
    /// State by state.
    OfEach(&'a [f64]),
    /// The same at every state.
    OfAll(&'a [f64]),
}

/// How the matrices of an array stand in memory.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Layout {
    /// As they are computed.
    Columns,
    Rows,
}

/// Where results go.
pub(crate) enum Target<'a> {
    /// As they are computed, state by state.
    Whole(&'a mut [f64]),
    /// Each part to its own place.
    Parts(Vec<(&'a mut [f64], Layout)>),
}

/// A method to be run at `states` states.
pub(crate) struct Work<'a> {
    pub(crate) backend: &'a AnyJit,
    pub(crate) method: Method,
    pub(crate) arguments: Vec<Numbers<'a>>,
    pub(crate) states: usize,
}

/// A few states, and where their results go.
struct Block<'a> {
    first: usize,
    states: usize,
    target: Target<'a>,
}

/// What a thread needs besides.
struct Scratch {
    /// Arguments that are the same at every state, once for each.
    repeated: Vec<Vec<f64>>,
    results: Vec<f64>,
}

impl Work<'_> {
    /// Runs it on so many threads.
    pub(crate) fn run(&self, target: Target<'_>, threads: usize) -> PyResult<()> {
        let least = LEAST.max(self.states.div_ceil(4 * threads));
        let size = least.next_multiple_of(8).min(BLOCK);
        let blocks = self.blocks(target, size);
        if threads == 1 || blocks.len() < 2 {
            let mut scratch = self.scratch(size);
            let mut blocks = blocks.into_iter();
            return blocks
                .try_for_each(|block| self.run_block(&mut scratch, block))
                .map_err(|error| refused(&error));
        }
        pool(threads)?.install(|| {
            let scratch = || self.scratch(size);
            let blocks = blocks.into_par_iter();
            blocks
                .map_init(scratch, |scratch, block| self.run_block(scratch, block))
                .collect::<Result<(), _>>()
                .map_err(|error| refused(&error))
        })
    }

    fn blocks<'t>(&self, mut target: Target<'t>, size: usize) -> Vec<Block<'t>> {
        let joints = self.backend.joints();
        let length = self.backend.length(self.method);
        let firsts = (0..self.states).step_by(size);
        firsts
            .map(|first| {
                let states = size.min(self.states - first);
                let target = match &mut target {
                    Target::Whole(rest) => Target::Whole(taken(rest, states * length)),
                    Target::Parts(rest) => {
                        let parts = parts(self.method).iter().zip(rest);
                        let taken = parts.map(|(part, (rest, layout))| {
                            (taken(rest, states * part.in_array(joints)), *layout)
                        });
                        Target::Parts(taken.collect())
                    }
                };
                Block {
                    first,
                    states,
                    target,
                }
            })
            .collect()
    }

    fn scratch(&self, size: usize) -> Scratch {
        let size = size.min(self.states);
        let repeated = |argument: &Numbers<'_>| match argument {
            Numbers::OfEach(_) => Vec::new(),
            Numbers::OfAll(numbers) => numbers.repeat(size),
        };
        Scratch {
            repeated: self.arguments.iter().map(repeated).collect(),
            results: Vec::new(),
        }
    }

    fn run_block(&self, scratch: &mut Scratch, block: Block<'_>) -> Result<(), CallError> {
        let Block {
            first,
            states,
            target,
        } = block;
        let given = self.arguments.iter().zip(&scratch.repeated);
        let lengths = self.method.arguments().iter();
        let arguments: Vec<&[f64]> = given
            .zip(lengths.map(|argument| argument.length(self.backend.joints())))
            .map(|((argument, repeated), length)| match argument {
                Numbers::OfEach(numbers) => &numbers[first * length..(first + states) * length],
                Numbers::OfAll(_) => &repeated[..states * length],
            })
            .collect();
        match target {
            Target::Whole(results) => self.compute(&arguments, states, results),
            Target::Parts(mut parts) => {
                let length = self.backend.length(self.method);
                scratch.results.resize(states * length, 0.0);
                self.compute(&arguments, states, &mut scratch.results)?;
                self.lay_out(&scratch.results, &mut parts);
                Ok(())
            }
        }
    }

    fn compute(
        &self,
        arguments: &[&[f64]],
        states: usize,
        results: &mut [f64],
    ) -> Result<(), CallError> {
        match states {
            1 => self.backend.call(self.method, arguments, results),
            _ => self.backend.call_batch(self.method, arguments, results),
        }
    }

    /// Results of some states to the arrays of their parts.
    fn lay_out(&self, results: &[f64], targets: &mut [(&mut [f64], Layout)]) {
        let joints = self.backend.joints();
        let length = self.backend.length(self.method);
        let mut begin = 0;
        for (part, (target, layout)) in parts(self.method).iter().zip(targets) {
            let computed = part.computed(joints);
            let states = results.chunks_exact(length);
            let places = target.chunks_exact_mut(part.in_array(joints));
            for (state, place) in states.zip(places) {
                lay_out(
                    part,
                    joints,
                    &state[begin..begin + computed],
                    place,
                    *layout,
                );
            }
            begin += computed;
        }
    }
}

/// The first `length` numbers of `rest`, which loses them.
fn taken<'a>(rest: &mut &'a mut [f64], length: usize) -> &'a mut [f64] {
    let (taken, left) = mem::take(rest).split_at_mut(length);
    *rest = left;
    taken
}

/// A part at one state.
fn lay_out(part: &Part, joints: usize, computed: &[f64], place: &mut [f64], layout: Layout) {
    match part.kind {
        Kind::Pose => {
            let poses = computed.chunks_exact(POSE[0]);
            for (pose, place) in poses.zip(place.chunks_exact_mut(POSE[1])) {
                transpose(pose, 3, &mut place[..POSE[0]]);
                place[POSE[0]..].copy_from_slice(&[0.0, 0.0, 0.0, 1.0]);
            }
        }
        Kind::Matrix(rows, columns) if layout == Layout::Rows => {
            let [rows, columns] = [rows, columns].map(|axis| axis.at(joints));
            let matrices = computed.chunks_exact(rows * columns);
            for (matrix, place) in matrices.zip(place.chunks_exact_mut(rows * columns)) {
                transpose(matrix, rows, place);
            }
        }
        _ => place.copy_from_slice(computed),
    }
}

/// A matrix by columns, of so many rows, by rows.
fn transpose(by_columns: &[f64], rows: usize, by_rows: &mut [f64]) {
    let columns = by_columns.len() / rows;
    for (row, place) in by_rows.chunks_exact_mut(columns).enumerate() {
        let entries = by_columns[row..].iter().step_by(rows);
        place
            .iter_mut()
            .zip(entries)
            .for_each(|(to, from)| *to = *from);
    }
}

/// What no caller can bring about: arguments have been read as the method takes them.
fn refused(error: &CallError) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}
