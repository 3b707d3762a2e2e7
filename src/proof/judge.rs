//! How large the error of each kind of quantity is, and how large it may be: a rule for each, named in the table of methods.

mod motion;
mod regressor;
mod task;

use core::cell::OnceCell;

use nalgebra::{IsometryMatrix3, SMatrix, SVector};

use super::scale::Scale;
use super::{State, relative, rounding, worse};
use crate::{Arm, JointKind, SerialChain};

pub(super) type Square<const N: usize> = SMatrix<f64, N, N>;
pub(super) type Twists<const N: usize> = SMatrix<f64, 6, N>;
pub(super) type Vector<const N: usize> = SVector<f64, N>;

/// An error, and what is allowed.
pub(super) type Verdict = (f64, f64);

/// What a reference says at a state, as far as several rules need it: computed when the first of them asks.
pub(super) struct Judge<'a, const N: usize> {
    pub(super) reference: &'a dyn Arm<N>,
    pub(super) chain: &'a SerialChain<N>,
    pub(super) state: &'a State<N>,
    pub(super) scale: Scale<N>,
    condition: OnceCell<f64>,
    gradient: OnceCell<(f64, Vector<N>)>,
    mass_derivatives: OnceCell<[Square<N>; N]>,
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
        Self {
            reference,
            chain,
            state,
            scale: Scale::new(chain, &state.q),
            condition: OnceCell::new(),
            gradient: OnceCell::new(),
            mass_derivatives: OnceCell::new(),
        }
    }

    /// The condition number of w_D.
    fn condition(&self) -> f64 {
        let condition = || self.scale.condition(self.reference, &self.state.q);
        *self.condition.get_or_init(condition)
    }

    /// The reference's w_D and ∇w_D.
    fn expected_gradient(&self) -> (f64, Vector<N>) {
        let gradient = || {
            self.reference
                .dynamic_manipulability_gradient(&self.state.q)
        };
        *self.gradient.get_or_init(gradient)
    }

    /// The reference's ∂M/∂q_i.
    fn expected_mass_derivatives(&self) -> &[Square<N>; N] {
        let derivatives = || self.reference.mass_matrix_derivatives(&self.state.q);
        self.mass_derivatives.get_or_init(derivatives)
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
        let expected = self.expected_mass_derivatives();
        let error = |i: usize| {
            let sizes = self.scale.links_beside(self.chain, i);
            let change = (found[i] - expected[i]) * self.unit(i);
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
        let known = || *self.expected_mass_derivatives();
        let (changes, _) = self.mass_derivatives(derivatives, known);
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
        let (expected, _) = self.expected_gradient();
        let error = relative(found - expected, expected);
        (error, self.conditioned(1.0))
    }

    /// A gradient has the rounding of w_D's dependence on J and M in it, besides that of J and M.
    pub(super) fn gradient(
        &self,
        found: (f64, Vector<N>),
        _: impl FnOnce() -> (f64, Vector<N>),
    ) -> Verdict {
        let (manipulability, gradient) = self.expected_gradient();
        let largest = gradient.amax().max(manipulability);
        let difference = found.1 - gradient;
        let slopes = (0..N).map(|i| relative(difference[i] * self.unit(i), largest));
        let (value, _) = self.manipulability(found.0, || manipulability);
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
        let (error, allowed) = self.gradient((value, slopes), || self.expected_gradient());
        // J's own error is small enough on its own account, or too large on any.
        let excess = if twists <= least { 0.0 } else { f64::INFINITY };
        (worse(error, excess), allowed)
    }

    pub(super) fn torques(
        &self,
        found: Vector<N>,
        expected: impl FnOnce() -> Vector<N>,
    ) -> Verdict {
        let State { qd, qdd, .. } = self.state;
        let sizes = self.scale.torque(qd, qdd) + self.friction();
        rounded::<N>(Scale::torques(&sizes, &(found - expected())))
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
        let sizes = self.scale.torque(qd, &found) + tau.abs() + self.friction();
        rounded::<N>(Scale::torques(&sizes, &(needed - tau)))
    }

    pub(super) fn torques_with_wrench(
        &self,
        found: Vector<N>,
        expected: impl FnOnce() -> Vector<N>,
    ) -> Verdict {
        let State { qd, qdd, .. } = self.state;
        let sizes = self.scale.torque(qd, qdd) + self.torques_of_wrench() + self.friction();
        rounded::<N>(Scale::torques(&sizes, &(found - expected())))
    }

    /// The error of the torques that the accelerations need.
    pub(super) fn accelerations_with_wrench(
        &self,
        found: Vector<N>,
        _: impl FnOnce() -> Vector<N>,
    ) -> Verdict {
        let State {
            q, qd, tau, wrench, ..
        } = self.state;
        let needed = self
            .reference
            .inverse_dynamics_with_wrench(q, qd, &found, wrench);
        let sizes =
            self.scale.torque(qd, &found) + tau.abs() + self.torques_of_wrench() + self.friction();
        rounded::<N>(Scale::torques(&sizes, &(needed - tau)))
    }

    /// What the terms of each joint's share in the wrench may amount to, N·m (N).
    fn torques_of_wrench(&self) -> Vector<N> {
        let wrench = self.state.wrench.abs();
        let force = wrench.fixed_rows::<3>(0).sum();
        let moment = wrench.fixed_rows::<3>(3).sum();
        Vector::from_fn(|joint, _| match self.chain.joints[joint].kind {
            JointKind::Revolute => moment + force * self.scale.length,
            JointKind::Prismatic => force,
        })
    }

    /// Friction's terms have one sign: each joint's error is relative to its friction.
    pub(super) fn frictions(
        &self,
        found: Vector<N>,
        expected: impl FnOnce() -> Vector<N>,
    ) -> Verdict {
        let expected = expected();
        rounded::<N>(Scale::torques(&expected.abs(), &(found - expected)))
    }

    fn friction(&self) -> Vector<N> {
        self.reference.friction_torque(&self.state.qd).abs()
    }

    /// Column by column, each by what the terms of its own sums can amount to: none in that of a joint at rest.
    pub(super) fn lock_impacts(
        &self,
        found: Square<N>,
        expected: impl FnOnce() -> Square<N>,
    ) -> Verdict {
        let difference = found - expected();
        let error = |k: usize| {
            let sizes = self.scale.impact(&self.state.qd, &self.state.qdd, k);
            Scale::torques(&sizes, &difference.column(k).into_owned())
        };
        rounded::<N>((0..N).map(error).fold(0.0, worse))
    }

    /// Of ∂τ/∂q and ∂τ/∂q̇.
    pub(super) fn torque_derivatives(
        &self,
        found: (Square<N>, Square<N>),
        expected: impl FnOnce() -> (Square<N>, Square<N>),
    ) -> Verdict {
        let State { qd, qdd, .. } = self.state;
        let expected = expected();
        let error = |j: usize| {
            let sizes = self.scale.torque_by_position(self.chain, j, qd, qdd);
            let by_position = (found.0.column(j) - expected.0.column(j)) * self.unit(j);
            let by_velocity = found.1.column(j) - expected.1.column(j);
            worse(
                Scale::torques(&sizes, &by_position),
                Scale::torques(&self.torque_by_velocity(j), &by_velocity),
            )
        };
        rounded::<N>((0..N).map(error).fold(0.0, worse))
    }

    /// What the terms of column j of ∂τ/∂q̇ may amount to.
    fn torque_by_velocity(&self, j: usize) -> Vector<N> {
        let qd = &self.state.qd;
        let mut sizes = self.scale.torque_by_velocity(qd);
        sizes[j] += self.chain.friction_slope(qd)[j];
        sizes
    }

    /// Of ∂q̈/∂q and ∂q̈/∂q̇ the error of the torques that they need, `M ∂q̈ + ∂τ`; of ∂q̈/∂τ that of M⁻¹.
    ///
    /// ∂τ/∂q is that of an acceleration which has the rounding of M⁻¹ in it: what the condition of M makes of that is counted with the sizes.
    pub(super) fn acceleration_derivatives(
        &self,
        found: (Square<N>, Square<N>, Square<N>),
        _: impl FnOnce() -> (Square<N>, Square<N>, Square<N>),
    ) -> Verdict {
        let State { q, qd, tau, .. } = self.state;
        let (by_position, by_velocity, by_torque) = found;
        let mass = self.reference.mass_matrix(q);
        let inverse = self.reference.inverse_mass_matrix(q);
        let qdd = self.reference.forward_dynamics(q, qd, tau);
        let slopes = self.reference.inverse_dynamics_derivatives(q, qd, &qdd);
        // What the acceleration may be off by, over the rounding of the torques that it is made of.
        let off = inverse.abs() * (self.scale.torque(qd, &qdd) + tau.abs());
        let error = |j: usize| {
            let unit = self.unit(j);
            let inertia = self.scale.inertia_beside(self.chain, j);
            let needs = |slope: &Vector<N>| inertia * inertia.dot(&slope.abs());
            let accelerated: Vector<N> = by_position.column(j) * unit;
            let sizes = self.scale.torque_by_position(self.chain, j, qd, &qdd)
                + needs(&accelerated)
                + needs(&off);
            let position = mass * accelerated + slopes.0.column(j) * unit;
            let accelerated: Vector<N> = by_velocity.column(j).into();
            let velocity = mass * accelerated + slopes.1.column(j);
            worse(
                Scale::torques(&sizes, &position),
                Scale::torques(
                    &(self.torque_by_velocity(j) + needs(&accelerated)),
                    &velocity,
                ),
            )
        };
        let (masses, allowed) = self.inverse_masses(by_torque, || inverse);
        ((0..N).map(error).fold(masses, worse), allowed)
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
        let tolerance = factor * rounding(N) * self.condition();
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
