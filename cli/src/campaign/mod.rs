//! `ulna campaign`: a scenario with every joint failing at many times, varied at random.

mod file;
mod record;
mod row;
mod summary;

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context;
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use ulna_study::Scenario;
use ulna_study::scenario::CampaignSettings;

use crate::arms::{self, GENERATED};
use crate::figures::{self, HeatMap};
use crate::output::{self, Files, FolderLock};
use crate::{Verdict, console};
use file::CampaignFile;
use record::Identity;
pub(crate) use row::{LawCells, Row};
use summary::Summary;
pub(crate) use summary::median;

/// Vary a scenario: every joint, a grid of failure times, random starts, goals and forces
///
/// Takes arms of up to 12 joints.
#[derive(Args)]
#[command(
    after_help = "Example:\n  ulna campaign scenarios/paper_like.toml --cases 140 --output target/campaign\n\n\
    Interrupted, it goes on where it stopped when it is called again. The result does not depend on the number of threads.\n\
    campaign.json beside the rows says which campaign they are of: those of another, and rows that were changed, are refused.\n\
    One run at a time works in a folder: it holds campaign.lock, which stays and is in nobody's way."
)]
pub(crate) struct Arguments {
    /// The scenario (TOML); its first experiment's rated torques are kept
    scenario: PathBuf,
    /// How many cases; without it as many as the scenario says
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(CampaignSettings::CASES))]
    cases: Option<u64>,
    /// The seed of all random numbers; without it the scenario's
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// How many threads; without it one for each core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Where campaign.csv, campaign.md and the figures go
    #[arg(long, short, value_name = "DIR", default_value = "out")]
    output: PathBuf,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let mut scenario = Scenario::load(&arguments.scenario, GENERATED)?;
    if let Some(cases) = arguments.cases {
        scenario = scenario.with_cases(cases)?;
    }
    if let Some(seed) = arguments.seed {
        scenario = scenario.with_seed(seed);
    }
    output::check_folder(&arguments.output)?;
    let threads = arguments.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    let folder = &arguments.output;
    let work = Work {
        scenario: &scenario,
        arguments,
    };
    let arm = arms::subject(scenario.arm())?;
    let cases = arm.campaign(&scenario)?;
    // Held until the figures are there too.
    let (rows, _lock) = pool.install(|| {
        let laws = scenario.campaign().laws();
        work.all(&|index| Row::of(&cases.case(index), laws))
    })?;

    let laws = scenario.campaign().laws();
    let map = HeatMap::new(&rows, laws, scenario.arm().joints().len());
    let summary = Summary::new(&scenario, &rows, arm.task().len());
    writeln!(out, "{}", summary.console())?;
    let footer = format!(
        "arm {}, scenario {}, campaign of {} cases, seed {}",
        scenario.arm().name(),
        scenario.name(),
        rows.len(),
        scenario.campaign().seed()
    );
    let mut files = Files::default();
    files.add("campaign.md", summary.page());
    let mut json = serde_json::to_vec_pretty(&summary)?;
    json.push(b'\n');
    files.add("campaign-summary.json", json);
    files.add("figures/campaign.svg", figures::svg(&map, &footer)?);
    files.add("figures/campaign.png", figures::png(&map, &footer)?);
    for path in files.write_to(folder)? {
        console::note(&format!("wrote {}", path.display()));
    }
    Ok(Verdict::Pass)
}

/// All rows of the campaign, found in the file or made, and the folder that they are in.
struct Work<'s> {
    scenario: &'s Scenario,
    arguments: &'s Arguments,
}

impl Work<'_> {
    /// All rows, by `make`.
    fn all(&self, make: &(dyn Fn(u64) -> Row + Sync)) -> anyhow::Result<(Vec<Row>, FolderLock)> {
        /// So many cases are made before they are written.
        const CHUNK: u64 = 500;
        let folder = &self.arguments.output;
        fs::create_dir_all(folder)
            .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        let lock = FolderLock::take(folder)?;
        let cases = self.scenario.campaign().cases();
        let identity = Identity::of(self.scenario);
        let header = row::header(self.scenario.campaign().laws())?;
        let mut file = CampaignFile::open(folder, cases, header, &identity, make)?;
        let found = file.rows();
        if found > 0 {
            console::note(&format!(
                "{found} of {cases} cases are in {} already",
                file.path().display()
            ));
        }
        let clock = Instant::now();
        let bar = ProgressBar::new(cases).with_position(found);
        bar.set_style(ProgressStyle::with_template(
            "{bar:40} {pos}/{len} cases, {per_sec}, {eta} left",
        )?);
        for start in (found..cases).step_by(CHUNK as usize) {
            let chunk = start..(start + CHUNK).min(cases);
            // In order of the number, whatever thread made them.
            let rows = chunk.into_par_iter().map(|index| {
                let row = make(index);
                bar.inc(1);
                row
            });
            file.append(rows.collect())?;
        }
        bar.finish_and_clear();
        let made = cases - found;
        if made > 0 {
            let seconds = clock.elapsed().as_secs_f64();
            console::note(&format!(
                "{made} cases in {seconds:.1} s: {:.0} a second",
                made as f64 / seconds
            ));
        }
        Ok((file.finish()?, lock))
    }
}
