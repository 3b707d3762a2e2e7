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

/// Whether every slice has an entry for each state.
///
/// # Errors
/// The first that has not.
pub(super) fn check(states: usize, slices: &[(&'static str, usize)]) -> Result<(), LengthMismatch> {
    for &(slice, length) in slices {
        if length != states {
            return Err(LengthMismatch {
                states,
                slice,
                length,
            });
        }
    }
    Ok(())
}
