//! [`ByTable`]: the arm of a table, as machine code or by the textbook.

use ulna::SerialChain;
use ulna_jit::{Error, Jit};
use ulna_table::{JointCountError, Model};

use crate::{CompiledFor, Copies, Subject};

/// The arm of a table, ready for experiments.
pub struct ByTable {
    /// The arm: machine code made of its table, or the textbook's formulas.
    pub subject: Box<dyn Subject>,
    /// Why it runs by the textbook, which takes some twenty times as long; `None` where it is machine code.
    pub no_code: Option<Error>,
}

/// The arm of `model`, of `N` joints.
pub(crate) fn by_table_of<const N: usize>(model: &Model) -> Result<ByTable, JointCountError>
where
    Copies: CompiledFor<N>,
{
    let chain: SerialChain<N> = SerialChain::try_from(model)?;
    Ok(match Jit::<N>::compile(model) {
        Ok(arm) => ByTable {
            subject: Copies::subject(Box::new(arm), chain),
            no_code: None,
        },
        Err(error) => ByTable {
            subject: Copies::textbook(chain),
            no_code: Some(error),
        },
    })
}
