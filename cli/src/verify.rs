//! `ulna verify`: the emitted program and the textbook against more digits, and against finite differences.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use ulna::proof::{self, Report, differences};
use ulna::{Method, SerialChain};
use ulna_codegen::{Generator, Interpreter};
use ulna_table::JointCountError;
use ulna_table::Model;

use crate::joints::{ForChain, with_chain};
use crate::methods::Methods;
use crate::{Verdict, console};

/// Compare an arm's emitted program, and the generic path, with a computation of twice as many digits, and with finite differences
#[derive(Args)]
#[command(after_help = "Example:\n  ulna verify arms/ssrms.toml --samples 10")]
pub(crate) struct Arguments {
    /// The arm's table (TOML)
    table: PathBuf,
    #[command(flatten)]
    methods: Methods,
    /// Random configurations, the same ones every time
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..))]
    samples: u32,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let model = console::load(&arguments.table)?;
    let verify = Verify {
        model: &model,
        generator: arguments.methods.generator(),
        samples: arguments.samples as usize,
    };
    let Found {
        emitted,
        textbook,
        differences,
    } = with_chain(&model, verify)??;
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
    let absent: Vec<&str> = arguments
        .methods
        .absent()
        .iter()
        .map(Method::name)
        .collect();
    if !absent.is_empty() {
        let absent = absent.join(", ");
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

struct Verify<'m> {
    model: &'m Model,
    generator: Generator,
    samples: usize,
}

struct Found {
    emitted: Report,
    textbook: Report,
    differences: Report,
}

impl ForChain for Verify<'_> {
    type Output = Result<Found, JointCountError>;

    fn run<const N: usize>(self, chain: &SerialChain<N>) -> Self::Output {
        let mut emitted: Interpreter<N> =
            Interpreter::of(self.model, self.generator.compile(self.model))?;
        let mut chain = *chain;
        if self.model.has_payload() {
            let payload = proof::payload(&chain);
            emitted = emitted.carrying(&payload);
            chain = chain.carrying(&payload);
        }
        let (chain, exact) = (&chain, emitted.exact());
        let generated = self.generator.chosen();
        let states = || proof::states(chain).take(self.samples);
        Ok(Found {
            emitted: proof::compare_with(&emitted, &exact, chain, states()).of(generated),
            textbook: proof::compare_with(chain, &exact, chain, states()).of(generated),
            differences: differences::compare(&emitted, chain, states()).of(generated),
        })
    }
}
