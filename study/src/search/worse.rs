//! Which joints a compensation makes worse: without them a norm says nothing about a joint.

/// A joint whose step is larger with a compensation than without.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorseJoint {
    /// Counted from 0.
    pub joint: usize,
    /// |Δτ̃_i| without compensation, N·m (N).
    pub before: f64,
    /// |Δτ̃_i| with it.
    pub after: f64,
    /// after / before; ∞ for a joint that has no step but rounding without compensation.
    pub ratio: f64,
}

/// What a step grows by, relative to itself, before it counts: solvers keep bounds to a tolerance.
const TOLERANCE: f64 = 1e-6;

/// Below this part of the largest joint's step another's is rounding.
const ROUNDING: f64 = 1e-9;

/// The joints that are not among `locked` and bear a larger step `after` than `before`, in ascending order; signs do not count.
pub fn worse_joints(before: &[f64], after: &[f64], locked: &[usize]) -> Vec<WorseJoint> {
    let largest = before
        .iter()
        .fold(0.0_f64, |most, step| most.max(step.abs()));
    let rounding = ROUNDING * largest;
    let joints = before.iter().zip(after).enumerate();
    joints
        .filter(|(joint, _)| !locked.contains(joint))
        .map(|(joint, (before, after))| WorseJoint {
            joint,
            before: before.abs(),
            after: after.abs(),
            ratio: if before.abs() > rounding {
                (after / before).abs()
            } else {
                f64::INFINITY
            },
        })
        .filter(|joint| joint.after > joint.before * (1.0 + TOLERANCE) + rounding)
        .collect()
}
