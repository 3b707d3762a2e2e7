//! [`Copies`]: the numbers of joints that experiments are compiled for.

use ulna::{Arm, SerialChain};
use ulna_table::{JointCountError, Model};

use crate::by_table::by_table_of;
use crate::subject::Held;
use crate::{ByTable, Subject};

/// The most joints of an arm that experiments are compiled for.
pub const MAX_JOINTS: usize = 12;

/// What is compiled for each number of joints, here and nowhere else: [`Subject`] for an arm that the caller has.
#[derive(Clone, Copy, Debug)]
pub struct Copies;

/// A number of joints that experiments are compiled for.
pub trait CompiledFor<const N: usize> {
    /// `arm`, generated code whose `chain` is the same arm as data, for experiments.
    fn subject(arm: Box<dyn Arm<N> + Send + Sync>, chain: SerialChain<N>) -> Box<dyn Subject>;

    /// The arm `chain`, computed by the textbook.
    fn textbook(chain: SerialChain<N>) -> Box<dyn Subject>;
}

macro_rules! copies {
    ($($joints:literal)+) => {
        $(
            impl CompiledFor<$joints> for Copies {
                fn subject(
                    arm: Box<dyn Arm<$joints> + Send + Sync>,
                    chain: SerialChain<$joints>,
                ) -> Box<dyn Subject> {
                    Box::new(Held { arm, chain, is_textbook: false })
                }

                fn textbook(chain: SerialChain<$joints>) -> Box<dyn Subject> {
                    Box::new(Held { arm: Box::new(chain), chain, is_textbook: true })
                }
            }
        )+

        /// The arm of `model`, ready for experiments.
        ///
        /// # Errors
        /// For more than [`MAX_JOINTS`] joints.
        pub fn by_table(model: &Model) -> Result<ByTable, JointCountError> {
            match model.joints().len() {
                $($joints => by_table_of::<$joints>(model),)+
                joints => Err(JointCountError {
                    arm: model.name().to_owned(),
                    joints,
                    expected: MAX_JOINTS,
                }),
            }
        }
    };
}

copies!(1 2 3 4 5 6 7 8 9 10 11 12);
