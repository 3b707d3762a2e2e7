//! `ulna verify`: the emitted program against the textbook and against finite differences.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use ulna::generic::JointCountError;
use ulna::proof::{self, Deviation, Report, differences};
use ulna::{Model, SerialChain};
use ulna_codegen::Interpreter;

use crate::joints::{ForChain, with_chain};
use crate::{Verdict, console};

/// Compare an arm's emitted program with the generic path and with finite differences
#[derive(Args)]
#[command(after_help = "Example:\n  ulna verify arms/ssrms.toml --samples 10")]
pub(crate) struct Arguments {
    /// The arm's table (TOML)
    table: PathBuf,
    /// Random configurations, the same ones every time
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..))]
    samples: u32,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let model = Model::load(&arguments.table)?;
    let samples = arguments.samples as usize;
    let verify = Verify {
        model: &model,
        samples,
    };
    let (textbook, differences) = with_chain(&model, verify)??;
    writeln!(
        out,
        "{}: the emitted program against the generic path\n{textbook}",
        model.name
    )?;
    writeln!(
        out,
        "against central differences of the emitted program itself"
    )?;
    for deviation in &differences {
        let Deviation {
            method,
            error,
            tolerance,
        } = deviation;
        let verdict = if deviation.passes() { "ok" } else { "WRONG" };
        writeln!(
            out,
            "{method:34} {error:9.1e}  {tolerance:9.0e}   {verdict}"
        )?;
    }
    if textbook.passes() && differences.iter().all(Deviation::passes) {
        return Ok(Verdict::Pass);
    }
    console::error(&format!("the code emitted for `{}` is wrong", model.name));
    Ok(Verdict::Fail)
}

struct Verify<'m> {
    model: &'m Model,
    samples: usize,
}

impl ForChain for Verify<'_> {
    type Output = Result<(Report, [Deviation; 3]), JointCountError>;

    fn run<const N: usize>(self, chain: &SerialChain<N>) -> Self::Output {
        let emitted = Interpreter::<N>::new(self.model)?;
        let states = || proof::states(chain).take(self.samples);
        let textbook = proof::compare(&emitted, chain, states());
        Ok((textbook, differences::compare(&emitted, states())))
    }
}
