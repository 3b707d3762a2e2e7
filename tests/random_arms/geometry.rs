//! Strategies for angles, lengths and places. All numbers are decimals of few digits, which shrink to others such:
//! a failing table stays one that a person can read.

use std::ops::RangeInclusive;

use proptest::prelude::*;
use proptest::sample::select;

use super::table::Place;

/// A number whose decimal logarithm is uniform, to three digits; the range is in tenths of a decade.
pub(crate) fn decades(tenths: RangeInclusive<i32>) -> BoxedStrategy<f64> {
    tenths
        .prop_map(|tenth| rounded(10_f64.powf(f64::from(tenth) / 10.0), 3))
        .boxed()
}

/// `value` to so many decimal digits.
pub(crate) fn rounded(value: f64, digits: usize) -> f64 {
    let text = format!("{value:.*e}", digits - 1);
    text.parse().unwrap_or(value)
}

/// An angle of any size, degrees.
fn oblique() -> BoxedStrategy<f64> {
    (-1800..=1800)
        .prop_map(|tenth| f64::from(tenth) / 10.0)
        .boxed()
}

/// A joint's twist, degrees: parallel and square axes, oblique ones, and those that are so but for a calibration.
pub(crate) fn twist() -> BoxedStrategy<f64> {
    prop_oneof![
        5 => Just(0.0),
        4 => select(vec![90.0, -90.0]),
        1 => Just(180.0),
        4 => oblique(),
        1 => select(vec![0.001, -0.001, 1e-5, 90.001, -89.999, 179.999]),
    ]
    .boxed()
}

/// A joint's offset or a turn of a place, degrees.
pub(crate) fn turn() -> BoxedStrategy<f64> {
    prop_oneof![
        4 => Just(0.0),
        2 => select(vec![90.0, -90.0, 180.0]),
        3 => oblique(),
    ]
    .boxed()
}

/// A length, m.
pub(crate) fn length() -> BoxedStrategy<f64> {
    prop_oneof![
        5 => Just(0.0),
        12 => (-1000..=1000).prop_map(|millimetres| f64::from(millimetres) / 1e3),
        1 => (-50..=50).prop_map(|microns| f64::from(microns) / 1e6),
        1 => (-1000..=1000).prop_map(|tenths| f64::from(tenths) / 10.0),
    ]
    .boxed()
}

/// A point: the origin, or anywhere.
pub(crate) fn point() -> BoxedStrategy<[f64; 3]> {
    let metre = || (-1000..=1000).prop_map(|millimetres| f64::from(millimetres) / 1e3);
    prop_oneof![
        1 => Just([0.0; 3]),
        1 => [length(), length(), length()],
        1 => [metre(), metre(), metre()],
    ]
    .boxed()
}

/// A base or a tool, or none.
pub(crate) fn place() -> BoxedStrategy<Option<Place>> {
    let place = (point(), [turn(), turn(), turn()]).prop_map(|(xyz, rpy)| Place { xyz, rpy });
    proptest::option::weighted(0.6, place).boxed()
}
