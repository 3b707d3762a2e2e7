//! How large the error of each kind of quantity is, and how large it may be: a rule for each, named in the table of methods.

use nalgebra::{IsometryMatrix3, SMatrix, SVector};

use super::scale::Scale;
use super::{State, relative, rounding, worse};
use crate::{Arm, JointKind, SerialChain};

pub(super) type Square<const N: usize> = SMatrix<f64, N, N>;
pub(super) type Twists<const N: usize> = SMatrix<f64, 6, N>;
pub(super) type Vector<const N: usize> = SVector<f64, N>;

/// An error, and what is allowed.
pub(super) type Verdict = (f64, f64);

/// What a reference says at a state, as far as several rules need it.
pub(super) struct Judge<'a, const N: usize> {
    pub(super) reference: &'a dyn Arm<N>,
    pub(super) chain: &'a SerialChain<N>,
    pub(super) state: &'a State<N>,
    pub(super) scale: Scale<N>,
    manipulability: f64,
    gradient: Vector<N>,
    mass_derivatives: [Square<N>; N],
}

pub(super) fn rounded<const N: usize>(error: f64) -> Verdict {
    (error, rounding(N))
}

/// A rule takes what the candidate found, and what tells what the reference does.
impl<'a, const N: usize> Judge<'a, N> {
    pub(super) fn new(
        reference: &'a dyn Arm<N>,
        chain: &'a SerialChain<N>,
        state: &'a State<N>,
    ) -> Self {
        let (manipulability, gradient) = reference.dynamic_manipulability_gradient(&state.q);
        Self {
            reference,
            chain,
            state,
            scale: Scale::new(reference, chain, &state.q),
            manipulability,
            gradient,
            mass_derivatives: reference.mass_matrix_derivatives(&state.q),
        }
    }

    /// The larger error of a rotation's entry and of a position.
    pub(super) fn pose(
        &self,
        found: IsometryMatrix3<f64>,
        expected: impl FnOnce() -> IsometryMatrix3<f64>,
    ) -> Verdict {
        rounded::<N>(self.apart(&found, &expected()))
    }

    /// How far apart two poses are.
    pub(super) fn apart(&self, a: &IsometryMatrix3<f64>, b: &IsometryMatrix3<f64>) -> f64 {
        let turned = a.rotation.matrix() - b.rotation.matrix();
        let moved = a.translation.vector - b.translation.vector;
        let turned = turned.iter().map(|x| x.abs());
        let moved = moved.iter().map(|x| x.abs() / self.scale.position);
        turned.chain(moved).fold(0.0, worse)
    }

    pub(super) fn twists(&self, found: Twists<N>, expected: impl FnOnce() -> Twists<N>) -> Verdict {
        rounded::<N>(self.scale.twists(&(found - expected())))
    }

    pub(super) fn twist_derivatives(
        &self,
        found: [Twists<N>; N],
        expected: impl FnOnce() -> [Twists<N>; N],
    ) -> Verdict {
        let expected = expected();
        let error = |i: usize| self.scale.twists(&(found[i] - expected[i])) * self.unit(i);
        rounded::<N>((0..N).map(error).fold(0.0, worse))
    }

    pub(super) fn masses(&self, found: Square<N>, expected: impl FnOnce() -> Square<N>) -> Verdict {
        rounded::<N>(Scale::masses(&self.scale.inertia, &(found - expected())))
    }

    pub(super) fn mass_derivatives(
        &self,
        found: [Square<N>; N],
        _: impl FnOnce() -> [Square<N>; N],
    ) -> Verdict {
        let error = |i: usize| {
            let sizes = match self.chain.joints[i].kind {
                JointKind::Revolute => &self.scale.inertia,
                JointKind::Prismatic => &self.scale.inertia_ahead,
            };
            let change = (found[i] - self.mass_derivatives[i]) * self.unit(i);
            Scale::masses(sizes, &change)
        };
        rounded::<N>((0..N).map(error).fold(0.0, worse))
    }

    pub(super) fn masses_and_derivatives(
        &self,
        (mass, derivatives): (Square<N>, [Square<N>; N]),
        _: impl FnOnce() -> (Square<N>, [Square<N>; N]),
    ) -> Verdict {
        let expected = || self.reference.mass_matrix(&self.state.q);
        let (masses, allowed) = self.masses(mass, expected);
        let (changes, _) = self.mass_derivatives(derivatives, || self.mass_derivatives);
        (worse(masses, changes), allowed)
    }

