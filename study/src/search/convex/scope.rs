//! Whose steps count: the healthy joints', or the locked ones' too.

use nalgebra::DVector;

/// The joints that a demand is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scope {
    /// The joints that are not locked.
    Healthy,
    /// Every joint. A locked joint's step goes into its brake, and through it into the structure.
    All,
}

/// A step below this part of the largest planned torque is what rounding leaves of the difference of two torques.
pub(in crate::search) const ROUNDING: f64 = 1e-12;

/// The joints of a [`Scope`], told apart by what there is to lower.
pub(super) struct Joints {
    /// With a step, in ascending order.
    pub(super) stepping: Vec<usize>,
    /// Without one: they cannot be lowered, and are to be given none.
    pub(super) still: Vec<usize>,
    /// Those that no demand is made for.
    pub(super) outside: Vec<usize>,
}

impl Joints {
    /// `largest` is the largest planned torque that a step is the difference of.
    pub(super) fn new(scope: Scope, healthy: &[usize], step: &DVector<f64>, largest: f64) -> Self {
        let counts = |joint: &usize| scope == Scope::All || healthy.contains(joint);
        let (inside, outside): (Vec<_>, Vec<_>) = (0..step.len()).partition(counts);
        let (stepping, still) = inside
            .into_iter()
            .partition(|joint| step[*joint].abs() > ROUNDING * largest);
        Self {
            stepping,
            still,
            outside,
        }
    }
}
