//! ∂τ/∂q and ∂τ/∂q̇ by central differences without truncation error, and the derivatives of the forward dynamics from them.
//!
//! For fixed rates and accelerations τ depends on a revolute angle as M and its derivatives do, as a trigonometric polynomial
//! of degree at most 2, and on a prismatic offset as a polynomial of degree at most 2 (Siciliano, Eq. 7.44):
//! [`super::finite_difference`] is exact. On the rates τ depends by `c(q, q̇)` alone, a quadratic form in them, whose central
//! difference is exact at any step; it is taken as long as the rates are large, so that nothing cancels.

use nalgebra::{SMatrix, SVector};

use super::SerialChain;
use super::mass_matrix::factor;
use crate::Arm;

type Square<const N: usize> = SMatrix<f64, N, N>;

impl<const N: usize> SerialChain<N> {
    /// ∂τ/∂q and ∂τ/∂q̇. What a rotor behind its gear takes depends on q̈ alone, and friction on its own joint's rate.
    pub(super) fn torque_derivatives(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> (Square<N>, Square<N>) {
        let inputs = self.inputs(q);
        let by_position = self.derivatives(&inputs, |shifted| self.torque_at(shifted, qd, qdd));
        // Gravity and q̈ do not depend on q̇, and would only bring in their rounding.
        let weightless = Self {
            gravity: [0.0; 3],
            ..*self
        };
        let velocity_products =
            |qd: &SVector<f64, N>| weightless.torque_at(&inputs, qd, &SVector::zeros());
        let speed = qd.abs().sum();
        let step = if speed == 0.0 { 1.0 } else { speed };
        let by_velocity: [SVector<f64, N>; N] = core::array::from_fn(|j| {
            let (mut ahead, mut behind) = (*qd, *qd);
            ahead[j] += step;
            behind[j] -= step;
            (velocity_products(&ahead) - velocity_products(&behind)) / (ahead[j] - behind[j])
        });
        (
            SMatrix::from_columns(&by_position),
            SMatrix::from_columns(&by_velocity) + SMatrix::from_diagonal(&self.friction_slope(qd)),
        )
    }

    /// ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ: `τ = ID(q, q̇, FD(q, q̇, τ))` differentiated
    /// (Carpentier and Mansard, Analytical Derivatives of Rigid Body Dynamics Algorithms, RSS 2018).
    pub(super) fn acceleration_derivatives(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        tau: &SVector<f64, N>,
    ) -> (Square<N>, Square<N>, Square<N>) {
        let qdd = self.forward_dynamics(q, qd, tau);
        let (by_position, by_velocity) = self.inverse_dynamics_derivatives(q, qd, &qdd);
        let mass_matrix = factor(self.mass_matrix(q));
        (
            mass_matrix.solve(&-by_position),
            mass_matrix.solve(&-by_velocity),
            self.inverse_mass_matrix(q),
        )
    }
}
