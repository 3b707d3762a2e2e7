//! The best compensation as a problem in few variables, for any number of joints: compiled once.

use nalgebra::{DMatrix, DVector};

use super::conic::{Minimum, Program};
use super::fairness::Fairness;
use super::least::{least_squares, least_squares_program, min_max};
use super::limits::TorqueLimits;
use super::optimal::ForcePriority;
use super::pseudo_inverse::{column_space, null_space, null_space_of_size, stack};
use super::scope::{Joints, Scope};
use crate::search::SearchError;

/// What the variables do at the lock, before and after it.
pub(super) struct Problem {
    /// U of all joints just before and just after the lock, by all variables.
    pub(super) torques: [DMatrix<f64>; 2],
    /// h, likewise.
    pub(super) forces: [DMatrix<f64>; 2],
    /// `(Jᵀ)†` just before the lock, task rows × N.
    pub(super) wrench: DMatrix<f64>,
    /// J there, likewise.
    pub(super) jacobian: DMatrix<f64>,
    /// The steps of all joints without compensation.
    pub(super) step: DVector<f64>,
    /// The joints that are not locked.
    pub(super) healthy: Vec<usize>,
    /// The largest planned torque at the lock.
    pub(super) largest: f64,
    /// What a newton metre of compensation weighs, in newton metres of impact.
    pub(super) effort: f64,
    /// The rated torques.
    pub(super) limits: TorqueLimits,
}

impl Problem {
    /// What the steps of all joints gain.
    pub(super) fn change(&self) -> DMatrix<f64> {
        &self.torques[1] - &self.torques[0]
    }

    /// h before on h after.
    fn force(&self) -> DMatrix<f64> {
        stack(&self.forces[0], &self.forces[1])
    }

    /// The variables that leave the tool force as it is.
    fn keeping(&self) -> DMatrix<f64> {
        null_space(&self.force())
    }

    /// D: an orthonormal basis of all changes of the steps that leave the tool force as it is, N × dim D.
    pub(super) fn changes(&self) -> DMatrix<f64> {
        let change = self.change();
        column_space(&(&change * self.keeping()), change.amax())
    }

    /// The joints of `scope`.
    pub(super) fn joints(&self, scope: Scope) -> Joints {
        Joints::new(scope, &self.healthy, &self.step, self.largest)
    }

    /// The same problem over the variables that `basis` spans.
    fn within(&self, basis: &DMatrix<f64>) -> Self {
        let restrict = |maps: &[DMatrix<f64>; 2]| [&maps[0] * basis, &maps[1] * basis];
        Self {
            torques: restrict(&self.torques),
            forces: restrict(&self.forces),
            wrench: self.wrench.clone(),
            jacobian: self.jacobian.clone(),
            step: self.step.clone(),
            healthy: self.healthy.clone(),
            largest: self.largest,
            effort: self.effort,
            limits: self.limits.within(basis),
        }
    }

    /// What has to stay when variables that cost nothing are chosen: the steps that `fairness` is about.
    fn outcome(&self, fairness: Fairness) -> DMatrix<f64> {
        match fairness {
            Fairness::LeastNorm => self.change().select_rows(&self.healthy),
            Fairness::NoJointWorse(_) | Fairness::WorstRatio(_) => self.change(),
        }
    }

