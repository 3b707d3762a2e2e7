//! Section 5 of the paper as a library: a [`Scenario`] in, the cases with their series out.
//!
//! A *case* is one experiment, one failure time, one way to find a compensation. The impact is that of Eq. 18 for
//! ever shorter control cycles; extremes and series are those of a [`Controller`] that flies the whole motion cycle by cycle.
//! Results carry plain lists, one entry for each joint, so that tables and figures need not know how many there are.

mod campaign;
mod flight;
mod truth;

use nalgebra::SVector;

use crate::compensation::{Compensation, Controller};
use crate::failure::{Failure, LockedJoints};
use crate::scenario::{Experiment, PlanError, PlannedMotion, Scenario};
use crate::search::{
    CoefficientLaw, ForcePriority, FrontierPoint, Objective, Operation, OperationOptions, Outcome,
    SearchError, SolveStatus, Stepwise, cancel_per_joint, frontier, least_impact, optimal,
};
use crate::simulation::{Ending, SimulationError};
use crate::{Arm, Law};
pub use campaign::{Campaign, CampaignCase, CampaignOutcome};
pub use flight::{Flight, Series};
pub use truth::{BrakeImpulse, Truth, TruthRun};

/// How a compensation is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// Eq. 16 by the paper's search (Figure 2).
    StepwisePerJoint,
    /// Eq. 16 exactly.
    PerJoint,
    /// Eq. 20 by the paper's search, repeated until no coefficient moves.
    StepwiseProjected,
    /// Eq. 20 exactly: the least norm over the healthy joints.
    Projected,
    /// The least norm over the healthy joints that any compensation leaves that keeps the static tool force.
    Optimal,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::StepwisePerJoint,
        Self::PerJoint,
        Self::StepwiseProjected,
        Self::Projected,
        Self::Optimal,
    ];

    /// The law whose parameters it finds.
    pub fn law(self) -> Law {
        match self {
            Self::StepwisePerJoint | Self::PerJoint => Law::PerJoint,
            Self::StepwiseProjected | Self::Projected => Law::Projected,
            Self::Optimal => Law::Optimal,
        }
    }

    /// Whether it is the paper's search in steps.
    pub fn is_stepwise(self) -> bool {
        matches!(self, Self::StepwisePerJoint | Self::StepwiseProjected)
    }
}

/// One experiment, one failure time, one method.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// [`Experiment::section`].
    pub section: String,
    /// How the compensation was found.
    pub method: Method,
    /// The joints that lock, counted from 0.
    pub failed_joints: Vec<usize>,
    /// When, s.
    pub failure_time: f64,
    /// The rated torques kept, N·m (N); infinite where a joint has none, `None` if none has.
    pub rated_torque: Option<Vec<f64>>,
    /// |Δτ̃_i| without compensation, N·m (N).
    pub impact_before: Vec<f64>,
    /// |Δτ̃_i| with compensation, N·m (N). A locked joint's goes into its brake.
    pub impact_after: Vec<f64>,
    /// The diagonal of k_d; zeros for [`Law::Optimal`], which has none.
    pub coefficients: Vec<f64>,
    /// h of Eq. 13 at the lock, the larger norm of just before and just after, N (with the moments' N·m, if the task has any).
    pub force_error: f64,
    /// How the search ended; `Err` if there is nothing that keeps the limits, and no compensation then.
    pub search: Result<Search, SearchError>,
    /// The whole motion under the controller.
    pub flight: Flight,
}

/// How the search for a compensation ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Found how.
    pub status: SolveStatus,
    /// Primal minus dual objective; `None` on a grid.
    pub gap: Option<f64>,
    /// Steps on the grid, or iterations of the solver.
    pub iterations: usize,
    /// The time it took, s.
    pub seconds: f64,
}

impl Case {
    /// 100 (1 − after/before) for each joint; 0 where there is no impact to suppress.
    pub fn suppression_percent(&self) -> Vec<f64> {
        let joints = self.impact_before.iter().zip(&self.impact_after);
        joints
            .map(|(before, after)| {
                if *before > 0.0 {
                    100.0 * (1.0 - after / before)
                } else {
                    0.0
                }
            })
            .collect()
    }

