//! [`DoubleDouble`]: numbers of 106 bits, the generator's measure of rounding errors.
//!
//! Constants are folded in them, so that what is emitted is rounded once, and programs are run in them, so that
//! the rounding of the same program in `f64` can be measured ([`crate::accuracy`]).
//!
//! A number is the unevaluated sum of two doubles of which the second is at most half a unit in the last place of the first.
//! Sum, product, quotient and root are good to a few units of 2⁻¹⁰⁴ (Dekker 1971; Joldes, Muller and Popescu 2017),
//! sine and cosine to 1e-31.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use ulna::Real;

use crate::sines::{HALF_PI, sin_cos_near_zero, turned};
pub(crate) use crate::sines::{LARGEST_ANGLE, portable_sin_cos};

/// The sum of two doubles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

/// What is left of a sum that cancels, relative to its summands, and is rounding: a few units of 2⁻¹⁰⁴.
const ROUNDING: f64 = 1e-30;

impl DoubleDouble {
    /// π/2.
    pub const HALF_PI: Self = Self {
        high: HALF_PI[0],
        low: HALF_PI[1],
    };

    /// Both doubles, bit by bit; 0 and −0 are one number here.
    pub fn to_bits(self) -> [u64; 2] {
        [self.high + 0.0, self.low + 0.0].map(f64::to_bits)
    }

    /// The number of these bits.
    pub fn from_bits(bits: [u64; 2]) -> Self {
        let [high, low] = bits.map(f64::from_bits);
        Self { high, low }
    }

    /// The nearest double.
    pub fn to_f64(self) -> f64 {
        self.high
    }

    /// Whether it is neither infinite nor NaN.
    pub fn is_finite(self) -> bool {
        (self.high + self.low).is_finite()
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// a + b for |a| ≥ |b|.
    fn quick_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self {
            high,
            low: b - (high - a),
        }
        .finite_or(high)
    }

    /// a + b.
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let of_b = high - a;
        Self {
            high,
            low: (a - (high - of_b)) + (b - of_b),
        }
        .finite_or(high)
    }

    /// a b. The target may have no fused multiply-add: both factors are split into halves (Veltkamp), scaled where they would overflow.
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        let (ah, al) = halves(a);
        let (bh, bl) = halves(b);
        Self {
            high,
            low: ((ah * bh - high) + ah * bl + al * bh) + al * bl,
        }
        .finite_or(high)
    }

    /// An infinity or NaN has no low part.
    fn finite_or(self, high: f64) -> Self {
        if self.low.is_finite() {
            self
        } else {
            Self { high, low: 0.0 }
        }
    }
}

/// A double as the sum of two of 26 bits each.
fn halves(x: f64) -> (f64, f64) {
    const LARGE: f64 = 1e300;
    const SCALE: f64 = 268_435_456.0; // 2²⁸
    if !x.is_finite() {
        return (x, 0.0);
    }
    if x.abs() > LARGE {
        let (high, low) = halves(x / SCALE);
        return (high * SCALE, low * SCALE);
    }
    let spread = 134_217_729.0 * x; // 2²⁷ + 1
    let high = spread - (spread - x);
    (high, x - high)
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let carried = Self::quick_sum(high.high, high.low + low.high);
        let sum = Self::quick_sum(carried.high, carried.low + low.low);
        if self.high.is_finite() && sum.high.abs() <= ROUNDING * self.high.abs() {
            // All digits have cancelled.
            return Self::default();
        }
        sum
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let exact = Self::product(self.high, other.high);
        let rest = self.high * other.low + self.low * other.high;
        if rest.is_finite() {
            Self::quick_sum(exact.high, exact.low + rest)
        } else {
            exact
        }
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        if !first.is_finite() || other.high.is_infinite() {
            return Self::of(first);
        }
        let rest = self - other * Self::of(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::of(second);
        let third = rest.high / other.high;
        Self::quick_sum(first, second) + Self::of(third)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let order = self.high.partial_cmp(&other.high)?;
        Some(order.then(self.low.partial_cmp(&other.low)?))
    }
}

impl PartialEq<f64> for DoubleDouble {
    fn eq(&self, other: &f64) -> bool {
        *self == Self::of(*other)
    }
}

