//! [`AnyJit`]: an arm whose number of joints is known at run time.

use std::fmt;
use std::sync::Arc;

use ulna::internal::{admit, carry};
use ulna::{Method, MethodSet, Payload, PayloadError, TaskRows};
use ulna_codegen::Compiled;
use ulna_table::Model;

use crate::host::Host;
use crate::kernel::{Kernel, MAX_PARTS};
use crate::{CallError, Error, shape};

/// An arm's methods as machine code, by method and slices, for who learns the number of joints at run time.
///
/// A clone shares the code, which is freed with the last of them. Calls need no more than `&self`, from any thread, and allocate
/// nothing for joint coordinates within [`PLAIN_LIMIT`](ulna::arm::PLAIN_LIMIT).
///
/// ```
/// use ulna::Method;
/// use ulna_jit::AnyJit;
/// use ulna_table::Model;
///
/// let arm = AnyJit::compile(&Model::load("../arms/planar_2r.toml")?)?;
/// assert_eq!(arm.shape(Method::MassMatrix), [[2, 2]]);
/// let mut masses = [0.0; 4];
/// arm.call(Method::MassMatrix, &[&[0.3, -0.7]], &mut masses)?;
/// assert!(masses[0] > 0.0 && masses[1] == masses[2]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct AnyJit {
    made: Arc<Made>,
    payload: Payload,
    /// The payload's, as kernels read them.
    parameters: [f64; Payload::PARAMETERS],
}

/// What all clones share.
struct Made {
    model: Model,
    /// By method, in the order of [`Method::ALL`].
    kernels: Vec<Option<Kernel>>,
}

impl fmt::Debug for AnyJit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AnyJit")
            .field("name", &self.name())
            .field("joints", &self.joints())
            .finish_non_exhaustive()
    }
}

impl AnyJit {
    /// Every method of the arm of `model`.
    ///
    /// # Errors
    /// When there is no machine code for this machine, or no memory for it.
    pub fn compile(model: &Model) -> Result<Self, Error> {
        Self::of(model, &ulna_codegen::compile(model))
    }

    /// Those methods of the arm of `model` that are among the programs `compiled` of it.
    ///
    /// # Errors
    /// As [`compile`](Self::compile); and when the programs are those of another arm.
    pub fn of(model: &Model, compiled: &Compiled) -> Result<Self, Error> {
        let host = Host::new()?;
        let joints = model.joints().len();
        let mut kernels: Vec<Option<Kernel>> = Method::ALL.iter().map(|_| None).collect();
        for found in &compiled.methods {
            let kernel = Kernel::new(&host, found.method, &found.program, joints)?;
            kernels[found.method as usize] = Some(kernel);
        }
        Ok(Self {
            parameters: Payload::NONE.parameters(model.tool()),
            payload: Payload::NONE,
            made: Arc::new(Made {
                model: model.clone(),
                kernels,
            }),
        })
    }

    /// The arm with `payload` at its tool.
    ///
    /// # Errors
    /// When the arm cannot carry it, or its table gives it no payload at run time.
    pub fn carrying(&self, payload: &Payload) -> Result<Self, PayloadError> {
        let model = self.model();
        if !model.has_payload() && *payload != Payload::NONE {
            return Err(PayloadError::NotAtRunTime);
        }
        let mut joints = model.joints().to_vec();
        carry(&mut joints, model.tool(), payload);
        admit(&joints)?;
        Ok(Self {
            parameters: payload.parameters(model.tool()),
            payload: *payload,
            made: Arc::clone(&self.made),
        })
    }

    /// The payload at its tool.
    pub fn payload(&self) -> Payload {
        self.payload
    }

    /// What it was made of.
    pub fn model(&self) -> &Model {
        &self.made.model
    }

    /// The arm's name.
    pub fn name(&self) -> &str {
        self.model().name()
    }

    /// How many joints it has.
    pub fn joints(&self) -> usize {
        self.model().joints().len()
    }

    /// The names of its joints, base first.
    pub fn joint_names(&self) -> &[String] {
        self.model().joint_names()
    }

    /// The rows of J in w_D.
    pub fn task(&self) -> TaskRows {
        self.model().task()
    }

    /// The methods that are compiled.
    pub fn methods(&self) -> MethodSet {
        let compiled = Method::ALL.iter().copied();
        let compiled: Vec<Method> = compiled
            .filter(|method| self.kernel(*method).is_some())
            .collect();
        MethodSet::of(&compiled)
    }

    /// Bytes of machine code and of the constants that it reads.
    pub fn code_size(&self) -> usize {
        self.made.kernels.iter().flatten().map(Kernel::size).sum()
    }

