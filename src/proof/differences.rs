//! An arm's derivatives against central differences of its own J, M and w_D.

use nalgebra::SVector;

use super::{Deviation, State};
use crate::Arm;

/// Step, rad (m): the truncation of the difference and the rounding of what it is taken of are about alike.
const STEP: f64 = 1e-5;
/// Distance of a singular configuration, rad (m), within which ∇w_D is not compared.
const KINK: f64 = 1e3 * STEP;

/// The largest relative errors of ∂J/∂q_i, ∂M/∂q_i and ∇w_D at `states`.
///
/// What the differences themselves leave is within the tolerances: 1e-9 or so, and more for w_D, whose rounding grows with
/// the condition of M.
pub fn compare<const N: usize>(
    arm: &impl Arm<N>,
    states: impl Iterator<Item = State<N>>,
) -> [Deviation; 3] {
    let mut deviations = [
        ("jacobian_derivatives", 1e-8),
        ("mass_matrix_derivatives", 1e-8),
        ("dynamic_manipulability_gradient", 1e-5),
    ]
    .map(|(method, tolerance)| Deviation {
        method,
        error: 0.0,
        tolerance,
    });
    for State { q, .. } in states {
        for (deviation, error) in deviations.iter_mut().zip(errors(arm, &q)) {
            // NaN is never greater, and must not be lost.
            if error > deviation.error || error.is_nan() {
                deviation.error = error;
            }
        }
    }
    deviations
}

fn errors<const N: usize>(arm: &impl Arm<N>, q: &SVector<f64, N>) -> [f64; 3] {
    let (mut jacobian, mut mass, mut gradient) =
        (Error::default(), Error::default(), Error::default());
    let jacobian_derivatives = arm.jacobian_derivatives(q);
    let mass_derivatives = arm.mass_matrix_derivatives(q);
    let (manipulability, manipulability_gradient) = arm.dynamic_manipulability_gradient(q);
    // A derivative that vanishes has the rounding of what it is taken of all the same.
    jacobian.scale = arm.geometric_jacobian(q).amax();
    mass.scale = arm.mass_matrix(q).amax();
    gradient.scale = manipulability;
    // Closer than this to a singular configuration w_D has a kink, which a difference would average over.
    let smooth = manipulability > KINK * manipulability_gradient.norm();
    for i in 0..N {
        let (mut ahead, mut behind) = (*q, *q);
        ahead[i] += STEP;
        behind[i] -= STEP;
        let width = ahead[i] - behind[i];
        let difference = (arm.geometric_jacobian(&ahead) - arm.geometric_jacobian(&behind)) / width;
        jacobian.add(jacobian_derivatives[i].as_slice(), difference.as_slice());
        let difference = (arm.mass_matrix(&ahead) - arm.mass_matrix(&behind)) / width;
        mass.add(mass_derivatives[i].as_slice(), difference.as_slice());
        if smooth {
            let difference =
                arm.dynamic_manipulability(&ahead) - arm.dynamic_manipulability(&behind);
            gradient.add(&[manipulability_gradient[i]], &[difference / width]);
        }
    }
    [jacobian, mass, gradient].map(Error::relative)
}

/// The largest difference of two entries, and the largest entry.
#[derive(Default)]
struct Error {
    difference: f64,
    scale: f64,
}

impl Error {
    fn add(&mut self, values: &[f64], references: &[f64]) {
        for (value, reference) in values.iter().zip(references) {
            let difference = (value - reference).abs();
            if difference > self.difference || difference.is_nan() {
                self.difference = difference;
            }
            self.scale = self.scale.max(reference.abs());
        }
    }

    fn relative(self) -> f64 {
        if self.scale == 0.0 {
            self.difference
        } else {
            self.difference / self.scale
        }
    }
}
