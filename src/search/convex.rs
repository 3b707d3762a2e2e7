//! The convex problems: Eq. 20's coefficients under all limits, and the best compensation there is.
//!
//! With x what is searched for, the impact is `Δτ̃ = step + R x`, the torques are `planned + T x`,
//! and the static tool force is off by `E x`. Where no limit binds, the least-squares problems are solved by a pseudoinverse,
//! which also picks the least x; otherwise by an interior-point method with a duality gap.

use std::time::Instant;

use nalgebra::{DMatrix, DVector, SVector, Vector6};

use super::coefficients::{CoefficientLaw, Maps, NO_SAY};
use super::conic::{Program, Solution};
use super::{Operation, Outcome, Sample, SearchError, SolveStatus};
use crate::TaskRow;
use crate::compensation::{Compensation, FreeTorque};

/// What of the healthy joints' steps is to be least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Objective {
    /// Their norm: bounded linear least squares.
    LeastSquares,
    /// The largest of them: a linear program.
    MinMax,
}

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
    pub outcome: Outcome<N>,
}

/// Rated torques on `planned + T x`, both sides of each in turn.
struct TorqueLimits {
    /// T, and −T below it.
    map: DMatrix<f64>,
    room: Vec<f64>,
    /// Joint and time of each row of the upper half.
    places: Vec<(usize, f64)>,
}

impl TorqueLimits {
    /// Of the samples with their maps T, for the joints that are not locked and have a limit.
    fn new<'a, const N: usize>(
        operation: &Operation<N>,
        samples: impl Iterator<Item = (&'a Sample<N>, DMatrix<f64>)>,
        variables: usize,
    ) -> Self {
        let mut rows = Vec::new();
        let mut room = (Vec::new(), Vec::new());
        let mut places = Vec::new();
        for (sample, map) in samples {
            for joint in sample.locked.healthy() {
                let rated = operation.rated_torque[joint];
                if rated.is_finite() {
                    rows.push(map.row(joint).into_owned());
                    room.0.push(rated - sample.planned[joint]);
                    room.1.push(rated + sample.planned[joint]);
                    places.push((joint, sample.time));
                }
            }
        }
        let count = rows.len();
        let map = DMatrix::from_fn(2 * count, variables, |i, j| {
            if i < count {
                rows[i][j]
            } else {
                -rows[i - count][j]
            }
        });
        room.0.append(&mut room.1);
        Self {
            map,
            room: room.0,
            places,
        }
    }

    fn admit(&self, x: &DVector<f64>) -> bool {
        let used = &self.map * x;
        used.iter().zip(&self.room).all(|(used, room)| used <= room)
    }

    /// The joint and the time with the least room.
    fn tightest(&self) -> SearchError {
        let rows = self.room.iter().enumerate();
        let (row, _) = rows.min_by(|a, b| a.1.total_cmp(b.1)).unwrap_or((0, &0.0));
        match self.places.get(row % self.places.len().max(1)) {
            Some((joint, time)) => SearchError::Empty {
                joint: *joint,
                time: *time,
            },
            None => SearchError::NotSolved("infeasible without limits"),
        }
    }
}