impl PartialOrd<f64> for DoubleDouble {
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        self.partial_cmp(&Self::of(*other))
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self::of(value)
    }
}

impl Real for DoubleDouble {
    fn of(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }

    fn mul_add(self, factor: Self, summand: Self) -> Self {
        self * factor + summand
    }

    fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 || !root.is_finite() {
            return Self::of(root);
        }
        // A step of Newton's from the double's root doubles its digits.
        let root = Self::of(root);
        let rest = self - root * root;
        root + rest / (root * Self::of(2.0))
    }

    /// Within ±`LARGEST_ANGLE`.
    fn sin_cos(self) -> (Self, Self) {
        let quarters = (self.high / HALF_PI[0]).round();
        // Each product is exact in two doubles.
        let rest = HALF_PI.iter().fold(self, |rest, part| {
            let product = Self::product(*part, quarters);
            Self::sum(rest.high, -product.high) + (Self::sum(rest.low, -product.low))
        });
        turned(quarters, sin_cos_near_zero(rest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number whose decimal digits after the first double are `low`.
    fn number(high: f64, low: f64) -> DoubleDouble {
        DoubleDouble { high, low }
    }

    fn near(actual: DoubleDouble, expected: DoubleDouble) {
        let error = (actual - expected).abs().to_f64();
        assert!(
            error <= 3e-31 * expected.high.abs().max(0.1),
            "{actual:?} for {expected:?}"
        );
    }

    #[test]
    fn quotients_and_roots_have_thirty_digits() {
        let third = DoubleDouble::of(1.0) / DoubleDouble::of(3.0);
        near(third, number(1.0 / 3.0, 1.850371707708594e-17));
        near(third * DoubleDouble::of(3.0), DoubleDouble::of(1.0));
        let root = DoubleDouble::of(2.0).sqrt();
        near(
            root,
            number(std::f64::consts::SQRT_2, -9.667293313452913e-17),
        );
        near(root * root, DoubleDouble::of(2.0));
    }

    /// By mpmath, 60 digits, split into two doubles.
    #[test]
    fn sines_have_thirty_digits() {
        #[rustfmt::skip]
        let table = [
            (1e-09, [1e-09, -1.6666666666666669e-28], [1.0, -5e-19]),
            (0.3, [0.29552020666133955, 1.8315357276792536e-17], [0.955336489125606, 4.1935600297907467e-17]),
            (0.8, [0.7173560908995228, 1.1851419720716684e-18], [0.6967067093471654, 1.9275818349860986e-18]),
            (std::f64::consts::FRAC_PI_2, [1.0, -1.874699728327322e-33], [6.123233995736766e-17, -1.4973849048591698e-33]),
            (2.5, [0.5984721441039565, -5.521403334082375e-17], [-0.8011436155469337, -1.8674742705085553e-17]),
            (-3.0, [-0.1411200080598672, -8.577269787017502e-18], [-0.9899924966004454, -4.2060261566099734e-17]),
            (100.25, [-0.2772828564548513, -1.361336774720287e-17], [0.9607883312760612, -2.1441388741342008e-17]),
            (-1000000.5, [-0.141954699000744, 2.184367841909782e-18], [0.9898731552232378, -5.5249748385267264e-17]),
            (314159000.0, [-0.9944295095093008, 2.9705355680125974e-17], [0.10540375048873533, -3.882425440991231e-18]),
        ];
        for (angle, sin, cos) in table {
            let (s, c) = DoubleDouble::of(angle).sin_cos();
            near(s, number(sin[0], sin[1]));
            near(c, number(cos[0], cos[1]));
        }
    }

    #[test]
    fn what_cancels_is_zero_and_what_overflows_is_no_number() {
        let third = DoubleDouble::of(1.0) / DoubleDouble::of(3.0);
        assert_eq!(
            third * DoubleDouble::of(3.0) - DoubleDouble::of(1.0),
            DoubleDouble::default()
        );
        let huge = DoubleDouble::of(1e200);
        assert!(!(huge * huge).is_finite());
        assert!(!(huge / DoubleDouble::default()).is_finite());
        assert!(huge > third && -huge < third);
    }
}
