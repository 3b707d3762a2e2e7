//! A method of an arm as machine code, with what is to be done before and after it.

use ulna::arm::singular::{counts_as_zero, least_volume_squared};
use ulna::internal::{coordinate, is_plain};
use ulna::{Method, Payload};
use ulna_codegen::Program;
use ulna_table::Model;

use crate::Error;
use crate::angles::Angles;
use crate::code::{Code, MAX_INPUTS, MAX_RESULTS};
use crate::host::Host;
use crate::translate::{ARGUMENTS, CONSTANTS, PAYLOAD, SINES, translate};

/// The code of a method.
#[derive(Debug)]
pub(crate) struct Kernel {
    angles: Angles,
    constants: Vec<f64>,
    code: Code,
    /// The first part of the result that is 0 where the task is singular.
    zero: Option<usize>,
    /// Whether the first argument are joint coordinates.
    has_q: bool,
}

impl Kernel {
    pub(crate) fn new(
        host: &Host,
        method: Method,
        program: &Program,
        joints: usize,
    ) -> Result<Self, Error> {
        let made = translate(host, method, program, joints)?;
        Ok(Self {
            angles: Angles::new(&program.angles),
            code: Code::new(&made)?,
            constants: made.constants,
            zero: method.zero_where_singular(),
            has_q: method.arguments().first() == Some(&ulna::Argument::Q),
        })
    }

    /// How many numbers each part of the result has.
    pub(crate) fn parts(&self) -> &[usize] {
        let results = &self.code.layout().results;
        &results[..results.len() - usize::from(self.zero.is_some())]
    }

    /// Bytes of machine code and of constants.
    pub(crate) fn size(&self) -> usize {
        self.code.len() + size_of_val(self.constants.as_slice())
    }

    /// The method's result for `arguments`, of the right lengths, into `parts`, which are 0.
    #[inline]
    pub(crate) fn run(
        &self,
        model: &Model,
        payload: &[f64; Payload::PARAMETERS],
        arguments: &[&[f64]],
        parts: &mut [&mut [f64]],
    ) {
        match arguments.first() {
            Some(q) if self.has_q && !is_plain(q) => {
                self.run_far(model, payload, arguments, parts);
            }
            _ => self.run_plain(model, payload, arguments, parts),
        }
    }

    /// As [`run`](Self::run), of coordinates that are read as others.
    #[cold]
    fn run_far(
        &self,
        model: &Model,
        payload: &[f64; Payload::PARAMETERS],
        arguments: &[&[f64]],
        parts: &mut [&mut [f64]],
    ) {
        let joints = model.joints().iter().zip(arguments[0]);
        let q: Vec<f64> = joints
            .map(|(joint, q)| coordinate(joint.kind, *q))
            .collect();
        let mut arguments = arguments.to_vec();
        arguments[0] = &q;
        self.run_plain(model, payload, &arguments, parts);
    }

    #[inline]
    fn run_plain(
        &self,
        model: &Model,
        payload: &[f64; Payload::PARAMETERS],
        arguments: &[&[f64]],
        parts: &mut [&mut [f64]],
    ) {
        let q = arguments[0];
        let mut volume_squared = [0.0];
        let count = parts.len();
        self.angles.with_sines(q, |sines| {
            let mut inputs: [&[f64]; MAX_INPUTS] = [&[]; MAX_INPUTS];
            inputs[CONSTANTS] = &self.constants;
            inputs[SINES] = sines;
            inputs[PAYLOAD] = payload;
            inputs[ARGUMENTS..][..arguments.len()].copy_from_slice(arguments);
            let inputs = &inputs[..ARGUMENTS + arguments.len()];
            let mut results: [&mut [f64]; MAX_RESULTS] = Default::default();
            for (result, part) in results.iter_mut().zip(&mut *parts) {
                *result = part;
            }
            let mut written = count;
            if self.zero.is_some() {
                results[count] = &mut volume_squared;
                written += 1;
            }
            self.code.run(inputs, &mut results[..written]);
        });
        if let Some(zero) = self.zero {
            let least = least_volume_squared(model.joints(), model.tool(), model.task(), q);
            if counts_as_zero(volume_squared[0], least, q) {
                parts[zero..].iter_mut().for_each(|part| part.fill(0.0));
            }
        }
    }
}
