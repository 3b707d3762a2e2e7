//! From a robot arm's table to unrolled Rust, or C: the generator of ulna.
//!
//! ```no_run
//! // build.rs, with `ulna-codegen` among the build dependencies and `ulna` among the others;
//! // then in src/lib.rs: include!(concat!(env!("OUT_DIR"), "/ssrms.rs"));
//! fn main() -> Result<(), ulna_codegen::Error> {
//!     ulna_codegen::compile_arms(&["arms/ssrms.toml"])
//! }
//! ```
//!
//! What is written is a type, here `Ssrms`, that implements [`ulna::Arm`], and a test that proves it.
//!
//! # Where to go
//!
//! - [`compile_arms`], [`compile_listed`] and [`compile_folder`]: for build scripts. The crate `ulna-macros` does it without one, the program `ulna` by hand.
//! - [`Generator`]: all that for some methods alone.
//! - [`generate`]: a [`Model`] in, [`Generated`] code out, as text or tokens.
//! - [`Generator::generate_c`]: the same arm in C, as a header and a source file ([`GeneratedC`], [`COptions`]).
//! - [`compile`]: the [`Program`]s that code is printed from, for whoever prints them in another way.
//! - [`BaseParameters`]: which combinations of inertial parameters an arm's torques depend on.
//! - [`Interpreter`]: an arm that runs its programs without a compiler, in `f64` or in 106 bits.
//!
//! There are no features.
//!
//! # C
//!
//! [`Generator::generate_c`] writes `NAME.h` and `NAME.c`: C99 without allocation, without a state between calls, and with nothing of a library but
//! `sin`, `cos` and `sqrt` (`sinf`, `cosf`, `sqrtf` in single precision). Each method is a function
//!
//! ```c
//! void NAME_method(const NAME_real q[N], ..., NAME_real result[LENGTH]);
//! ```
//!
//! - The arguments are those of the method of [`ulna::Arm`], whether or not this arm's numbers depend on them. `result` is its result, all parts
//!   one after another, matrices by columns, without anything between; the header says of each function which number stands where.
//!   It must not overlap an argument.
//! - Coordinates are read as every backend reads them, and where the task is [singular](ulna::arm::singular) the same numbers are 0 as in Rust:
//!   for finite coordinates no result is NaN. In single precision the rounding that tells singular poses is that of `float`.
//! - An arm with a payload at run time takes `const NAME_real payload[10]` before `result` in every function, and has a function `NAME_payload`
//!   that makes these numbers of a body's mass, centroid and inertia in the tool's frame. It does not judge them, as [`ulna::Payload::new`] does.
//! - Products and sums stand as they are: the compiler's `-ffp-contract` decides whether they are fused. With `-ffp-contract=off` the
//!   results are those of [`Interpreter`] to the bit where sines are of the same library.
//! - Functions have at most [`COptions::FUNCTION_LENGTH`] statements unless [another number](COptions::function_length) is asked for; longer methods are
//!   several static functions that hand on a structure on the stack.
//!
//! # Inside
//!
//! The stages, in the order in which an arm passes through them:
//!
//! | stage | from | to |
//! |---|---|---|
//! | formulate | [`ulna_table::Model`] | named outputs on a graph, differentiated there |
//! | schedule | outputs on a graph | a straight-line [`Program`] |
//! | accuracy | programs | their rounding errors, on which the choice of formulas depends |
//! | emit | programs | Rust, C |

mod accuracy;
mod base_parameters;
mod build;
mod choose;
mod cost;
mod differentiate;
mod double_double;
mod emit;
mod fold;
mod formulate;
mod generator;
mod graph;
#[doc(hidden)]
pub mod internal;
mod interpret;
mod label;
mod op;
mod schedule;
mod sines;
mod stage;

use ulna::MethodSet;
use ulna_table::{Lint, Model};

