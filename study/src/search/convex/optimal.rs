//! The best compensation there is, and the frontier of force error against impact.

use std::time::Instant;

use nalgebra::{DMatrix, DVector, SVector, Vector6};

use super::conic::Minimum;
use super::healthy_part;
use super::least::{least_squares, least_squares_program};
use super::limits::TorqueLimits;
use super::pseudo_inverse::{column_space, null_space, pseudo_inverse, stack};
use crate::search::{OperatingPoint, Operation, SearchError, Solution};
use ulna::TaskRow;
use ulna::control::compensation::{Compensation, FreeTorque};

/// How [`optimal()`] weighs the tool force against the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ForcePriority {
    /// The static tool force stays as it is, before and after the lock.
    Exact,
    /// Its error has at most this norm just before and just after the lock, N (with the moments' N·m, if the task has any):
    /// at least 0, or ∞. Of all compensations with the least impact, the one with the least error is taken.
    AtMost(f64),
    /// Least `‖Δτ̃‖² + ρ² (‖h‖² + ‖h'‖²)`: a newton of force error before (h) or after (h') the lock weighs as ρ N·m of impact. Above 0.
    Weight(f64),
}

/// A point of the frontier of force error against impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontierPoint<const N: usize> {
    /// The force error allowed, N.
    pub allowed: f64,
    /// The best compensation within it.
    pub solution: Solution<N>,
}

/// The best compensation there is: free torques before and after the lock, the healthy joints' impact least by `priority`,
/// the rated torques kept on both sides of the lock. Elsewhere a control cycle keeps them by scaling.
///
/// Any compensation is of its form at the lock, so that at equal force error no law leaves less.
pub fn optimal<const N: usize>(
    operation: &Operation<N>,
    priority: ForcePriority,
) -> Result<Solution<N>, SearchError> {
    let clock = Instant::now();
    let [before, after] = [operation.before(), operation.after()].map(FreeMap::new);
    let healthy: Vec<usize> = operation.healthy().collect();
    let step = healthy_part(operation, &operation.step());
    let problem = Problem::new([&before, &after], &healthy, step);
    let samples = [operation.before(), operation.after()].into_iter();
    let samples = samples.zip(problem.torques.iter().cloned());
    let limits = TorqueLimits::new(operation, samples, problem.impact.ncols());
    let minimum = problem.solve(priority, &limits)?;
    let seconds = clock.elapsed().as_secs_f64();
    let (x_before, x_after) = minimum.x.as_slice().split_at(before.torque.ncols());
    let compensation = Compensation::Optimal {
        before: before.parameters(x_before),
        after: after.parameters(x_after),
    };
    Ok(minimum.solution(operation, compensation, seconds))
}

/// The least impact over the healthy joints for each force error allowed, N: from all of the tool force kept (0) to any price.
pub fn frontier<const N: usize>(
    operation: &Operation<N>,
    allowed: &[f64],
) -> Result<Vec<FrontierPoint<N>>, SearchError> {
    let point = |allowed: &f64| {
        let solution = optimal(operation, ForcePriority::AtMost(*allowed))?;
        Ok(FrontierPoint {
            allowed: *allowed,
            solution,
        })
    };
    allowed.iter().map(point).collect()
}

/// The problem for any number of joints: apart from [`optimal()`], so that this is compiled once.
struct Problem {
    /// U of all joints just before and just after the lock, by all variables.
    torques: [DMatrix<f64>; 2],
    /// h, likewise.
    forces: [DMatrix<f64>; 2],
    /// One on the other.
    force: DMatrix<f64>,
    /// What the healthy joints' steps gain.
    impact: DMatrix<f64>,
    /// The healthy joints' steps without compensation.
    step: DVector<f64>,
}

impl Problem {
    fn new([before, after]: [&FreeMap; 2], healthy: &[usize], step: DVector<f64>) -> Self {
        let first = before.torque.ncols();
        let variables = first + after.torque.ncols();
        let from_all = |map: &DMatrix<f64>, first: usize| {
            let mut wide = DMatrix::zeros(map.nrows(), variables);
            wide.columns_mut(first, map.ncols()).copy_from(map);
            wide
        };
        let torques = [from_all(&before.torque, 0), from_all(&after.torque, first)];
        let forces = [from_all(&before.force, 0), from_all(&after.force, first)];
        Self {
            force: stack(&forces[0], &forces[1]),
            impact: (&torques[1] - &torques[0]).select_rows(healthy),
            torques,
            forces,
            step,
        }
    }