/// Eq. 20 exactly: the coefficients that make the healthy joints' steps least by `objective`,
/// with all torques within the rated ones at all samples.
pub fn least_impact<const N: usize>(
    operation: &Operation<N>,
    objective: Objective,
) -> Result<Outcome<N>, SearchError> {
    let clock = Instant::now();
    let maps = Maps::new(operation, CoefficientLaw::Projected);
    // In units in which each coefficient adds at most 1 N·m anywhere.
    let size = SVector::<f64, N>::from_fn(|i, _| {
        let columns = maps.at.iter().map(|map| map.column(i).amax());
        columns.fold(0.0, f64::max)
    });
    let active: Vec<usize> = (0..N).filter(|i| size[*i] > NO_SAY * size.amax()).collect();
    let scaled = |map: &nalgebra::SMatrix<f64, N, N>| {
        DMatrix::from_fn(N, active.len(), |joint, column| {
            map[(joint, active[column])] / size[active[column]]
        })
    };
    let healthy: Vec<usize> = operation.healthy().collect();
    let impact = scaled(&maps.step()).select_rows(&healthy);
    let step = healthy_part(operation, &operation.step());
    let samples = operation.samples.iter().zip(maps.at.iter().map(scaled));
    let limits = TorqueLimits::new(operation, samples, active.len());

    let solution = match objective {
        Objective::LeastSquares => least_squares(&impact, &step, &limits, Program::solve)?,
        Objective::MinMax => min_max(&impact, &step, &limits)?,
    };
    let solution = solution.with_least_variables(&impact, &limits);
    let seconds = clock.elapsed().as_secs_f64();
    let mut k = SVector::zeros();
    for (i, x) in active.iter().zip(&solution.x) {
        k[*i] = x / size[*i];
    }
    Ok(solution.outcome(operation, Compensation::Projected(k), seconds))
}

