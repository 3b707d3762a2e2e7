//! A convex program put together row by row, and solved by Clarabel.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use nalgebra::{DMatrix, DVector};

use crate::search::{SearchError, SolveStatus};

/// `min ½ xᵀ P x + qᵀ x`, P diagonal, subject to `b − A x` in a product of cones.
pub(super) struct Program {
    /// The diagonal of P.
    pub(super) quadratic: Vec<f64>,
    /// q.
    pub(super) linear: Vec<f64>,
    rows: Vec<(usize, usize, f64)>,
    bounds: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
    /// Of the gap and of the constraints, relative.
    pub(super) tolerance: f64,
}

/// What the solver says.
pub(super) struct Minimum {
    pub(super) x: DVector<f64>,
    pub(super) status: SolveStatus,
    pub(super) gap: f64,
    pub(super) iterations: usize,
}

impl Program {
    /// Without objective and constraints, of `variables`.
    pub(super) fn new(variables: usize) -> Self {
        Self {
            quadratic: vec![0.0; variables],
            linear: vec![0.0; variables],
            rows: Vec::new(),
            bounds: Vec::new(),
            cones: Vec::new(),
            tolerance: 1e-10,
        }
    }

    /// The rows `b − Σ A x`, for the cone that is pushed next: each A acts on the variables from a first one on.
    fn constrain(&mut self, blocks: &[(usize, &DMatrix<f64>)], b: &[f64]) {
        let start = self.bounds.len();
        for (first, a) in blocks {
            for (column, values) in a.column_iter().enumerate() {
                for (row, value) in values.iter().enumerate() {
                    if *value != 0.0 {
                        self.rows.push((start + row, first + column, *value));
                    }
                }
            }
        }
        self.bounds.extend_from_slice(b);
    }

    /// `A x = b`.
    pub(super) fn equal(&mut self, a: &DMatrix<f64>, b: &[f64]) {
        self.constrain(&[(0, a)], b);
        self.cones.push(SupportedConeT::ZeroConeT(b.len()));
    }

    /// `A x ≤ b`.
    pub(super) fn at_most(&mut self, a: &DMatrix<f64>, b: &[f64]) {
        if b.is_empty() {
            return;
        }
        self.constrain(&[(0, a)], b);
        self.cones.push(SupportedConeT::NonnegativeConeT(b.len()));
    }

    /// `‖A x‖ ≤ radius`.
    pub(super) fn norm_at_most(&mut self, a: &DMatrix<f64>, radius: f64) {
        let mut cone = a.clone().insert_row(0, 0.0);
        cone.neg_mut();
        let mut b = vec![0.0; a.nrows() + 1];
        b[0] = radius;
        self.constrain(&[(0, &cone)], &b);
        self.cones.push(SupportedConeT::SecondOrderConeT(b.len()));
    }

    /// `‖A x‖ ≤ x_bound`, A on the variables before `bound`.
    pub(super) fn norm_at_most_variable(&mut self, a: &DMatrix<f64>, bound: usize) {
        let mut cone = a
            .clone()
            .insert_row(0, 0.0)
            .resize_horizontally(bound + 1, 0.0);
        cone[(0, bound)] = 1.0;
        cone.neg_mut();
        self.constrain(&[(0, &cone)], &vec![0.0; a.nrows() + 1]);
        self.cones
            .push(SupportedConeT::SecondOrderConeT(a.nrows() + 1));
    }

    /// `A x ≤ b`, A on the variables from `first` on.
    pub(super) fn at_most_from(&mut self, first: usize, a: &DMatrix<f64>, b: &[f64]) {
        self.at_most_of(&[(first, a)], b);
    }

    /// `Σ A x ≤ b`.
    pub(super) fn at_most_of(&mut self, blocks: &[(usize, &DMatrix<f64>)], b: &[f64]) {
        self.constrain(blocks, b);
        self.cones.push(SupportedConeT::NonnegativeConeT(b.len()));
    }

    /// `−b ≤ Σ A x ≤ b`.
    pub(super) fn within(&mut self, blocks: &[(usize, &DMatrix<f64>)], b: &[f64]) {
        let negative: Vec<_> = blocks.iter().map(|(first, a)| (*first, -*a)).collect();
        let negative: Vec<_> = negative.iter().map(|(first, a)| (*first, a)).collect();
        self.constrain(blocks, b);
        self.constrain(&negative, b);
        self.cones
            .push(SupportedConeT::NonnegativeConeT(2 * b.len()));
    }

    /// `‖c + Σ A x‖ ≤ radius + slope x_bound`.
    pub(super) fn cone(
        &mut self,
        blocks: &[(usize, &DMatrix<f64>)],
        c: &[f64],
        radius: f64,
        bound: Option<(usize, f64)>,
    ) {
        let below = |a: &DMatrix<f64>| -a.clone().insert_row(0, 0.0);
        let mut cone: Vec<_> = blocks.iter().map(|(first, a)| (*first, below(a))).collect();
        if let Some((variable, slope)) = bound {
            let mut head = DMatrix::zeros(c.len() + 1, 1);
            head[(0, 0)] = -slope;
            cone.push((variable, head));
        }
        let cone: Vec<_> = cone.iter().map(|(first, a)| (*first, a)).collect();
        let mut b = vec![radius];
        b.extend_from_slice(c);
        self.constrain(&cone, &b);
        self.cones.push(SupportedConeT::SecondOrderConeT(b.len()));
    }

    /// Solves it; `None` if it has no admissible point.
    pub(super) fn solve(self) -> Result<Option<Minimum>, SearchError> {
        let variables = self.linear.len();
        let diagonal: Vec<usize> = (0..variables).collect();
        let p = CscMatrix::new_from_triplets(
            variables,
            variables,
            diagonal.clone(),
            diagonal,
            self.quadratic,
        );
        let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for (row, column, value) in self.rows {
            rows.push(row);
            columns.push(column);
            values.push(value);
        }
        let a = CscMatrix::new_from_triplets(self.bounds.len(), variables, rows, columns, values);
        let settings = DefaultSettings {
            verbose: false,
            tol_gap_abs: self.tolerance,
            tol_gap_rel: self.tolerance,
            tol_feas: self.tolerance,
            tol_infeas_abs: 1e-12,
            tol_infeas_rel: 1e-12,
            ..DefaultSettings::default()
        };
        let mut solver =
            DefaultSolver::new(&p, &self.linear, &a, &self.bounds, &self.cones, settings)
                .map_err(|_| SearchError::NotSolved("the program is malformed"))?;
        solver.solve();
        let solution = solver.solution;
        let status = match solution.status {
            SolverStatus::Solved => SolveStatus::Solved,
            SolverStatus::AlmostSolved => SolveStatus::AlmostSolved,
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                return Ok(None);
            }
            SolverStatus::MaxIterations => {
                return Err(SearchError::NotSolved("too many iterations"));
            }
            SolverStatus::InsufficientProgress => {
                return Err(SearchError::NotSolved("insufficient progress"));
            }
            _ => return Err(SearchError::NotSolved("numerical error")),
        };
        Ok(Some(Minimum {
            x: DVector::from_vec(solution.x),
            status,
            gap: (solution.obj_val - solution.obj_val_dual).abs(),
            iterations: solution.iterations as usize,
        }))
    }
}
