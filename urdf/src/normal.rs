//! [`Normal`]: the common normal of two axes.

use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::rows::{ROUNDING, SLACK};

/// Times the distance of two joints, m: where their common normal is farther away, a row loses digits to it, since inertias grow with its
/// square. A UR5e whose axes miss their places by 1e-2 rad, with a normal 100 times as far, differs by 2e-12, by 3e-3 rad by 7e-12.
const FAR: f64 = 200.0;
/// Wherever the joints are, m: an axis meets two normals, whose distance is within the 100 m of a table.
const FARTHEST: f64 = 49.0;
/// Joints that are nearer than this, m, count as if they were so far apart there.
const NEAR: f64 = 0.1;

/// Two lines: along `axis` through the origin, and along `next` through `point`. The directions have length 1.
pub(crate) struct Axes {
    pub(crate) axis: Vector3<f64>,
    pub(crate) point: Vector3<f64>,
    pub(crate) next: Vector3<f64>,
}

/// The common normal of an axis and the next one.
pub(crate) struct Normal {
    /// From the first axis to the second, of length 1, in the first joint's frame.
    pub(crate) direction: Vector3<f64>,
    /// How long it is, m; not negative.
    pub(crate) length: f64,
    /// From the first axis to the second about the normal, rad.
    pub(crate) twist: f64,
    /// Where it leaves the first axis, from the first joint's origin along it, m.
    pub(crate) start: f64,
    /// Where it meets the second axis, from the second joint's origin along it, m.
    pub(crate) end: f64,
    /// The angle and the distance of axes that are taken as parallel and are not quite.
    pub(crate) doubt: Option<(f64, f64)>,
}

impl Normal {
    /// Where it may point either way, or anywhere, it goes the way of `hint`; where it may start anywhere, it starts at `from`.
    pub(crate) fn between(axes: &Axes, hint: Vector3<f64>, from: f64) -> Self {
        let Axes { axis, point, next } = *axes;
        let cross = axis.cross(&next);
        let sine = cross.norm();
        if sine > ROUNDING {
            let start = point.cross(&next).dot(&cross) / (sine * sine);
            let end = point.cross(&axis).dot(&cross) / (sine * sine);
            let distance = start.abs().max(end.abs());
            if distance <= (FAR * point.norm().max(NEAR)).min(FARTHEST) {
                return Self::skew(axes, hint, start);
            }
            let doubt = Some((sine.atan2(axis.dot(&next).abs()), distance));
            return Self {
                doubt,
                ..Self::parallel(axes, hint, from)
            };
        }
        Self::parallel(axes, hint, from)
    }

    fn skew(axes: &Axes, hint: Vector3<f64>, start: f64) -> Self {
        let Axes { axis, point, next } = *axes;
        let cross = axis.cross(&next);
        // Of axes that are nearly parallel the product is at a right angle only but for its rounding.
        let direction = across(cross.normalize(), axis);
        let along = point.dot(&direction);
        // Axes that intersect have a normal either way.
        let towards = if along.abs() > SLACK {
            along
        } else {
            direction.dot(&hint)
        };
        let direction = direction * 1_f64.copysign(towards);
        let twist = cross.dot(&direction).atan2(axis.dot(&next));
        Self::along(axes, direction, along.abs(), twist, start)
    }

    fn parallel(axes: &Axes, hint: Vector3<f64>, start: f64) -> Self {
        let Axes { axis, point, next } = *axes;
        let aside = point - axis * point.dot(&axis);
        let length = aside.norm();
        // Of one line with itself any normal will do.
        let (direction, length) = if length > SLACK {
            (aside / length, length)
        } else {
            (hint, 0.0)
        };
        let twist = if axis.dot(&next) > 0.0 { 0.0 } else { PI };
        Self::along(axes, direction, length, twist, start)
    }

    /// Of this direction, length and twist, from `start` on.
    fn along(axes: &Axes, direction: Vector3<f64>, length: f64, twist: f64, start: f64) -> Self {
        let Axes { axis, point, next } = *axes;
        // From where it starts, so that what rounding has done to the start is not done twice.
        let end = (axis * start + direction * length - point).dot(&next);
        Self {
            direction,
            length,
            twist,
            start,
            end,
            doubt: None,
        }
    }
}

/// What of `direction` is across `axis`, of length 1; any such direction if nothing is.
pub(crate) fn across(direction: Vector3<f64>, axis: Vector3<f64>) -> Vector3<f64> {
    let candidates = [direction, Vector3::y(), Vector3::z()];
    let across = candidates.map(|direction| direction - axis * direction.dot(&axis));
    let enough = across.iter().find(|across| across.norm() > 1e-3);
    // One of two directions at a right angle is at least at half of one to any axis.
    enough.unwrap_or(&across[2]).normalize()
}
