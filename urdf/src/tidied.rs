//! Numbers without what only rounding has put there: a zero that is one makes shorter code, and an even number can be read.

use nalgebra::{Matrix3, Vector3};

use crate::body::Body;
use crate::frame::Frame;
use crate::rows::{ROUNDING, SLACK, tidy};

/// A frame whose axes along those of its parent to [`ROUNDING`] are so exactly, and whose origin has no digits beyond [`SLACK`].
pub(crate) fn frame(frame: &Frame) -> Frame {
    Frame {
        rotation: squared(frame.rotation),
        translation: vector(&frame.translation),
    }
}

/// A body whose centroid has no digits beyond [`SLACK`], and whose inertia none beyond that share of it.
pub(crate) fn body(body: &Body) -> Body {
    let slack = SLACK * body.inertia.amax();
    Body {
        mass: body.mass,
        com: vector(&body.com),
        inertia: body.inertia.map(|entry| tidy(entry, slack)),
    }
}

fn vector(vector: &Vector3<f64>) -> Vector3<f64> {
    vector.map(|coordinate| tidy(coordinate, SLACK))
}

/// The rotation, with what is one of the parent's axes as that axis. What is left of the others is off by rounding's square.
fn squared(rotation: Matrix3<f64>) -> Matrix3<f64> {
    let mut squared = rotation;
    for i in 0..3 {
        for j in 0..3 {
            let others = (0..3).filter(|k| *k != j).map(|k| rotation[(i, k)]);
            if others.fold(0.0, |most: f64, entry| most.max(entry.abs())) <= ROUNDING {
                let along = rotation[(i, j)].signum();
                squared.row_mut(i).fill(0.0);
                squared.column_mut(j).fill(0.0);
                squared[(i, j)] = along;
            }
        }
    }
    squared
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn what_is_square_but_for_rounding_is_square() {
        for (rpy, exact) in [
            ([FRAC_PI_2 + 3e-12, 0.0, 0.7], [FRAC_PI_2, 0.0, 0.7]),
            ([2e-13, PI - 2e-13, -2e-12], [0.0, PI, 0.0]),
            ([0.3, 0.0, 4e-12], [0.3, 0.0, 0.0]),
        ] {
            let [rounded, exact] = [rpy, exact].map(|rpy| Frame::from_rpy([0.0; 3], rpy).rotation);
            let squared = squared(rounded);
            assert!((squared - exact).amax() <= 2e-16, "{squared}{exact}");
            let zeros = |matrix: &Matrix3<f64>| matrix.iter().filter(|x| **x == 0.0).count();
            assert_eq!(zeros(&squared), zeros(&exact), "{squared}{exact}");
        }
        let other = Frame::from_rpy([0.0; 3], [1e-10, 0.4, 0.5]).rotation;
        assert_eq!(squared(other), other);
    }

    #[test]
    fn bodies_keep_what_is_more_than_rounding() {
        let given = Body {
            mass: 2.0,
            com: Vector3::new(-4.1e-16, 0.058_249_999_999_992_2, 1e-12),
            inertia: Matrix3::new(0.01, -2e-17, 1e-9, -2e-17, 0.02, 0.0, 1e-9, 0.0, 0.02),
        };
        let tidied = body(&given);
        assert_eq!(tidied.com, Vector3::new(0.0, 0.058_25, 1e-12));
        assert_eq!((tidied.inertia[1], tidied.inertia[2]), (0.0, 1e-9));
    }
}
