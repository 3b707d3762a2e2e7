//! From a robot arm's table to unrolled Rust: the generator of ulna.
//!
//! The stages, in the order in which an arm passes through them:
//!
//! | stage | from | to |
//! |---|---|---|
//! | [`formulate`] | [`ulna_table::Model`] | named outputs on a [`graph`], differentiated there ([`differentiate`]) |
//! | [`schedule`] | outputs on a graph | a straight-line [`Program`] |
//! | [`accuracy`] | programs | their rounding errors, of which the choice of formulas depends |
//! | [`emit`] | programs | Rust |
//!
//! A build script calls [`compile_arms`]; the macro and the command line call [`generate`].

pub mod accuracy;
pub mod build;
mod choose;
pub mod cost;
pub mod differentiate;
pub mod double_double;
pub mod emit;
mod fold;
pub mod formulate;
pub mod graph;
pub mod interpret;
pub mod op;
pub mod schedule;
mod sines;

use ulna_table::Model;

pub use build::{Error, compile_arms, compile_folder};
pub use cost::Counts;
pub use emit::Generated;
pub use interpret::Interpreter;
pub use schedule::Program;

use accuracy::{Conditioned, Yardstick};
use choose::{choose, conditioned};
use formulate::chain::Chain;
use formulate::{Choices, QUANTITIES, Quantity};
use graph::Graph;

/// A method of [`ulna::Arm`] as a program.
#[derive(Debug)]
pub struct Method {
    /// The method's name.
    pub name: &'static str,
    /// What it returns, in a sentence.
    pub doc: &'static str,
    /// Its arguments: some of `q`, `qd`, `qdd`, `tau`.
    pub arguments: &'static [&'static str],
    /// What it computes.
    pub program: Program,
    /// The largest relative error to be expected of it: see [`accuracy`].
    pub error: f64,
}

/// An arm's methods as programs.
#[derive(Debug)]
pub struct Compiled {
    /// Every method of [`ulna::Arm`] that needs arithmetic.
    pub methods: Vec<Method>,
    /// At how many states, random ones and near-singular ones, their errors were measured.
    pub states: [usize; 2],
    /// How exact w_D and ∇w_D are; `None` if they are 0 everywhere.
    pub conditioned: Option<Conditioned>,
    /// What the user should know of the arm.
    pub warnings: Vec<String>,
}

/// The whole way from a model to Rust. `source` is the table's path.
///
/// Its last part stands in the header, and no more of it: the same table gives the same bytes, wherever it is read from.
pub fn generate(model: &Model, source: &str) -> Generated {
    let file_name = source.rsplit(std::path::is_separator).next();
    Generated::new(model, file_name.unwrap_or(source), compile(model))
}

/// Every method of [`ulna::Arm`] that needs arithmetic, as a program.
pub fn compile(model: &Model) -> Compiled {
    let yardstick = Yardstick::new(model);
    let choices = choose(model, &yardstick);
    let method = |quantity: &Quantity| {
        let program = compile_quantity(model, quantity, choices);
        Method {
            name: quantity.method,
            doc: quantity.doc,
            arguments: quantity.arguments,
            error: yardstick.error(&program),
            program,
        }
    };
    let methods: Vec<Method> = QUANTITIES.iter().map(method).collect();
    Compiled {
        conditioned: conditioned(model, &methods, choices, &yardstick),
        methods,
        states: [yardstick.random(), yardstick.near_singular],
        warnings: warnings_of(&yardstick),
    }
}

/// What the user should know of an arm before there is code for it; a sentence each.
pub fn warnings(model: &Model) -> Vec<String> {
    warnings_of(&Yardstick::new(model))
}

fn warnings_of(yardstick: &Yardstick) -> Vec<String> {
    let singular = "w_D is 0 in every configuration: the task's rows of J depend on each other; \
                    leave out of [task] rows what the arm cannot move";
    let found = yardstick.singular_everywhere.then(|| singular.to_owned());
    found.into_iter().collect()
}

fn compile_quantity(model: &Model, quantity: &Quantity, choices: Choices) -> Program {
    let graph = Graph::new();
    let chain = Chain::new(&graph, model);
    schedule::schedule(&graph, &(quantity.formulate)(&chain, choices))
}
