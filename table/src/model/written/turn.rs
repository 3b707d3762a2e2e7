//! A rotation's roll, pitch and yaw.

use std::f64::consts::FRAC_PI_2;

use ulna::Angle;

/// Roll, pitch and yaw of the rotation with these rows, R = Rz(yaw) Ry(pitch) Rx(roll), rad.
///
/// Roll is read off first, and yaw from what is left when roll is taken away: near a pitch of a quarter turn, where the
/// two are not determined each by itself, they give the rotation back together. Whole quarter turns come out as such.
pub(super) fn roll_pitch_yaw(rotation: &[[f64; 3]; 3]) -> [f64; 3] {
    let [x, y, z] = rotation;
    let pitch = (-z[0]).atan2(z[1].hypot(z[2]));
    // At a pitch of a quarter turn any roll will do.
    let roll = if z[1] == 0.0 && z[2] == 0.0 {
        0.0
    } else {
        z[1].atan2(z[2])
    };
    let (sin, cos) = Angle::from_radians(roll).sin_cos();
    let yaw = (sin * x[2] - cos * x[1]).atan2(cos * y[1] - sin * y[2]);
    [roll, pitch, yaw].map(whole_quarters)
}

/// The angle itself, or the whole quarter turns that it is but for rounding.
fn whole_quarters(angle: f64) -> f64 {
    let quarters = (angle / FRAC_PI_2).round() * FRAC_PI_2;
    if (angle - quarters).abs() <= 4.0 * f64::EPSILON {
        quarters
    } else {
        angle
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    use nalgebra::{Matrix3, Rotation3};

    fn rotation(roll: f64, pitch: f64, yaw: f64) -> Matrix3<f64> {
        Rotation3::from_euler_angles(roll, pitch, yaw).into_inner()
    }

    fn rows(matrix: Matrix3<f64>) -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]))
    }

    #[test]
    fn every_rotation_comes_back() {
        let turns = [-PI, -2.0, -FRAC_PI_2, -0.3, 0.0, 1e-9, 1.0, FRAC_PI_2, 3.0];
        let pitches = [
            -FRAC_PI_2,
            -FRAC_PI_2 + 1e-9,
            -1.0,
            0.0,
            0.4,
            FRAC_PI_2 - 1e-5,
            FRAC_PI_2 - 1e-8,
            FRAC_PI_2,
        ];
        for roll in turns {
            for yaw in turns {
                for pitch in pitches {
                    let given = rotation(roll, pitch, yaw);
                    let [roll, pitch, yaw] = roll_pitch_yaw(&rows(given));
                    let off = (rotation(roll, pitch, yaw) - given).amax();
                    assert!(off < 1e-15, "{roll} {pitch} {yaw}: {off:e}");
                }
            }
        }
    }

    #[test]
    fn quarter_turns_are_whole() {
        let exact = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        for angle in roll_pitch_yaw(&exact) {
            assert_eq!(Angle::from_radians(angle).quarter_turns().1, 0.0);
        }
    }
}
