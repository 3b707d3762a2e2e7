//! Eq. 20 exactly: bounded linear least squares, or a linear program.

use std::time::Instant;

use nalgebra::{DMatrix, SMatrix, SVector};

use super::healthy_part;
use super::least::{least_squares, min_max};
use super::limits::TorqueLimits;
use super::pseudo_inverse::stack;
use crate::search::coefficients::{CoefficientLaw, Maps, NO_SAY};
use crate::search::{Operation, SearchError, Solution};
use ulna::control::compensation::Compensation;

/// What of the healthy joints' steps is to be least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Objective {
    /// Their norm: bounded linear least squares.
    LeastSquares,
    /// The largest of them: a linear program.
    MinMax,
}

/// Eq. 20 exactly: the coefficients that make the healthy joints' steps least by `objective`,
/// with all torques within the rated ones at all samples.
pub fn least_impact<const N: usize>(
    operation: &Operation<N>,
    objective: Objective,
) -> Result<Solution<N>, SearchError> {
    let clock = Instant::now();
    let maps = Maps::new(operation, CoefficientLaw::Projected);
    // In units in which each coefficient adds at most 1 N·m anywhere.
    let size = SVector::<f64, N>::from_fn(|i, _| {
        let columns = maps.at.iter().map(|map| map.column(i).amax());
        columns.fold(0.0, f64::max)
    });
    let gradients = operation.samples().iter();
    let gradient = gradients.map(|sample| sample.pose.gradient.amax());
    let strongest = gradient.fold(size.amax(), f64::max);
    let active: Vec<usize> = (0..N).filter(|i| size[*i] > NO_SAY * strongest).collect();
    let scaled = |map: &SMatrix<f64, N, N>| {
        DMatrix::from_fn(N, active.len(), |joint, column| {
            map[(joint, active[column])] / size[active[column]]
        })
    };
    let healthy: Vec<usize> = operation.healthy().collect();
    let impact = scaled(&maps.step()).select_rows(&healthy);
    let step = healthy_part(operation, &operation.step());
    let samples = operation.samples().iter().zip(maps.at.iter().map(scaled));
    let limits = TorqueLimits::new(operation, samples, active.len());

    // Without weight, no rows.
    let effort = match operation.effort() {
        0.0 => DMatrix::zeros(0, active.len()),
        weight => {
            let at_lock = [maps.before(), maps.after()].map(scaled);
            stack(&at_lock[0], &at_lock[1]) * weight
        }
    };
    let outcome = stack(&impact, &effort);
    let minimum = match objective {
        Objective::LeastSquares => {
            let step = step.resize_vertically(outcome.nrows(), 0.0);
            least_squares((&outcome, 1.0), &step, &limits)?
        }
        Objective::MinMax => min_max(&impact, &step, &effort, &limits, None)?,
    };
    let minimum = minimum.with_least_variables(&outcome, &limits);
    let seconds = clock.elapsed().as_secs_f64();
    let mut k = SVector::zeros();
    for (i, x) in active.iter().zip(&minimum.x) {
        k[*i] = x / size[*i];
    }
    Ok(minimum.solution(operation, Compensation::Projected(k), seconds))
}
