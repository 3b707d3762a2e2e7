//! Whether any compensation that keeps the tool force lowers every joint: proof that none does, or one that does.
//!
//! Let D be all changes `U' − U` of the torque steps by compensations that keep the static tool force before and after the lock. D is a linear space.
//! With an instant lock and away from singular poses it is the null space of J, all columns in it: `J U = 0` and `J U' = 0` give
//! `J (U' − U) = 0`, and `U' = 0` with any U of the null space reaches all of it. So what acts before the lock alone does as well as both.
//! (With a control period the arm moves between the two, and D is larger: by torques that grow as the period shrinks.)
//!
//! **Certificate.** Let y be orthogonal to D; with D as above, `y = Jᵀ f` for a tool wrench f. Then `y · after = y · step` for every such compensation.
//! Let further `y_i` have the sign of `step_i`, or be 0, for each joint of the scope, and be 0 outside it
//! (over the healthy joints alone: f gives no torque on a locked joint). Then
//!
//! `Σ |y_i| |step_i| = y · step = y · after ≤ Σ |y_i| |after_i|`.
//!
//! So of the joints with `y_i ≠ 0`, the *covered* ones, not all are lowered by any such compensation; if it lowers one of them, it raises another,
//! and the sum of their steps, weighted with |y_i|, is not lowered at all.
//!
//! **Witness.** If there is no such y but 0, then (Gordan 1873; with the joints that have no step, Motzkin 1936) some d in D has the sign of
//! `−step_i` for every joint of the scope, and a small enough multiple of it lowers them all. Exactly one of the two exists.
//!
//! Joints at the margin:
//! - A joint whose step is 0, up to rounding, can not be lowered; it is to be given none. Its `y_i` may have any sign, and `|y_i| |after_i|` joins the right-hand sum.
//! - A joint whose y_i is 0 for every y orthogonal to D, as one whose column of J is 0, can be moved by itself. It can be freed of its step whatever the others do,
//!   and can not help them: it is never covered. Joint 7 of ssrms under a position task is one.
//! - A joint may have `y_i = 0` in every certificate for its sign's sake. The covered joints returned are all that any certificate covers:
//!   the others of the scope can be lowered all at once, with the covered ones left as they are.
//!
//! Rated torques only take compensations away: a certificate holds with them too. A witness keeps them.

use nalgebra::{DMatrix, DVector, SVector, Vector6};

use super::conic::Program;
use super::fairness::{Acts, Fairness};
use super::free_map::task_rows;
use super::optimal::{ForcePriority, FreeMaps, Optimum};
use super::problem::Problem;
use super::pseudo_inverse::{null_space_of_size, stack};
use super::scope::Scope;
use crate::search::{Operation, SearchError, Solution};

/// Whether every joint of a [`Scope`] can be lowered at once with the tool force kept.
#[derive(Clone, Debug, PartialEq)]
pub enum LowerAll<const N: usize> {
    /// No.
    Certificate(Certificate<N>),
    /// Yes, by this compensation: that with the least [`Fairness::WorstRatio`].
    Witness(Solution<N>),
}

/// The proof that no compensation which keeps the tool force lowers every joint (the module's head has the theorem).
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate<const N: usize> {
    /// f, `[force; moment]`, world axes, N and N·m, 0 outside the task; in units in which none of its components exceeds 1.
    pub wrench: Vector6<f64>,
    /// y, `Jᵀ f` of all joints just before the lock, N·m (N): orthogonal to every change of the steps; of the sign of the step, or 0, for each joint of the scope that has one.
    ///
    /// Beside the covered joints only those without a step can weigh: to lower all covered joints at once, one of these would have to be given a step.
    ///
    /// Where the pose counts as near-singular nothing acts, any y will do, and f is but the nearest wrench.
    pub weights: SVector<f64, N>,
    /// The least |y_i| over the covered joints: f is the wrench for which it is largest, N·m per N (N per N for a prismatic joint).
    pub margin: f64,
    /// The joints that cannot be lowered all at once, counted from 0, ascending.
    pub joints: Vec<usize>,
}

