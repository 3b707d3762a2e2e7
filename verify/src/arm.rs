//! [`Sides`]: an arm of `N` joints on every road. All that is compiled for each `N`.

use std::iter;

use ulna::proof::{self, State, differences};
use ulna::{Arm, MethodSet, SerialChain};
use ulna_codegen::{Compiled, Interpreter};
use ulna_table::{JointCountError, Model};

use crate::Verified;
use crate::states::States;

/// The sides that are compared, and states to compare them at.
pub(crate) struct Sides<const N: usize> {
    methods: MethodSet,
    /// The programs in doubles.
    emitted: Interpreter<N>,
    /// The programs in 106 bits.
    exact: Interpreter<N>,
    textbook: SerialChain<N>,
    next: Box<dyn Iterator<Item = State<N>> + Send + Sync>,
    drawn: Vec<State<N>>,
}

impl<const N: usize> Sides<N> {
    /// Those of the arm of `model`.
    pub(crate) fn boxed(
        model: &Model,
        compiled: Compiled,
    ) -> Result<Box<dyn States>, JointCountError> {
        let methods = compiled.generated();
        let mut textbook: SerialChain<N> = SerialChain::try_from(model)?;
        let mut emitted: Interpreter<N> = Interpreter::of(model, compiled)?;
        if model.has_payload() {
            let payload = proof::payload(&textbook);
            emitted = emitted.carrying(&payload);
            textbook = textbook.carrying(&payload);
        }
        Ok(Box::new(Self {
            methods,
            exact: emitted.exact(),
            emitted,
            next: Box::new(proof::states(&textbook)),
            textbook,
            drawn: Vec::new(),
        }))
    }

    fn compare(&self, state: Option<State<N>>) -> Verified {
        let Self {
            methods,
            emitted,
            exact,
            textbook: chain,
            ..
        } = self;
        let reported = |candidate: &dyn Arm<N>| {
            proof::compare_methods(*methods, candidate, exact, chain, state)
        };
        Verified {
            emitted: reported(emitted),
            textbook: reported(chain),
            differences: differences::compare_methods(*methods, emitted, chain, state),
        }
    }
}

impl<const N: usize> States for Sides<N> {
    fn draw(&mut self, count: usize) {
        let next = iter::repeat_with(|| self.next.next()).take(count);
        self.drawn = next.flatten().collect();
    }

    fn at(&self, index: usize) -> Verified {
        self.compare(self.drawn.get(index).copied())
    }

    fn nowhere(&self) -> Verified {
        self.compare(None)
    }
}
