//! [`Progress`]: a line on stderr that says what is being done. Only on a terminal, and only of work that takes a while.

use std::fmt::Display;
use std::sync::Once;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// What is done sooner is not worth a line.
const PATIENCE: Duration = Duration::from_millis(700);

/// The line. It goes when this does.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    shown: Once,
}

impl Progress {
    /// Nothing to be seen yet.
    pub(crate) fn new() -> anyhow::Result<Self> {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        bar.set_style(ProgressStyle::with_template("{elapsed} {msg}")?);
        Ok(Self {
            bar,
            start: Instant::now(),
            shown: Once::new(),
        })
    }

    /// What is done now.
    pub(crate) fn says(&self, what: impl Display) {
        self.show();
        self.bar.set_message(what.to_string());
        self.bar.tick();
    }

    /// From here on `count` things are done, all of them `what`: the line says how many have been.
    pub(crate) fn counts(&self, count: u64, what: &str) -> anyhow::Result<()> {
        let template = "{elapsed} {msg}: {pos} of {len}, {eta} left";
        self.bar.set_style(ProgressStyle::with_template(template)?);
        self.bar.set_length(count);
        self.says(what);
        Ok(())
    }

    /// One of them is done.
    pub(crate) fn one_done(&self) {
        self.show();
        self.bar.inc(1);
    }

    fn show(&self) {
        if self.start.elapsed() > PATIENCE {
            let stderr = || self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.shown.call_once(stderr);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
