//! `ulna assess`: every law over a grid of failures for which it was not tuned.

mod page;
mod results;
mod table;

use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use rayon::prelude::*;
use ulna_experiments::Subject;
use ulna_study::Scenario;
use ulna_study::assess::{Assessment, GroundTruth, Tuning};
use ulna_study::experiment::ExperimentError;

use crate::figures::{self, RatioMaps};
use crate::output::{self, Files};
use crate::{Verdict, arms, console, reproduce};

pub(crate) use table::title;

const PAGE: &str = "assess.md";
const MAPS: &str = "figures/assess";
const PAIRS: &str = "figures/assess_pairs";

/// Judge every law over failures for which it was not tuned: every joint and pair, at a grid of times
///
/// Takes arms of up to 12 joints.
#[derive(Args)]
#[command(
    after_help = "Example:\n  ulna assess scenarios/tool_path.toml --output target/assess\n\n\
    Laws with coefficients are tuned once, for the scenario's joints at the failure time nearest to the middle of the motion,\n\
    and then meet all others. [assess] of the scenario says how fine the grid is, and what the robust law may do."
)]
pub(crate) struct Arguments {
    /// The scenario (TOML), whose first experiment counts; without it the paper's, as far as it can be repeated
    scenario: Option<PathBuf>,
    /// Where assess.json, the page and the figures go
    #[arg(long, short, value_name = "DIR", default_value = reproduce::OUTPUT)]
    output: PathBuf,
}

/// What was found, and of what.
struct Findings<'s> {
    scenario: &'s Scenario,
    assessment: Assessment,
    /// Some of the failures simulated, gain by gain.
    felt: Vec<GroundTruth>,
    /// How many failures those are.
    simulated: usize,
    /// s.
    times: Vec<f64>,
    tuning: Tuning,
    joints: usize,
    /// What the task leaves to the healthy arm.
    null_space: usize,
    /// Whether any torque limit was kept.
    limited: bool,
    seconds: f64,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let scenario = reproduce::scenario(arguments.scenario.as_deref())?;
    output::check_folder(&arguments.output)?;
    let arm = arms::subject(scenario.arm())?;
    let findings = Findings::of(&*arm, &scenario)?;
    table::write(&findings, out)?;
    out.flush()?;
    let mut files = Files::default();
    files.add("assess.json", results::json(&findings)?);
    files.add(PAGE, page::write(&findings));
    let maps = RatioMaps::of_singles(&findings.assessment, &findings.times, &scenario);
    files.add(format!("{MAPS}.svg"), figures::svg(&maps, &maps.footer())?);
    files.add(format!("{MAPS}.png"), figures::png(&maps, &maps.footer())?);
    if findings.has_pairs() {
        let maps = RatioMaps::of_pairs(&findings.assessment, &findings.times, &scenario);
        files.add(format!("{PAIRS}.svg"), figures::svg(&maps, &maps.footer())?);
        files.add(format!("{PAIRS}.png"), figures::png(&maps, &maps.footer())?);
    }
    let written = files.write_to(&arguments.output)?;
    console::note(&format!(
        "wrote {} files to {} after {:.1} s; {PAGE} says what was found",
        written.len(),
        arguments.output.display(),
        findings.seconds
    ));
    Ok(Verdict::Pass)
}

impl<'s> Findings<'s> {
    fn of(arm: &dyn Subject, scenario: &'s Scenario) -> Result<Self, ExperimentError> {
        let clock = Instant::now();
        let grid = arm.assess(scenario)?;
        let failures: Vec<usize> = (0..grid.count()).collect();
        let cases = everything(&failures, &|failure| grid.cases(failure))?;
        let failures = grid.simulated();
        let felt = grid.gains().into_iter().map(|gain| {
            let felt = everything(&failures, &|failure| grid.felt(failure, gain))?;
            Ok(grid.ground_truth(gain, &felt))
        });
        Ok(Self {
            scenario,
            felt: felt.collect::<Result<_, ExperimentError>>()?,
            simulated: failures.len(),
            assessment: grid.assessment(cases),
            times: grid.times().to_vec(),
            tuning: grid.tuning(),
            joints: arm.joints(),
            null_space: arm.joints().saturating_sub(arm.task().len()),
            limited: grid.rated_torque().iter().any(|rated| rated.is_finite()),
            seconds: clock.elapsed().as_secs_f64(),
        })
    }

    fn has_pairs(&self) -> bool {
        self.assessment.laws.iter().any(|law| law.pairs.is_some())
    }
}

/// Something of every failure, side by side.
fn everything<T: Send>(
    failures: &[usize],
    one: &(dyn Fn(usize) -> Result<T, ExperimentError> + Sync),
) -> Result<Vec<T>, ExperimentError> {
    failures.par_iter().map(|failure| one(*failure)).collect()
}
