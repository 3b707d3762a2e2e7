//! [`CoefficientBound`]: what keeps a coefficient of Eq. 16 from cancelling its joint's step.

use nalgebra::SVector;

use crate::search::{
    Assessment, CoefficientLaw, Operation, equivalent_per_joint, feasible_interval,
};
use ulna::control::compensation::Compensation;

/// A coefficient that a rated torque cuts: the one that would cancel the step lies outside of Eq. 28.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoefficientBound {
    /// The coefficient that would cancel the step.
    pub wanted: f64,
    /// The end of the interval of Eq. 28 that it lies beyond.
    pub limit: f64,
    /// Which end that is.
    pub side: BoundSide,
    /// When the joint would come to its rated torque, s.
    pub time: f64,
}

/// An end of the interval of Eq. 28.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BoundSide {
    /// k_di^down.
    Lower,
    /// k_di^up.
    Upper,
}

/// The coefficients of Eq. 16 that cancel each joint's step, whatever its rated torque.
pub(super) fn wanted<const N: usize>(operation: &Operation<N>) -> SVector<f64, N> {
    let cancelled = Assessment {
        impact: SVector::zeros(),
        ..operation.assess(&Compensation::none())
    };
    equivalent_per_joint(operation, &cancelled)
}

/// What cuts each coefficient of Eq. 16; `None` where nothing does.
pub(super) fn bounds<const N: usize>(operation: &Operation<N>) -> Vec<Option<CoefficientBound>> {
    let wanted = wanted(operation);
    let bound = |joint: usize| {
        // Under Eq. 16 a joint's interval is its own, whatever the other coefficients are.
        let interval =
            feasible_interval(operation, CoefficientLaw::PerJoint, joint, &wanted).ok()?;
        let wanted = wanted[joint];
        let (limit, side, time) = if wanted > interval.upper {
            (interval.upper, BoundSide::Upper, interval.upper_time)
        } else if wanted < interval.lower {
            (interval.lower, BoundSide::Lower, interval.lower_time)
        } else {
            return None;
        };
        Some(CoefficientBound {
            wanted,
            limit,
            side,
            time: time?,
        })
    };
    (0..N).map(bound).collect()
}
