//! The constraints of the program, a function each.

use nalgebra::{DMatrix, DVector, SVector};

use super::part::{Part, Place};
use crate::search::convex::conic::Program;
use crate::search::convex::free_map::FreeMap;

/// `‖h‖ ≤ ε` of a whole map, whose variables begin at `first`.
pub(super) fn keep_force(program: &mut Program, map: &FreeMap, first: usize, budget: f64) {
    keep_force_of(program, map, first + map.null.ncols(), budget);
}

/// The same with the force's own variables beginning at `first`: P z bends nothing.
pub(super) fn keep_force_of(program: &mut Program, map: &FreeMap, first: usize, budget: f64) {
    let null = map.null.ncols();
    let forces = map.force.ncols() - null;
    if forces > 0 {
        let force = map.force.columns(null, forces).into_owned();
        program.cone(&[(first, &force)], &vec![0.0; force.nrows()], budget, None);
    }
}

/// `|planned + T x| ≤ rated` where a rated torque is finite.
pub(super) fn keep_torque(
    program: &mut Program,
    (first, torque): (usize, &DMatrix<f64>),
    planned: &DVector<f64>,
    rated: &DVector<f64>,
) {
    let bound: Vec<usize> = (0..rated.len()).filter(|i| rated[*i].is_finite()).collect();
    if bound.is_empty() {
        return;
    }
    let rows = torque.select_rows(&bound);
    let room = |sign: f64| -> Vec<f64> {
        let room = bound.iter().map(|i| rated[*i] - sign * planned[*i]);
        room.collect()
    };
    program.at_most_from(first, &rows, &room(1.0));
    program.at_most_from(first, &-rows, &room(-1.0));
}

/// `|U₀(next) − U₀| ≤ rate · time`.
pub(super) fn couple<const N: usize>(
    program: &mut Program,
    [(part, place), (next, after)]: [(&Part, &Place); 2],
    time: f64,
    rate: &SVector<f64, N>,
) {
    let bound: Vec<usize> = (0..N).filter(|i| rate[*i].is_finite()).collect();
    if bound.is_empty() {
        return;
    }
    let from = -part.before.torque.select_rows(&bound);
    let to = next.before.torque.select_rows(&bound);
    let room: Vec<f64> = bound.iter().map(|i| rate[*i] * time).collect();
    program.within(&[(place.before, &from), (after.before, &to)], &room);
}

/// `|U₀| ≤ rate · time` at the first moment.
pub(super) fn begin<const N: usize>(
    program: &mut Program,
    (part, place): (&Part, &Place),
    time: f64,
    rate: &SVector<f64, N>,
) {
    let bound: Vec<usize> = (0..N).filter(|i| rate[*i].is_finite()).collect();
    if !bound.is_empty() {
        let torque = part.before.torque.select_rows(&bound);
        let room: Vec<f64> = bound.iter().map(|i| rate[*i] * time).collect();
        program.within(&[(place.before, &torque)], &room);
    }
}

/// `x_bound ≤ x_worst` for each of `bounds`, variables that stand one after the other.
pub(super) fn below(program: &mut Program, bounds: &[usize], worst: usize) {
    if let Some(first) = bounds.first() {
        let count = bounds.len();
        let each = DMatrix::identity(count, count);
        let all = DMatrix::from_element(count, 1, -1.0);
        program.at_most_of(&[(*first, &each), (worst, &all)], &vec![0.0; count]);
    }
}
