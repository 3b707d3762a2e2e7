//! From a number of joints that is known at run time to one that is a type.

use anyhow::bail;
use ulna::SerialChain;
use ulna_table::Model;

/// What to do with a chain, whatever its number of joints.
pub(crate) trait ForChain {
    /// What comes of it.
    type Output;

    /// Does it.
    fn run<const N: usize>(self, chain: &SerialChain<N>) -> Self::Output;
}

/// Runs `work` on the chain of `model`.
///
/// # Errors
/// When the arm has more joints than experiments are compiled for.
pub(crate) fn with_chain<W: ForChain>(model: &Model, work: W) -> anyhow::Result<W::Output> {
    macro_rules! dispatch {
        ($most:literal: $($joints:literal)+) => {
            match model.joints().len() {
                $($joints => Ok(work.run(&SerialChain::<$joints>::try_from(model)?)),)+
                joints => bail!(
                    "arm `{}` has {joints} joints; `ulna reproduce`, `ulna assess` and `ulna campaign` take up to {most}. \
                     `ulna check`, `ulna generate`, `ulna cost` and `ulna verify` take every arm, up to {all} joints; \
                     experiments with more than {most} are a program of your own, with `ulna_study` and `SerialChain::<{joints}>`",
                    model.name(),
                    most = $most,
                    all = Model::MAX_JOINTS,
                ),
            }
        };
    }
    // A number of joints more is some three seconds more of compiling the program.
    dispatch!(12: 1 2 3 4 5 6 7 8 9 10 11 12)
}
