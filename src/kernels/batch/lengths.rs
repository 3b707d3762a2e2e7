//! [`LengthMismatch`]: the slices of a batch are of one length.

/// The slices of a batch are of different lengths. Nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{slice}` has {length} entries in a batch of {states} states")]
pub struct LengthMismatch {
    /// How many states there are.
    pub states: usize,
    /// The slice of another length: `qd`, `qdd`, `tau` or `out`.
    pub slice: &'static str,
    /// Its length.
    pub length: usize,
}

/// Whether a slice has an entry for each state.
///
/// # Errors
/// It has not.
#[inline]
pub(super) fn check(
    states: usize,
    slice: &'static str,
    length: usize,
) -> Result<(), LengthMismatch> {
    if length == states {
        Ok(())
    } else {
        Err(LengthMismatch {
            states,
            slice,
            length,
        })
    }
}
