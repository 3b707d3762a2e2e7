//! The generic path: textbook formulas on nalgebra, for any table at run time. The specification of every backend.

use crate::{Joint, Placement, TaskRows};

/// A serial chain of `N` joints, evaluated by textbook formulas.
///
/// All of it is plain data, so that generated code can carry its own chain as a constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SerialChain<const N: usize> {
    /// The joints, base first.
    pub joints: [Joint; N],
    /// `world_from_base`.
    pub base: Placement,
    /// `frame_N_from_tool`.
    pub tool: Placement,
    /// Gravity, m/s², world axes.
    pub gravity: [f64; 3],
    /// The rows of J in w_D.
    pub task: TaskRows,
}