pub use accuracy::Conditioned;
pub use base_parameters::{BaseParameter, BaseParameters, Term};
pub use build::{Error, compile_arms, compile_folder, compile_listed};
pub use cost::Counts;
pub use double_double::DoubleDouble;
pub use emit::c::{Abi, COptions, GeneratedC, Precision};
pub use emit::rust::Generated;
pub use generator::{Generator, UnknownMethod};
pub use graph::{AngleSum, Input};
pub use interpret::Interpreter;
pub use label::Label;
pub use op::Op;
pub use schedule::{Operand, Output, Program, Size, Step};
pub use stage::Stage;
pub use ulna::Method;

use accuracy::TestStates;
use choose::{choose, conditioned};
use formulate::Choices;
use formulate::chain::Chain;
use graph::Graph;

/// A method of [`ulna::Arm`] as a program.
#[derive(Debug)]
pub struct MethodProgram {
    /// Which one.
    pub method: Method,
    /// What it computes.
    pub program: Program,
    /// The largest relative error to be expected of its worst entry: 8 times what was measured at random states and near singular poses.
    pub error: f64,
}

impl Compiled {
    /// The methods that are generated.
    pub fn generated(&self) -> MethodSet {
        let methods: Vec<Method> = self.methods.iter().map(|found| found.method).collect();
        MethodSet::of(&methods)
    }
}

impl MethodProgram {
    fn of(methods: &[Self], method: Method) -> Option<&Self> {
        methods.iter().find(|found| found.method == method)
    }
}

/// An arm's methods as programs.
#[derive(Debug)]
pub struct Compiled {
    /// Every method that is generated, in the order of [`Method::ALL`].
    pub methods: Vec<MethodProgram>,
    /// Which columns of the regressor the base regressor keeps, and why.
    pub base_parameters: BaseParameters,
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
    Generator::new().generate(model, source)
}

/// Every method of [`ulna::Arm`] as a program.
pub fn compile(model: &Model) -> Compiled {
    Generator::new().compile(model)
}

/// Those methods as programs; `watch` is told of every step before it is taken.
fn compile_methods(model: &Model, methods: MethodSet, watch: &dyn Fn(Stage)) -> Compiled {
    watch(Stage::Choosing);
    let states = TestStates::new(model);
    let base_parameters = BaseParameters::of(model);
    let choices = Choices {
        base: base_parameters.columns(),
        ..choose(model, &states, methods)
    };
    let methods = methods.iter().map(|method| {
        watch(Stage::Formulating(method));
        let program = compile_method(model, method, choices);
        MethodProgram {
            method,
            error: states.error(&program),
            program,
        }
    });
    let methods: Vec<MethodProgram> = methods.collect();
    Compiled {
        conditioned: conditioned(model, &methods, choices, &states),
        methods,
        base_parameters,
        states: [states.random(), states.near_singular],
        warnings: warnings_of(model, &states),
    }
}

/// What the user should know of an arm before there is code for it, a sentence each, beside what [`Model::lint`] finds.
pub fn warnings(model: &Model) -> Vec<String> {
    warnings_of(model, &TestStates::new(model))
}

fn warnings_of(model: &Model, states: &TestStates) -> Vec<String> {
    let lint = Lint::SingularTask;
    if !states.singular_everywhere || model.allows(lint) {
        return Vec::new();
    }
    vec![format!(
        "w_D is 0 in every configuration: the task's rows of J depend on each other; \
         leave out of [task] rows what the arm cannot move (`allow = [{:?}]` switches this off)",
        lint.name()
    )]
}

fn compile_method(model: &Model, method: Method, choices: Choices) -> Program {
    compile_on(&Graph::new(), model, method, choices)
}

fn compile_on(graph: &Graph, model: &Model, method: Method, choices: Choices) -> Program {
    let chain = Chain::new(graph, model);
    schedule::schedule(graph, &formulate::formulate(method, &chain, choices))
}
