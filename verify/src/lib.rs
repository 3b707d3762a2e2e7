//! An arm's emitted programs and the textbook side by side, for every number of joints that a table may have.
//!
//! ```
//! use ulna_codegen::Generator;
//! use ulna_table::Model;
//!
//! let model = Model::load("../arms/planar_2r.toml")?;
//! let compiled = Generator::new().compile(&model);
//! let found = ulna_verify::verify(&model, compiled, 10, &|| ())?;
//! assert!(found.passes(), "{}", found.emitted);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Inside
//!
//! Where everything else has its number of joints as a type's parameter, here all those numbers are compiled. Nothing else is:
//! the crate is there so that this is done once, and with few optimizations (`Cargo.toml` of the workspace), whatever changes in the program.

mod arm;
mod states;

use rayon::{ThreadPoolBuildError, ThreadPoolBuilder};
use ulna::proof::Report;
use ulna_codegen::Compiled;
use ulna_table::{JointCountError, Model};

use arm::Sides;
use states::{States, all};

/// The stack of a thread in which an arm of the most joints is compared without optimizations, bytes.
/// All of ∂M/∂q takes a quarter of a megabyte, and each hand that it goes through as much again.
const STACK: usize = 64 << 20;

/// What a comparison of an arm found: a report on each pair of roads to the same numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verified {
    /// The emitted programs in doubles against themselves in 106 bits.
    pub emitted: Report,
    /// The textbook against the emitted programs in 106 bits.
    pub textbook: Report,
    /// The emitted derivatives against central differences of what they are derivatives of.
    pub differences: Report,
}

impl Verified {
    /// Whether nothing differs by more than rounding explains.
    pub fn passes(&self) -> bool {
        let Self {
            emitted,
            textbook,
            differences,
        } = self;
        [emitted, textbook, differences]
            .into_iter()
            .all(Report::passes)
    }

    /// This and what was found at other states.
    fn and(self, later: &Self) -> Self {
        Self {
            emitted: self.emitted.and(&later.emitted),
            textbook: self.textbook.and(&later.textbook),
            differences: self.differences.and(&later.differences),
        }
    }
}

/// Why nothing was compared.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// More joints than [`Model::MAX_JOINTS`].
    #[error(transparent)]
    Joints(#[from] JointCountError),
    /// No thread could be started.
    #[error("cannot start the threads to compare in: {0}")]
    Threads(#[from] ThreadPoolBuildError),
}

/// Compares what is `compiled` of `model`, method by method, at the first `samples` of [`ulna::proof::states`], on all processors.
///
/// An arm with a payload at run time carries [`ulna::proof::payload`]. Methods that are not compiled are left out.
/// `each` is called after every state.
///
/// # Errors
/// When the system has no thread to spare.
pub fn verify(
    model: &Model,
    compiled: Compiled,
    samples: usize,
    each: &(dyn Fn() + Sync),
) -> Result<Verified, Error> {
    compare(states_of(model, compiled)?, samples, each)
}

/// [`verify`] of an arm of `N` joints, compiled as the caller is: with optimizations it takes a tenth of the time to run, and
/// its caller three seconds more to compile.
///
/// # Errors
/// As [`verify`], and if the arm has another number of joints.
pub fn verify_as<const N: usize>(
    model: &Model,
    compiled: Compiled,
    samples: usize,
    each: &(dyn Fn() + Sync),
) -> Result<Verified, Error> {
    compare(Sides::<N>::boxed(model, compiled)?, samples, each)
}

fn compare(
    mut states: Box<dyn States>,
    samples: usize,
    each: &(dyn Fn() + Sync),
) -> Result<Verified, Error> {
    let threads = ThreadPoolBuilder::new().stack_size(STACK).build()?;
    Ok(threads.install(|| all(&mut *states, samples, each)))
}

/// The arm by its number of joints.
fn states_of(model: &Model, compiled: Compiled) -> Result<Box<dyn States>, JointCountError> {
    const { assert!(Model::MAX_JOINTS == 32) };
    macro_rules! dispatch {
        ($($joints:literal)+) => {
            match model.joints().len() {
                $($joints => Sides::<$joints>::boxed(model, compiled),)+
                joints => Err(JointCountError {
                    arm: model.name().to_owned(),
                    joints,
                    expected: Model::MAX_JOINTS,
                }),
            }
        };
    }
    dispatch!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32)
}
