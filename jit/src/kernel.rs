//! A method of an arm as machine code, with what is to be done before and after it.

use ulna::arm::singular::{counts_as_zero, least_volume_squared};
use ulna::internal::{coordinate, is_plain};
use ulna::{Method, Payload};
use ulna_codegen::Program;
use ulna_table::Model;

use crate::Error;
use crate::code::{Code, MAX_INPUTS, MAX_RESULTS};
use crate::host::Host;
use crate::translate::{ARGUMENTS, CONSTANTS, PAYLOAD, translate};

/// The most parts that a result has.
pub(crate) const MAX_PARTS: usize = MAX_RESULTS - 1;

/// The code of a method.
#[derive(Debug)]
pub(crate) struct Kernel {
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
    pub(crate) fn run<const A: usize>(
        &self,
        model: &Model,
        payload: &[f64; Payload::PARAMETERS],
        arguments: [&[f64]; A],
        parts: &mut [&mut [f64]],
    ) {
        if self.has_q && !is_plain(arguments[0]) {
            self.run_far(model, payload, arguments, parts);
        } else {
            self.run_plain(model, payload, arguments, parts);
        }
    }

    /// As [`run`](Self::run), of coordinates that are not read as they are.
    #[cold]
    fn run_far<const A: usize>(
        &self,
        model: &Model,
        payload: &[f64; Payload::PARAMETERS],
        arguments: [&[f64]; A],
        parts: &mut [&mut [f64]],
    ) {
        let joints = model.joints().iter().zip(arguments[0]);
        let q: Vec<f64> = joints
            .map(|(joint, q)| coordinate(joint.kind, *q))
            .collect();
        let mut arguments = arguments;
        arguments[0] = &q;
        self.run_plain(model, payload, arguments, parts);
    }

    #[inline(always)]
    fn run_plain<const A: usize>(
        &self,
        model: &Model,
        payload: &[f64; Payload::PARAMETERS],
        arguments: [&[f64]; A],
        parts: &mut [&mut [f64]],
    ) {
        let mut inputs: [&[f64]; MAX_INPUTS] = [&[]; MAX_INPUTS];
        inputs[CONSTANTS] = &self.constants;
        inputs[PAYLOAD] = payload;
        inputs[ARGUMENTS..][..A].copy_from_slice(&arguments);
        let inputs = &inputs[..ARGUMENTS + A];
        let Some(zero) = self.zero else {
            self.code.run(inputs, parts);
            return;
        };
        let mut volume_squared = [0.0];
        let mut results: [&mut [f64]; MAX_RESULTS] = Default::default();
        let mut count = 0;
        for part in &mut *parts {
            results[count] = part;
            count += 1;
        }
        results[count] = &mut volume_squared;
        self.code.run(inputs, &mut results[..=count]);
        let q = arguments[0];
        let least = least_volume_squared(model.joints(), model.tool(), model.task(), q);
        if counts_as_zero(volume_squared[0], least, q) {
            parts[zero..].iter_mut().for_each(|part| part.fill(0.0));
        }
    }
}