    /// The best by `fairness` and `priority`.
    pub(super) fn solve(
        &self,
        fairness: Fairness,
        priority: ForcePriority,
    ) -> Result<Minimum, SearchError> {
        let exact = matches!(priority, ForcePriority::Exact | ForcePriority::AtMost(0.0));
        let change = self.change();
        let size = change.select_rows(&self.healthy).amax();
        let fixed = self.fixed(fairness, exact)?;
        let mut basis = if exact {
            self.keeping()
        } else {
            DMatrix::identity(change.ncols(), change.ncols())
        };
        if !fixed.all.is_empty() {
            let moved = change.select_rows(&fixed.all) * &basis;
            basis = &basis * null_space_of_size(&moved, change.amax());
        }
        let inner = self.within(&basis);
        let search = Search {
            problem: &inner,
            fairness,
            fixed: &fixed,
            size,
        };
        let none = DMatrix::zeros(0, basis.ncols());
        let mut minimum = match priority {
            ForcePriority::Exact | ForcePriority::AtMost(0.0) => search.least(&none, None)?,
            ForcePriority::AtMost(radius) if radius > 0.0 => {
                let [before, after] = &inner.forces;
                let within: &dyn Fn(&mut Program) = &|program| {
                    if radius.is_finite() {
                        program.norm_at_most(before, radius);
                        program.norm_at_most(after, radius);
                    }
                };
                let outcome = inner.outcome(fairness);
                search.least(&none, Some(within))?.with_least_force(
                    &outcome,
                    [before, after],
                    radius,
                    &inner.limits,
                )?
            }
            ForcePriority::Weight(weight) if weight > 0.0 && weight.is_finite() => {
                search.least(&(inner.force() * weight), None)?
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
        minimum.x = basis * minimum.x;
        let kept = stack(&self.outcome(fairness), &self.force());
        Ok(minimum.with_least_variables(&kept, &self.limits))
    }

    /// The joints whose steps cannot change under `fairness`, if `exact` with the tool force kept.
    fn fixed(&self, fairness: Fairness, exact: bool) -> Result<Fixed, SearchError> {
        let (Fairness::NoJointWorse(scope) | Fairness::WorstRatio(scope)) = fairness else {
            return Ok(Fixed::default());
        };
        let mut all = self.joints(scope).still;
        let found = if exact { self.weights(scope)? } else { None };
        let covered = found.map_or_else(Vec::new, |found| found.joints);
        all.extend(&covered);
        Ok(Fixed {
            all,
            covered: !covered.is_empty(),
        })
    }
}

/// Joints whose steps stay as they are.
#[derive(Default)]
struct Fixed {
    all: Vec<usize>,
    /// Whether some of them have a step, and a certificate that it stays.
    covered: bool,
}

/// The search within the variables that are left.
struct Search<'a> {
    problem: &'a Problem,
    fairness: Fairness,
    fixed: &'a Fixed,
    /// How large the entries of the change of the steps are if none has been cancelled.
    size: f64,
}

impl Search<'_> {
    /// The best, with the squares of the rows `besides` in the objective, and constraints.
    fn least(
        &self,
        besides: &DMatrix<f64>,
        constrain: Option<&dyn Fn(&mut Program)>,
    ) -> Result<Minimum, SearchError> {
        let problem = self.problem;
        let change = problem.change();
        let mut besides = besides.clone();
        if problem.effort > 0.0 {
            let torques = stack(&problem.torques[0], &problem.torques[1]);
            besides = stack(&besides, &(torques * problem.effort));
        }
        let fair = |scope| {
            let mut joints = problem.joints(scope).stepping;
            joints.retain(|joint| !self.fixed.all.contains(joint));
            let (rows, step) = (
                change.select_rows(&joints),
                problem.step.select_rows(&joints),
            );
            (rows, step)
        };
        let (rows, step, limits) = match self.fairness {
            Fairness::WorstRatio(_) if self.fixed.covered => {
                // No worst ratio is below 1 then, and nothing is cheaper than no compensation at all.
                (
                    DMatrix::zeros(0, change.ncols()),
                    DVector::zeros(0),
                    problem.limits.clone(),
                )
            }
            Fairness::WorstRatio(scope) => {
                let (mut rows, mut step) = fair(scope);
                // In units of the whole step, so that effort weighs as it does beside a norm.
                let whole = step.norm();
                for (i, entry) in step.iter_mut().enumerate() {
                    let scale = whole / entry.abs();
                    rows.row_mut(i).scale_mut(scale);
                    *entry *= scale;
                }
                return min_max(&rows, &step, &besides, &problem.limits, constrain);
            }
            Fairness::NoJointWorse(scope) => {
                let (rows, step) = fair(scope);
                let room = [step.abs() - &step, step.abs() + &step];
                let limits = problem.limits.and(&rows, &room);
                let healthy = &problem.healthy;
                (
                    change.select_rows(healthy),
                    problem.step.select_rows(healthy),
                    limits,
                )
            }
            Fairness::LeastNorm => {
                let healthy = &problem.healthy;
                let rows = change.select_rows(healthy);
                (
                    rows,
                    problem.step.select_rows(healthy),
                    problem.limits.clone(),
                )
            }
        };
        let rows = stack(&rows, &besides);
        let step = step.resize_vertically(rows.nrows(), 0.0);
        match constrain {
            None => least_squares((&rows, self.size.max(rows.amax())), &step, &limits),
            Some(constrain) => least_squares_program(&rows, &step, &limits, constrain),
        }
    }
}