/// The best compensation there is: free torques before and after the lock, the healthy joints' impact least by `priority`,
/// the rated torques kept on both sides of the lock. Elsewhere a control cycle keeps them by scaling.
///
/// Any compensation is of its form at the lock, so that at equal force error no law leaves less.
pub fn optimal<const N: usize>(
    operation: &Operation<N>,
    priority: ForcePriority,
) -> Result<Outcome<N>, SearchError> {
    let clock = Instant::now();
    let [before, after] = [operation.before(), operation.after()].map(FreeMap::new);
    let variables = before.torque.ncols() + after.torque.ncols();
    let from_all = |map: &DMatrix<f64>, first: usize| {
        let mut wide = DMatrix::zeros(map.nrows(), variables);
        wide.columns_mut(first, map.ncols()).copy_from(map);
        wide
    };
    let torque_before = from_all(&before.torque, 0);
    let torque_after = from_all(&after.torque, before.torque.ncols());
    let force_before = from_all(&before.force, 0);
    let force_after = from_all(&after.force, before.torque.ncols());
    let force = stack(&force_before, &force_after);
    let healthy: Vec<usize> = operation.healthy().collect();
    let impact = (&torque_after - &torque_before).select_rows(&healthy);
    let step = healthy_part(operation, &operation.step());
    let samples = [
        (operation.before(), torque_before),
        (operation.after(), torque_after),
    ];
    let limits = TorqueLimits::new(operation, samples.into_iter(), variables);

    let solution = match priority {
        ForcePriority::Exact | ForcePriority::AtMost(0.0) => {
            // Without limits, within the null space of E.
            let keeping = DMatrix::identity(variables, variables) - pseudo_inverse(&force) * &force;
            let x = -(&keeping * pseudo_inverse(&(&impact * &keeping))) * &step;
            if limits.admit(&x) {
                Solution::closed_form(x)
            } else {
                least_squares_program(&impact, &step, &limits, |mut program| {
                    program.equal(&force, &vec![0.0; force.nrows()]);
                    program.solve()
                })?
            }
        }
        ForcePriority::AtMost(radius) if radius > 0.0 => {
            let least = least_squares_program(&impact, &step, &limits, |mut program| {
                if radius.is_finite() {
                    program.norm_at_most(&force_before, radius);
                    program.norm_at_most(&force_after, radius);
                }
                program.solve()
            })?;
            let forces = [&force_before, &force_after];
            least.with_least_force(&impact, forces, radius, &limits)?
        }
        ForcePriority::Weight(weight) if weight > 0.0 && weight.is_finite() => {
            let weighted = stack(&impact, &(&force * weight));
            let step = step.clone().resize_vertically(weighted.nrows(), 0.0);
            least_squares(&weighted, &step, &limits, Program::solve)?
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
    let solution = solution.with_least_variables(&stack(&impact, &force), &limits);
    let seconds = clock.elapsed().as_secs_f64();
    let (x_before, x_after) = solution.x.as_slice().split_at(before.torque.ncols());
    let compensation = Compensation::Optimal {
        before: before.parameters(x_before),
        after: after.parameters(x_after),
    };
    Ok(solution.outcome(operation, compensation, seconds))
}

/// The least impact over the healthy joints for each force error allowed, N: from all of the tool force kept (0) to any price.
pub fn frontier<const N: usize>(
    operation: &Operation<N>,
    allowed: &[f64],
) -> Result<Vec<FrontierPoint<N>>, SearchError> {
    let point = |allowed: &f64| {
        let outcome = optimal(operation, ForcePriority::AtMost(*allowed))?;
        Ok(FrontierPoint {
            allowed: *allowed,
            outcome,
        })
    };
    allowed.iter().map(point).collect()
}

/// `U = P z + Jᵀ f` at one sample as a map of few variables: P's range and the task's rows of f.
struct FreeMap<const N: usize> {
    /// U, N × variables.
    torque: DMatrix<f64>,
    /// h, task rows × variables.
    force: DMatrix<f64>,
    /// z of each of the first variables, N × rank of P.
    null: DMatrix<f64>,
    /// The rows of f of the other variables.
    rows: Vec<usize>,
}

impl<const N: usize> FreeMap<N> {
    fn new(sample: &Sample<N>) -> Self {
        let pose = &sample.pose;
        let unit = |i: usize| SVector::<f64, N>::from_fn(|j, _| f64::from(u8::from(i == j)));
        let mut projector = DMatrix::zeros(N, N);
        for i in 0..N {
            projector.set_column(i, &pose.project(&unit(i)));
        }
        let null = column_space(&projector.transpose());
        let rows: Vec<usize> = pose.task().iter().map(TaskRow::index).collect();
        let lifted = DMatrix::from_fn(N, rows.len(), |joint, column| {
            let mut wrench = Vector6::zeros();
            wrench[rows[column]] = 1.0;
            pose.lift(&wrench)[joint]
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

    fn parameters(&self, x: &[f64]) -> FreeTorque<N> {
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

impl Solution {
    fn closed_form(x: DVector<f64>) -> Self {
        Self {
            x,
            status: SolveStatus::ClosedForm,
            gap: 0.0,
            iterations: 0,
        }
    }

    /// Of all x with the same outcome the shortest, unless a limit forbids it: the solver leaves open what costs nothing.
    fn with_least_variables(mut self, outcome: &DMatrix<f64>, limits: &TorqueLimits) -> Self {
        let least = pseudo_inverse(outcome) * (outcome * &self.x);
        if limits.admit(&least) {
            self.x = least;
        }
        self
    }

    /// Of all x with the same impact the one with the least force error: `min s`, `‖E x‖ ≤ s` before and after.
    fn with_least_force(
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

    fn outcome<const N: usize>(
        &self,
        operation: &Operation<N>,
        compensation: Compensation<N>,
        seconds: f64,
    ) -> Outcome<N> {
        Outcome {
            compensation,
            assessment: operation.assess(&compensation),
            status: self.status,
            gap: Some(self.gap),
            iterations: self.iterations,
            seconds,
        }
    }
}

type Solve = Result<Option<Solution>, SearchError>;

/// `min ‖step + R x‖` within the limits: by the pseudoinverse if they do not bind.
fn least_squares(
    impact: &DMatrix<f64>,
    step: &DVector<f64>,
    limits: &TorqueLimits,
    solve: impl FnOnce(Program) -> Solve,
) -> Result<Solution, SearchError> {
    let x = -pseudo_inverse(impact) * step;
    if limits.admit(&x) {
        return Ok(Solution::closed_form(x));
    }
    least_squares_program(impact, step, limits, solve)
}

/// The same by the solver, `solve`, which may add constraints: with r = step + R x, `min ½ ‖r‖²`.
fn least_squares_program(
    impact: &DMatrix<f64>,
    step: &DVector<f64>,
    limits: &TorqueLimits,
    solve: impl FnOnce(Program) -> Solve,
) -> Result<Solution, SearchError> {
    let (joints, variables) = impact.shape();
    let mut program = Program::new(variables + joints);
    program.quadratic[variables..].fill(1.0);
    let mut definition = impact.clone().resize_horizontally(variables + joints, 0.0);
    for i in 0..joints {
        definition[(i, variables + i)] = -1.0;
    }
    program.equal(&definition, (-step).as_slice());
    program.at_most(&limits.map, &limits.room);
    let mut solution = solve(program)?.ok_or_else(|| limits.tightest())?;
    solution.x = solution.x.rows(0, variables).into_owned();
    Ok(solution)
}

/// `min s` with `|step + R x| ≤ s` within the limits.
fn min_max(
    impact: &DMatrix<f64>,
    step: &DVector<f64>,
    limits: &TorqueLimits,
) -> Result<Solution, SearchError> {
    let variables = impact.ncols();
    let mut program = Program::new(variables + 1);
    program.linear[variables] = 1.0;
    for (map, bound) in [(impact.clone(), -step), (-impact, step.clone())] {
        let within = map.insert_column(variables, -1.0);
        program.at_most(&within, bound.as_slice());
    }
    program.at_most(&limits.map, &limits.room);
    let mut solution = program.solve()?.ok_or_else(|| limits.tightest())?;
    solution.x = solution.x.rows(0, variables).into_owned();
    Ok(solution)
}

fn healthy_part<const N: usize>(
    operation: &Operation<N>,
    vector: &SVector<f64, N>,
) -> DVector<f64> {
    DVector::from_iterator(
        N - operation.failure.joints.len(),
        operation.healthy().map(|joint| vector[joint]),
    )
}

fn stack(upper: &DMatrix<f64>, lower: &DMatrix<f64>) -> DMatrix<f64> {
    let mut both = upper
        .clone()
        .resize_vertically(upper.nrows() + lower.nrows(), 0.0);
    both.rows_mut(upper.nrows(), lower.nrows()).copy_from(lower);
    both
}

/// Pivots below this part of the largest count as 0.
const RANK_TOLERANCE: f64 = 1e-9;

/// An orthonormal basis of a matrix's column space, by Householder's QR with column pivoting (Golub and Van Loan, 5.4.2).
fn column_space(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    if matrix.is_empty() {
        return DMatrix::zeros(matrix.nrows(), 0);
    }
    let qr = matrix.clone().col_piv_qr();
    let r = qr.r();
    // The pivots shrink along the diagonal.
    let pivots = (0..r.nrows().min(r.ncols())).map(|i| r[(i, i)].abs());
    let rank = pivots
        .take_while(|pivot| *pivot > RANK_TOLERANCE * r[(0, 0)].abs())
        .count();
    qr.q().columns(0, rank).into_owned()
}

/// A†, by a complete orthogonal decomposition `A = Q C Zᵀ`, C square and regular (Golub and Van Loan, 5.4.7).
/// A singular value decomposition would do as well, but nalgebra's loses half of the digits where the rank is deficient.
fn pseudo_inverse(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let q = column_space(matrix);
    if q.is_empty() {
        return DMatrix::zeros(matrix.ncols(), matrix.nrows());
    }
    let rows = q.tr_mul(matrix).transpose();
    let decomposition = rows.qr();
    // Qᵀ A = Rᵀ Zᵀ, so A† = Z R⁻ᵀ Qᵀ.
    match decomposition
        .r()
        .transpose()
        .solve_lower_triangular(&q.transpose())
    {
        Some(solved) => decomposition.q() * solved,
        None => DMatrix::zeros(matrix.ncols(), matrix.nrows()),
    }
}
