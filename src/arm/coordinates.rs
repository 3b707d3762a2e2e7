//! Joint coordinates as every backend reads them: finite results for every finite coordinate, however absurd.

use crate::{JointKind, Real, SerialChain};

/// The farthest that a prismatic joint's coordinate is read as, m: ten times the longest link of a table.
///
/// Farther out, what a light link before the joint adds to M would drown in the rounding of what the joint carries:
/// tables are refused whose links are too light for this distance.
pub const PRISMATIC_LIMIT: f64 = 1e3;

/// A prismatic joint's coordinate as every backend reads it: held within ±[`PRISMATIC_LIMIT`],
/// so that no finite coordinate, however absurd, makes a result NaN. An infinite one is no coordinate: NaN.
#[inline]
pub(crate) fn prismatic_offset(q: f64) -> f64 {
    if q.is_infinite() {
        f64::NAN
    } else {
        q.clamp(-PRISMATIC_LIMIT, PRISMATIC_LIMIT)
    }
}

/// Up to here coordinates, rad or m, are read as they are: two turns and a half. Beyond it a revolute joint's is the same angle within ±π.
pub const PLAIN_LIMIT: f64 = 16.0;

/// A revolute joint's coordinate as generated code reads it: beyond [`PLAIN_LIMIT`], the same angle within ±π. NaN if infinite.
///
/// Generated code adds angles of parallel joints before it takes their sine; of large angles the sum would be rounded
/// coarsely, or overflow. The sine and cosine of the angle itself are exact however large it is.
#[inline]
pub(crate) fn revolute_angle(q: f64) -> f64 {
    if q.abs() <= PLAIN_LIMIT {
        q
    } else {
        let (sin, cos) = Real::sin_cos(q);
        nalgebra::RealField::atan2(sin, cos)
    }
}

/// Whether kernels may read the joint coordinates as they are: always, but for absurd ones.
#[inline(always)]
pub(crate) fn are_plain<const N: usize>(q: &[f64; N]) -> bool {
    largest(q.map(f64::abs)) <= PLAIN_LIMIT
}

/// Whether kernels may read joint coordinates as they are, for who knows their number at run time.
#[inline]
pub fn is_plain(q: &[f64]) -> bool {
    !q.iter().any(|q| q.abs() > PLAIN_LIMIT)
}

/// The largest of some numbers, none below 0.
#[inline(always)]
fn largest<const K: usize>(numbers: [f64; K]) -> f64 {
    let mut largest = 0.0;
    for number in numbers {
        // `f64::max` would take three instructions where this takes one.
        largest = if number > largest { number } else { largest };
    }
    largest
}

/// Joint coordinates as kernels read them: finite results for every finite coordinate.
#[cold]
pub fn coordinates<const N: usize>(chain: &SerialChain<N>, q: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|i| coordinate(chain.joints[i].kind, q[i]))
}

/// A joint's coordinate as kernels read it.
pub fn coordinate(kind: JointKind, q: f64) -> f64 {
    match kind {
        JointKind::Revolute => revolute_angle(q),
        JointKind::Prismatic => prismatic_offset(q),
    }
}
