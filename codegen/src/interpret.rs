//! The generated programs, run as they are without a compiler: `ulna verify` proves a table's code this way.

use std::marker::PhantomData;
use std::sync::Arc;

use nalgebra::SVector;
use ulna::internal::{Quantity, coordinates};
use ulna::proof::State;
use ulna::{Arm, Method, SerialChain, TaskRows};
use ulna_table::{JointCountError, Model};

use crate::Compiled;
use crate::accuracy::{Scalar, read};
use crate::double_double::DoubleDouble;

/// An arm that evaluates its programs step by step, on the scalars `R`; results are rounded to `f64`.
#[derive(Debug)]
pub struct Interpreter<const N: usize, R = f64> {
    chain: SerialChain<N>,
    compiled: Arc<Compiled>,
    scalar: PhantomData<R>,
}

/// An arm without rounding errors but those of its results: its programs run on numbers of 106 bits.
pub type Exact<const N: usize> = Interpreter<N, DoubleDouble>;

impl<const N: usize> Interpreter<N> {
    /// The arm of `model`, compiled to programs.
    ///
    /// # Errors
    /// When the model has another number of joints than `N`.
    pub fn new(model: &Model) -> Result<Self, JointCountError> {
        Ok(Self {
            chain: SerialChain::try_from(model)?,
            compiled: Arc::new(crate::compile(model)),
            scalar: PhantomData,
        })
    }

    /// The same programs, run without rounding errors.
    pub fn exact(&self) -> Exact<N> {
        Interpreter {
            chain: self.chain,
            compiled: Arc::clone(&self.compiled),
            scalar: PhantomData,
        }
    }
}

impl<const N: usize, R: Scalar> Interpreter<N, R> {
    /// What it runs.
    pub fn compiled(&self) -> &Compiled {
        &self.compiled
    }

    /// A method's result at a state, of which it reads its arguments.
    fn run<T: Quantity>(&self, method: Method, state: &State<N>) -> T {
        let mut result = T::zero();
        let found = &self.compiled.methods;
        let Some(found) = found.iter().find(|found| found.method == method) else {
            return result;
        };
        let program = &found.program;
        let q = R::coordinates(&self.chain, &state.q);
        let others = [&state.qd, &state.qdd, &state.tau].map(SVector::as_slice);
        let numbers = program.evaluate(R::number, |input, angles| {
            read::<R>(input, angles, q.as_slice(), others)
        });
        let mut numbers = numbers.into_iter().map(R::to_f64);
        for part in 0..T::PARTS {
            for (place, number) in result.part_mut(part).iter_mut().zip(&mut numbers) {
                *place = number;
            }
        }
        if let (Some(zero), Some(volume_squared)) = (method.zero_where_singular(), numbers.next()) {
            let q = coordinates(&self.chain, &state.q.data.0[0]);
            if self.chain.is_singular(&q, volume_squared) {
                result = result.zero_from(zero);
            }
        }
        result
    }
}

macro_rules! define_interpreter {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        impl<const N: usize, R: Scalar> Arm<N> for Interpreter<N, R> {
            fn task(&self) -> TaskRows {
                self.chain.task
            }

            fn rated_torque(&self) -> SVector<f64, N> {
                self.chain.rated_torque()
            }

            $(
                fn $method(&self, $($argument: &SVector<f64, N>),+) -> $output {
                    let state = State { $($argument: *$argument,)+ ..State::default() };
                    self.run(Method::$variant, &state)
                }
            )+
        }
    };
}

ulna::methods! { [N] define_interpreter {} }
