//! Arms that are hard on a computation in doubles against exact numbers (`tests/oracle/golden_light.py`): last links with
//! next to no inertia, axes all but parallel, an arm all but stretched out.
//!
//! `cargo test --test oracle_light -- --nocapture` prints the largest errors.

use nalgebra::SVector;
use serde::Deserialize;
use ulna::{Arm, SerialChain};
use ulna_codegen::Interpreter;
use ulna_table::Model;

/// A line of `data/light/<arm>.jsonl`.
#[derive(Deserialize)]
struct Golden {
    q: Vec<f64>,
    w: f64,
    gradient: Vec<f64>,
    condition: f64,
}

/// What rounding may leave of w_D and its gradient, relative to the largest of them.
///
/// Beside an entry of the gradient w_D is small where a singular pose is near, and there no computation keeps its digits.
const TOLERANCE: f64 = 1e-10;

fn golden(name: &str) -> Vec<Golden> {
    let path = format!(
        "{}/oracle/data/light/{name}.jsonl",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let lines = text.lines().map(serde_json::from_str);
    lines
        .map(|line| line.unwrap_or_else(|error| panic!("{path}: {error}")))
        .collect()
}

/// The arm of that name, from beside its numbers or from `arms/`.
fn model(folder: &str, name: &str) -> Model {
    let path = format!("{}/{folder}/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Model::load(path).unwrap_or_else(|errors| panic!("{errors}"))
}

#[track_caller]
fn agrees<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let (mut largest, mut at) = (0.0, String::new());
    for Golden {
        q,
        w: exact,
        gradient: slopes,
        condition,
    } in golden(name)
    {
        let (w, gradient) = arm.dynamic_manipulability_gradient(&SVector::from_column_slice(&q));
        let alone = arm.dynamic_manipulability(&SVector::from_column_slice(&q));
        assert_eq!(gradient.len(), slopes.len());
        let scale = slopes.iter().fold(exact, |scale, x| scale.max(x.abs()));
        let pairs = gradient.iter().zip(&slopes);
        for (actual, exact) in pairs.chain([(&w, &exact), (&alone, &exact)]) {
            let error = (actual - exact).abs() / scale;
            if error.is_nan() || error > largest {
                largest = error;
                at = format!("{actual:e} for {exact:e} at q = {q:?}, condition {condition:.0e}");
            }
        }
    }
    println!("{backend:9} {name:20} {largest:8.1e}  {at}");
    assert!(
        largest <= TOLERANCE,
        "{backend} {name}: {largest:.1e}, {at}"
    );
}

macro_rules! arms {
    ($folder:literal: $($name:ident $joints:literal)*) => {
        $(mod $name {
            use super::{Interpreter, SerialChain, agrees, model};

            #[test]
            fn textbook_agrees_with_exact_numbers() {
                let chain = SerialChain::<$joints>::try_from(&model($folder, stringify!($name)));
                agrees("textbook", stringify!($name), &chain.unwrap_or_else(|error| panic!("{error}")));
            }

            #[test]
            fn programs_agree_with_exact_numbers() {
                let programs = Interpreter::<$joints>::new(&model($folder, stringify!($name)));
                agrees("programs", stringify!($name), &programs.unwrap_or_else(|error| panic!("{error}")));
            }
        })*
    };
}

arms!("arms": planar_2r 2);
arms!("oracle/data/light":
    two_1e_4 2
    two_1e_6 2
    two_1e_8 2
    two_1e_10 2
    six_position_1e_6 6
    six_position_1e_8 6
    six_position_1e_10 6
    six_pose_1e_6 6
    six_pose_1e_8 6
    six_pose_1e_10 6
    mixed_1e_6 4
    mixed_1e_8 4
    parallel_turns 2
    parallel_reach 2
);