    /// The parts of a method's result, each as `[]` (a number), `[length]`, `[rows, columns]` or `[how many, rows, columns]`.
    ///
    /// A pose is its rotation, `[3, 3]`, and its translation, `[3]`; of many poses each is `[3, 4]`, the translation its last column.
    pub fn shape(&self, method: Method) -> Vec<Vec<usize>> {
        shape::shape(method, self.joints())
    }

    /// How many numbers a method's result has, all parts together.
    pub fn length(&self, method: Method) -> usize {
        shape::lengths(&self.shape(method)).iter().sum()
    }

    /// Writes a method's result for `arguments`, in the order of [`Method::arguments`]: part after part, matrices by columns.
    ///
    /// # Errors
    /// A slice of another length, or a method that is not compiled; nothing is written then.
    pub fn call(
        &self,
        method: Method,
        arguments: &[&[f64]],
        result: &mut [f64],
    ) -> Result<(), CallError> {
        let call = self.prepared(method, arguments)?;
        for (argument, slice) in method.arguments().iter().zip(arguments) {
            check(argument.name(), slice.len(), argument.length(self.joints()))?;
        }
        check("result", result.len(), call.lengths.iter().sum())?;
        call.run(self, arguments, result);
        Ok(())
    }

    /// As [`call`](Self::call), for many states: each argument has those of one state after those of the other, and so have `results`.
    ///
    /// # Errors
    /// As there; the first argument tells how many states there are.
    pub fn call_batch(
        &self,
        method: Method,
        arguments: &[&[f64]],
        results: &mut [f64],
    ) -> Result<(), CallError> {
        let call = self.prepared(method, arguments)?;
        let length: usize = call.lengths.iter().sum();
        let lengths = method
            .arguments()
            .iter()
            .map(|argument| argument.length(self.joints()));
        let lengths: Vec<usize> = lengths.collect();
        let states = match (arguments, lengths.as_slice()) {
            ([first, ..], [own, ..]) => first.len() / own,
            _ => 0,
        };
        for ((argument, slice), own) in method.arguments().iter().zip(arguments).zip(&lengths) {
            check(argument.name(), slice.len(), states * own)?;
        }
        check("result", results.len(), states * length)?;
        let mut own: Vec<&[f64]> = arguments.to_vec();
        for (state, result) in results.chunks_exact_mut(length).enumerate() {
            for ((own, all), length) in own.iter_mut().zip(arguments).zip(&lengths) {
                *own = &all[state * length..][..*length];
            }
            call.run(self, &own, result);
        }
        Ok(())
    }

    fn prepared(&self, method: Method, arguments: &[&[f64]]) -> Result<Prepared<'_>, CallError> {
        let kernel = self.kernel(method).ok_or(CallError::NotCompiled(method))?;
        let expected = method.arguments().len();
        if arguments.len() != expected {
            return Err(CallError::Arguments {
                method,
                expected,
                given: arguments.len(),
            });
        }
        Ok(Prepared {
            kernel,
            lengths: kernel.parts(),
        })
    }

    /// The code of a method, if it is compiled.
    #[inline]
    pub(crate) fn kernel(&self, method: Method) -> Option<&Kernel> {
        self.made.kernels[method as usize].as_ref()
    }

    /// The payload's parameters.
    #[inline]
    pub(crate) fn parameters(&self) -> &[f64; Payload::PARAMETERS] {
        &self.parameters
    }
}

/// A call whose arguments are still to be checked.
struct Prepared<'a> {
    kernel: &'a Kernel,
    /// Of the result's parts.
    lengths: &'a [usize],
}

impl Prepared<'_> {
    fn run(&self, arm: &AnyJit, arguments: &[&[f64]], result: &mut [f64]) {
        result.fill(0.0);
        let mut parts: [&mut [f64]; MAX_PARTS] = Default::default();
        let mut rest = result;
        for (part, length) in parts.iter_mut().zip(self.lengths) {
            (*part, rest) = rest.split_at_mut(*length);
        }
        let parts = &mut parts[..self.lengths.len()];
        let (model, payload) = (arm.model(), arm.parameters());
        match *arguments {
            [a] => self.kernel.run(model, payload, [a], parts),
            [a, b] => self.kernel.run(model, payload, [a, b], parts),
            [a, b, c] => self.kernel.run(model, payload, [a, b, c], parts),
            [a, b, c, d] => self.kernel.run(model, payload, [a, b, c, d], parts),
            _ => {}
        }
    }
}

fn check(slice: &'static str, length: usize, expected: usize) -> Result<(), CallError> {
    if length == expected {
        Ok(())
    } else {
        Err(CallError::Length {
            slice,
            length,
            expected,
        })
    }
}
