//! [`ToolForce`]: the wrench that the tool exerts, over time.

use nalgebra::Vector6;

/// A wrench whose components are polynomials of time, such as Eq. 31, and which a lock may change.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolForce {
    /// For each of `[force; moment]`, world axes, at the tool point: the coefficients of t⁰, t¹, ..., N and N·m per sⁿ.
    pub coefficients: [Vec<f64>; 6],
    /// `ΔF_e` and `ΔN_e` of Eq. 8, `[force; moment]`, N and N·m: what a lock takes from it, before minus after.
    pub lock_step: Vector6<f64>,
}

impl ToolForce {
    /// The same wrench at all times, whatever locks.
    pub fn constant(wrench: &Vector6<f64>) -> Self {
        Self {
            coefficients: core::array::from_fn(|i| vec![wrench[i]]),
            lock_step: Vector6::zeros(),
        }
    }

    /// The wrench at `time` s as long as nothing has locked, N and N·m.
    pub fn at(&self, time: f64) -> Vector6<f64> {
        let horner = |coefficients: &Vec<f64>| {
            let powers = coefficients.iter().rev();
            powers.fold(0.0, |sum, coefficient| sum * time + coefficient)
        };
        Vector6::from_iterator(self.coefficients.iter().map(horner))
    }

    /// The wrench at `time` s after the lock, N and N·m.
    pub fn after_lock(&self, time: f64) -> Vector6<f64> {
        self.at(time) - self.lock_step
    }

    /// Whether time plays no part.
    pub fn is_constant(&self) -> bool {
        let mut powers = self
            .coefficients
            .iter()
            .flat_map(|component| component.iter().skip(1));
        powers.all(|coefficient| *coefficient == 0.0)
    }
}