    /// The norm of the impact over the joints that are not locked: before and after, N·m.
    pub fn healthy_impact(&self) -> (f64, f64) {
        let norm = |impact: &[f64]| {
            let joints = impact.iter().enumerate();
            let healthy = joints.filter(|(joint, _)| !self.failed_joints.contains(joint));
            healthy
                .map(|(_, torque)| torque * torque)
                .sum::<f64>()
                .sqrt()
        };
        (norm(&self.impact_before), norm(&self.impact_after))
    }
}

/// What force error buys: the least impact over the healthy joints for each force error at the lock.
#[derive(Clone, Debug, PartialEq)]
pub struct Tradeoff {
    /// Force error, N, and the norm of the impact, N·m; ascending in the first.
    pub frontier: Vec<(f64, f64)>,
}

/// All cases of an experiment at one failure time.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// [`Experiment::section`].
    pub section: String,
    /// s.
    pub failure_time: f64,
    /// One for each [`Method`], in the order of [`Method::ALL`].
    pub cases: Vec<Case>,
    /// The frontier that [`Method::Optimal`] is the end of; `None` where the limits leave no compensation at all.
    pub tradeoff: Option<Tradeoff>,
}

impl Study {
    /// The case of `method`.
    pub fn case(&self, method: Method) -> &Case {
        &self.cases[method as usize]
    }
}

/// Why a scenario cannot be tried out.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ExperimentError {
    /// The motion cannot be flown.
    #[error("the motion cannot be flown: {0}")]
    Motion(#[from] PlanError),
    /// A joint that the arm does not have, counted from 0.
    #[error("joint {} fails, the arm has {joints}", joint + 1)]
    Joint {
        /// Counted from 0.
        joint: usize,
        /// How many there are.
        joints: usize,
    },
    /// The operation cannot be looked at.
    #[error(transparent)]
    Operation(#[from] SearchError),
    /// The operation cannot be simulated.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// A simulation did not come to its end.
    #[error("the simulated lock at {time} s did not come to its end: {ending:?}")]
    Unfinished {
        /// The failure time, s.
        time: f64,
        /// How it ended.
        ending: Ending,
    },
}

/// The largest time between two knots of a tool path, s.
const KNOT_PERIOD: f64 = 0.02;

/// An arm on the motion of a scenario, ready for its experiments.
#[derive(Clone, Debug)]
pub struct Laboratory<'a, A, const N: usize> {
    arm: &'a A,
    scenario: &'a Scenario,
    motion: PlannedMotion<N>,
    failed_joints: LockedJoints<N>,
}

impl<'a, A: Arm<N>, const N: usize> Laboratory<'a, A, N> {
    /// How many points of a frontier are computed.
    const FRONTIER_POINTS: u32 = 20;

    /// Plans the motion.
    ///
    /// # Errors
    /// When `arm` is not the scenario's, or cannot fly its motion.
    pub fn new(arm: &'a A, scenario: &'a Scenario) -> Result<Self, ExperimentError> {
        let motion = scenario.motion.plan(arm, KNOT_PERIOD)?;
        let failed = &scenario.failed_joints;
        let failed_joints = LockedJoints::new(failed).ok_or_else(|| ExperimentError::Joint {
            joint: failed.iter().copied().max().unwrap_or(0),
            joints: N,
        })?;
        Ok(Self {
            arm,
            scenario,
            motion,
            failed_joints,
        })
    }

    /// The planned motion.
    pub fn motion(&self) -> &PlannedMotion<N> {
        &self.motion
    }

    /// Every experiment at every failure time, in the scenario's order.
    ///
    /// # Errors
    /// When the motion under the tool force cannot be looked at, as with torques that are no finite numbers.
    pub fn run(&self) -> Result<Vec<Study>, ExperimentError> {
        let experiments = self.scenario.experiments.iter();
        let studies = experiments.flat_map(|experiment| {
            let times = self.scenario.failure_times.iter();
            times.map(move |time| self.study(experiment, *time))
        });
        studies.collect()
    }

