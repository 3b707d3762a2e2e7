//! [`Scenario`]: one motion of one arm, the joints that lock, and the experiments made with it.
//!
//! Read from TOML with the care that arm tables get: every error at once, each with its line and what to write instead.
//! The files in `scenarios/` show all keys.

mod arm;
mod force;
mod format;
mod motion;
mod read;
mod validate;

pub use arm::{KnownArm, ScenarioArm};
pub use force::ToolForce;
pub use format::reference;
pub use motion::{Motion, Path as MotionPath, PlanError, PlannedMotion};

use std::fmt;
use std::path::Path;

use crate::simulation::BrakeProfile;
use read::ScenarioTable;
use ulna_table::diagnostics::{Diagnostics, Sink};
use ulna_table::toml_reader::read_file;

/// A validated scenario. Lists over joints have one entry for each joint of [`arm`](Self::arm).
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// What it is called.
    pub name: String,
    /// A sentence about it; may be empty.
    pub description: String,
    /// Which arm moves.
    pub arm: ScenarioArm,
    /// The planned motion.
    pub motion: Motion,
    /// The joints that lock together, counted from 0, ascending.
    pub failed_joints: Vec<usize>,
    /// The failure times t_f, s.
    pub failure_times: Vec<f64>,
    /// The control cycle Δt, s: torque limits are kept at its multiples.
    pub cycle: f64,
    /// The paper's search for k_d.
    pub search: SearchGrid,
    /// The brakes of the failed joints, where the lock is simulated.
    pub brake: BrakeSettings,
    /// What is tried with the motion.
    pub experiments: Vec<Experiment>,
    /// The random variation of [`Scenario`] in a campaign.
    pub campaign: CampaignSettings,
}

/// Figure 2: where the search for k_di starts, and its step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchGrid {
    /// The first value.
    pub start: f64,
    /// The step, above 0; both signs are tried.
    pub step: f64,
}

/// Brakes that take time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrakeSettings {
    /// From moving to locked, s.
    pub duration: f64,
    /// How the rate falls in that time.
    pub profile: BrakeProfile,
}

/// A tool force and torque limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiment {
    /// Its number, such as the paper's "5.2"; no two are alike.
    pub section: String,
    /// A few words.
    pub title: String,
    /// What the tool exerts.
    pub force: ToolForce,
    /// The rated torques to keep, N·m (N); `None` for no limit.
    pub rated_torque: Option<Vec<f64>>,
    /// Figures from elsewhere, to stand beside ours.
    pub references: Vec<Reference>,
    /// What to draw of it.
    pub figures: Vec<Figure>,
}

/// A figure of an experiment.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What its files are called; `snake_case`.
    pub name: String,
    /// What it shows.
    pub kind: FigureKind,
}

/// What a [`Figure`] shows.
#[derive(Clone, Debug, PartialEq)]
pub enum FigureKind {
    /// Torques over time, without and with suppression.
    Torque {
        /// Of these joints, counted from 0.
        joints: Vec<usize>,
        /// With the failure at this one of the failure times, s.
        time: f64,
    },
    /// The impact joint by joint, before and after, at every failure time, and the tool force over time if it varies.
    Impact,
}

/// Somebody else's figures for a failure time.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Where they stand.
    pub source: String,
    /// The failure time, s.
    pub time: f64,
    /// Impact torque without compensation, N·m (N), joint by joint; `None` where there is no figure.
    pub before: Vec<Option<f64>>,
    /// Impact torque with compensation, likewise.
    pub after: Vec<Option<f64>>,
    /// The coefficients k_d, likewise.
    pub coefficients: Vec<Option<f64>>,
}

/// How a campaign varies a scenario. All ranges are symmetric and uniform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CampaignSettings {
    /// How many cases.
    pub cases: u64,
    /// The seed of all random numbers.
    pub seed: u64,
    /// How many failure times, evenly spread over the motion.
    pub failure_times: u64,
    /// Each joint's start is moved by at most so much, rad (m).
    pub start_spread: f64,
    /// Each joint's goal is moved by at most so much, rad (m).
    pub goal_spread: f64,
    /// Each task component of the tool force is within so much, N (N·m), constant in time.
    pub force_spread: f64,
}

impl Scenario {
    /// The most bytes that a scenario may have.
    const MAX_BYTES: u64 = 256 * 1024;

    /// Reads the scenario at `path`. It may name the arms in `known`, or a table by its path from the scenario's folder.
    ///
    /// # Errors
    /// Everything that is wrong with the scenario and with the table that it names, at once.
    pub fn load(path: impl AsRef<Path>, known: &[KnownArm]) -> Result<Self, ScenarioErrors> {
        let path = path.as_ref();
        let text = read_file(Path::new(""), path, Self::MAX_BYTES)
            .map_err(|found| ScenarioErrors(vec![found]))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&text, &path.display().to_string(), folder, known)
    }

    /// Reads the scenario `text`, which errors call `source_name`; tables are looked for from `folder`.
    ///
    /// # Errors
    /// Everything that is wrong with the scenario and with the table that it names, at once.
    pub fn parse(
        text: &str,
        source_name: &str,
        folder: &Path,
        known: &[KnownArm],
    ) -> Result<Self, ScenarioErrors> {
        let sink = Sink::new(source_name, text);
        let mut table_errors = None;
        let scenario = ScenarioTable::read(text, &sink).and_then(|table| {
            let arm = table.arm.as_ref().and_then(|name| {
                ScenarioArm::find(name, folder, known, &sink)
                    .map_err(|errors| table_errors = errors)
                    .ok()
            });
            table.into_scenario(arm, &sink)
        });
        let found = sink.finish();
        match (scenario, table_errors) {
            (Some(scenario), None) if !found.has_errors() => Ok(scenario),
            (_, of_table) => {
                let texts = [Some(found), of_table].into_iter().flatten();
                Err(ScenarioErrors(
                    texts.filter(|found| !found.is_empty()).collect(),
                ))
            }
        }
    }
}

/// Why a scenario was refused: the findings in the scenario, and those in the arm's table that it names.
#[derive(Clone)]
pub struct ScenarioErrors(Vec<Diagnostics>);

impl ScenarioErrors {
    /// The findings, text by text.
    pub fn texts(&self) -> &[Diagnostics] {
        &self.0
    }
}

impl fmt::Display for ScenarioErrors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let texts: Vec<_> = self.0.iter().map(Diagnostics::to_string).collect();
        formatter.write_str(&texts.join("\n\n"))
    }
}

/// The same text as `Display`: `main` prints the error that it returns by `Debug`.
impl fmt::Debug for ScenarioErrors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "the scenario is refused\n\n{self}")
    }
}

impl std::error::Error for ScenarioErrors {}
