//! [`ExperimentRunner`]: an arm on the motion of a scenario, and the experiments made with it.

use std::fmt;

use nalgebra::SVector;

use super::bound::bounds;
use super::{
    AnyArm, Case, ExperimentError, ForceKept, KNOT_PERIOD, Rollout, Search, SearchMethod, Study,
    Tradeoff, list, rated_torque,
};
use crate::scenario::{Experiment, PlannedMotion, Scenario};
use crate::search::{
    CoefficientLaw, EFFORT, Field, ForcePriority, FrontierPoint, Objective, Operation,
    OperationOptions, SearchError, Solution, Stepwise, cancel_per_joint, equivalent_per_joint,
    frontier, least_impact, optimal,
};
use ulna::Law;
use ulna::control::compensation::{Compensation, Controller};
use ulna::control::failure::{Failure, LockedJoints};

/// An arm on the motion of a scenario, ready for its experiments.
#[derive(Clone)]
pub struct ExperimentRunner<'a, const N: usize> {
    pub(super) arm: &'a AnyArm<N>,
    pub(super) scenario: &'a Scenario,
    motion: PlannedMotion<N>,
    failed_joints: LockedJoints<N>,
}

impl<const N: usize> fmt::Debug for ExperimentRunner<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ExperimentRunner")
            .field("scenario", self.scenario)
            .finish_non_exhaustive()
    }
}

impl<'a, const N: usize> ExperimentRunner<'a, N> {
    /// How many points of a frontier are computed.
    const FRONTIER_POINTS: u32 = 20;

    /// Plans the motion.
    ///
    /// # Errors
    /// When `arm` is not the scenario's, or cannot execute its motion.
    pub fn new(arm: &'a AnyArm<N>, scenario: &'a Scenario) -> Result<Self, ExperimentError> {
        let motion = scenario.motion().plan(arm, KNOT_PERIOD)?;
        let failed = scenario.failed_joints();
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

    pub(super) fn failed_joints(&self) -> LockedJoints<N> {
        self.failed_joints
    }

    /// Every experiment at every failure time, in the scenario's order.
    ///
    /// # Errors
    /// When the motion under the tool force cannot be looked at, as with torques that are no finite numbers.
    pub fn run(&self) -> Result<Vec<Study>, ExperimentError> {
        let experiments = self.scenario.experiments().iter();
        let studies = experiments.flat_map(|experiment| {
            let times = self.scenario.failure_times().iter();
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
        let cases = SearchMethod::ALL.map(|method| self.case(experiment, &operation, method));
        let per_joint = cases[SearchMethod::PerJoint as usize].force_error;
        Ok(Study {
            section: experiment.section().to_owned(),
            failure_time,
            tradeoff: tradeoff(&operation, per_joint, Self::FRONTIER_POINTS).ok(),
            cases: cases.into(),
            force_kept: ForceKept::new(&operation),
        })
    }

    /// The scenario's failure at one time.
    pub(super) fn failure(&self, time: f64) -> Failure<N> {
        Failure {
            joints: self.failed_joints,
            time,
        }
    }

    pub(super) fn operation(
        &self,
        experiment: &Experiment,
        failure_time: f64,
    ) -> Result<Operation<N>, ExperimentError> {
        self.operation_with(experiment, failure_time, Field::default(), EFFORT)
    }

    /// The same with a field in the place of ∇w_D, and a weight of effort.
    pub(super) fn operation_with(
        &self,
        experiment: &Experiment,
        failure_time: f64,
        field: Field,
        effort: f64,
    ) -> Result<Operation<N>, ExperimentError> {
        let failure = self.failure(failure_time);
        let options = OperationOptions {
            sample_period: self.scenario.cycle(),
            step_time: experiment.step_time(),
            wrench_step: experiment.force().lock_step,
            rated_torque: rated_torque(experiment)?,
            field,
            effort,
            projector: self.scenario.servo().projector(),
        };
        let force = |time| experiment.force().at(time);
        let operation = Operation::new(self.arm, &self.motion, force, &failure, &options)?;
        Ok(operation)
    }

    fn case(
        &self,
        experiment: &Experiment,
        operation: &Operation<N>,
        method: SearchMethod,
    ) -> Case {
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
        let controller = Controller::new(self.arm, compensation)
            .with_rated_torque(*operation.rated_torque())
            .with_projector(self.scenario.servo().projector());
        let rollout = Rollout::execute(
            &controller,
            &self.motion,
            experiment.force(),
            failure,
            experiment.step_time(),
            self.scenario.cycle(),
        );
        let coefficients = match compensation {
            Compensation::PerJoint(k) | Compensation::Projected(k) => k,
            Compensation::Optimal { .. } => equivalent_per_joint(operation, &assessment),
        };
        Case {
            section: experiment.section().to_owned(),
            method,
            failed_joints: failure.joints.iter().collect(),
            failure_time: failure.time,
            step_time: experiment.step_time(),
            rated_torque: experiment.rated_torque().map(<[f64]>::to_vec),
            impact_before: list(&operation.step().abs()),
            impact_after: list(&assessment.impact.abs()),
            coefficients: list(&coefficients),
            bounds: match (method.law(), &search) {
                (Law::PerJoint, Ok(_)) => bounds(operation),
                _ => vec![None; N],
            },
            force_error: assessment.force_error(),
            search,
            rollout,
        }
    }

    pub(super) fn search(
        &self,
        operation: &Operation<N>,
        method: SearchMethod,
    ) -> Result<Solution<N>, SearchError> {
        let grid = self.scenario.search();
        let stepwise = Stepwise {
            start: SVector::repeat(grid.start()),
            ..Stepwise::with_step(grid.step())
        };
        match method {
            SearchMethod::StepwisePerJoint => stepwise.search(operation, CoefficientLaw::PerJoint),
            SearchMethod::PerJoint => cancel_per_joint(operation),
            SearchMethod::StepwiseProjected => {
                stepwise.search(operation, CoefficientLaw::Projected)
            }
            SearchMethod::Projected => least_impact(operation, Objective::LeastSquares),
            SearchMethod::Optimal => optimal(operation, ForcePriority::Exact),
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
            let assessment = &point.solution.assessment;
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