/// Whether a compensation that keeps the static tool force can lower the steps of all joints in `scope` at once.
///
/// # Errors
/// When the motion itself breaks rated torques at the lock, or when rounding or a rated torque without any room leave neither answer.
pub fn lower_every_joint<const N: usize>(
    operation: &Operation<N>,
    scope: Scope,
) -> Result<LowerAll<N>, SearchError> {
    let problem = FreeMaps::new(operation, Acts::Both).problem(operation);
    let Some(found) = problem.weights(scope)? else {
        let witness = Optimum {
            priority: ForcePriority::Exact,
            fairness: Fairness::WorstRatio(scope),
            acts: Acts::Both,
        };
        let witness = witness.solve(operation)?;
        let (step, impact) = (operation.step(), witness.assessment.impact);
        let mut stepping = problem.joints(scope).stepping.into_iter();
        return if stepping.all(|joint| impact[joint].abs() < step[joint].abs()) {
            Ok(LowerAll::Witness(witness))
        } else {
            Err(SearchError::NotSolved(
                "neither that every joint can be lowered nor that none can is beyond rounding and the rated torques",
            ))
        };
    };
    let weights = SVector::from_fn(|joint, _| found.weights[joint]);
    let mut wrench = operation.before().pose.null_space.static_wrench(&weights);
    // In the unit that the margin is stated in, to the last digit.
    let largest = wrench.amax();
    let unit = if largest > 0.0 { 1.0 / largest } else { 1.0 };
    wrench *= unit;
    let weights = weights * unit;
    let covered = found.joints.iter().map(|joint| weights[*joint].abs());
    Ok(LowerAll::Certificate(Certificate {
        wrench,
        weights,
        margin: covered.fold(f64::INFINITY, f64::min),
        joints: found.joints,
    }))
}

/// y, and the joints that it covers.
pub(super) struct Weights {
    pub(super) weights: DVector<f64>,
    pub(super) joints: Vec<usize>,
}

/// Weights below this part of the largest that could be are 0: the solver's tolerance.
const ZERO: f64 = 1e-8;

impl Problem {
    /// The certificate's weights that cover the most joints of `scope`, and among those the largest margin; `None` if there are none.
    pub(super) fn weights(&self, scope: Scope) -> Result<Option<Weights>, SearchError> {
        let joints = self.joints(scope);
        let changes = self.changes();
        let space = Orthogonal::new(&changes, &joints.outside, &self.wrench, &self.jacobian);
        let movable = |joint: &usize| space.basis.row(*joint).amax() > ZERO;
        let stepping: Vec<usize> = joints.stepping.into_iter().filter(movable).collect();
        if stepping.is_empty() || space.basis.is_empty() {
            return Ok(None);
        }
        if let Some(weights) = self.with_largest_margin(&space, &stepping)? {
            return Ok(Some(Weights {
                weights,
                joints: stepping,
            }));
        }
        // Not all: each that is covered by any is covered by the sum.
        let mut sum = DVector::zeros(self.step.len());
        for joint in &stepping {
            let signed = self.signed_rows(&space, &[*joint]);
            let mut program = space.program(0);
            program.linear.copy_from_slice((-signed).as_slice());
            program.at_most(
                &-self.signed_rows(&space, &stepping),
                &vec![0.0; stepping.len()],
            );
            sum += space.solve(program)?;
        }
        let threshold = ZERO * space.size();
        let covered = |joint: &usize| sum[*joint] * self.step[*joint].signum() > threshold;
        let (covered, bare): (Vec<usize>, Vec<usize>) = stepping.into_iter().partition(covered);
        if covered.is_empty() {
            return Ok(None);
        }
        // The others' weights are exactly 0 from here on.
        let none: Vec<usize> = joints.outside.into_iter().chain(bare).collect();
        let space = Orthogonal::new(&changes, &none, &self.wrench, &self.jacobian);
        let weights = self.with_largest_margin(&space, &covered)?;
        Ok(weights.map(|weights| Weights {
            weights,
            joints: covered,
        }))
    }

