//! Sines and cosines that come out alike on every machine, by series, in any precision.

use ulna::Real;

/// Up to here sines and cosines are right, rad: whole turns are taken off exactly.
pub(crate) const LARGEST_ANGLE: f64 = 1_073_741_824.0;

/// π/2 as the sum of four doubles.
pub(crate) const HALF_PI: [f64; 4] = [
    std::f64::consts::FRAC_PI_2,
    6.123_233_995_736_766e-17,
    -1.497_384_904_859_169_8e-33,
    5.562_271_104_316_826e-50,
];

/// Sine and cosine of `x` within ±π/4, by their series for an eighth of it, and three doublings.
pub(crate) fn sin_cos_near_zero<R: Real>(x: R) -> (R, R) {
    let (one, two) = (R::of(1.0), R::of(2.0));
    let eighth = x * R::of(0.125);
    let square = eighth * eighth;
    // sin y and 1 − cos y keep their digits through the doublings: sin 2y = 2 sin y (1 − v), 1 − cos 2y = 2 sin² y.
    let (mut sin, mut versine) = (R::of(0.0), R::of(0.0));
    for k in (1..=8).rev() {
        let k = f64::from(2 * k);
        sin = (one - sin) * square / R::of(k * (k + 1.0));
        versine = (one - versine) * square / R::of((k + 1.0) * (k + 2.0));
    }
    sin = eighth * (one - sin);
    versine = square * R::of(0.5) * (one - versine);
    for _ in 0..3 {
        (sin, versine) = (two * sin * (one - versine), two * sin * sin);
    }
    (sin, one - versine)
}

/// Sine and cosine of an angle from those of what is left when so many quarter turns are taken off.
pub(crate) fn turned<R: Real>(quarters: f64, (sin, cos): (R, R)) -> (R, R) {
    match (quarters % 4.0) as i64 {
        0 => (sin, cos),
        1 | -3 => (cos, -sin),
        2 | -2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Sine and cosine in `f64`, alike on every machine, of an angle of a few turns.
pub(crate) fn portable_sin_cos(angle: f64) -> (f64, f64) {
    let quarters = (angle / HALF_PI[0]).round();
    let rest = angle - quarters * HALF_PI[0] - quarters * HALF_PI[1];
    turned(quarters, sin_cos_near_zero(rest))
}
