//! [`Ablation`]: what of a suppression is due to the vector field, and what to acting before the lock or after it.

use super::{ExperimentError, ExperimentRunner};
use crate::scenario::Experiment;
use crate::search::{
    Acts, Field, Objective, Operation, Optimum, Scope, SearchError, Solution, cancel_per_joint,
    least_impact,
};

/// One experiment and one failure time, by laws from which one thing at a time is taken away. Effort has no weight in them.
#[derive(Clone, Debug, PartialEq)]
pub struct Ablation {
    /// [`Experiment::section`].
    pub section: String,
    /// s.
    pub failure_time: f64,
    /// The joints that lock, counted from 0.
    pub failed_joints: Vec<usize>,
    /// The norm of the steps of the healthy joints without compensation, N·m (N).
    pub healthy_before: f64,
    /// One for each [`Variant`], in the order of [`Variant::all`].
    pub rows: Vec<AblationRow>,
}

/// A law, and what is changed in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// Eq. 16 exactly, with this field in the place of ∇w_D.
    PerJoint(Field),
    /// Eq. 20 exactly, with this field in the place of ∇w_D.
    Projected(Field),
    /// The least norm that keeps the tool force, acting at this side of the lock.
    Optimal(Acts),
}

impl Variant {
    /// The seed of the random field.
    const SEED: u64 = 2026;

    /// Every field in either law, and the optimum at every side of the lock.
    pub fn all() -> impl Iterator<Item = Self> {
        let fields = [
            Field::DynamicManipulability,
            Field::KinematicManipulability,
            Field::Ones,
            Field::Random(Self::SEED),
        ];
        let acts = [Acts::Both, Acts::Before, Acts::After];
        let per_joint = fields.into_iter().map(Self::PerJoint);
        let projected = fields.into_iter().map(Self::Projected);
        per_joint
            .chain(projected)
            .chain(acts.into_iter().map(Self::Optimal))
    }

    /// What it makes U of, beside coefficients.
    fn field(self) -> Field {
        match self {
            Self::PerJoint(field) | Self::Projected(field) => field,
            Self::Optimal(_) => Field::default(),
        }
    }

    fn search<const N: usize>(self, operation: &Operation<N>) -> Result<Solution<N>, SearchError> {
        match self {
            Self::PerJoint(_) => cancel_per_joint(operation),
            Self::Projected(_) => least_impact(operation, Objective::LeastSquares),
            Self::Optimal(acts) => Optimum {
                acts,
                ..Optimum::default()
            }
            .solve(operation),
        }
    }
}

/// A variant, and what came of it; `Err` if nothing keeps the limits.
#[derive(Clone, Debug, PartialEq)]
pub struct AblationRow {
    /// Which.
    pub variant: Variant,
    /// What it leaves and what it costs.
    pub outcome: Result<AblationOutcome, SearchError>,
}

/// What a law leaves and what it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AblationOutcome {
    /// The norm of the steps of the healthy joints, N·m (N).
    pub healthy_after: f64,
    /// The healthy joint with the largest |Δτ̃_i| / |step_i|, counted from 0, and that ratio; `None` if none has a step.
    pub worst_joint: Option<(usize, f64)>,
    /// h of Eq. 13 at the lock, the larger norm of just before and just after, N (with the moments' N·m, if the task has any).
    pub force_error: f64,
    /// The largest norm of h over the whole motion.
    pub max_force_error: f64,
    /// The largest |U_i| over joints and motion, N·m (N).
    pub max_compensation: f64,
}

impl<const N: usize> ExperimentRunner<'_, N> {
    /// One experiment with the failure at `failure_time`, by every [`Variant`].
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn ablation(
        &self,
        experiment: &Experiment,
        failure_time: f64,
    ) -> Result<Ablation, ExperimentError> {
        // The field is all that operations differ in; the paper's serves the optimum too. Effort has no weight:
        // it would leave alone, under one field and not under another, what costs a thousand times its worth.
        let mut operations: Vec<(Field, Operation<N>)> = Vec::new();
        let mut rows = Vec::new();
        for variant in Variant::all() {
            let field = variant.field();
            if !operations.iter().any(|(made, _)| *made == field) {
                let operation = self.operation_with(experiment, failure_time, field, 0.0)?;
                operations.push((field, operation));
            }
            let made = operations.iter().filter(|(made, _)| *made == field);
            rows.extend(made.map(|(_, operation)| {
                AblationRow {
                    variant,
                    outcome: variant
                        .search(operation)
                        .map(|found| outcome(operation, &found)),
                }
            }));
        }
        let operation = self.operation(experiment, failure_time)?;
        let failed = operation.failure().joints;
        Ok(Ablation {
            section: experiment.section().to_owned(),
            failure_time,
            failed_joints: failed.iter().collect(),
            healthy_before: failed.without(&operation.step()).norm(),
            rows,
        })
    }
}

fn outcome<const N: usize>(operation: &Operation<N>, found: &Solution<N>) -> AblationOutcome {
    let assessment = &found.assessment;
    AblationOutcome {
        healthy_after: assessment.healthy_impact,
        worst_joint: operation.worst_joint(assessment, Scope::Healthy),
        force_error: assessment.force_error(),
        max_force_error: assessment.max_force_error,
        max_compensation: assessment.peak_compensation.amax(),
    }
}