    /// σ_i y_i of `joints`, by the coordinates of y.
    fn signed_rows(&self, space: &Orthogonal, joints: &[usize]) -> DMatrix<f64> {
        let mut rows = space.basis.select_rows(joints);
        for (i, joint) in joints.iter().enumerate() {
            rows.row_mut(i).scale_mut(self.step[*joint].signum());
        }
        rows
    }

    /// y with `σ_i y_i ≥ t` for all `joints` and the largest t; `None` if that is 0.
    fn with_largest_margin(
        &self,
        space: &Orthogonal,
        joints: &[usize],
    ) -> Result<Option<DVector<f64>>, SearchError> {
        let coordinates = space.basis.ncols();
        if coordinates == 0 {
            return Ok(None);
        }
        let mut program = space.program(1);
        program.linear[coordinates] = -1.0;
        let rows = -self.signed_rows(space, joints);
        let rows = rows.insert_column(coordinates, 1.0);
        program.at_most(&rows, &vec![0.0; joints.len()]);
        let weights = space.solve(program)?;
        let signed = joints
            .iter()
            .map(|joint| weights[*joint] * self.step[*joint].signum());
        let margin = signed.fold(f64::INFINITY, f64::min);
        Ok((margin > ZERO * space.size()).then_some(weights))
    }
}

/// All y orthogonal to the changes of the steps, those of some joints 0.
struct Orthogonal {
    /// Orthonormal, N × its dimension.
    basis: DMatrix<f64>,
    /// What is to stay within ±1: f, and what y is beside Jᵀ f.
    bounded: DMatrix<f64>,
}

impl Orthogonal {
    fn new(
        changes: &DMatrix<f64>,
        without: &[usize],
        wrench: &DMatrix<f64>,
        jacobian: &DMatrix<f64>,
    ) -> Self {
        let joints = changes.nrows();
        let mut zero = DMatrix::zeros(without.len(), joints);
        for (row, joint) in without.iter().enumerate() {
            zero[(row, *joint)] = 1.0;
        }
        let basis = null_space_of_size(&stack(&changes.transpose(), &zero), 1.0);
        let wrench = wrench * &basis;
        let rest = &basis - jacobian.tr_mul(&wrench);
        // Rounding is no reason for a bound.
        let beside: Vec<usize> = (0..joints)
            .filter(|joint| rest.row(*joint).amax() > ZERO)
            .collect();
        let bounded = stack(&wrench, &rest.select_rows(&beside));
        Self { basis, bounded }
    }

    /// How large an entry of y can become.
    fn size(&self) -> f64 {
        1.0 / self.bounded.amax()
    }

    /// A program in the coordinates of y within its bounds, and `more` variables.
    fn program(&self, more: usize) -> Program {
        let mut program = Program::new(self.basis.ncols() + more);
        let ones = vec![1.0; self.bounded.nrows()];
        program.at_most(&self.bounded, &ones);
        program.at_most(&-&self.bounded, &ones);
        program
    }

    /// y of the solution.
    fn solve(&self, program: Program) -> Result<DVector<f64>, SearchError> {
        let unsolved = SearchError::NotSolved("the program of the certificate");
        let minimum = program.solve()?.ok_or(unsolved)?;
        Ok(&self.basis * minimum.x.rows(0, self.basis.ncols()))
    }
}

/// `(Jᵀ)†` of all joints just before the lock, and J, both with the task's rows alone: what makes f of y, and y of f.
pub(super) fn wrench_maps<const N: usize>(operation: &Operation<N>) -> [DMatrix<f64>; 2] {
    let before = operation.before();
    let rows = task_rows(before);
    let wrench = DMatrix::from_fn(rows.len(), N, |row, joint| {
        let unit = SVector::<f64, N>::from_fn(|i, _| f64::from(u8::from(i == joint)));
        before.pose.null_space.static_wrench(&unit)[rows[row]]
    });
    let jacobian = DMatrix::from_fn(rows.len(), N, |row, joint| {
        before.pose.jacobian[(rows[row], joint)]
    });
    [wrench, jacobian]
}
