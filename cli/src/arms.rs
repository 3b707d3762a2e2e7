//! From the arm of a scenario, known at run time, to a type.

use anyhow::bail;
use ulna::SerialChain;
use ulna_experiments::{ByTable, MAX_JOINTS, Subject};
use ulna_study::experiment::AnyArm;
use ulna_study::scenario::{KnownArm, ScenarioArm};
use ulna_table::Model;

use crate::console;
use crate::joints::{ForChain, with_chain};

/// What to do with an arm, whatever its backend and its number of joints.
pub(crate) trait ForArm {
    /// What comes of it.
    type Output;

    /// Does it.
    fn run<const N: usize>(self, arm: &AnyArm<N>) -> Self::Output;
}

macro_rules! generated_arms {
    ($(($Type:ident, $name:ident, $joints:literal))+) => {
        /// The arms that were generated when the program was compiled.
        pub(crate) const GENERATED: &[KnownArm] = &[$(KnownArm {
            name: stringify!($name),
            joints: &ulna_generated::$Type::CHAIN.joints,
            joint_names: &ulna_generated::$Type::JOINT_NAMES,
        }),+];

        fn with_generated<W: ForArm>(name: &str, work: W) -> anyhow::Result<W::Output> {
            match name {
                $(stringify!($name) => Ok(work.run(&ulna_generated::$Type::default())),)+
                _ => bail!("no arm `{name}` was compiled into the program"),
            }
        }

        fn generated(name: &str) -> anyhow::Result<Box<dyn Subject>> {
            match name {
                $(stringify!($name) => {
                    let arm = Box::new(ulna_generated::$Type::default());
                    Ok(ulna_experiments::subject(arm, ulna_generated::$Type::CHAIN))
                })+
                _ => bail!("no arm `{name}` was compiled into the program"),
            }
        }

        fn with_generated_chain<W: ForChain>(name: &str, work: W) -> anyhow::Result<W::Output> {
            match name {
                $(stringify!($name) => Ok(work.run(&ulna_generated::$Type::CHAIN)),)+
                _ => bail!("no arm `{name}` was compiled into the program"),
            }
        }
    };
}
ulna_generated::for_each_arm!(generated_arms);

/// The arm of a scenario: generated code where there is some, and otherwise machine code made of its table now.
/// Where the machine has none, the textbook, which it says: a command calls it once.
///
/// # Errors
/// When the arm has more joints than the program was compiled for.
pub(crate) fn subject(arm: &ScenarioArm) -> anyhow::Result<Box<dyn Subject>> {
    let (path, model) = match arm {
        ScenarioArm::Known(known) => return generated(known.name),
        ScenarioArm::Table { path, model } => (path, model),
    };
    let ByTable { subject, no_code } = by_table(model)?;
    if let Some(error) = no_code {
        console::note(&format!(
            "arm `{}` of {} is not compiled into the program, and {error}: it runs by the textbook formulas, \
             slower, with the same numbers but for rounding",
            model.name(),
            path.display()
        ));
    }
    Ok(subject)
}

/// The arm of a table.
fn by_table(model: &Model) -> anyhow::Result<ByTable> {
    let joints = model.joints().len();
    if joints > MAX_JOINTS {
        bail!(
            "arm `{}` has {joints} joints; `ulna reproduce`, `ulna assess` and `ulna campaign` take up to {MAX_JOINTS}. \
             `ulna check`, `ulna generate`, `ulna cost` and `ulna verify` take every arm, up to {all} joints; \
             experiments with more than {MAX_JOINTS} are a program of your own, with `ulna_study` and `SerialChain::<{joints}>`",
            model.name(),
            all = Model::MAX_JOINTS,
        );
    }
    Ok(ulna_experiments::by_table(model)?)
}

/// Runs `work` on generated code where there is some, and otherwise on the generic path, which it says: a command calls it once.
///
/// # Errors
/// When the arm has more joints than the program was compiled for.
pub(crate) fn with_arm<W: ForArm>(arm: &ScenarioArm, work: W) -> anyhow::Result<W::Output> {
    struct OnChain<W>(W);
    impl<W: ForArm> ForChain for OnChain<W> {
        type Output = W::Output;
        fn run<const N: usize>(self, chain: &SerialChain<N>) -> W::Output {
            self.0.run(chain)
        }
    }
    match arm {
        ScenarioArm::Known(known) => with_generated(known.name, work),
        ScenarioArm::Table { path, model } => {
            console::note(&format!(
                "arm `{}` of {} is not compiled into the program: it runs by the textbook formulas, \
                 slower, with the same numbers but for rounding",
                model.name(),
                path.display()
            ));
            with_chain(model, OnChain(work))
        }
    }
}

/// Runs `work` on the arm as data: for what no generated code offers, such as where the links are.
///
/// # Errors
/// As [`with_arm`].
pub(crate) fn with_chain_of<W: ForChain>(arm: &ScenarioArm, work: W) -> anyhow::Result<W::Output> {
    match arm {
        ScenarioArm::Known(known) => with_generated_chain(known.name, work),
        ScenarioArm::Table { model, .. } => with_chain(model, work),
    }
}
