//! [`Frame`]: where something stands.

use nalgebra::{Matrix3, Vector3};
use ulna::Angle;

/// The pose of one frame in another: what turns and moves the coordinates of the first into those of the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Axes of the first frame as columns.
    pub(crate) rotation: Matrix3<f64>,
    /// Origin of the first frame, m.
    pub(crate) translation: Vector3<f64>,
}

impl Frame {
    /// No rotation, no translation.
    pub(crate) fn identity() -> Self {
        Self {
            rotation: Matrix3::identity(),
            translation: Vector3::zeros(),
        }
    }

    /// An `<origin>`: R = Rz(yaw) Ry(pitch) Rx(roll), about the fixed axes; exact at whole quarter turns.
    pub(crate) fn from_rpy(xyz: [f64; 3], rpy: [f64; 3]) -> Self {
        let turns = rpy.map(|radians| Angle::from_radians(radians).sin_cos());
        let [(sr, cr), (sp, cp), (sy, cy)] = turns;
        let rx = Matrix3::new(1.0, 0.0, 0.0, 0.0, cr, -sr, 0.0, sr, cr);
        let ry = Matrix3::new(cp, 0.0, sp, 0.0, 1.0, 0.0, -sp, 0.0, cp);
        let rz = Matrix3::new(cy, -sy, 0.0, sy, cy, 0.0, 0.0, 0.0, 1.0);
        Self {
            rotation: rz * ry * rx,
            translation: xyz.into(),
        }
    }

    /// Turned by `angle` about the unit vector `axis`: R = 1 + sin K + (1 − cos) K², K the cross product with the axis.
    pub(crate) fn turned(axis: &Vector3<f64>, angle: f64) -> Self {
        let (sin, cos) = Angle::from_radians(angle).sin_cos();
        let cross = axis.cross_matrix();
        Self {
            rotation: Matrix3::identity() + cross * sin + cross * cross * (1.0 - cos),
            translation: Vector3::zeros(),
        }
    }

    /// Moved by `translation`.
    pub(crate) fn moved(translation: Vector3<f64>) -> Self {
        Self {
            rotation: Matrix3::identity(),
            translation,
        }
    }

    /// The pose in this one's parent of a frame that stands at `inner` in this one.
    pub(crate) fn times(&self, inner: &Self) -> Self {
        Self {
            rotation: self.rotation * inner.rotation,
            translation: self.point(&inner.translation),
        }
    }

    /// The other way round.
    pub(crate) fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self {
            rotation,
            translation: -(rotation * self.translation),
        }
    }

    /// The parent's coordinates of a point.
    pub(crate) fn point(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * point + self.translation
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use approx::assert_relative_eq;
    use nalgebra::{Rotation3, Unit};

    use super::*;

    #[test]
    fn quarter_turns_are_exact_and_others_are_those_of_nalgebra() {
        let exact = Frame::from_rpy([0.0; 3], [FRAC_PI_2, -PI, 3.0 * FRAC_PI_2]);
        for entry in &exact.rotation {
            assert!([0.0, 1.0, -1.0].contains(entry), "{exact:?}");
        }
        let frame = Frame::from_rpy([1.0, 2.0, 3.0], [0.3, -1.2, 2.5]);
        let expected = Rotation3::from_euler_angles(0.3, -1.2, 2.5);
        assert_relative_eq!(frame.rotation, *expected.matrix(), epsilon = 1e-15);

        let axis = Vector3::new(0.48, -0.6, 0.64);
        let expected = Rotation3::from_axis_angle(&Unit::new_unchecked(axis), 0.7);
        let turned = Frame::turned(&axis, 0.7);
        assert_relative_eq!(turned.rotation, *expected.matrix(), epsilon = 1e-15);
    }

    #[test]
    fn a_frame_and_its_inverse_leave_a_point_where_it_is() {
        let frame = Frame::from_rpy([0.1, -0.2, 0.3], [0.3, -1.2, 2.5]);
        let point = Vector3::new(1.0, 2.0, 3.0);
        assert_relative_eq!(
            frame.inverse().point(&frame.point(&point)),
            point,
            epsilon = 1e-14
        );
        let both = frame.times(&frame.inverse());
        assert_relative_eq!(both.rotation, Matrix3::identity(), epsilon = 1e-15);
        assert_relative_eq!(both.translation, Vector3::zeros(), epsilon = 1e-15);
    }
}
