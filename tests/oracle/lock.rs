//! The impact torques of each joint's lock against 40 digits (`golden_lock.py`).

use serde::Deserialize;
use ulna::Arm;
use ulna::proof::State;

use crate::{Errors, read, states};

/// A line of `data/<arm>.lock.jsonl`.
#[derive(Deserialize)]
struct Lock {
    lock_impacts: Vec<f64>,
}

/// What rounding may leave, relative to the largest entry.
const TOLERANCE: f64 = 1e-12;

pub(crate) fn agrees<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let mut errors = Errors::default();
    let exact = read::<Lock>(&format!("{name}.lock.jsonl"));
    for (State { q, qd, qdd, .. }, exact) in states(name).into_iter().zip(exact) {
        let impacts = arm.lock_impacts(&q, &qd, &qdd);
        errors.record("lock impacts", impacts.iter().copied(), &exact.lock_impacts);
    }
    errors.check(&format!("{backend} {name}"), TOLERANCE);
}
