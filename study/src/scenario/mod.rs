//! [`Scenario`]: one motion of one arm, the joints that lock, and the experiments made with it.
//!
//! Read from TOML with the care that arm tables get: every error at once, each with its line and what to write instead.
//! The files in `scenarios/` show all keys.

mod arm;
mod drives;
mod experiment;
mod force;
mod format;
mod motion;
mod read;
mod settings;
mod validate;

pub use arm::{KnownArm, ScenarioArm};
pub use drives::{MotorSettings, ServoSettings};
pub use experiment::{Experiment, Figure, FigureKind, Reference};
pub use force::ToolForce;
pub use format::reference;
pub use motion::{Motion, Path as MotionPath, PlanError, PlannedMotion};
pub use settings::{AssessSettings, BrakeSettings, CampaignSettings, CaseCountError, SearchGrid};

use std::fmt;
use std::path::Path;

use read::ScenarioTable;
use ulna_table::diagnostics::{Diagnostics, Sink};
use ulna_table::toml_reader::read_file;
use ulna_table::{Model, TableErrors};

/// A validated scenario. Lists over joints have one entry for each joint of [`arm`](Self::arm).
///
/// Only a text can become one, and only what its methods change can be changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    name: String,
    description: String,
    arm: ScenarioArm,
    motion: Motion,
    failed_joints: Vec<usize>,
    failure_times: Vec<f64>,
    cycle: f64,
    search: SearchGrid,
    brake: BrakeSettings,
    servo: ServoSettings,
    motors: MotorSettings,
    experiments: Vec<Experiment>,
    campaign: CampaignSettings,
    assess: AssessSettings,
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
        let text = Self::read(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&text, &path.display().to_string(), folder, known)
    }

    /// The text of the scenario at `path`, for [`parse`](Self::parse).
    ///
    /// # Errors
    /// When it cannot be read, or is too long for a scenario.
    pub fn read(path: impl AsRef<Path>) -> Result<String, ScenarioErrors> {
        read_file(Path::new(""), path.as_ref(), Self::MAX_BYTES)
            .map_err(|found| ScenarioErrors(vec![found]))
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
        Self::with_tables(text, source_name, folder, known, &|path| Model::load(path))
    }

    /// [`parse`](Self::parse) where the table that the text names has been read before: for a scenario that has left its machine.
    ///
    /// # Errors
    /// Everything that is wrong with the scenario, at once.
    pub fn parse_with_table(
        text: &str,
        source_name: &str,
        folder: &Path,
        known: &[KnownArm],
        table: &Model,
    ) -> Result<Self, ScenarioErrors> {
        Self::with_tables(text, source_name, folder, known, &|_| Ok(table.clone()))
    }

    fn with_tables(
        text: &str,
        source_name: &str,
        folder: &Path,
        known: &[KnownArm],
        load: &dyn Fn(&Path) -> Result<Model, TableErrors>,
    ) -> Result<Self, ScenarioErrors> {
        let sink = Sink::new(source_name, text);
        let mut table_errors = None;
        let scenario = ScenarioTable::read(text, &sink).and_then(|table| {
            let arm = table.arm.as_ref().and_then(|name| {
                ScenarioArm::find(name, folder, known, load, &sink)
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

/// What is in it.
impl Scenario {
    /// What it is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A sentence about it; may be empty.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Which arm moves.
    pub fn arm(&self) -> &ScenarioArm {
        &self.arm
    }

    /// The planned motion.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// The joints that lock together, counted from 0, ascending; at least one.
    pub fn failed_joints(&self) -> &[usize] {
        &self.failed_joints
    }

    /// The failure times t_f, s: while the arm moves, each once; at least one.
    pub fn failure_times(&self) -> &[f64] {
        &self.failure_times
    }

    /// The control cycle, s: torque limits are kept at its multiples. The Δt of Eq. 18 is [`Experiment::step_time`].
    pub fn cycle(&self) -> f64 {
        self.cycle
    }

    /// The paper's search for k_d.
    pub fn search(&self) -> SearchGrid {
        self.search
    }

    /// The brakes of the failed joints, where the lock is simulated.
    pub fn brake(&self) -> BrakeSettings {
        self.brake
    }

    /// How the controller follows the plan, and its projector.
    pub fn servo(&self) -> ServoSettings {
        self.servo
    }

    /// The rotors behind their gears, where the lock is simulated.
    pub fn motors(&self) -> &MotorSettings {
        &self.motors
    }

    /// What is tried with the motion; at least one.
    pub fn experiments(&self) -> &[Experiment] {
        &self.experiments
    }

    /// The random variation of [`Scenario`] in a campaign.
    pub fn campaign(&self) -> CampaignSettings {
        self.campaign
    }

    /// How laws are judged over failures for which they were not tuned.
    pub fn assess(&self) -> &AssessSettings {
        &self.assess
    }

    /// The same scenario with so many cases in its campaign.
    ///
    /// # Errors
    /// When there may not be so many ([`CampaignSettings::CASES`]).
    pub fn with_cases(mut self, cases: u64) -> Result<Self, CaseCountError> {
        if !CampaignSettings::CASES.contains(&cases) {
            return Err(CaseCountError { cases });
        }
        self.campaign.cases = cases;
        Ok(self)
    }

    /// The same scenario with another seed for its campaign.
    pub fn with_seed(mut self, seed: u64) -> Self {
        self.campaign.seed = seed;
        self
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
