//! What the best compensation is best at, joint by joint.

use super::scope::Scope;

/// What [`Optimum`](super::Optimum) makes small. A least norm is often bought with joints that get worse than without compensation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Fairness {
    /// The norm of the healthy joints' steps, whatever becomes of each.
    #[default]
    LeastNorm,
    /// That norm, with no joint of the scope worse than without compensation: `|Δτ̃_i| ≤ |step_i|`.
    /// A joint without a step gets none.
    NoJointWorse(Scope),
    /// The largest `|Δτ̃_i| / |step_i|` over the scope's joints. A joint without a step gets none.
    ///
    /// Where the tool force is kept and no compensation lowers every joint
    /// ([`lower_every_joint`](super::lower_every_joint)), the ratio is 1 and the compensation none at all.
    WorstRatio(Scope),
}

/// When the best compensation acts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Acts {
    /// Before the lock and after it.
    ///
    /// With the tool force kept and an instant lock this is no better than [`Before`](Self::Before): any change of the steps lies in the null space
    /// of J, and what acts before the lock reaches all of it.
    #[default]
    Both,
    /// Up to the lock, as if it were known to come; nothing from then on.
    Before,
    /// From the lock on, by the joints that are left. With the tool force kept and the static projector, the least norm is that of
    /// `U' = −P' step`, P' the projector of the locked arm.
    After,
}
