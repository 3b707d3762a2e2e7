//! [`Failures`]: every failure of an assessment, and the laws that meet them.

use ulna_study::assess::{AssessedCase, AssessedLaw, Assessment, FailureGrid, GroundTruth, Tuning};
use ulna_study::experiment::ExperimentError;

/// [`FailureGrid`] with its laws, whatever the number of joints.
pub trait Failures: Sync {
    /// How many there are.
    fn count(&self) -> usize;

    /// [`FailureGrid::times`], s.
    fn times(&self) -> &[f64];

    /// [`FailureGrid::tuning`].
    fn tuning(&self) -> Tuning;

    /// [`FailureGrid::rated_torque`], N·m (N); infinite where there is none.
    fn rated_torque(&self) -> &[f64];

    /// What each law makes of a failure; `None` where the limits leave a law nothing.
    ///
    /// # Errors
    /// When the motion under the tool force cannot be looked at.
    fn cases(&self, failure: usize) -> Result<Vec<Option<AssessedCase>>, ExperimentError>;

    /// [`Assessment::new`] of the [`cases`](Self::cases) of all failures.
    fn assessment(&self, cases: Vec<Vec<Option<AssessedCase>>>) -> Assessment;

    /// [`FailureGrid::simulated`]: the failures that are simulated.
    fn simulated(&self) -> Vec<usize>;

    /// [`FailureGrid::gains`], rad/s: those that they are simulated with.
    fn gains(&self) -> Vec<f64>;

    /// [`FailureGrid::felt`]: what the healthy joints transmit under each law, N·m (N).
    ///
    /// # Errors
    /// As [`cases`](Self::cases).
    fn felt(&self, failure: usize, gain: f64) -> Result<Vec<Option<f64>>, ExperimentError>;

    /// [`GroundTruth::new`] of what is [`felt`](Self::felt) at all simulated failures.
    fn ground_truth(&self, gain: f64, felt: &[Vec<Option<f64>>]) -> GroundTruth;
}

/// A grid and its laws.
pub(crate) struct Assessing<'a, const N: usize> {
    pub(crate) grid: FailureGrid<'a, N>,
    pub(crate) laws: Vec<AssessedLaw<N>>,
}

impl<const N: usize> Failures for Assessing<'_, N> {
    fn count(&self) -> usize {
        self.grid.len()
    }

    fn times(&self) -> &[f64] {
        self.grid.times()
    }

    fn tuning(&self) -> Tuning {
        self.grid.tuning()
    }

    fn rated_torque(&self) -> &[f64] {
        self.grid.rated_torque().as_slice()
    }

    fn cases(&self, failure: usize) -> Result<Vec<Option<AssessedCase>>, ExperimentError> {
        self.grid.cases(&self.laws, failure)
    }

    fn assessment(&self, cases: Vec<Vec<Option<AssessedCase>>>) -> Assessment {
        Assessment::new(&self.laws, cases)
    }

    fn simulated(&self) -> Vec<usize> {
        self.grid.simulated()
    }

    fn gains(&self) -> Vec<f64> {
        self.grid.gains()
    }

    fn felt(&self, failure: usize, gain: f64) -> Result<Vec<Option<f64>>, ExperimentError> {
        self.grid.felt(&self.laws, failure, gain)
    }

    fn ground_truth(&self, gain: f64, felt: &[Vec<Option<f64>>]) -> GroundTruth {
        GroundTruth::new(&self.laws, gain, felt)
    }
}
