//! The least `step + R x` within limits, in the two norms, and among equals the least x or the least force error.

use nalgebra::{DMatrix, DVector};

use super::conic::{Minimum, Program};
use super::limits::TorqueLimits;
use super::pseudo_inverse::pseudo_inverse;
use crate::search::{SearchError, SolveStatus};

/// `min ‖step + R x‖` within the limits: by the pseudoinverse if they do not bind. R comes with the size of what it is computed from.
pub(super) fn least_squares(
    (impact, size): (&DMatrix<f64>, f64),
    step: &DVector<f64>,
    limits: &TorqueLimits,
) -> Result<Minimum, SearchError> {
    let x = -pseudo_inverse(impact, size) * step;
    if limits.admit(&x) {
        return Ok(Minimum::closed_form(x));
    }
    least_squares_program(impact, step, limits, &|_| ())
}

/// The same by the solver, with the constraints that `constrain` adds: with r = step + R x, `min ½ ‖r‖²`.
pub(super) fn least_squares_program(
    impact: &DMatrix<f64>,
    step: &DVector<f64>,
    limits: &TorqueLimits,
    constrain: &dyn Fn(&mut Program),
) -> Result<Minimum, SearchError> {
    let (joints, variables) = impact.shape();
    let mut program = Program::new(variables + joints);
    program.quadratic[variables..].fill(1.0);
    let mut definition = impact.clone().resize_horizontally(variables + joints, 0.0);
    for i in 0..joints {
        definition[(i, variables + i)] = -1.0;
    }
    program.equal(&definition, (-step).as_slice());
    program.at_most(&limits.map, &limits.room);
    constrain(&mut program);
    let mut solution = program.solve()?.ok_or_else(|| limits.tightest())?;
    solution.x = solution.x.rows(0, variables).into_owned();
    Ok(solution)
}

/// `min s` with `|step + R x| ≤ s` within the limits; with rows `besides`, B: `min s² + ‖B x‖²`.
pub(super) fn min_max(
    impact: &DMatrix<f64>,
    step: &DVector<f64>,
    besides: &DMatrix<f64>,
    limits: &TorqueLimits,
    constrain: Option<&dyn Fn(&mut Program)>,
) -> Result<Minimum, SearchError> {
    let (variables, rows) = (impact.ncols(), besides.nrows());
    let mut program = Program::new(variables + 1 + rows);
    if rows == 0 {
        program.linear[variables] = 1.0;
    } else {
        program.quadratic[variables] = 1.0;
        // The rows' sizes go into the objective: the solver does not like small ones.
        let mut definition = besides
            .clone()
            .resize_horizontally(variables + 1 + rows, 0.0);
        for i in 0..rows {
            let size = besides.row(i).amax();
            if size > 0.0 {
                definition.row_mut(i).unscale_mut(size);
            }
            program.quadratic[variables + 1 + i] = size * size;
            definition[(i, variables + 1 + i)] = -1.0;
        }
        program.equal(&definition, &vec![0.0; rows]);
    }
    for (map, mut bound) in [(impact.clone(), -step), (-impact, step.clone())] {
        let mut within = map.insert_column(variables, -1.0);
        // Rows of very different sizes are not solved well.
        for (i, bound) in bound.iter_mut().enumerate() {
            let size = within.row(i).amax();
            within.row_mut(i).unscale_mut(size);
            *bound /= size;
        }
        program.at_most(&within, bound.as_slice());
    }
    if step.is_empty() {
        // Nothing else bounds s where all joints are locked.
        let mut least = DMatrix::zeros(1, variables + 1);
        least[(0, variables)] = -1.0;
        program.at_most(&least, &[0.0]);
    }
    program.at_most(&limits.map, &limits.room);
    if let Some(constrain) = constrain {
        constrain(&mut program);
    }
    let mut solution = program.solve()?.ok_or_else(|| limits.tightest())?;
    solution.x = solution.x.rows(0, variables).into_owned();
    Ok(solution)
}

impl Minimum {
    pub(super) fn closed_form(x: DVector<f64>) -> Self {
        Self {
            x,
            status: SolveStatus::ClosedForm,
            gap: 0.0,
            iterations: 0,
        }
    }

    /// Of all x with the same outcome the shortest, unless a limit forbids it: the solver leaves open what costs nothing.
    pub(super) fn with_least_variables(
        mut self,
        outcome: &DMatrix<f64>,
        limits: &TorqueLimits,
    ) -> Self {
        let least = pseudo_inverse(outcome, outcome.amax()) * (outcome * &self.x);
        if limits.admit(&least) {
            self.x = least;
        }
        self
    }

    /// Of all x with the same impact the one with the least force error: `min s`, `‖E x‖ ≤ s` before and after.
    pub(super) fn with_least_force(
        mut self,
        impact: &DMatrix<f64>,
        forces: [&DMatrix<f64>; 2],
        allowed: f64,
        limits: &TorqueLimits,
    ) -> Result<Self, SearchError> {
        let variables = impact.ncols();
        let mut program = Program::new(variables + 1);
        program.linear[variables] = 1.0;
        program.equal(impact, (impact * &self.x).as_slice());
        for force in forces {
            program.norm_at_most_variable(force, variables);
        }
        program.at_most(&limits.map, &limits.room);
        // The solver's own x is admissible to its tolerances only; where that is not enough, it stays.
        if let Ok(Some(least)) = program.solve()
            && least.x[variables] < allowed
        {
            self.x = least.x.rows(0, variables).into_owned();
            self.iterations += least.iterations;
        }
        Ok(self)
    }
}
