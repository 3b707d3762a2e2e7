//! The rate limit of U.

use nalgebra::{SVector, Vector6};

use crate::control::compensation::{Cycle, TaskPose};
use crate::control::failure::LockedJoints;

/// How far each joint's U may go in `dt` s at `rate`, N·m (N).
#[inline]
pub(super) fn admitted<const N: usize>(rate: &SVector<f64, N>, dt: f64) -> SVector<f64, N> {
    let dt = dt.max(0.0);
    rate.map(|rate| {
        if rate.is_finite() {
            rate * dt
        } else {
            f64::INFINITY
        }
    })
}

/// The last cycle's U, and what it takes to carry it along with the null space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried<const N: usize> {
    compensation: SVector<f64, N>,
    /// The static tool wrench that it realised, whether it was meant to or not.
    wrench: Vector6<f64>,
    /// [`TaskPose::fade`] it had been multiplied by.
    fade: f64,
}

impl<const N: usize> Carried<N> {
    /// U of a cycle.
    pub(super) fn new(pose: &TaskPose<N>, cycle: &Cycle<N>) -> Self {
        Self {
            compensation: cycle.compensation,
            wrench: cycle.force_error,
            fade: pose.fade(),
        }
    }

    /// U = 0.
    pub(super) fn nothing() -> Self {
        Self {
            compensation: SVector::zeros(),
            wrench: Vector6::zeros(),
            fade: 1.0,
        }
    }

    /// U as it acted.
    pub(super) fn compensation(&self) -> &SVector<f64, N> {
        &self.compensation
    }

    /// Each joint as far towards `wanted` as is `admitted`, and whether that is not all the way.
    #[inline]
    pub(super) fn joint_by_joint(
        &self,
        wanted: &SVector<f64, N>,
        admitted: &SVector<f64, N>,
    ) -> (SVector<f64, N>, bool) {
        let u = SVector::from_fn(|i, _| {
            let last = self.compensation[i];
            wanted[i].max(last - admitted[i]).min(last + admitted[i])
        });
        (u, u != *wanted)
    }

    /// As far towards `wanted` on the straight way as is `admitted` for every joint, and whether that is not all the way.
    ///
    /// The way starts at the last U carried into `pose`: its part in the null space there, the torque of its tool wrench there,
    /// faded as the pose fades.
    #[inline]
    pub(super) fn as_a_whole(
        &self,
        pose: &TaskPose<N>,
        locked: LockedJoints<N>,
        wanted: &SVector<f64, N>,
        admitted: &SVector<f64, N>,
    ) -> (SVector<f64, N>, bool) {
        let beyond = |u: &SVector<f64, N>, from: &SVector<f64, N>| {
            (0..N).any(|i| (u[i] - from[i]).abs() > admitted[i])
        };
        if !beyond(wanted, &self.compensation) {
            return (*wanted, false);
        }
        let start = self.carry(pose, locked);
        let way = wanted - start;
        // Counted from where U was; if no point of the way is near enough to that, from where it was carried to.
        let share = share_within(&(start - self.compensation), &way, admitted)
            .or_else(|| share_within(&SVector::zeros(), &way, admitted))
            .unwrap_or(0.0);
        if share < 1.0 {
            (start + way * share, true)
        } else {
            (*wanted, false)
        }
    }

    fn carry(&self, pose: &TaskPose<N>, locked: LockedJoints<N>) -> SVector<f64, N> {
        let fade = if pose.fade() < self.fade {
            pose.fade() / self.fade
        } else {
            1.0
        };
        let kept = pose.null_space.project(&locked.without(&self.compensation));
        let bent = locked.without(&pose.jacobian.tr_mul(&self.wrench));
        (kept + bent) * fade
    }
}

/// The largest x in 0 to 1 with `|offset + x way|` within `admitted` for every joint, if there is one.
#[inline]
fn share_within<const N: usize>(
    offset: &SVector<f64, N>,
    way: &SVector<f64, N>,
    admitted: &SVector<f64, N>,
) -> Option<f64> {
    let (mut least, mut most) = (0.0_f64, 1.0_f64);
    for i in 0..N {
        let (offset, way, admitted) = (offset[i], way[i], admitted[i]);
        if admitted == f64::INFINITY {
            continue;
        }
        if way == 0.0 {
            if offset.abs() > admitted {
                return None;
            }
            continue;
        }
        let towards = admitted.copysign(way);
        least = least.max((-towards - offset) / way);
        most = most.min((towards - offset) / way);
    }
    (least <= most).then_some(most)
}
