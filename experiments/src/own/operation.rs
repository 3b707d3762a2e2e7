//! [`Operation`]: a plan with a lock in it, and the searches for a compensation.

use nalgebra::SVector;
use ulna::control::compensation::Projector;
use ulna::control::failure::Failure;
use ulna_study::experiment::{AnyArm, ExperimentError};
use ulna_study::scenario::ToolForce;
use ulna_study::search::{
    self, CoefficientLaw, EFFORT, Objective, OperationOptions, Optimum, SearchError, Solution,
    SolveStatus, Stepwise, cancel_per_joint, least_impact,
};

use super::plan::planned;
use crate::lists::{list, locked, vector_or};
use crate::{Law, Plan};

/// A lock in a motion, and what is kept to.
#[derive(Clone, Debug, PartialEq)]
pub struct Locking {
    /// The joints that lock together, counted from 0.
    pub joints: Vec<usize>,
    /// When, s.
    pub time: f64,
    /// What the tool exerts, and what the lock takes from it.
    pub force: ToolForce,
    /// N·m (N); `None` for no limit.
    pub rated_torque: Option<Vec<f64>>,
    /// The projector of every law.
    pub projector: Projector,
    /// The largest time between two times that a search looks at, s.
    pub sample_period: f64,
    /// Δt of Eq. 18, s.
    pub step_time: f64,
    /// The weight of effort in every search ([`OperationOptions::effort`]).
    pub effort: f64,
}

impl Locking {
    /// `joints` that lock at `time` s, the tool exerting `force`; without rated torques, and with the defaults of [`OperationOptions`].
    pub fn new(joints: &[usize], time: f64, force: ToolForce) -> Self {
        Self {
            joints: joints.to_vec(),
            time,
            force,
            rated_torque: None,
            projector: Projector::Static,
            sample_period: 0.05,
            step_time: 0.0,
            effort: EFFORT,
        }
    }

    pub(crate) fn failure<const N: usize>(&self) -> Result<Failure<N>, ExperimentError> {
        Ok(Failure {
            joints: locked(&self.joints)?,
            time: self.time,
        })
    }
}

/// How a compensation is searched for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Search {
    /// Eq. 16 exactly: [`cancel_per_joint`].
    PerJoint,
    /// Eq. 20 exactly: [`least_impact`].
    Projected(Objective),
    /// The best compensation there is.
    Optimal(Optimum),
    /// The paper's search (Figure 2).
    Stepwise {
        /// Whose coefficients.
        law: CoefficientLaw,
        /// Where every coefficient starts.
        start: f64,
        /// Above 0.
        step: f64,
        /// How often to go on from the best point with a tenth of the step; 0 is the paper's search.
        refinements: u32,
    },
}

/// What a compensation does to an operation: [`search::Assessment`], whatever the number of joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Assessed {
    /// Δτ̃ of Eq. 18, after minus before, N·m (N).
    pub impact: Vec<f64>,
    /// Its norm over the joints that do not lock.
    pub healthy_impact: f64,
    /// By how much the static wrench of the tool is off just before the lock, N and N·m.
    pub force_error_before: [f64; 6],
    /// Just after it.
    pub force_error_after: [f64; 6],
    /// The largest norm over the whole motion.
    pub max_force_error: f64,
    /// The largest |τ_i| over the whole motion, brakes excepted, N·m (N).
    pub peak_torque: Vec<f64>,
    /// The largest |U_i|.
    pub peak_compensation: Vec<f64>,
    /// What is left of the rated torques, N·m (N); infinite without limits.
    pub least_margin: f64,
}

/// What a search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The law with its parameters.
    pub law: Law,
    /// What it does.
    pub assessed: Assessed,
    /// How the search ended.
    pub status: SolveStatus,
    /// The solver's optimality gap, N²m² or N·m; 0 for a closed form, `None` on a grid.
    pub gap: Option<f64>,
    /// Steps on the grid, or iterations of the solver.
    pub iterations: usize,
    /// How long it took, s.
    pub seconds: f64,
}

/// A planned motion with a lock in it: [`search::Operation`], whatever the number of joints.
pub trait Operation: Send + Sync {
    /// The step of each joint's torque without compensation, after minus before, N·m (N).
    fn step(&self) -> Vec<f64>;

    /// Searches.
    ///
    /// # Errors
    /// When nothing keeps the limits, an argument makes no search, or a solver stops without an answer.
    fn search(&self, search: &Search) -> Result<Found, SearchError>;

    /// What `law` does, cut at rated torques as a control cycle cuts it.
    ///
    /// # Errors
    /// When it is a law for another number of joints.
    fn assess(&self, law: &Law) -> Result<Assessed, ExperimentError>;
}

impl<const N: usize> Operation for search::Operation<N> {
    fn step(&self) -> Vec<f64> {
        list(&self.step())
    }

    fn search(&self, search: &Search) -> Result<Found, SearchError> {
        let found = match search {
            Search::PerJoint => cancel_per_joint(self),
            Search::Projected(objective) => least_impact(self, *objective),
            Search::Optimal(optimum) => optimum.solve(self),
            Search::Stepwise {
                law,
                start,
                step,
                refinements,
            } => {
                let stepwise = Stepwise {
                    start: SVector::repeat(*start),
                    refinements: *refinements,
                    ..Stepwise::with_step(*step)
                };
                stepwise.search(self, *law)
            }
        };
        found.map(|solution| Found::from(&solution))
    }

    fn assess(&self, law: &Law) -> Result<Assessed, ExperimentError> {
        Ok(Assessed::from(&self.assess(&law.compensation()?)))
    }
}

impl<const N: usize> From<&search::Assessment<N>> for Assessed {
    fn from(assessment: &search::Assessment<N>) -> Self {
        Self {
            impact: list(&assessment.impact),
            healthy_impact: assessment.healthy_impact,
            force_error_before: assessment.force_error_before.into(),
            force_error_after: assessment.force_error_after.into(),
            max_force_error: assessment.max_force_error,
            peak_torque: list(&assessment.peak_torque),
            peak_compensation: list(&assessment.peak_compensation),
            least_margin: assessment.least_margin,
        }
    }
}

impl<const N: usize> From<&Solution<N>> for Found {
    fn from(solution: &Solution<N>) -> Self {
        Self {
            law: Law::of(&solution.compensation),
            assessed: Assessed::from(&solution.assessment),
            status: solution.status,
            gap: solution.gap,
            iterations: solution.iterations,
            seconds: solution.seconds,
        }
    }
}

pub(crate) fn operation<const N: usize>(
    arm: &AnyArm<N>,
    plan: &dyn Plan,
    locking: &Locking,
) -> Result<Box<dyn Operation>, ExperimentError> {
    let motion = planned::<N>(plan)?;
    let no_limit = SVector::repeat(f64::INFINITY);
    let options = OperationOptions {
        sample_period: locking.sample_period,
        step_time: locking.step_time,
        wrench_step: locking.force.lock_step,
        rated_torque: vector_or(locking.rated_torque.as_deref(), no_limit)?,
        projector: locking.projector,
        effort: locking.effort,
        ..OperationOptions::default()
    };
    let force = |time| locking.force.at(time);
    let failure = locking.failure()?;
    let operation = search::Operation::new(arm, motion, force, &failure, &options)?;
    Ok(Box::new(operation))
}
