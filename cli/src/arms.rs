//! From the arm of a scenario, known at run time, to a type.

use anyhow::bail;
use ulna::SerialChain;
use ulna_study::experiment::AnyArm;
use ulna_study::scenario::{KnownArm, ScenarioArm};

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

        fn with_generated_chain<W: ForChain>(name: &str, work: W) -> anyhow::Result<W::Output> {
            match name {
                $(stringify!($name) => Ok(work.run(&ulna_generated::$Type::CHAIN)),)+
                _ => bail!("no arm `{name}` was compiled into the program"),
            }
        }
    };
}
ulna_generated::for_each_arm!(generated_arms);

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
