//! The generated programs, run as they are without a compiler: `ulna verify` proves a table's code this way.

use std::sync::Arc;

use nalgebra::SVector;
use ulna::internal::{Quantity, coordinates};
use ulna::proof::State;
use ulna::{Arm, Joint, JointKind, Method, Payload, SerialChain, TaskRows};
use ulna_table::{JointCountError, Model};

use crate::accuracy::{Arguments, Scalar};
use crate::double_double::DoubleDouble;
use crate::schedule::Program;
use crate::{Compiled, MethodProgram};

/// An arm that evaluates its programs step by step, in `f64` or, if it is [exact](Self::exact), in 106 bits.
#[derive(Clone, Debug)]
pub struct Interpreter<const N: usize> {
    chain: SerialChain<N>,
    /// The same with its payload: for methods that are not compiled.
    carrying: SerialChain<N>,
    compiled: Arc<Compiled>,
    arithmetic: Arithmetic,
    /// The payload's parameters. Programs of an arm that has none do not read them.
    payload: Vec<f64>,
}

/// What programs are run in; results are rounded to `f64`.
#[derive(Clone, Copy, Debug)]
struct Arithmetic {
    coordinate: fn(JointKind, f64) -> f64,
    run: fn(&Program, Arguments<'_>) -> Vec<f64>,
}

impl Arithmetic {
    fn of<R: Scalar>() -> Self {
        Self {
            coordinate: R::coordinate,
            run: R::run,
        }
    }
}

impl<const N: usize> Interpreter<N> {
    /// The arm of `model`, compiled to programs that run in `f64`.
    ///
    /// # Errors
    /// When the model has another number of joints than `N`.
    pub fn new(model: &Model) -> Result<Self, JointCountError> {
        Self::of(model, crate::compile(model))
    }

    /// The arm of `model` with the programs `compiled` of it; what has none runs by the formulas of [`SerialChain`].
    ///
    /// # Errors
    /// When the model has another number of joints than `N`.
    pub fn of(model: &Model, compiled: Compiled) -> Result<Self, JointCountError> {
        let chain = SerialChain::try_from(model)?;
        Ok(Self {
            chain,
            carrying: chain,
            compiled: Arc::new(compiled),
            arithmetic: Arithmetic::of::<f64>(),
            payload: Payload::NONE.parameters(model.tool()).to_vec(),
        })
    }

    /// The same arm with `payload`, if its table gives it one at run time; [`SerialChain::admit`] tells whether it can carry it.
    #[must_use]
    pub fn carrying(&self, payload: &Payload) -> Self {
        Self {
            payload: payload.parameters(&self.chain.tool).to_vec(),
            carrying: self.chain.carrying(payload),
            ..self.clone()
        }
    }

    /// The same programs without rounding errors but those of their results: they run in numbers of 106 bits.
    pub fn exact(&self) -> Self {
        Self {
            arithmetic: Arithmetic::of::<DoubleDouble>(),
            ..self.clone()
        }
    }

    /// What it runs.
    pub fn compiled(&self) -> &Compiled {
        &self.compiled
    }

    /// A method's result at a state, of which it reads its arguments.
    fn run<T: Quantity>(&self, method: Method, state: &State<N>) -> T {
        let (numbers, is_singular) = self.numbers(method, state);
        let result: T = assembled(&numbers);
        match method.zero_where_singular() {
            Some(zero) if is_singular => result.zero_from(zero),
            _ => result,
        }
    }

    /// The numbers of a method's result, and whether the task is singular, if that matters to the method.
    fn numbers(&self, method: Method, state: &State<N>) -> (Vec<f64>, bool) {
        let State {
            q,
            qd,
            qdd,
            tau,
            wrench,
        } = state;
        let arguments = Arguments {
            q: q.as_slice(),
            qd: qd.as_slice(),
            qdd: qdd.as_slice(),
            tau: tau.as_slice(),
            wrench: wrench.as_slice(),
            payload: &self.payload,
        };
        let mut numbers = numbers(
            &self.compiled,
            method,
            &self.chain.joints,
            arguments,
            self.arithmetic,
        );
        if method.zero_where_singular().is_none() {
            return (numbers, false);
        }
        let volume_squared = numbers.pop().unwrap_or(0.0);
        let q = coordinates(&self.chain, &q.data.0[0]);
        (numbers, self.chain.is_singular(&q, volume_squared))
    }
}

/// All that a method's kernel returns. Apart from the interpreter: it does not depend on the number of joints.
fn numbers(
    compiled: &Compiled,
    method: Method,
    joints: &[Joint],
    arguments: Arguments<'_>,
    arithmetic: Arithmetic,
) -> Vec<f64> {
    let Some(found) = MethodProgram::of(&compiled.methods, method) else {
        return Vec::new();
    };
    let read = joints.iter().zip(arguments.q);
    let q: Vec<f64> = read
        .map(|(joint, q)| (arithmetic.coordinate)(joint.kind, *q))
        .collect();
    (arithmetic.run)(&found.program, Arguments { q: &q, ..arguments })
}

/// A result from its numbers, part by part.
fn assembled<T: Quantity>(mut numbers: &[f64]) -> T {
    let mut result = T::zero();
    for part in 0..T::PARTS {
        let places = result.part_mut(part);
        if let Some((own, rest)) = numbers.split_at_checked(places.len()) {
            places.copy_from_slice(own);
            numbers = rest;
        }
    }
    result
}

macro_rules! define_interpreter {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        impl<const N: usize> Arm<N> for Interpreter<N> {
            fn task(&self) -> TaskRows {
                self.chain.task
            }

            fn rated_torque(&self) -> SVector<f64, N> {
                self.chain.rated_torque()
            }

            $(
                fn $method(&self, $($argument: &ulna::argument_type!([N] $argument)),+) -> $output {
                    if MethodProgram::of(&self.compiled.methods, Method::$variant).is_none() {
                        return self.carrying.$method($($argument),+);
                    }
                    let state = State { $($argument: *$argument,)+ ..State::default() };
                    self.run(Method::$variant, &state)
                }
            )+
        }
    };
}

ulna::methods! { [N] define_interpreter {} }
