//! Every arm of `arms/` that there are numbers for, by the textbook and as compiled, against those made outside: Pinocchio's, and mpmath's to 40 digits
//! (the scripts beside this file). A module for each family of quantities, whose numbers stand in `data/<arm>.<family>.jsonl`.
//!
//! `cargo test --test oracle -- --nocapture` prints the largest errors.

mod derivatives;
mod dynamics;
mod lock;
mod manipulability;
mod motion;
mod payload;
mod regressor;

use nalgebra::{SMatrix, SVector};
use serde::Deserialize;
use ulna::SerialChain;
use ulna::proof::State;
use ulna_table::Model;

fn read<Line: for<'a> Deserialize<'a>>(file: &str) -> Vec<Line> {
    let path = format!("{}/oracle/data/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let lines: Vec<Line> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{path}: {error}")))
        .collect();
    assert_eq!(lines.len(), 100, "{path}");
    lines
}

fn chain<const N: usize>(name: &str) -> SerialChain<N> {
    let path = format!("{}/../arms/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let model = Model::load(path).unwrap_or_else(|errors| panic!("{errors}"));
    SerialChain::try_from(&model).unwrap_or_else(|error| panic!("{error}"))
}

/// The largest errors seen, by quantity.
#[derive(Default)]
struct Errors(Vec<(&'static str, f64)>);

impl Errors {
    /// The largest difference, relative to the largest expected entry (to 1 where all of them are 0).
    fn record(
        &mut self,
        quantity: &'static str,
        actual: impl IntoIterator<Item = f64>,
        expected: &[f64],
    ) {
        self.record_conditioned(quantity, actual, expected, 1.0);
    }

    /// The same of a quantity whose rounding a condition number multiplies: over that number.
    fn record_conditioned(
        &mut self,
        quantity: &'static str,
        actual: impl IntoIterator<Item = f64>,
        expected: &[f64],
        condition: f64,
    ) {
        let actual: Vec<f64> = actual.into_iter().collect();
        assert_eq!(actual.len(), expected.len(), "{quantity}");
        let scale = expected.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
        let difference = actual.iter().zip(expected).fold(0.0_f64, |max, (a, e)| {
            assert!(!a.is_nan(), "{quantity} is NaN");
            max.max((a - e).abs())
        });
        let error = if scale == 0.0 {
            difference
        } else {
            difference / (scale * condition)
        };
        match self.0.iter_mut().find(|(name, _)| *name == quantity) {
            Some((_, largest)) => *largest = largest.max(error),
            None => self.0.push((quantity, error)),
        }
    }

    #[track_caller]
    fn check(&self, arm: &str, tolerance: f64) {
        for (quantity, error) in &self.0 {
            println!("{arm:28} {quantity:18} {error:8.1e}");
        }
        for (quantity, error) in &self.0 {
            assert!(
                *error <= tolerance,
                "{arm}: {quantity} is off by {error:.1e}"
            );
        }
    }
}

fn row_by_row<const R: usize, const C: usize>(matrix: &SMatrix<f64, R, C>) -> Vec<f64> {
    matrix.transpose().iter().copied().collect()
}

fn upper_triangle<const N: usize>(matrix: &SMatrix<f64, N, N>) -> Vec<f64> {
    let entries = (0..N).flat_map(|r| (r..N).map(move |c| (r, c)));
    entries.map(|entry| matrix[entry]).collect()
}

/// The arguments at which every family's numbers were made: a line of `data/<arm>.jsonl`.
#[derive(Deserialize)]
struct Arguments {
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    tau: Vec<f64>,
}

/// The arguments, as vectors.
fn states<const N: usize>(name: &str) -> Vec<State<N>> {
    let lines = read::<Arguments>(&format!("{name}.jsonl"));
    let vector = |numbers: &[f64]| SVector::from_column_slice(numbers);
    lines
        .iter()
        .map(|line| State {
            q: vector(&line.q),
            qd: vector(&line.qd),
            qdd: vector(&line.qdd),
            tau: vector(&line.tau),
            ..State::default()
        })
        .collect()
}

include!(concat!(env!("OUT_DIR"), "/tables.rs"));
include!(concat!(env!("OUT_DIR"), "/measured.rs"));

macro_rules! of_tables {
    ($(($name:ident, $n:literal))*) => {
        mod generic {
            $(if_measured! { $name {
                mod $name {
                    crate::both!("generic", stringify!($name), crate::chain::<$n>(stringify!($name)));
                }
            } })*
        }
    };
}

macro_rules! compiled {
    ($(($Type:ident, $name:ident, $n:literal))*) => {
        mod generated {
            $(if_measured! { $name {
                mod $name {
                    crate::both!("generated", stringify!($name), ulna_generated::$Type::default());
                }
            } })*
        }
    };
}

macro_rules! both {
    ($backend:literal, $name:expr, $arm:expr) => {
        #[test]
        fn dynamics() {
            crate::dynamics::agrees($backend, $name, &$arm);
        }

        #[test]
        fn lock() {
            crate::lock::agrees($backend, $name, &$arm);
        }

        #[test]
        fn manipulability() {
            crate::manipulability::agrees($backend, $name, &$arm);
        }

        #[test]
        fn regressor() {
            crate::regressor::agrees($backend, $name, &$arm);
        }

        #[test]
        fn derivatives() {
            crate::derivatives::agrees($backend, $name, &$arm);
        }

        #[test]
        fn motion() {
            crate::motion::agrees($backend, $name, &$arm);
        }
    };
}
use both;

for_each_table!(of_tables);
ulna_generated::for_each_arm!(compiled);
