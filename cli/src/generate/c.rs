//! `ulna generate --language c`: a header and a source file.

use std::fmt::Write as _;
use std::path::Path;

use anyhow::bail;
use clap::error::ErrorKind;
use clap::{Args, ValueEnum};
use ulna_codegen::{Abi, COptions, Generator, Precision};

use super::{Arguments, check, usage};
use crate::console;
use crate::output::{Files, check_folder};
use crate::progress::Progress;

/// What is asked for of C alone.
#[derive(Args)]
pub(super) struct Options {
    /// C: the scalar
    #[arg(long, value_enum)]
    precision: Option<Scalar>,
    /// C: statements in a function, at most; what is longer becomes several functions [default: 2000]
    #[arg(long, value_name = "N", value_parser = length)]
    function_length: Option<usize>,
    /// C: an interface beside the functions of the methods
    #[arg(long, value_enum)]
    abi: Option<Interface>,
}

/// A scalar of C.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Scalar {
    /// 64 bits (what is written unless another one is asked for)
    Double,
    /// 32 bits
    Float,
}

/// An interface that others read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Interface {
    /// Inverse and forward dynamics with their Jacobians as `casadi.external` reads them, in NAME_casadi.h and NAME_casadi.c
    Casadi,
}

fn length(text: &str) -> Result<usize, String> {
    let least = COptions::SHORTEST;
    let length = text.parse().ok().filter(|length| *length >= least);
    length.ok_or_else(|| format!("it must be a whole number, {least} or more"))
}

impl Options {
    /// The first of them that was given.
    pub(super) fn given(&self) -> Option<&'static str> {
        [
            ("--precision", self.precision.is_some()),
            ("--function-length", self.function_length.is_some()),
            ("--abi", self.abi.is_some()),
        ]
        .into_iter()
        .find_map(|(name, given)| given.then_some(name))
    }

    fn options(&self) -> COptions {
        let mut options = COptions::new();
        if let Some(scalar) = self.precision {
            options = options.precision(match scalar {
                Scalar::Double => Precision::Double,
                Scalar::Float => Precision::Float,
            });
        }
        if let Some(length) = self.function_length {
            options = options.function_length(length);
        }
        match self.abi {
            Some(Interface::Casadi) => options.abi(Abi::Casadi),
            None => options,
        }
    }

    /// The options as they were given, each with a space before it.
    fn as_given(&self) -> String {
        let mut text = " --language c".to_owned();
        let name = |value: Option<clap::builder::PossibleValue>| {
            value.map(|value| value.get_name().to_owned())
        };
        let words = [
            (
                "precision",
                name(self.precision.and_then(|x| x.to_possible_value())),
            ),
            (
                "function-length",
                self.function_length.map(|n| n.to_string()),
            ),
            ("abi", name(self.abi.and_then(|x| x.to_possible_value()))),
        ];
        for (option, value) in words {
            if let Some(value) = value {
                // Writing to a String does not fail.
                let _ = write!(text, " --{option} {value}");
            }
        }
        text
    }
}

/// Writes both files to `folder`, or checks them.
pub(super) fn run(arguments: &Arguments, folder: &Path) -> anyhow::Result<()> {
    let model = console::load(&arguments.table)?;
    let generator = arguments.methods.generator();
    if let Some(Interface::Casadi) = arguments.c.abi {
        refuse_incomplete(arguments, &generator, model.has_payload());
    }
    if !arguments.check {
        check_folder(folder)?;
    }
    let progress = Progress::new()?;
    let generated = generator.generate_c_watched(
        &model,
        &arguments.table.display().to_string(),
        arguments.c.options(),
        &|stage| progress.says(stage),
    );
    drop(progress);
    console::warnings(&arguments.table, generated.warnings());
    if arguments.check {
        return check_both(arguments, folder, &generated.files());
    }
    let mut files = Files::default();
    for (name, text) in generated.files() {
        files.add(name, text);
    }
    files.write_to(folder).map(drop)
}

/// Ends the program where there is no such interface: CasADi's numbers are doubles, and its functions call methods.
fn refuse_incomplete(arguments: &Arguments, generator: &Generator, has_payload: bool) {
    if arguments.c.precision == Some(Scalar::Float) {
        usage(
            ErrorKind::ArgumentConflict,
            "`--abi casadi` is in double precision, as CasADi is: leave out `--precision float`",
        );
    }
    let missing: Vec<&str> = Abi::Casadi
        .methods(has_payload)
        .into_iter()
        .filter(|method| !generator.chosen().contains(*method))
        .map(ulna_codegen::Method::name)
        .collect();
    if !missing.is_empty() {
        usage(
            ErrorKind::ArgumentConflict,
            &format!(
                "`--abi casadi` is made of more methods: add {} to `--methods`, or leave that out",
                missing.join(",")
            ),
        );
    }
}

/// Fails if one of the files is not what it should be, and says so of both.
fn check_both(
    arguments: &Arguments,
    folder: &Path,
    files: &[(String, &str)],
) -> anyhow::Result<()> {
    let again = arguments.again(&arguments.c.as_given(), folder);
    let wrong: Vec<String> = files
        .iter()
        .filter_map(|(name, text)| check(&folder.join(name), text, &again).err())
        .map(|error| format!("{error:#}"))
        .collect();
    if wrong.is_empty() {
        return Ok(());
    }
    bail!("{}", wrong.join("\n"))
}
