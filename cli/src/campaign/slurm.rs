//! [`Script`]: a campaign in shards, as a job array of Slurm.

use std::fmt;
use std::path::Path;

use anyhow::{Context, bail};
use ulna_study::Scenario;

use super::{Arguments, MOST_SUMMED_UP};

/// The longest array of a Slurm that nobody has configured otherwise: its `MaxArraySize` is 1001, and 0 counts.
const MOST_TASKS: u64 = 1000;
/// So long a shard is to take, s: long beside its start, short beside what a kill or a full queue costs.
const SHARD_SECONDS: f64 = 1800.0;
/// A shard may take so many times what it takes here: on slower cores, all of which are busy.
const MARGIN: f64 = 4.0;
/// And so many minutes besides: for the start, and for disks that others use as well.
const EXTRA_MINUTES: f64 = 10.0;
/// What merging takes of a row, s: 0.5 KB that are read and written, by a slow disk.
const MERGE_SECONDS: f64 = 5e-6;
/// What a row that is summed up takes in memory, MB.
const SUMMED_UP_MB: f64 = 1e-3;

/// What `bash` runs: it submits itself as an array, each task of which makes a shard, and their merge for when all are made.
pub(super) struct Script {
    name: String,
    cases: u64,
    seed: u64,
    shards: u64,
    threads: u16,
    /// What a case took one thread of this machine, s.
    seconds: f64,
    program: String,
    scenario: String,
    output: String,
}

impl Script {
    /// For the campaign of `scenario`, a case of which takes one thread so many `seconds`.
    pub(super) fn new(
        scenario: &Scenario,
        arguments: &Arguments,
        seconds: f64,
    ) -> anyhow::Result<Self> {
        let campaign = scenario.campaign();
        let cases = campaign.cases();
        let threads = arguments.threads.unwrap_or(1);
        let fitting = (seconds * cases as f64 / (f64::from(threads) * SHARD_SECONDS)).ceil();
        let most = cases.min(MOST_TASKS);
        let program = std::env::current_exe().context("cannot tell where this program is")?;
        Ok(Self {
            name: name(scenario.name()),
            cases,
            seed: campaign.seed(),
            shards: arguments.shards.unwrap_or((fitting as u64).clamp(1, most)),
            threads,
            seconds,
            program: quoted(&program)?,
            scenario: quoted(&arguments.scenario)?,
            output: quoted(&arguments.output)?,
        })
    }

    /// What a user may have to change.
    pub(super) fn warnings(&self) -> Vec<String> {
        let mut found = Vec::new();
        if self.shards > MOST_TASKS {
            found.push(format!(
                "{} shards: Slurm takes arrays of {MOST_TASKS} unless its MaxArraySize is set higher \
                 (`scontrol show config` tells)",
                self.shards
            ));
        }
        if self.cases > MOST_SUMMED_UP {
            found.push(format!(
                "page and figures will be of the first {MOST_SUMMED_UP} of {} cases: so many rows are kept in memory",
                self.cases
            ));
        }
        found
    }

    /// What a shard takes here, s.
    fn shard_seconds(&self) -> f64 {
        let cases = self.cases.div_ceil(self.shards);
        self.seconds * cases as f64 / f64::from(self.threads)
    }
}

/// A job's name: of a scenario's what needs no quotes.
fn name(scenario: &str) -> String {
    let safe = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let of_scenario: String = scenario.chars().filter(|c| safe(*c)).collect();
    format!("ulna-{of_scenario}")
}

/// The absolute `path` as a word of a shell, whatever is in it: the job runs elsewhere.
fn quoted(path: &Path) -> anyhow::Result<String> {
    let absolute = std::path::absolute(path);
    let absolute = absolute.with_context(|| format!("cannot tell where {} is", path.display()))?;
    let text = absolute.to_str();
    let Some(text) = text.filter(|text| !text.contains(char::is_control)) else {
        bail!(
            "{absolute:?} cannot be written into a script: a name in it is not UTF-8, or has a line break or another \
             control character in it; rename it"
        );
    };
    Ok(format!("'{}'", text.replace('\'', r"'\''")))
}

/// Minutes for a job that takes `seconds` here.
fn minutes(seconds: f64) -> f64 {
    (MARGIN * seconds / 60.0 + EXTRA_MINUTES).ceil()
}

impl fmt::Display for Script {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            name,
            cases,
            seed,
            shards,
            threads,
            program,
            scenario,
            output,
            ..
        } = self;
        let summed_up = (*cases).min(MOST_SUMMED_UP);
        let shard_seconds = self.shard_seconds();
        let time = minutes(shard_seconds);
        let merge_time = minutes(MERGE_SECONDS * *cases as f64);
        let merge_memory = (512.0 + SUMMED_UP_MB * summed_up as f64).ceil();
        let milliseconds = 1e3 * self.seconds;
        write!(
            f,
            r#"#!/bin/bash
# Written by `ulna campaign --slurm`: {cases} cases in {shards} shards, then their merge.
#
#   bash THIS_FILE [OPTION...]     submits the shards as an array, and the merge for when all of them are made
#   sbatch [OPTION...] THIS_FILE   submits the shards alone
#
# Options such as --partition=NAME or --account=NAME are sbatch's. A shard that was killed, or ran out of time, goes on
# where it stopped when this is submitted again; one that is made already takes no time.
#
# A case took {milliseconds:.3} ms on one thread of the machine that wrote this, a shard {shard_seconds:.1} s on {threads}. The limit is {MARGIN} times that
# and {EXTRA_MINUTES} minutes.
#
#SBATCH --job-name={name}
#SBATCH --array=1-{shards}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={threads}
#SBATCH --mem-per-cpu=512M
#SBATCH --time={time}
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail

if [[ -z "${{SLURM_ARRAY_TASK_ID:-}}" ]]; then
    # Not a task of the array: submit it. `job` may have the cluster's name behind a semicolon.
    job=$(sbatch --parsable "$@" "$0")
    exec sbatch --dependency="afterok:${{job%%;*}}" --kill-on-invalid-dep=yes "$@" <<'MERGE'
#!/bin/bash
#SBATCH --job-name={name}-merge
#SBATCH --ntasks=1
#SBATCH --mem={merge_memory}M
#SBATCH --time={merge_time}
#SBATCH --requeue
set -euo pipefail
ulna={program}
scenario={scenario}
output={output}
"$ulna" merge "$output" --output "$output/campaign.csv"
# All cases are there: page and figures alone are made.
"$ulna" campaign "$scenario" --cases {summed_up} --seed {seed} --output "$output"
MERGE
fi

ulna={program}
scenario={scenario}
output={output}
exec "$ulna" campaign "$scenario" --cases {cases} --seed {seed} \
    --shard "$SLURM_ARRAY_TASK_ID/{shards}" --threads "${{SLURM_CPUS_PER_TASK:-{threads}}}" --output "$output"
"#
        )
    }
}
