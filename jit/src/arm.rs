//! [`Jit`]: machine code as an [`Arm`].

use ulna::internal::Quantity;
use ulna::nalgebra::SVector;
use ulna::{Arm, Method, Payload, PayloadError, SerialChain, TaskRows};
use ulna_codegen::Compiled;
use ulna_table::{JointCountError, Model};

use crate::kernel::{Kernel, MAX_PARTS};
use crate::{AnyJit, Error};

/// An arm of `N` joints whose methods are machine code made at run time; what is not compiled runs by the formulas of [`SerialChain`].
///
/// ```
/// use ulna::Arm as _;
/// use ulna::nalgebra::Vector2;
/// use ulna_jit::Jit;
/// use ulna_table::Model;
///
/// let arm = Jit::<2>::compile(&Model::load("../arms/planar_2r.toml")?)?;
/// let (w, gradient) = arm.dynamic_manipulability_gradient(&Vector2::new(0.3, -0.7));
/// assert!(w > 0.0 && gradient.norm() > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Jit<const N: usize> {
    any: AnyJit,
    /// With its payload: for methods that are not compiled.
    chain: SerialChain<N>,
}

impl<const N: usize> Jit<N> {
    /// Every method of the arm of `model`.
    ///
    /// # Errors
    /// When the model has another number of joints than `N`; and as [`AnyJit::compile`].
    pub fn compile(model: &Model) -> Result<Self, Error> {
        SerialChain::<N>::try_from(model)?;
        Ok(Self::new(AnyJit::compile(model)?)?)
    }

    /// The arm of `model` with the programs `compiled` of it.
    ///
    /// # Errors
    /// As [`compile`](Self::compile).
    pub fn of(model: &Model, compiled: &Compiled) -> Result<Self, Error> {
        SerialChain::<N>::try_from(model)?;
        Ok(Self::new(AnyJit::of(model, compiled)?)?)
    }

    /// An arm that is compiled already.
    ///
    /// # Errors
    /// When it has another number of joints than `N`.
    pub fn new(any: AnyJit) -> Result<Self, JointCountError> {
        let chain = SerialChain::try_from(any.model())?.carrying(&any.payload());
        Ok(Self { any, chain })
    }

    /// The same for any number of joints.
    pub fn any(&self) -> &AnyJit {
        &self.any
    }

    /// The textbook's arm of the same table, with the same payload.
    pub fn chain(&self) -> &SerialChain<N> {
        &self.chain
    }

    /// The arm with `payload` at its tool.
    ///
    /// # Errors
    /// As [`AnyJit::carrying`].
    pub fn carrying(&self, payload: &Payload) -> Result<Self, PayloadError> {
        let any = self.any.carrying(payload)?;
        let chain = match SerialChain::try_from(any.model()) {
            Ok(chain) => chain.carrying(payload),
            Err(_) => self.chain,
        };
        Ok(Self { any, chain })
    }

    /// A method's result by its code.
    #[inline(always)]
    fn run<T: Quantity, const A: usize>(&self, kernel: &Kernel, arguments: [&[f64]; A]) -> T {
        let mut result = T::zero();
        let mut parts: [&mut [f64]; MAX_PARTS] = Default::default();
        let mut count = 0;
        result.give_parts(&mut |part| {
            parts[count] = part;
            count += 1;
        });
        let parts = &mut parts[..count];
        kernel.run(self.any.model(), self.any.parameters(), arguments, parts);
        result
    }
}

macro_rules! define_methods {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        impl<const N: usize> Arm<N> for Jit<N> {
            fn task(&self) -> TaskRows {
                self.chain.task
            }

            fn rated_torque(&self) -> SVector<f64, N> {
                self.chain.rated_torque()
            }

            $(
                fn $method(&self, $($argument: &ulna::argument_type!([N] $argument)),+) -> $output {
                    match self.any.kernel(Method::$variant) {
                        Some(kernel) => self.run(kernel, [$($argument.as_slice()),+]),
                        None => self.chain.$method($($argument),+),
                    }
                }
            )+
        }
    };
}

ulna::methods! { [N] define_methods {} }
