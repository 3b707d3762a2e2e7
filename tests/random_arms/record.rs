//! w_D and its gradient of many arms, written for another judge: `tests/oracle/judge_random_arms.py`.

use std::fs::File;
use std::io::{BufWriter, Write as _};

use nalgebra::SVector;
use serde::Serialize;
use ulna::SerialChain;
use ulna_codegen::Interpreter;

/// How many configurations of each arm are recorded.
pub(crate) const SAMPLES: usize = 20;

/// One configuration of an arm, by both roads.
pub(crate) struct Sample {
    q: Vec<f64>,
    programs: Manipulability,
    textbook: Manipulability,
}

#[derive(Serialize)]
struct Manipulability {
    w: f64,
    gradient: Vec<f64>,
}

/// A line of the file.
#[derive(Serialize)]
struct Line<'s> {
    index: u64,
    table: &'s str,
    q: Vec<&'s [f64]>,
    /// The generated programs'.
    results: Vec<&'s Manipulability>,
    textbook: Vec<&'s Manipulability>,
}

impl Manipulability {
    fn of<const N: usize>(arm: &impl ulna::Arm<N>, q: &SVector<f64, N>) -> Self {
        let (w, gradient) = arm.dynamic_manipulability_gradient(q);
        Self {
            w,
            gradient: gradient.as_slice().to_vec(),
        }
    }
}

impl Sample {
    pub(crate) fn of<const N: usize>(
        programs: &Interpreter<N>,
        chain: &SerialChain<N>,
        q: &SVector<f64, N>,
    ) -> Self {
        Self {
            q: q.as_slice().to_vec(),
            programs: Manipulability::of(programs, q),
            textbook: Manipulability::of(chain, q),
        }
    }
}

/// The file, a line for each arm.
pub(crate) struct Record(BufWriter<File>);

impl Record {
    pub(crate) fn create(path: &str) -> Self {
        let file = File::create(path).unwrap_or_else(|error| panic!("{path}: {error}"));
        Self(BufWriter::new(file))
    }

    pub(crate) fn add(&mut self, index: u64, table: &str, samples: &[Sample]) {
        let line = Line {
            index,
            table,
            q: samples.iter().map(|sample| &sample.q[..]).collect(),
            results: samples.iter().map(|sample| &sample.programs).collect(),
            textbook: samples.iter().map(|sample| &sample.textbook).collect(),
        };
        let text = serde_json::to_string(&line).unwrap_or_else(|error| panic!("{error}"));
        writeln!(self.0, "{text}").unwrap_or_else(|error| panic!("{error}"));
    }
}