    /// An entry's error beside what it changes by, at worst and to first order, where M's entries change by ε of what they can amount to:
    /// `δM⁻¹ = −M⁻¹ δM M⁻¹`.
    pub(super) fn inverse_masses(
        &self,
        found: Square<N>,
        expected: impl FnOnce() -> Square<N>,
    ) -> Verdict {
        let expected = expected();
        let sizes = expected.abs() * self.scale.inertia;
        rounded::<N>(Scale::masses(&sizes, &(found - expected)))
    }

    pub(super) fn manipulability(&self, found: f64, _: impl FnOnce() -> f64) -> Verdict {
        let error = relative(found - self.manipulability, self.manipulability);
        (error, self.conditioned(1.0))
    }

    /// A gradient has the rounding of w_D's dependence on J and M in it, besides that of J and M.
    pub(super) fn gradient(
        &self,
        found: (f64, Vector<N>),
        _: impl FnOnce() -> (f64, Vector<N>),
    ) -> Verdict {
        let largest = self.gradient.amax().max(self.manipulability);
        let difference = found.1 - self.gradient;
        let slopes = (0..N).map(|i| relative(difference[i] * self.unit(i), largest));
        let (value, _) = self.manipulability(found.0, || self.manipulability);
        (slopes.fold(value, worse), self.conditioned(4.0))
    }

    pub(super) fn twists_and_gradient(
        &self,
        found: (Twists<N>, f64, Vector<N>),
        _: impl FnOnce() -> (Twists<N>, f64, Vector<N>),
    ) -> Verdict {
        let (jacobian, value, slopes) = found;
        let expected = || self.reference.geometric_jacobian(&self.state.q);
        let (twists, least) = self.twists(jacobian, expected);
        let beside = (self.manipulability, self.gradient);
        let (error, allowed) = self.gradient((value, slopes), || beside);
        // J's own error is small enough on its own account, or too large on any.
        let excess = if twists <= least { 0.0 } else { f64::INFINITY };
        (worse(error, excess), allowed)
    }

    pub(super) fn torques(
        &self,
        found: Vector<N>,
        expected: impl FnOnce() -> Vector<N>,
    ) -> Verdict {
        self.torques_of(&self.state.qd, &self.state.qdd, found, expected)
    }

    pub(super) fn torques_unaccelerated(
        &self,
        found: Vector<N>,
        expected: impl FnOnce() -> Vector<N>,
    ) -> Verdict {
        self.torques_of(&self.state.qd, &Vector::zeros(), found, expected)
    }

    pub(super) fn torques_at_rest(
        &self,
        found: Vector<N>,
        expected: impl FnOnce() -> Vector<N>,
    ) -> Verdict {
        self.torques_of(&Vector::zeros(), &Vector::zeros(), found, expected)
    }

    /// The error of the torques that the accelerations need.
    pub(super) fn accelerations(&self, found: Vector<N>, _: impl FnOnce() -> Vector<N>) -> Verdict {
        let State { q, qd, tau, .. } = self.state;
        let needed = self.reference.inverse_dynamics(q, qd, &found);
        let sizes = self.scale.torque(qd, &found) + tau.abs();
        rounded::<N>(Scale::torques(&sizes, &(needed - tau)))
    }

    fn torques_of(
        &self,
        qd: &Vector<N>,
        qdd: &Vector<N>,
        found: Vector<N>,
        expected: impl FnOnce() -> Vector<N>,
    ) -> Verdict {
        let sizes = self.scale.torque(qd, qdd);
        rounded::<N>(Scale::torques(&sizes, &(found - expected())))
    }

    /// `factor` times what the condition number of w_D makes of rounding.
    /// Where that leaves less than two digits, first-order theory says no more.
    fn conditioned(&self, factor: f64) -> f64 {
        let tolerance = factor * rounding(N) * self.scale.condition;
        if tolerance > 1e-2 {
            f64::INFINITY
        } else {
            tolerance
        }
    }

    pub(super) fn unit(&self, joint: usize) -> f64 {
        self.scale.unit(self.chain, joint)
    }
}
