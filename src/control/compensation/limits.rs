//! Eq. 14: torques within the rated ones, and what a compensation loses for it.

use nalgebra::SVector;

use super::{Law, Status};
use crate::control::failure::LockedJoints;

/// The two-sided Eq. 14 for the joints that are not locked.
#[derive(Clone, Copy, Debug)]
pub struct Limits<const N: usize> {
    /// Rated torque of each joint, N·m (N).
    pub rated_torque: SVector<f64, N>,
    /// The joints that Eq. 14 is not about.
    pub locked: LockedJoints<N>,
}

/// What a torque may exceed the rated one by before it counts, relative: solvers keep limits to a tolerance.
const LIMIT_TOLERANCE: f64 = 1e-9;

impl<const N: usize> Limits<N> {
    /// The torques within the rated ones, and what had to be done for it.
    #[inline]
    pub fn cut(
        &self,
        planned: &SVector<f64, N>,
        compensation: &SVector<f64, N>,
        law: Law,
    ) -> (SVector<f64, N>, Status) {
        let exceeds = |torque: &SVector<f64, N>, i: usize| {
            torque[i].abs() > self.rated_torque[i] * (1.0 + LIMIT_TOLERANCE)
        };
        let wanted = planned + compensation;
        let mut status = Status::Nominal;
        for i in self.locked.healthy() {
            if exceeds(&wanted, i) {
                status = status.max(if exceeds(planned, i) {
                    Status::Overloaded
                } else {
                    Status::Saturated
                });
            }
        }
        let torque = match (status, law) {
            (Status::Nominal, _) | (_, Law::PerJoint) => wanted,
            (_, Law::Projected | Law::Optimal) => match self.scale(planned, compensation) {
                Some(scale) => {
                    status = Status::Saturated;
                    planned + compensation * scale
                }
                None => {
                    status = Status::Overloaded;
                    *planned
                }
            },
        };
        let within = SVector::from_fn(|i, _| {
            if self.locked.contains(i) {
                torque[i]
            } else {
                let rated = self.rated_torque[i];
                torque[i].max(-rated).min(rated)
            }
        });
        (within, status)
    }

    /// The largest s in 0 to 1 with `|planned + s compensation|` within the rated torques, if there is one.
    fn scale(&self, planned: &SVector<f64, N>, compensation: &SVector<f64, N>) -> Option<f64> {
        let (mut least, mut most) = (0.0_f64, 1.0_f64);
        for i in self.locked.healthy() {
            let (rated, planned, slope) = (self.rated_torque[i], planned[i], compensation[i]);
            if slope == 0.0 {
                if planned.abs() > rated {
                    return None;
                }
                continue;
            }
            let towards = rated.copysign(slope);
            least = least.max((-towards - planned) / slope);
            most = most.min((towards - planned) / slope);
        }
        (least <= most).then_some(most)
    }
}
