//! Δt of Eq. 18 and ΔF_e of Eq. 8, where an experiment has them: a line for the console, a sentence for the page.

use std::fmt::{self, Write as _};
use std::io::{self, Write};

use ulna_study::scenario::Experiment;

/// A line on the console; nothing where the lock takes no time and leaves the force as it is.
pub(super) fn write(experiment: &Experiment, out: &mut dyn Write) -> io::Result<()> {
    match describe(experiment) {
        Some(text) => writeln!(out, "{text}"),
        None => Ok(()),
    }
}

/// A paragraph on the page, likewise.
pub(super) fn sentence(page: &mut String, experiment: &Experiment) -> fmt::Result {
    match describe(experiment) {
        Some(text) => writeln!(page, "In this experiment {text}.\n"),
        None => Ok(()),
    }
}

fn describe(experiment: &Experiment) -> Option<String> {
    let (time, step) = (experiment.step_time(), &experiment.force().lock_step);
    let time = (time > 0.0).then(|| {
        format!("the first torque after the lock is taken {time} s after it (Delta t of Eq. 18)")
    });
    let step = (step.amax() > 0.0).then(|| {
        let components: Vec<_> = step.iter().map(f64::to_string).collect();
        format!(
            "the lock takes [{}] N and N m from the tool's wrench (Delta F_e of Eq. 8)",
            components.join(", ")
        )
    });
    let parts: Vec<_> = [time, step].into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join(", and "))
}
