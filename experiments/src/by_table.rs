//! [`by_table`]: the arm of a table, by its number of joints.

use ulna::SerialChain;
use ulna_codegen::Interpreter;
use ulna_table::{JointCountError, Model};

use crate::{Subject, subject};

/// The most joints of an arm that experiments are compiled for.
pub const MAX_JOINTS: usize = 12;

/// More joints than experiments are compiled for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("arm `{arm}` has {joints} joints; experiments take up to {MAX_JOINTS}")]
pub struct TooManyJoints {
    /// The arm's name.
    pub arm: String,
    /// How many it has.
    pub joints: usize,
}

/// The arm of a table, ready for experiments.
pub struct ByTable {
    /// The arm.
    pub subject: Box<dyn Subject>,
}

/// The arm of `model`, ready for experiments.
///
/// # Errors
/// For more than [`MAX_JOINTS`] joints.
pub fn by_table(model: &Model) -> Result<ByTable, TooManyJoints> {
    macro_rules! dispatch {
        ($($joints:literal)+) => {
            match model.joints().len() {
                $($joints => of::<$joints>(model),)+
                _ => return Err(too_many(model)),
            }
        };
    }
    const { assert!(MAX_JOINTS == 12) };
    dispatch!(8).map_err(|_| too_many(model))
}

/// The arm of `model`, of `N` joints.
///
/// # Errors
/// For another number of joints.
pub fn of<const N: usize>(model: &Model) -> Result<ByTable, JointCountError> {
    let chain: SerialChain<N> = SerialChain::try_from(model)?;
    let arm: Interpreter<N> = Interpreter::new(model)?;
    Ok(ByTable {
        subject: subject(Box::new(arm), chain),
    })
}

fn too_many(model: &Model) -> TooManyJoints {
    TooManyJoints {
        arm: model.name().to_owned(),
        joints: model.joints().len(),
    }
}
