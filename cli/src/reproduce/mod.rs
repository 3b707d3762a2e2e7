//! `ulna reproduce`: the experiments of a scenario.

mod ablation;
mod bounds;
mod coefficients;
mod csv;
mod drawings;
mod force;
mod limited;
mod lock_step;
mod page;
mod plan_steps;
mod references;
mod results;
mod structure;
mod table;
mod verdict;
pub(crate) mod words;
mod worse;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::*;
use ulna_experiments::Subject;
use ulna_study::Scenario;
use ulna_study::experiment::{
    Ablation, ExperimentError, LimitedSuppression, LockMechanics, PlanSteps, SimulatedLock, Study,
    Sweep,
};
use ulna_study::scenario::{Experiment, ScenarioErrors};

use crate::arms::{self, GENERATED};
use crate::output::{self, Files};
use crate::{Verdict, console};
use force::Asked;

/// The scenario that is repeated when none is named; compiled in, so that the program needs no repository.
const PAPER_LIKE: &str = include_str!("../../scenarios/paper_like.toml");
pub(crate) const OUTPUT: &str = "out";
/// What was found, in words.
const PAGE: &str = "README.md";

/// Repeat the paper's experiments: its tables beside ours, figures, series and results.json
///
/// Takes arms of up to 12 joints.
#[derive(Args)]
#[command(
    after_help = "Example:\n  ulna reproduce scenarios/tool_path.toml --output target/reproduce"
)]
pub(crate) struct Arguments {
    /// The experiments (TOML); without it the paper's, as far as they can be repeated
    scenario: Option<PathBuf>,
    /// Where figures, series and results go
    #[arg(long, short, value_name = "DIR", default_value = OUTPUT)]
    output: PathBuf,
}

impl Default for Arguments {
    fn default() -> Self {
        Self {
            scenario: None,
            output: OUTPUT.into(),
        }
    }
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let scenario = scenario(arguments.scenario.as_deref())?;
    output::check_folder(&arguments.output)?;
    let arm = arms::subject(scenario.arm())?;
    let findings = Findings::of(&*arm, &scenario)?;
    table::write(&scenario, &findings, out)?;
    ablation::write(&findings.ablations, out)?;
    out.flush()?;
    let mut files = Files::default();
    files.add(PAGE, page::write(&scenario, &findings)?);
    results::add(&mut files, &scenario, &findings)?;
    ablation::add(&mut files, &findings.ablations)?;
    drawings::add(&mut files, &scenario, &findings)?;
    verdict::add(&mut files, &scenario, &findings)?;
    let written = files.write_to(&arguments.output)?;
    console::note(&format!(
        "wrote {} files to {}; {PAGE} says what was found",
        written.len(),
        arguments.output.display()
    ));
    Ok(Verdict::Pass)
}

/// The scenario at `path`, or the paper's.
pub(crate) fn scenario(path: Option<&Path>) -> Result<Scenario, ScenarioErrors> {
    match path {
        Some(path) => Scenario::load(path, GENERATED),
        None => Scenario::parse(
            PAPER_LIKE,
            "scenarios/paper_like.toml",
            Path::new("scenarios"),
            GENERATED,
        ),
    }
}

/// What came of a scenario.
struct Findings {
    /// Every experiment at every failure time.
    studies: Vec<Study>,
    /// The first experiment simulated, at every failure time; `Err` if that cannot be.
    simulations: Result<Vec<SimulatedLock>, ExperimentError>,
    /// The steps of the plan under the force of the first experiment, whatever locks.
    plan_steps: PlanSteps,
    /// What rated torques cost, for every experiment that has them, at every failure time at which they can be kept.
    limited: Vec<LimitedSuppression>,
    /// The first experiment with other fields and on one side of the lock, at every failure time.
    ablations: Vec<Ablation>,
    /// The same with other servos and rotors.
    sweeps: Result<Vec<Sweep>, ExperimentError>,
    /// The arm as a mechanism, at every failure time.
    locks: Vec<LockMechanics>,
}

impl Findings {
    /// The studies of an experiment, one for each failure time.
    fn of_section<'f>(&'f self, experiment: &Experiment) -> Vec<&'f Study> {
        let studies = self.studies.iter();
        studies
            .filter(|study| study.section == experiment.section())
            .collect()
    }

    /// What the tool is to exert in a study of `experiment`.
    fn asked(&self, experiment: &Experiment, study: &Study) -> Asked {
        Asked::of(experiment, study, &self.locks)
    }

    /// Asks everything of the arm, side by side.
    fn of(arm: &dyn Subject, scenario: &Scenario) -> Result<Self, ExperimentError> {
        let locks = arm.mechanics(scenario)?;
        let runner = arm.experiments(scenario)?;
        let (experiments, failure_times) = (scenario.experiments(), scenario.failure_times());
        let pairs = experiments.iter().flat_map(|experiment| {
            let times = failure_times.iter();
            times.map(move |time| (experiment, *time))
        });
        // Each stands by itself, and the order of the results is that of the pairs.
        let pairs: Vec<_> = pairs.collect();
        let limited = pairs
            .par_iter()
            .filter_map(|(experiment, time)| runner.limited(experiment, *time).transpose());
        let limited = limited.collect::<Result<_, _>>()?;
        let studies = pairs
            .into_par_iter()
            .map(|(experiment, time)| runner.study(experiment, time));
        let first = &experiments[0];
        let times = failure_times.par_iter();
        let simulations = times
            .clone()
            .map(|time| runner.simulated_lock(first, *time));
        let ablations = times.clone().map(|time| runner.ablation(first, *time));
        let sweeps = times.map(|time| runner.sweep(first, *time));
        Ok(Self {
            ablations: ablations.collect::<Result<_, _>>()?,
            studies: studies.collect::<Result<_, _>>()?,
            simulations: simulations.collect(),
            sweeps: sweeps.collect(),
            plan_steps: runner.plan_steps(first),
            limited,
            locks,
        })
    }
}
