//! From a robot arm's table to unrolled Rust: the generator of ulna.
//!
//! The stages, in the order in which an arm passes through them:
//!
//! | stage | from | to |
//! |---|---|---|
//! | [`formulate`] | [`ulna::Model`] | named outputs on a [`graph`], differentiated there ([`differentiate`]) |
//! | [`schedule`] | outputs on a graph | a straight-line [`Program`] |
//! | [`emit`] | programs | Rust |
//!
//! A build script calls [`compile_arms`]; the macro and the command line call [`generate`].

pub mod build;
pub mod cost;
pub mod differentiate;
pub mod emit;
mod fold;
pub mod formulate;
pub mod graph;
pub mod interpret;
pub mod op;
pub mod schedule;

use ulna::Model;

pub use build::{Error, compile_arms, compile_folder};
pub use cost::Counts;
pub use emit::Generated;
pub use interpret::Interpreter;
pub use schedule::Program;

use formulate::chain::Chain;
use formulate::{Frames, QUANTITIES, Quantity};
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
}

/// The whole way from a model to Rust. `source` is the table's path.
///
/// Its last part stands in the header, and no more of it: the same table gives the same bytes, wherever it is read from.
pub fn generate(model: &Model, source: &str) -> Generated {
    let methods = compile(model);
    let file_name = source.rsplit(std::path::is_separator).next();
    Generated::new(model, file_name.unwrap_or(source), &methods)
}

/// Every method of [`ulna::Arm`] that needs arithmetic, as a program.
pub fn compile(model: &Model) -> Vec<Method> {
    let frames = cheapest_frames(model);
    let method = |quantity: &Quantity| Method {
        name: quantity.method,
        doc: quantity.doc,
        arguments: quantity.arguments,
        program: compile_quantity(model, quantity, frames),
    };
    QUANTITIES.iter().map(method).collect()
}

fn compile_quantity(model: &Model, quantity: &Quantity, frames: Frames) -> Program {
    let graph = Graph::new();
    let chain = Chain::new(&graph, model);
    schedule::schedule(&graph, &(quantity.formulate)(&chain, frames))
}

/// Tries the Jacobian in every frame, and keeps the cheapest for J itself and for w_D.
fn cheapest_frames(model: &Model) -> Frames {
    let groups = Chain::new(&Graph::new(), model).groups.len();
    let cost = |method: &str, frames: Frames| {
        let quantity = QUANTITIES.iter().find(|quantity| quantity.method == method);
        quantity.map(|quantity| compile_quantity(model, quantity, frames).steps.len())
    };
    let cheapest = |method: &str, frames: fn(usize) -> Frames| {
        let groups = 0..=groups;
        groups
            .min_by_key(|group| cost(method, frames(*group)))
            .unwrap_or(0)
    };
    Frames {
        world: cheapest("geometric_jacobian", |world| Frames { world, task: 0 }),
        task: cheapest("dynamic_manipulability_gradient", |task| Frames {
            world: task,
            task,
        }),
    }
}
