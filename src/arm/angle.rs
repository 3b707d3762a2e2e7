//! [`Angle`]: exact at quarter turns.

use core::f64::consts::FRAC_PI_2;

/// An angle in radians whose sine and cosine are exact at whole quarter turns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angle {
    /// The angle, rad.
    pub radians: f64,
}

impl Angle {
    /// The angle of `radians`.
    pub const fn from_radians(radians: f64) -> Self {
        Self { radians }
    }

    /// The whole number of quarter turns nearest to the angle, and what is left, rad:
    /// exactly 0 where the angle is a quarter turn's multiple to within its last few bits.
    pub fn quarter_turns(self) -> (i64, f64) {
        let quarters = round(self.radians / FRAC_PI_2);
        let rest = self.radians - quarters * FRAC_PI_2;
        let rounding = 4.0 * f64::EPSILON * self.radians.abs();
        (
            quarters as i64,
            if rest.abs() <= rounding { 0.0 } else { rest },
        )
    }

    /// Sine and cosine; exactly 0 and ±1 at quarter turns.
    pub fn sin_cos(self) -> (f64, f64) {
        match self.quarter_turns() {
            (quarters, 0.0) => match quarters.rem_euclid(4) {
                0 => (0.0, 1.0),
                1 => (1.0, 0.0),
                2 => (0.0, -1.0),
                _ => (-1.0, 0.0),
            },
            _ => crate::Real::sin_cos(self.radians),
        }
    }
}

/// Rounds half away from zero; `f64::round` needs the standard library.
fn round(x: f64) -> f64 {
    (x + 0.5_f64.copysign(x)) as i64 as f64
}