    /// One experiment with the failure at `failure_time`.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn study(
        &self,
        experiment: &Experiment,
        failure_time: f64,
    ) -> Result<Study, ExperimentError> {
        let operation = self.operation(experiment, failure_time)?;
        let cases = Method::ALL.map(|method| self.case(experiment, &operation, method));
        let per_joint = cases[Method::PerJoint as usize].force_error;
        Ok(Study {
            section: experiment.section.clone(),
            failure_time,
            tradeoff: tradeoff(&operation, per_joint, Self::FRONTIER_POINTS).ok(),
            cases: cases.into(),
        })
    }

    fn operation(
        &self,
        experiment: &Experiment,
        failure_time: f64,
    ) -> Result<Operation<N>, SearchError> {
        let failure = Failure {
            joints: self.failed_joints,
            time: failure_time,
        };
        let options = OperationOptions {
            sample_period: self.scenario.cycle,
            rated_torque: rated_torque(experiment),
            ..OperationOptions::default()
        };
        let force = |time| experiment.force.at(time);
        Operation::new(self.arm, &self.motion, force, &failure, &options)
    }

    fn case(&self, experiment: &Experiment, operation: &Operation<N>, method: Method) -> Case {
        let found = self.search(operation, method);
        let (compensation, search) = match found {
            Ok(outcome) => (
                outcome.compensation,
                Ok(Search {
                    status: outcome.status,
                    gap: outcome.gap,
                    iterations: outcome.iterations,
                    seconds: outcome.seconds,
                }),
            ),
            Err(error) => (Compensation::none(), Err(error)),
        };
        let assessment = operation.assess(&compensation);
        let failure = operation.failure();
        let controller =
            Controller::new(self.arm, compensation).with_rated_torque(*operation.rated_torque());
        let flight = Flight::fly(
            &controller,
            &self.motion,
            &experiment.force,
            failure,
            self.scenario.cycle,
        );
        let coefficients = match compensation {
            Compensation::PerJoint(k) | Compensation::Projected(k) => k,
            Compensation::Optimal { .. } => SVector::zeros(),
        };
        Case {
            section: experiment.section.clone(),
            method,
            failed_joints: failure.joints.iter().collect(),
            failure_time: failure.time,
            rated_torque: experiment.rated_torque.clone(),
            impact_before: list(&operation.step().abs()),
            impact_after: list(&assessment.impact.abs()),
            coefficients: list(&coefficients),
            force_error: assessment.force_error(),
            search,
            flight,
        }
    }

    fn search(&self, operation: &Operation<N>, method: Method) -> Result<Outcome<N>, SearchError> {
        let grid = self.scenario.search;
        let stepwise = Stepwise {
            start: SVector::repeat(grid.start),
            ..Stepwise::with_step(grid.step)
        };
        match method {
            Method::StepwisePerJoint => stepwise.search(operation, CoefficientLaw::PerJoint),
            Method::PerJoint => cancel_per_joint(operation),
            Method::StepwiseProjected => stepwise.search(operation, CoefficientLaw::Projected),
            Method::Projected => least_impact(operation, Objective::LeastSquares),
            Method::Optimal => optimal(operation, ForcePriority::Exact),
        }
    }
}

/// The frontier, up to the force error from which more of it buys nothing: with `most` N the impact is all gone, if limits allow.
fn tradeoff<const N: usize>(
    operation: &Operation<N>,
    most: f64,
    points: u32,
) -> Result<Tradeoff, SearchError> {
    let up_to = |most: f64| {
        let allowed: Vec<f64> = (0..=points)
            .map(|i| most * f64::from(i) / f64::from(points))
            .collect();
        let point = |point: &FrontierPoint<N>| {
            let assessment = &point.outcome.assessment;
            (assessment.force_error(), assessment.healthy_impact)
        };
        let points = frontier(operation, &allowed)?;
        Ok::<Vec<(f64, f64)>, SearchError>(points.iter().map(point).collect())
    };
    let coarse = up_to(most)?;
    let first = coarse.first().map_or(0.0, |point| point.1);
    let least = coarse.iter().map(|point| point.1).fold(first, f64::min);
    let enough = coarse.iter().find(|point| point.1 <= least + 1e-6 * first);
    Ok(Tradeoff {
        frontier: up_to(enough.map_or(most, |point| point.0))?,
    })
}

/// Infinite where there is no limit.
fn rated_torque<const N: usize>(experiment: &Experiment) -> SVector<f64, N> {
    let rated = experiment.rated_torque.as_deref();
    let rated = rated.and_then(|rated| <[f64; N]>::try_from(rated).ok());
    rated.map_or(SVector::repeat(f64::INFINITY), SVector::from)
}

fn list<const N: usize>(vector: &SVector<f64, N>) -> Vec<f64> {
    vector.as_slice().to_vec()
}
