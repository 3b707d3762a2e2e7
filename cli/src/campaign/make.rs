//! Making the cases of a part, on all threads, into its file.

use std::fs;
use std::ops::Range;
use std::time::{Duration, Instant};

use anyhow::Context;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use ulna_study::Scenario;

use super::file::CampaignFile;
use super::part::Part;
use super::row::Row;
use crate::console;
use crate::output::Lock;

/// What makes a case, by its number.
pub(super) type Make<'m> = &'m (dyn Fn(u64) -> Row + Sync);

/// So many cases are made before they are written.
struct Chunk(u64);

impl Chunk {
    const FIRST: Self = Self(64);
    const MOST: u64 = 1 << 14;
    /// What is lost when the program is killed. Sooner written is slower: each time the disk is waited for, and a file
    /// system that a thousand shards share waits for all of them.
    const TIME: Duration = Duration::from_secs(2);

    /// After one that took so long.
    fn next(self, taken: Duration) -> Self {
        if taken < Self::TIME / 2 {
            Self((2 * self.0).min(Self::MOST))
        } else {
            self
        }
    }
}

/// All rows of `part`, found in its file or made; returned if they are to be kept, and with what keeps others away.
pub(super) fn make_part(
    part: &Part,
    scenario: &Scenario,
    keep: bool,
    make: Make<'_>,
) -> anyhow::Result<(Vec<Row>, Lock)> {
    let folder = part.folder();
    fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let lock = Lock::take(&part.file("lock"), &part.to_string())?;
    let range = part.range();
    let cases = range.end - range.start;
    let mut file = CampaignFile::open(part, scenario, keep, make)?;
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
    let mut chunk = Chunk::FIRST;
    let mut start = range.start + found;
    while start < range.end {
        let clock = Instant::now();
        let end = range.end.min(start + chunk.0);
        // In order of the number, whatever thread made them.
        let rows = (start..end).into_par_iter().map(|index| {
            let row = make(index);
            bar.inc(1);
            row
        });
        file.append(rows.collect())?;
        start = end;
        chunk = chunk.next(clock.elapsed());
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

/// What a case of `range` costs one thread of this machine, s: as many are made as take a second, all over the range.
pub(super) fn seconds_a_case(range: &Range<u64>, make: Make<'_>) -> f64 {
    const PATIENCE: Duration = Duration::from_secs(1);
    const MOST: u64 = 1000;
    let cases = range.end - range.start;
    let step = (cases / MOST).max(1);
    // The first has what is paid once.
    make(range.start);
    let clock = Instant::now();
    let mut made = 0;
    for index in range.clone().step_by(usize::try_from(step).unwrap_or(1)) {
        make(index);
        made += 1;
        if clock.elapsed() > PATIENCE {
            break;
        }
    }
    clock.elapsed().as_secs_f64() / f64::from(made.max(1))
}
