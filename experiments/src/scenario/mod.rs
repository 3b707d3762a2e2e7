//! What a scenario asks of its arm: experiments, a campaign, an assessment.

mod assess;

pub(crate) use assess::Assessing;
pub use assess::Failures;

use ulna_study::experiment::{
    Ablation, Campaign, CampaignCase, ExperimentError, ExperimentRunner, LimitedSuppression,
    PlanSteps, SimulatedLock, Study, Sweep,
};
use ulna_study::scenario::Experiment;

/// An arm on the motion of a scenario: [`ExperimentRunner`], whatever the number of joints. Times are those of the failure, s.
pub trait Experiments: Sync {
    /// [`ExperimentRunner::study`].
    ///
    /// # Errors
    /// When the motion under the tool force cannot be looked at.
    fn study(&self, experiment: &Experiment, time: f64) -> Result<Study, ExperimentError>;

    /// [`ExperimentRunner::simulated_lock`].
    ///
    /// # Errors
    /// As [`study`](Self::study), and when the simulation without compensation does not come to its end.
    fn simulated_lock(
        &self,
        experiment: &Experiment,
        time: f64,
    ) -> Result<SimulatedLock, ExperimentError>;

    /// [`ExperimentRunner::sweep`].
    ///
    /// # Errors
    /// As [`simulated_lock`](Self::simulated_lock).
    fn sweep(&self, experiment: &Experiment, time: f64) -> Result<Sweep, ExperimentError>;

    /// [`ExperimentRunner::ablation`].
    ///
    /// # Errors
    /// As [`study`](Self::study).
    fn ablation(&self, experiment: &Experiment, time: f64) -> Result<Ablation, ExperimentError>;

    /// [`ExperimentRunner::limited`].
    ///
    /// # Errors
    /// As [`study`](Self::study).
    fn limited(
        &self,
        experiment: &Experiment,
        time: f64,
    ) -> Result<Option<LimitedSuppression>, ExperimentError>;

    /// [`ExperimentRunner::plan_steps`].
    fn plan_steps(&self, experiment: &Experiment) -> PlanSteps;
}

impl<const N: usize> Experiments for ExperimentRunner<'_, N> {
    fn study(&self, experiment: &Experiment, time: f64) -> Result<Study, ExperimentError> {
        self.study(experiment, time)
    }

    fn simulated_lock(
        &self,
        experiment: &Experiment,
        time: f64,
    ) -> Result<SimulatedLock, ExperimentError> {
        self.simulated_lock(experiment, time)
    }

    fn sweep(&self, experiment: &Experiment, time: f64) -> Result<Sweep, ExperimentError> {
        self.sweep(experiment, time)
    }

    fn ablation(&self, experiment: &Experiment, time: f64) -> Result<Ablation, ExperimentError> {
        self.ablation(experiment, time)
    }

    fn limited(
        &self,
        experiment: &Experiment,
        time: f64,
    ) -> Result<Option<LimitedSuppression>, ExperimentError> {
        self.limited(experiment, time)
    }

    fn plan_steps(&self, experiment: &Experiment) -> PlanSteps {
        self.plan_steps(experiment)
    }
}

/// The cases of a campaign: [`Campaign`], whatever the number of joints.
pub trait Cases: Sync {
    /// [`Campaign::failure_times`].
    fn failure_times(&self) -> Vec<f64>;

    /// [`Campaign::case`]: a function of the scenario's seed and of `index` alone.
    fn case(&self, index: u64) -> CampaignCase;
}

impl<const N: usize> Cases for Campaign<'_, N> {
    fn failure_times(&self) -> Vec<f64> {
        self.failure_times()
    }

    fn case(&self, index: u64) -> CampaignCase {
        self.case(index)
    }
}
