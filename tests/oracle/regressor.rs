//! The regressor against Pinocchio (`golden_regressor.py`).

use nalgebra::SVector;
use serde::Deserialize;
use ulna::Arm;
use ulna::proof::State;

use crate::{Errors, read, states};

/// A line of `data/<arm>.regressor.jsonl`.
#[derive(Deserialize)]
struct Golden {
    weights: Vec<f64>,
    weighted: Vec<Vec<f64>>,
    #[serde(default)]
    regressor: Vec<Vec<f64>>,
}

/// What rounding may leave, relative to the largest entry of a kind: torques of the mass, of the first moments, of the inertia.
const TOLERANCE: f64 = 1e-12;

/// Columns of a kind.
const KINDS: [(&str, std::ops::Range<usize>); 3] =
    [("Y of m", 0..1), ("Y of m c", 1..4), ("Y of I", 4..10)];

pub(crate) fn agrees<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let mut errors = Errors::default();
    let golden = read::<Golden>(&format!("{name}.regressor.jsonl"));
    let mut in_full = 0;
    for (state, golden) in states::<N>(name).into_iter().zip(golden) {
        let State { q, qd, qdd, .. } = state;
        let blocks = arm.regressor(&q, &qd, &qdd);
        let weights = SVector::<f64, 10>::from_column_slice(&golden.weights);
        assert_eq!(golden.weighted.len(), N);
        for (block, expected) in blocks.iter().zip(&golden.weighted) {
            let actual = block * weights;
            errors.record("Y times weights", actual.iter().copied(), expected);
        }
        if golden.regressor.is_empty() {
            continue;
        }
        let base = arm.base_regressor(&q, &qd, &qdd);
        assert_eq!(golden.regressor.len(), N);
        for (link, expected) in golden.regressor.iter().enumerate() {
            in_full += 1;
            for (kind, columns) in KINDS {
                let expected = &expected[columns.start * N..columns.end * N];
                let actual = blocks[link].columns_range(columns.clone());
                errors.record(kind, actual.iter().copied(), expected);
            }
            let base_columns = base[link].column_iter().zip(expected.chunks(N));
            for (column, expected) in base_columns.filter(|(column, _)| column.amax() > 0.0) {
                errors.record("base columns", column.iter().copied(), expected);
            }
        }
    }
    assert_eq!(in_full, 5 * N);
    errors.check(&format!("{backend} {name}"), TOLERANCE);
}
