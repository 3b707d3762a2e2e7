//! [`Body`]: a rigid body's mass, centroid and inertia; several of them as one; and which no body can have.

use nalgebra::{Matrix3, Vector3};
use ulna_table::impossible_inertia;

use crate::frame::Frame;

/// A rigid body in some frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Body {
    /// Mass, kg.
    pub(crate) mass: f64,
    /// Centroid, m.
    pub(crate) com: Vector3<f64>,
    /// Inertia tensor about the centroid in the frame's axes, kg·m².
    pub(crate) inertia: Matrix3<f64>,
}

impl Body {
    /// No body at all.
    pub(crate) fn none() -> Self {
        Self {
            mass: 0.0,
            com: Vector3::zeros(),
            inertia: Matrix3::zeros(),
        }
    }

    /// Whether it has neither mass nor inertia.
    pub(crate) fn is_nothing(&self) -> bool {
        self.mass == 0.0 && self.inertia == Matrix3::zeros()
    }

    /// The same body in the frame in which its own stands at `frame`.
    pub(crate) fn seen_from(&self, frame: &Frame) -> Self {
        let rotation = frame.rotation;
        let turned = rotation * self.inertia * rotation.transpose();
        Self {
            mass: self.mass,
            com: frame.point(&self.com),
            // The upper triangle twice: rounding must not make the tensor unsymmetric.
            inertia: Matrix3::from_fn(|i, j| turned[(i.min(j), i.max(j))]),
        }
    }

    /// Both bodies as one: I = I₁ + I₂ + µ (dᵀd 1 − d dᵀ), with the reduced mass µ and the distance d of the centroids
    /// (Siciliano, *Robotics*, B.2: the parallel axis theorem, about the common centroid).
    pub(crate) fn joined(&self, other: &Self) -> Self {
        // What has no mass has no centroid either; the other's must not be rounded for it.
        if other.mass == 0.0 || self.mass == 0.0 {
            let heavy = if other.mass == 0.0 { self } else { other };
            return Self {
                inertia: self.inertia + other.inertia,
                ..*heavy
            };
        }
        let mass = self.mass + other.mass;
        let distance = other.com - self.com;
        let reduced = self.mass * other.mass / mass;
        let steiner =
            Matrix3::identity() * distance.norm_squared() - distance * distance.transpose();
        Self {
            mass,
            com: self.com + distance * (other.mass / mass),
            inertia: self.inertia + other.inertia + steiner * reduced,
        }
    }

    /// The tensor's rows.
    pub(crate) fn inertia_rows(&self) -> [[f64; 3]; 3] {
        self.inertia.transpose().into()
    }

    /// Why no rigid body can be this one, in words, and the numbers of it; thin rods and points are bodies.
    pub(crate) fn fault(&self) -> Option<(String, String)> {
        if self.mass == 0.0 && self.inertia != Matrix3::zeros() {
            let moments = format!(
                "{:?} kg m^2 about the axes",
                self.inertia.diagonal().data.0[0]
            );
            return Some(("is one without mass".to_owned(), moments));
        }
        let found = impossible_inertia(&self.inertia_rows())?;
        // As little more as makes a body of what is one but for a moment of 0.
        let allowance = 1e-11 * self.inertia.amax() + 1e-11;
        let thicker = Self {
            inertia: self.inertia + Matrix3::identity() * allowance,
            ..*self
        };
        let thicker = impossible_inertia(&thicker.inertia_rows())?;
        let [least, middle, largest] = found.principal;
        // Two moments of 0 come out of a tensor's eigenvalues on either side of it.
        if least.abs() <= allowance && middle.abs() <= allowance {
            let numbers = format!("{}: the sum of the other two is 0", found.numbers());
            return Some((thicker.rule().to_owned(), numbers));
        }
        if least >= -allowance {
            return Some((thicker.rule().to_owned(), thicker.numbers()));
        }
        let percent = -100.0 * least / largest.abs().max(-least);
        let numbers = format!(
            "{}: below 0 by {percent:.1} % of the largest",
            found.numbers()
        );
        Some((found.rule().to_owned(), numbers))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn body(mass: f64, com: [f64; 3], diagonal: [f64; 3]) -> Body {
        Body {
            mass,
            com: com.into(),
            inertia: Matrix3::from_diagonal(&diagonal.into()),
        }
    }

    /// Two halves of a homogeneous rod are the rod.
    #[test]
    fn halves_make_the_whole() {
        let thin = |mass: f64, length: f64| mass * length * length / 12.0;
        let half = |x| body(1.5, [x, 0.0, 0.0], [0.0, thin(1.5, 1.0), thin(1.5, 1.0)]);
        let whole = half(0.5).joined(&half(1.5));
        let expected = body(3.0, [1.0, 0.0, 0.0], [0.0, thin(3.0, 2.0), thin(3.0, 2.0)]);
        assert_relative_eq!(whole.com, expected.com, epsilon = 1e-15);
        assert_relative_eq!(whole.inertia, expected.inertia, epsilon = 1e-15);
        assert_eq!(whole.mass, 3.0);
    }

    #[test]
    fn what_has_no_mass_changes_no_digit() {
        let one = body(0.3, [0.1, 0.7, -0.3], [0.1, 0.2, 0.25]);
        assert_eq!(one.joined(&Body::none()), one);
        assert_eq!(Body::none().joined(&one), one);
    }

    #[test]
    fn faults_say_by_how_much() {
        let numbers = |mass, diagonal| {
            let fault = body(mass, [0.0; 3], diagonal).fault();
            fault.map(|(_, numbers)| numbers)
        };
        assert_eq!(numbers(1.0, [0.0; 3]), None);
        assert_eq!(numbers(1.0, [0.0, 1.0, 1.0]), None);
        assert_eq!(numbers(1.0, [1.0, 1.0, 2.001]), None);
        assert_eq!(numbers(0.0, [0.0; 3]), None);
        assert!(numbers(0.0, [1.0; 3]).is_some());
        for (diagonal, expected) in [
            ([1.0, 1.0, 2.5], ": beyond the sum by 25.0 %"),
            ([0.0, 1.0, 1.2], ": beyond the sum by 20.0 %"),
            ([-1e-17, 1.0, 1.2], ": beyond the sum by 20.0 %"),
            ([0.0, 0.0, 1.0], ": the sum of the other two is 0"),
            ([-1e-17, 1e-17, 1.0], ": the sum of the other two is 0"),
            ([-0.5, 2.0, 2.0], ": below 0 by 25.0 % of the largest"),
            ([-2.0, -1.0, -0.5], ": below 0 by 100.0 % of the largest"),
        ] {
            let numbers = numbers(1.0, diagonal).unwrap();
            assert!(numbers.ends_with(expected), "{numbers}");
        }
    }
}
