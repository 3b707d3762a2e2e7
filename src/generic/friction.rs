//! Friction in the joints.

use nalgebra::SVector;

use super::SerialChain;
use crate::{Friction, Real};

impl Friction {
    /// What the motor bears for it at the rate `qd`, N·m (N): `viscous · q̇ + coulomb · q̇ / √(q̇² + smoothing²)`
    /// (Siciliano 7.2; the sign of q̇ in Coulomb's law smoothed, so that friction has a derivative at rest and none of it there).
    pub fn torque(&self, qd: f64) -> f64 {
        let smoothed = Real::sqrt(qd * qd + self.smoothing * self.smoothing);
        self.viscous * qd + self.coulomb * (qd / smoothed)
    }

    /// The slope of [`torque`](Self::torque) by q̇, N·m·s/rad (N·s/m): that of q̇/s, s = √(q̇² + ε²), is (ε/s)²/s.
    pub fn slope(&self, qd: f64) -> f64 {
        let smoothed = Real::sqrt(qd * qd + self.smoothing * self.smoothing);
        let share = self.smoothing / smoothed;
        self.viscous + self.coulomb * (share * share / smoothed)
    }
}

impl<const N: usize> SerialChain<N> {
    /// That of each joint at the rates `qd`.
    pub(super) fn friction(&self, qd: &SVector<f64, N>) -> SVector<f64, N> {
        SVector::from_fn(|i, _| self.joints[i].friction.torque(qd[i]))
    }

    /// Its slope by the joint's own rate.
    pub(crate) fn friction_slope(&self, qd: &SVector<f64, N>) -> SVector<f64, N> {
        SVector::from_fn(|i, _| self.joints[i].friction.slope(qd[i]))
    }
}
