//! [`Bar`]: how far a campaign is, on stderr.

use std::path::Path;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use ulna_campaign::Watch;

use crate::console;

/// A bar on a terminal; what was found and what was made, everywhere.
pub(super) struct Bar {
    bar: ProgressBar,
    clock: Instant,
}

impl Bar {
    /// Of nothing yet.
    pub(super) fn new() -> anyhow::Result<Self> {
        let bar = ProgressBar::new(0);
        bar.set_style(ProgressStyle::with_template(
            "{bar:40} {pos}/{len} cases, {per_sec}, {eta} left",
        )?);
        Ok(Self {
            bar,
            clock: Instant::now(),
        })
    }

    /// So many cases were `made`.
    pub(super) fn ends(&self, made: u64) {
        self.bar.finish_and_clear();
        if made > 0 {
            let seconds = self.clock.elapsed().as_secs_f64();
            console::note(&format!(
                "{made} cases in {seconds:.1} s: {:.0} a second",
                made as f64 / seconds
            ));
        }
    }
}

impl Watch for Bar {
    fn begins(&self, rows: u64, cases: u64, path: &Path) {
        if rows > 0 {
            console::note(&format!(
                "{rows} of {cases} cases are in {} already",
                path.display()
            ));
        }
        self.bar.set_length(cases);
        self.bar.set_position(rows);
        self.bar.reset_eta();
    }

    fn one_made(&self) {
        self.bar.inc(1);
    }
}
