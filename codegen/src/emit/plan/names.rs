//! What the values of a kernel are called: each name once.

use std::collections::{HashMap, HashSet};

use ulna::Argument;

use crate::graph::AngleSum;
use crate::op::Op;
use crate::schedule::{Operand, Program};

/// Names as they are given, each once.
pub(super) struct Names<'p> {
    program: &'p Program,
    taken: HashSet<String>,
    /// Of each step that is a term of one value and nothing else, that value: a step that has a label.
    sums: Vec<Option<usize>>,
    /// How many terms of a value have been named.
    terms: HashMap<usize, usize>,
    /// How many values without a label there are.
    numbered: usize,
}

impl<'p> Names<'p> {
    /// None yet, but those of arguments, sines and cosines, and of what generated code has besides.
    pub(super) fn new(program: &'p Program, angle_names: &[String]) -> Self {
        let arguments = Argument::ALL.map(|argument| argument.name().to_owned());
        let angles = angle_names
            .iter()
            .flat_map(|name| [format!("s{name}"), format!("c{name}")]);
        let taken = arguments.into_iter().chain(angles);
        Self {
            program,
            taken: taken.chain(["state".to_owned()]).collect(),
            sums: sums(program),
            terms: HashMap::new(),
            numbered: 0,
        }
    }

    /// Takes `names` for other things.
    pub(super) fn reserve(&mut self, names: impl Iterator<Item = String>) {
        self.taken.extend(names);
    }

    /// A name for a step: its label, or that of the value that it is a term of and a number, with a letter more if that is taken;
    /// or else a number.
    pub(super) fn name(&mut self, step: usize) -> String {
        let label = |step: usize| self.program.labels[step].as_ref();
        let mut name = match (label(step), self.sums[step]) {
            (Some(own), _) => own.text.clone(),
            (None, Some(sum)) => {
                let term = self.terms.entry(sum).or_default();
                *term += 1;
                let sum = label(sum).map_or("", |label| &label.text);
                format!("{sum}_term{term}")
            }
            (None, None) => {
                self.numbered += 1;
                return format!("t{}", self.numbered);
            }
        };
        while !self.taken.insert(name.clone()) {
            name.push('b');
        }
        name
    }
}

/// Of each step that only one other needs, and that one to add it to something, the next step on the way that has a label.
fn sums(program: &Program) -> Vec<Option<usize>> {
    let count = program.steps.len();
    let (mut uses, mut user) = (vec![0_usize; count], vec![None; count]);
    for (index, step) in program.steps.iter().enumerate() {
        let adds = matches!(step.op, Op::Add | Op::Sub | Op::Neg);
        let operands = [step.a, step.b];
        for operand in &operands[..step.op.row().arity] {
            if let Operand::Step(used) = *operand {
                uses[used] += 1;
                user[used] = adds.then_some(index);
            }
        }
    }
    let outputs = program.outputs.iter();
    for element in outputs.flat_map(|output| &output.elements) {
        if let Operand::Step(used) = *element {
            uses[used] += 1;
            user[used] = None;
        }
    }
    let mut sums = vec![None; count];
    for step in (0..count).rev() {
        let next = user[step].filter(|_| uses[step] == 1);
        sums[step] = next.and_then(|next: usize| match program.labels[next] {
            Some(_) => Some(next),
            None => sums[next],
        });
    }
    sums
}

/// A short name for each angle: the joints' numbers, from 1.
pub(super) fn angle_names(angles: &[AngleSum]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for angle in angles {
        let numbers: Vec<String> = angle.joints.iter().map(|i| (i + 1).to_string()).collect();
        let separator = if angle.joints.iter().all(|i| *i < 9) {
            ""
        } else {
            "_"
        };
        let mut name = numbers.join(separator);
        while names.contains(&name) {
            name.push('b');
        }
        names.push(name);
    }
    names
}
