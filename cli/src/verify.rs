//! `ulna verify`: the emitted program and the textbook against more digits, and against finite differences.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use ulna_table::Model;
use ulna_verify::Verified;

use crate::methods::Methods;
use crate::progress::Progress;
use crate::{Verdict, console};

/// Compare an arm's emitted program, and the generic path, with a computation of twice as many digits, and with finite differences
#[derive(Args)]
#[command(after_help = "Example:\n  ulna verify arms/ssrms.toml --samples 10")]
pub(crate) struct Arguments {
    /// The arm's table (TOML)
    table: PathBuf,
    #[command(flatten)]
    methods: Methods,
    /// Random configurations, the same ones every time; without it 100, and of arms of more than 12 joints,
    /// where each takes longer, fewer: 42 of 16 joints, 12 of 24, 5 of 32
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    samples: Option<u32>,
}

impl Arguments {
    /// How many configurations, of an arm of `joints` joints. What one takes grows faster than the third power of their number.
    fn samples(&self, joints: usize) -> usize {
        const SAMPLES: usize = 100;
        const PLENTY: usize = 12;
        let of_long_arms = || SAMPLES * PLENTY.pow(3) / joints.max(PLENTY).pow(3);
        self.samples
            .map_or_else(of_long_arms, |given| given as usize)
    }
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let (_, model) = console::examine(&arguments.table)?;
    let Verified {
        emitted,
        textbook,
        differences,
    } = verified(&model, arguments)?;
    let carrying = if model.has_payload() {
        " with a payload as heavy as its last link"
    } else {
        ""
    };
    writeln!(
        out,
        "{}{carrying}: the emitted program against its own formulas in 106 bits\n{emitted}",
        model.name()
    )?;
    writeln!(
        out,
        "the generic path against the emitted formulas in 106 bits\n{textbook}"
    )?;
    if !differences.deviations().is_empty() {
        writeln!(
            out,
            "the emitted program against central differences of itself"
        )?;
    }
    for deviation in differences.deviations() {
        writeln!(out, "{deviation}")?;
    }
    if let Some(absent) = arguments.methods.absent() {
        writeln!(out, "\nnot generated, and not compared: {absent}")?;
    }
    let mut verdict = Verdict::Pass;
    let mut wrong = |what: &str| {
        console::error(&format!("`{}`: {what}", model.name()));
        verdict = Verdict::Fail;
    };
    if !emitted.passes() {
        wrong("the emitted code loses more digits than rounding explains");
    }
    if !textbook.passes() {
        wrong("the emitted formulas and the generic path disagree");
    }
    if !differences.passes() {
        wrong("the emitted derivatives are not those of the emitted quantities");
    }
    Ok(verdict)
}

/// What comes of all comparisons.
fn verified(model: &Model, arguments: &Arguments) -> anyhow::Result<Verified> {
    let progress = Progress::new()?;
    let generator = arguments.methods.generator();
    let compiled = generator.compile_watched(model, &|stage| progress.says(stage));
    let samples = arguments.samples(model.joints().len());
    progress.counts(samples as u64, "comparing at random states")?;
    let each = || progress.one_done();
    // What most arms have is compiled with optimizations, as this program is.
    let verify = match model.joints().len() {
        6 => ulna_verify::verify_as::<6>,
        7 => ulna_verify::verify_as::<7>,
        _ => ulna_verify::verify,
    };
    Ok(verify(model, compiled, samples, &each)?)
}
