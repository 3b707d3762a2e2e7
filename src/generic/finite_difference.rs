//! ∂J/∂q_i and ∂M/∂q_i by central differences with steps so chosen that they have no truncation error.
//!
//! As functions of one revolute angle, the entries of J and M are trigonometric polynomials of degree at most 2:
//! J is linear in the joint's rotation, M at most quadratic. What a central difference sees of
//! such a function is `b_1 sin h + b_2 sin 2h`, and its derivative is `b_1 + 2 b_2`. With `D(h) = (f(q + h) − f(q − h)) / 2`,
//! a quarter turn gives `D(π/2) = b_1`, an eighth gives `D(π/4) = b_1/√2 + b_2`, so that
//!
//! `∂f/∂q = 2 D(π/4) + (1 − √2) D(π/2)`
//!
//! exactly. A prismatic offset enters as a polynomial of degree at most 2, whose central difference is exact at any step;
//! it is taken as long as the chain. With such long steps nothing cancels: what is left is
//! the rounding of J and M themselves, where a short step would leave 1e-10 and a fourth-order rule 1e-12.

use core::array::from_fn;
use core::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use nalgebra::SMatrix;

use super::SerialChain;
use super::kinematics::JointInput;

impl<const N: usize> SerialChain<N> {
    /// ∂f/∂q_i for every i, of a matrix that depends on the joints as J or M does.
    pub(super) fn derivatives<const R: usize, const C: usize>(
        &self,
        inputs: &[JointInput; N],
        f: impl Fn(&[JointInput; N]) -> SMatrix<f64, R, C>,
    ) -> [SMatrix<f64, R, C>; N] {
        let at = |joint: usize, input: JointInput| {
            let mut shifted = *inputs;
            shifted[joint] = input;
            f(&shifted)
        };
        from_fn(|i| match inputs[i] {
            JointInput::Angle { sin, cos } => {
                let turned = |sin_h: f64, cos_h: f64| {
                    let input = JointInput::Angle {
                        sin: sin * cos_h + cos * sin_h,
                        cos: cos * cos_h - sin * sin_h,
                    };
                    at(i, input)
                };
                let half_difference =
                    |sin_h: f64, cos_h: f64| (turned(sin_h, cos_h) - turned(-sin_h, cos_h)) * 0.5;
                let eighth = half_difference(FRAC_1_SQRT_2, FRAC_1_SQRT_2);
                let quarter = half_difference(1.0, 0.0);
                eighth * 2.0 + quarter * (1.0 - SQRT_2)
            }
            JointInput::Offset(q) => {
                let step = self.length(&Self::offsets(inputs));
                let (ahead, behind) = (q + step, q - step);
                (at(i, JointInput::Offset(ahead)) - at(i, JointInput::Offset(behind)))
                    / (ahead - behind)
            }
        })
    }
}
