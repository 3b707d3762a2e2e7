//! `ulna campaign`: a scenario with every joint failing at many times, varied at random.

pub(crate) mod merge;
mod pace;
mod slurm;
mod summary;
mod watch;

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use ulna_campaign::{Campaign, Part, make};
use ulna_study::Scenario;
use ulna_study::experiment::Shard;
use ulna_study::scenario::CampaignSettings;

use crate::arms::{self, GENERATED};
use crate::figures::{self, HeatMap};
use crate::output::{self, Files};
use crate::{Verdict, console};
use pace::seconds_a_case;
use summary::Summary;
pub(crate) use summary::median;
use watch::Bar;

/// The most cases of a run that sums up: their rows are in memory together, with what is counted of them 0.8 KB each with
/// six laws.
const MOST_SUMMED_UP: u64 = 10_000_000;

/// Vary a scenario: every joint, a grid of failure times, random starts, goals and forces
///
/// Takes arms of up to 12 joints.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  ulna campaign scenarios/paper_like.toml --cases 140 --output target/campaign\n  \
    ulna campaign scenarios/paper_like.toml --cases 140 --shard 1/2 --output target/shards\n  \
    ulna campaign scenarios/paper_like.toml --cases 140 --shard 2/2 --output target/shards\n  \
    ulna campaign scenarios/paper_like.toml --cases 140 --slurm --output target/shards\n\n\
    Interrupted, it goes on where it stopped when it is called again. The result does not depend on the number of threads.\n\
    campaign.json beside the rows says which campaign they are of: those of another, and rows that were changed, are refused.\n\
    One run at a time works in a folder: it holds campaign.lock, which stays and is in nobody's way.\n\n\
    A case depends on the seed and its number alone, so that a campaign can be made in shards, on as many machines as there are.\n\
    `--shard 3/16` makes campaign-0003-of-0016.csv with its manifest, a .json, and goes on where it stopped as well.\n\
    All shards may share a folder, at the same time too. `ulna merge` puts them together; where it has written campaign.csv,\n\
    the campaign without `--shard` finds all cases there, and adds page and figures.\n\
    A run that sums up takes 10000000 cases at most; with fewer `--cases` it sums up the first of those that are there.\n\n\
    `--slurm` prints a script for Slurm: `bash SCRIPT` submits the shards as an array, and after them their merge."
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
    /// How many threads; without it one for each core, and one for each shard of a script
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Make the I-th of N shards alone, counted from 1; `ulna merge` puts them together
    #[arg(long, value_name = "I/N", conflicts_with = "slurm")]
    shard: Option<Shard>,
    /// Print a script for Slurm that makes the campaign in shards
    #[arg(long)]
    slurm: bool,
    /// How many shards the script has; without it as many as take half an hour each, 1000 at most
    #[arg(long, value_name = "N", requires = "slurm", value_parser = clap::value_parser!(u64).range(1..))]
    shards: Option<u64>,
    /// Where campaign.csv, campaign.md and the figures go, or the shards
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
    let cases = scenario.campaign().cases();
    let shards = arguments.shard.map(Shard::of).or(arguments.shards);
    if let Some(shards) = shards.filter(|shards| *shards > cases) {
        bail!("{shards} shards of {cases} cases: there may be as many shards as cases");
    }
    output::check_folder(&arguments.output)?;
    let arm = arms::subject(scenario.arm())?;
    if arguments.slurm {
        let seconds = seconds_a_case(&Campaign::new(&*arm, &scenario)?);
        let script = slurm::Script::new(&scenario, arguments, seconds)?;
        script
            .warnings()
            .iter()
            .for_each(|text| console::warning(text));
        write!(out, "{script}")?;
        return Ok(Verdict::Pass);
    }
    if arguments.shard.is_none() && cases > MOST_SUMMED_UP {
        bail!(
            "{cases} cases: a run that sums up keeps their rows in memory, {MOST_SUMMED_UP} at most; make the campaign \
             in shards, with `--shard` or `--slurm`, and put them together with `ulna merge`; `--cases {MOST_SUMMED_UP}` \
             then sums up the first of them"
        );
    }
    let part = Part::new(arguments.output.clone(), arguments.shard, cases);
    let threads = arguments.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    let campaign = Campaign::new(&*arm, &scenario)?;
    let keep = arguments.shard.is_none();
    let bar = Bar::new()?;
    // Its lock is held until the figures are there too.
    let made = make(&part, &campaign, keep, &pool, &bar)?;
    bar.ends(made.made);
    if arguments.shard.is_some() {
        for end in ["csv", "json"] {
            console::note(&format!("wrote {}", part.file(end).display()));
        }
        return Ok(Verdict::Pass);
    }

    let folder = &arguments.output;
    let rows = &made.rows;
    let laws = scenario.campaign().laws();
    let map = HeatMap::new(rows, laws, scenario.arm().joints().len());
    let summary = Summary::new(&scenario, rows, arm.task().iter().count());
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
