//! What the arms of `arms/` cost: a page in Markdown with the operations of the main methods, and the nanoseconds that
//! generated code takes for a call.
//!
//! `cargo bench --bench arms --features all-arms > arms.md`. An arm that is not compiled has its operations counted, and no times.

use std::error::Error;
use std::fs;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use ulna::internal::call;
use ulna::proof::{State, states};
use ulna::{Arm, Instructions, Method};
use ulna_codegen::Generator;
use ulna_table::Model;

/// What most users call.
const METHODS: [Method; 10] = [
    Method::ForwardKinematics,
    Method::GeometricJacobian,
    Method::MassMatrix,
    Method::MassMatrixDerivatives,
    Method::InverseDynamics,
    Method::ForwardDynamics,
    Method::InverseDynamicsDerivatives,
    Method::ForwardDynamicsDerivatives,
    Method::DynamicManipulabilityGradient,
    Method::LockImpacts,
];

/// So many states in turn, that no branch is learnt by heart.
const STATES: usize = 64;

/// Turns of each method, of which the median counts.
const ROUNDS: usize = 101;

/// A turn lasts at least so long, that the clock's steps do not matter.
const TURN: Duration = Duration::from_micros(200);

/// Nanoseconds that a call takes, method by method.
fn times<const N: usize>(arm: &impl Arm<N>, states: &[State<N>]) -> Vec<f64> {
    METHODS
        .iter()
        .map(|method| time(arm, *method, states))
        .collect()
}

fn time<A: Arm<N>, const N: usize>(arm: &A, method: Method, states: &[State<N>]) -> f64 {
    let call = call(method);
    let turn = |repeats: usize| {
        let start = Instant::now();
        for _ in 0..repeats {
            for state in states {
                call(arm, state);
            }
        }
        start.elapsed()
    };
    let mut repeats = 1;
    while turn(repeats) < TURN {
        repeats *= 2;
    }
    let mut turns: Vec<Duration> = (0..ROUNDS).map(|_| turn(repeats)).collect();
    turns.sort();
    turns[ROUNDS / 2].as_secs_f64() * 1e9 / (repeats * states.len()) as f64
}

macro_rules! by_name {
    ($(($Type:ident, $name:ident, $joints:literal))*) => {
        /// The times of an arm, if it is compiled.
        fn times_of(arm: &str) -> Option<Vec<f64>> {
            match arm {
                $(stringify!($name) => {
                    let states: Vec<State<$joints>> = states(&ulna_generated::$Type::CHAIN).take(STATES).collect();
                    Some(times(&ulna_generated::$Type::default(), &states))
                })*
                _ => None,
            }
        }
    };
}
ulna_generated::for_each_arm!(by_name);

/// The tables of `arms/`, in alphabetical order.
fn tables() -> std::io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../arms"))?;
    let paths: Vec<PathBuf> = entries
        .map(|entry| Ok(entry?.path()))
        .collect::<std::io::Result<_>>()?;
    let is_table = |path: &PathBuf| path.extension().is_some_and(|it| it == "toml");
    let mut tables: Vec<PathBuf> = paths.into_iter().filter(is_table).collect();
    tables.sort();
    Ok(tables)
}

/// What the processor calls itself, where the system says so in a file.
fn processor() -> String {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info
        .lines()
        .find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map_or(std::env::consts::ARCH, |(_, name)| name.trim())
        .to_owned()
}

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "Operations, pairs of a sine and a cosine not counted, and nanoseconds a call: generated code, default flags, on {} ({:?}), \
         medians of {ROUNDS} turns.\n",
        processor(),
        Instructions::of_machine(),
    );
    let names = METHODS.map(Method::name).join(" | ");
    println!(
        "| arm | joints | {names} |\n|---|---|{}",
        "---|".repeat(METHODS.len())
    );
    let mut absent = Vec::new();
    for table in tables()? {
        let model = Model::load(&table)?;
        let compiled = Generator::new().methods(&METHODS).generate(&model, "");
        let times = times_of(model.name());
        let cells = METHODS.iter().enumerate().map(|(i, method)| {
            let counted = compiled
                .counts()
                .iter()
                .find(|(counted, _)| counted == method);
            let operations = counted.map_or(0, |(_, counts)| counts.total);
            match &times {
                Some(times) => format!("{operations}, {:.0} ns", times[i]),
                None => operations.to_string(),
            }
        });
        let cells: Vec<String> = cells.collect();
        println!(
            "| {} | {} | {} |",
            model.name(),
            model.joints().len(),
            cells.join(" | ")
        );
        if times.is_none() {
            absent.push(model.name().to_owned());
        }
    }
    if !absent.is_empty() {
        eprintln!(
            "not compiled, and not timed: {}; `--features all-arms` compiles them",
            absent.join(", ")
        );
    }
    Ok(())
}
