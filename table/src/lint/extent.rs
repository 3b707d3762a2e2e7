//! [`Extent`]: what a link reaches over.

use nalgebra::{Rotation3, Vector3};

use ulna::{Joint, Placement};

/// The sine of an angle between two axes below which where they pass each other is no place on a link: six degrees.
const NEARLY_PARALLEL: f64 = 0.1;
/// Below this one the axes are parallel.
const PARALLEL: f64 = 1e-9;

/// The line that a link reaches over, in its frame: from the foot of the row's x on the joint's axis, `d` before the origin,
/// over the origin along the next row's `a` to that joint's axis and along it to the next origin; for the last link to the tool.
///
/// Before the first link the foot is left out: `d` of joint 1 is how high the base stands.
pub(super) struct Extent {
    points: Vec<Vector3<f64>>,
    /// m.
    pub(super) length: f64,
    /// Whether the points say where the link is. Where two axes are nearly parallel, as a calibration leaves them, their origins are anywhere along them.
    pub(super) is_certain: bool,
}

impl Extent {
    /// That of link `index` of the chain, counted from 0.
    pub(super) fn of(joints: &[Joint], tool: &Placement, index: usize) -> Self {
        let mut points = Vec::new();
        if let Some(own) = joints.get(index).filter(|_| index > 0) {
            points.push(Vector3::new(0.0, 0.0, -own.d));
        }
        points.push(Vector3::zeros());
        match joints.get(index + 1) {
            Some(next) => {
                let axis = Vector3::new(next.a, 0.0, 0.0);
                let along = Rotation3::from_axis_angle(&Vector3::x_axis(), next.alpha.radians);
                points.push(axis);
                points.push(axis + along * Vector3::new(0.0, 0.0, next.d));
            }
            None => points.push(Vector3::from(tool.translation)),
        }
        let steps = points.windows(2).map(|ends| (ends[1] - ends[0]).norm());
        Self {
            length: steps.sum(),
            // The foot depends on the axis before, the origin on the one behind, the next origin on the one behind that.
            is_certain: (index..=index + 2).all(|row| crosses_clearly(joints, row)),
            points,
        }
    }

    /// How far `point` is from the line, m.
    pub(super) fn distance(&self, point: Vector3<f64>) -> f64 {
        let to_step = |ends: &[Vector3<f64>]| {
            let (start, along) = (ends[0], ends[1] - ends[0]);
            let square = along.norm_squared();
            let share = if square > 0.0 {
                ((point - start).dot(&along) / square).clamp(0.0, 1.0)
            } else {
                0.0
            };
            (point - start - along * share).norm()
        };
        let distances = self.points.windows(2).map(to_step);
        distances.fold(f64::INFINITY, f64::min)
    }

    /// How far the farthest point of the line is from `point`, m.
    pub(super) fn farthest(&self, point: Vector3<f64>) -> f64 {
        let distances = self.points.iter().map(|end| (end - point).norm());
        distances.fold(0.0, f64::max)
    }

    /// The direction of the line, if it is nearly straight: its ends are apart by four fifths of its length.
    pub(super) fn direction(&self) -> Option<Vector3<f64>> {
        let across = self.points.last()? - self.points.first()?;
        let apart = across.norm();
        (apart > 0.8 * self.length && apart > 0.0).then(|| across / apart)
    }

    /// From where to where the line goes along `direction`, m.
    pub(super) fn along(&self, direction: Vector3<f64>) -> [f64; 2] {
        let places = self.points.iter().map(|point| point.dot(&direction));
        places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], place| {
            [low.min(place), high.max(place)]
        })
    }
}

/// Whether it is well defined where the axis of row `index` passes the one before. A parallel one passes it anywhere: its origin
/// is beside the one before, and as well defined as that.
pub(super) fn crosses_clearly(joints: &[Joint], index: usize) -> bool {
    let rows = joints.iter().take(index + 1).rev();
    let mut sines = rows.map(|row| row.alpha.sin_cos().0.abs());
    let crossing = sines.find(|sine| *sine > PARALLEL);
    crossing.is_none_or(|sine| sine >= NEARLY_PARALLEL)
}
