//! `ulna reproduce`: the experiments of a scenario.

mod bounds;
mod csv;
mod drawings;
mod limited;
mod lock_step;
mod page;
mod plan_steps;
mod results;
mod table;
mod words;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::*;
use ulna_study::Scenario;
use ulna_study::experiment::{
    AnyArm, ExperimentError, ExperimentRunner, LimitedSuppression, PlanSteps, Study, Truth,
};
use ulna_study::scenario::Experiment;

use crate::arms::{ForArm, GENERATED, with_arm};
use crate::output::{self, Files};
use crate::{Verdict, console};

/// The scenario that is repeated when none is named; compiled in, so that the program needs no repository.
const PAPER_LIKE: &str = include_str!("../../scenarios/paper_like.toml");
const OUTPUT: &str = "out";
/// What was found, in words.
const PAGE: &str = "README.md";

/// Repeat the paper's experiments: its tables beside ours, figures, series and results.json
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
    let scenario = match &arguments.scenario {
        Some(path) => Scenario::load(path, GENERATED)?,
        None => Scenario::parse(
            PAPER_LIKE,
            "scenarios/paper_like.toml",
            Path::new("scenarios"),
            GENERATED,
        )?,
    };
    output::check_folder(&arguments.output)?;
    let findings = with_arm(scenario.arm(), Findings::of(&scenario))??;
    table::write(&scenario, &findings, out)?;
    out.flush()?;
    let mut files = Files::default();
    files.add(PAGE, page::write(&scenario, &findings)?);
    results::add(&mut files, &scenario, &findings)?;
    drawings::add(&mut files, &scenario, &findings)?;
    let written = files.write_to(&arguments.output)?;
    console::note(&format!(
        "wrote {} files to {}; {PAGE} says what was found",
        written.len(),
        arguments.output.display()
    ));
    Ok(Verdict::Pass)
}

/// What came of a scenario.
struct Findings {
    /// Every experiment at every failure time.
    studies: Vec<Study>,
    /// The first experiment simulated, at every failure time; `Err` if that cannot be.
    truths: Result<Vec<Truth>, ExperimentError>,
    /// The steps of the plan under the force of the first experiment, whatever locks.
    plan_steps: PlanSteps,
    /// What rated torques cost, for every experiment that has them, at every failure time at which they can be kept.
    limited: Vec<LimitedSuppression>,
}

impl Findings {
    /// The studies of an experiment, one for each failure time.
    fn of_section<'f>(&'f self, experiment: &Experiment) -> Vec<&'f Study> {
        let studies = self.studies.iter();
        studies
            .filter(|study| study.section == experiment.section())
            .collect()
    }

    /// The work that leads to the findings.
    fn of(scenario: &Scenario) -> Work<'_> {
        Work(scenario)
    }
}

struct Work<'s>(&'s Scenario);

impl ForArm for Work<'_> {
    type Output = Result<Findings, ExperimentError>;

    fn run<const N: usize>(self, arm: &AnyArm<N>) -> Self::Output {
        let runner = ExperimentRunner::new(arm, self.0)?;
        let study = |experiment: &Experiment, time| runner.study(experiment, time);
        let truth = |experiment: &Experiment, time| runner.truth(experiment, time);
        let limited = |experiment: &Experiment, time| runner.limited(experiment, time);
        let plan_steps = runner.plan_steps(&self.0.experiments()[0]);
        explore(self.0, plan_steps, &study, &truth, &limited)
    }
}

/// One experiment with the failure at one time, s.
type Attempt<'l, T> = dyn Fn(&Experiment, f64) -> Result<T, ExperimentError> + Sync + 'l;

/// Everything that is asked of a runner, side by side. Apart from it, so that this is not compiled for each number of joints.
fn explore(
    scenario: &Scenario,
    plan_steps: PlanSteps,
    study: &Attempt<'_, Study>,
    truth: &Attempt<'_, Truth>,
    limited: &Attempt<'_, Option<LimitedSuppression>>,
) -> Result<Findings, ExperimentError> {
    let (experiments, failure_times) = (scenario.experiments(), scenario.failure_times());
    let pairs = experiments.iter().flat_map(|experiment| {
        let times = failure_times.iter();
        times.map(move |time| (experiment, *time))
    });
    // Each stands by itself, and the order of the results is that of the pairs.
    let pairs: Vec<_> = pairs.collect();
    let limited = pairs
        .par_iter()
        .filter_map(|(experiment, time)| limited(experiment, *time).transpose());
    let limited = limited.collect::<Result<_, _>>()?;
    let studies = pairs
        .into_par_iter()
        .map(|(experiment, time)| study(experiment, time));
    let truths = failure_times
        .par_iter()
        .map(|time| truth(&experiments[0], *time));
    Ok(Findings {
        studies: studies.collect::<Result<_, _>>()?,
        truths: truths.collect(),
        plan_steps,
        limited,
    })
}