    fn solve(
        &self,
        priority: ForcePriority,
        limits: &TorqueLimits,
    ) -> Result<Minimum, SearchError> {
        let Self {
            force,
            impact,
            step,
            ..
        } = self;
        let minimum = match priority {
            ForcePriority::Exact | ForcePriority::AtMost(0.0) => {
                // Without limits, within the null space of E.
                let keeping = null_space(force);
                let x = -(&keeping * pseudo_inverse(&(impact * &keeping), impact.amax())) * step;
                if limits.admit(&x) {
                    Minimum::closed_form(x)
                } else {
                    least_squares_program(impact, step, limits, &|program| {
                        program.equal(force, &vec![0.0; force.nrows()]);
                    })?
                }
            }
            ForcePriority::AtMost(radius) if radius > 0.0 => {
                let least = least_squares_program(impact, step, limits, &|program| {
                    if radius.is_finite() {
                        program.norm_at_most(&self.forces[0], radius);
                        program.norm_at_most(&self.forces[1], radius);
                    }
                })?;
                let [before, after] = &self.forces;
                least.with_least_force(impact, [before, after], radius, limits)?
            }
            ForcePriority::Weight(weight) if weight > 0.0 && weight.is_finite() => {
                let weighted = stack(impact, &(force * weight));
                let step = step.clone().resize_vertically(weighted.nrows(), 0.0);
                least_squares((&weighted, weighted.amax()), &step, limits)?
            }
            ForcePriority::AtMost(value) => {
                return Err(SearchError::Argument {
                    name: "force error allowed",
                    range: "at least 0 N",
                    value,
                });
            }
            ForcePriority::Weight(value) => {
                return Err(SearchError::Argument {
                    name: "weight of the force error",
                    range: "a finite number above 0 m",
                    value,
                });
            }
        };
        Ok(minimum.with_least_variables(&stack(impact, force), limits))
    }
}

/// `U = P z + Jᵀ f` at one sample as a map of few variables: P's range and the task's rows of f.
pub(super) struct FreeMap {
    /// U, N × variables.
    pub(super) torque: DMatrix<f64>,
    /// h, task rows × variables.
    pub(super) force: DMatrix<f64>,
    /// z of each of the first variables, N × rank of P.
    pub(super) null: DMatrix<f64>,
    /// The rows of f of the other variables.
    rows: Vec<usize>,
}

impl FreeMap {
    pub(super) fn new<const N: usize>(sample: &OperatingPoint<N>) -> Self {
        let pose = &sample.pose;
        let unit = |i: usize| SVector::<f64, N>::from_fn(|j, _| f64::from(u8::from(i == j)));
        let mut projector = DMatrix::zeros(N, N);
        for i in 0..N {
            projector.set_column(i, &pose.project(&unit(i)));
        }
        let null = column_space(&projector.transpose(), 1.0);
        let rows: Vec<usize> = pose.task().iter().map(TaskRow::index).collect();
        let lifted = DMatrix::from_fn(N, rows.len(), |joint, column| {
            let mut wrench = Vector6::zeros();
            wrench[rows[column]] = 1.0;
            pose.static_torque(&wrench)[joint]
        });
        let mut torque = (&projector * &null).resize_horizontally(null.ncols() + rows.len(), 0.0);
        torque
            .columns_mut(null.ncols(), rows.len())
            .copy_from(&lifted);
        let force = DMatrix::from_fn(rows.len(), torque.ncols(), |row, column| {
            let torque = SVector::from_fn(|joint, _| torque[(joint, column)]);
            pose.null_space.static_wrench(&torque)[rows[row]]
        });
        Self {
            torque,
            force,
            null,
            rows,
        }
    }

    /// Without the variables of f, if the force is to be `exact`.
    pub(super) fn kept(mut self, exact: bool) -> Self {
        if exact {
            let null = self.null.ncols();
            self.torque = self.torque.columns(0, null).into_owned();
            self.force = self.force.columns(0, null).into_owned();
            self.rows.clear();
        }
        self
    }

    pub(super) fn parameters<const N: usize>(&self, x: &[f64]) -> FreeTorque<N> {
        let (null, forces) = x.split_at(self.null.ncols());
        let torque = &self.null * DVector::from_column_slice(null);
        let mut wrench = Vector6::zeros();
        for (row, force) in self.rows.iter().zip(forces) {
            wrench[*row] = *force;
        }
        FreeTorque {
            torque: SVector::from_fn(|joint, _| torque[joint]),
            wrench,
        }
    }
}
