//! The constant coefficients that are best at all failures at once: what Eq. 16 and 20 can do without knowing what fails when.

use std::time::Instant;

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use super::conic::Program;
use super::robust::{Moment, TOLERANCE};
use crate::search::coefficients::{CoefficientLaw, NO_SAY};
use crate::search::{SearchError, SolveStatus};

/// Constant coefficients, and the worst that they leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BestConstant<const N: usize> {
    /// The diagonal of k_d.
    pub coefficients: SVector<f64, N>,
    /// The largest norm of the healthy joints' steps over all locks at all times, N·m (N): no other constants leave less
    /// by more than [`gap`](Self::gap).
    pub worst: f64,
    /// How the search ended.
    pub status: SolveStatus,
    /// Primal minus dual objective, N·m (N).
    pub gap: f64,
    /// How long it took, s.
    pub seconds: f64,
}

/// What a coefficient costs that adds 1 N·m to a step, N·m: it decides among equals, and keeps the solver's first point near.
const TIE: f64 = 1e-9;

/// `min over k of max over all locks of all moments of ‖step + R k‖` over the healthy joints, a second-order cone program.
/// Rated torques are left to the control cycle.
///
/// # Errors
/// When there is nothing to choose, or the solver stops without an answer.
pub fn best_constant<const N: usize>(
    moments: &[Moment<N>],
    law: CoefficientLaw,
) -> Result<BestConstant<N>, SearchError> {
    let clock = Instant::now();
    let mut locks = Vec::new();
    let mut size = SVector::<f64, N>::zeros();
    let mut strongest = 0.0_f64;
    for moment in moments {
        let before = law.map(&moment.before);
        strongest = strongest.max(moment.before.pose.gradient.amax());
        for after in &moment.after {
            let mut map: SMatrix<f64, N, N> = law.map(after) - before;
            // What goes into the brakes does not count.
            for joint in after.locked.iter() {
                map.row_mut(joint).fill(0.0);
            }
            size = size.sup(&column_sizes(&map));
            let step = moment.step(after);
            locks.push((after.locked, map, step));
        }
    }
    // In units in which the largest step is 1, and each coefficient adds at most 1 to a step.
    let largest = locks.iter().map(|(.., step)| step.norm());
    let largest = largest.fold(f64::MIN_POSITIVE, f64::max);
    let strongest = strongest.max(size.amax());
    let active: Vec<usize> = (0..N).filter(|i| size[*i] > NO_SAY * strongest).collect();
    let variables = active.len();
    let mut program = Program::new(variables + 1);
    program.tolerance = TOLERANCE;
    program.linear[variables] = 1.0;
    program.quadratic[..variables].fill(TIE);
    for (locked, map, step) in &locks {
        let healthy: Vec<usize> = locked.healthy().collect();
        let rows = DMatrix::from_fn(healthy.len(), variables, |row, column| {
            map[(healthy[row], active[column])] / size[active[column]]
        });
        let step: Vec<f64> = healthy.iter().map(|joint| step[*joint] / largest).collect();
        program.cone(&[(0, &rows)], &step, 0.0, Some((variables, 1.0)));
    }
    let solved = program.solve()?;
    let minimum = solved.ok_or(SearchError::NotSolved("infeasible without limits"))?;
    let mut coefficients = SVector::zeros();
    for (joint, x) in active.iter().zip(&minimum.x) {
        coefficients[*joint] = x * largest / size[*joint];
    }
    Ok(BestConstant {
        coefficients,
        worst: DVector::from_vec(
            locks
                .iter()
                .map(|(locked, map, step)| locked.without(&(step + map * coefficients)).norm())
                .collect(),
        )
        .amax(),
        status: minimum.status,
        gap: minimum.gap * largest,
        seconds: clock.elapsed().as_secs_f64(),
    })
}

fn column_sizes<const N: usize>(map: &SMatrix<f64, N, N>) -> SVector<f64, N> {
    SVector::from_fn(|i, _| map.column(i).amax())
}
