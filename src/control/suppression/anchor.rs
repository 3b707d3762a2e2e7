//! [`Anchor`]: what a transition starts from, and how it goes.

use nalgebra::SVector;

use crate::control::compensation::{FreeTorque, TaskPose, nearest};
use crate::control::failure::LockedJoints;

/// A compensation that was missing at one time, ramped out from there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Anchor<const N: usize> {
    start: f64,
    ramp: f64,
    held: Held<N>,
}

#[derive(Clone, Copy, Debug)]
enum Held<const N: usize> {
    /// As much of it as keeps the tool force within a budget, wherever the arm goes.
    Force(FreeTorque<N>),
    /// All of it, joint by joint: between laws of which one bends the tool force anyway.
    Whole(SVector<f64, N>),
}

impl<const N: usize> Anchor<N> {
    /// What of `missing` keeps the tool force within `force_budget`; none without a ramp.
    pub(super) fn nearest(
        start: f64,
        ramp: f64,
        pose: &TaskPose<N>,
        missing: &SVector<f64, N>,
        force_budget: f64,
    ) -> Option<Self> {
        let held = Held::Force(nearest(pose, missing, force_budget));
        (ramp > 0.0).then_some(Self { start, ramp, held })
    }

    /// All that is `missing`; none without a ramp.
    pub(super) fn whole(start: f64, ramp: f64, missing: &SVector<f64, N>) -> Option<Self> {
        let held = Held::Whole(*missing);
        (ramp > 0.0).then_some(Self { start, ramp, held })
    }

    /// Whether its force error is a commanded one.
    pub(super) fn keeps_force(&self) -> bool {
        matches!(self.held, Held::Force(_))
    }

    /// The whole of it in `pose`, N·m (N).
    #[inline]
    pub(super) fn torque(&self, pose: &TaskPose<N>, locked: LockedJoints<N>) -> SVector<f64, N> {
        match &self.held {
            Held::Force(free) => pose.free_torque(free),
            Held::Whole(torque) => locked.without(torque) * pose.fade(),
        }
    }

    /// s: 1 at the start, 0 from the ramp's end on, with no step in its first and second derivative: `1 − 10x³ + 15x⁴ − 6x⁵`.
    #[inline]
    pub(super) fn share(&self, time: f64) -> f64 {
        let x = ((time - self.start) / self.ramp).max(0.0);
        if x < 1.0 {
            1.0 - x * x * x * (10.0 - x * (15.0 - 6.0 * x))
        } else {
            0.0
        }
    }
}
