//! [`by_table`]: the arm of a table, by its number of joints.

use ulna::SerialChain;
use ulna_jit::{Error, Jit};
use ulna_table::{JointCountError, Model};

use crate::{Subject, subject, textbook};

/// The most joints of an arm that experiments are compiled for.
pub const MAX_JOINTS: usize = 12;

/// The arm of a table, ready for experiments.
pub struct ByTable {
    /// The arm: machine code made of its table, or the textbook's formulas.
    pub subject: Box<dyn Subject>,
    /// Why it runs by the textbook, which takes ten to thirty times as long; `None` where it is machine code.
    pub no_code: Option<Error>,
}

/// The arm of `model`, ready for experiments.
///
/// # Errors
/// For more than [`MAX_JOINTS`] joints.
pub fn by_table(model: &Model) -> Result<ByTable, JointCountError> {
    macro_rules! dispatch {
        ($($joints:literal)+) => {
            match model.joints().len() {
                $($joints => by_table_of::<$joints>(model),)+
                joints => Err(JointCountError {
                    arm: model.name().to_owned(),
                    joints,
                    expected: MAX_JOINTS,
                }),
            }
        };
    }
    const { assert!(MAX_JOINTS == 12) };
    dispatch!(1 2 3 4 5 6 7 8 9 10 11 12)
}

/// [`by_table`] of an arm of `N` joints, compiled where it is called and as the caller is.
///
/// # Errors
/// For another number of joints.
pub fn by_table_of<const N: usize>(model: &Model) -> Result<ByTable, JointCountError> {
    let chain: SerialChain<N> = SerialChain::try_from(model)?;
    Ok(match Jit::<N>::compile(model) {
        Ok(arm) => ByTable {
            subject: subject(Box::new(arm), chain),
            no_code: None,
        },
        Err(error) => ByTable {
            subject: textbook(chain),
            no_code: Some(error),
        },
    })
}
