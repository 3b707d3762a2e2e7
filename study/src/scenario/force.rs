//! [`ToolForce`]: the wrench that the tool exerts, over time.

use nalgebra::Vector6;

/// A wrench whose components are polynomials of time, such as Eq. 31.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolForce {
    /// For each of `[force; moment]`, world axes, at the tool point: the coefficients of t⁰, t¹, ..., N and N·m per sⁿ.
    pub coefficients: [Vec<f64>; 6],
}

impl ToolForce {
    /// The same wrench at all times.
    pub fn constant(wrench: &Vector6<f64>) -> Self {
        Self {
            coefficients: core::array::from_fn(|i| vec![wrench[i]]),
        }
    }

    /// The wrench at `time` s, N and N·m.
    pub fn at(&self, time: f64) -> Vector6<f64> {
        let horner = |coefficients: &Vec<f64>| {
            let powers = coefficients.iter().rev();
            powers.fold(0.0, |sum, coefficient| sum * time + coefficient)
        };
        Vector6::from_iterator(self.coefficients.iter().map(horner))
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
