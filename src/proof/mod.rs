//! Two backends side by side: [`compare`] runs every method of [`Arm`] on both at the same states.
//!
//! `ulna verify`, the tests and whoever generates an arm use it to show that an implementation does what
//! the textbook formulas of [`SerialChain`] do.

pub mod differences;
#[doc(hidden)]
pub mod random;
mod report;
mod scale;

use core::f64::consts::PI;

use nalgebra::{IsometryMatrix3, SMatrix, SVector};

pub use report::{Deviation, Report};
use scale::Scale;

use crate::{Arm, JointKind, SerialChain};
use random::SplitMix64;

/// A configuration of an arm, its motion, and its motors' torques.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<const N: usize> {
    /// Joint coordinates, rad (m).
    pub q: SVector<f64, N>,
    /// Their rates, rad/s (m/s).
    pub qd: SVector<f64, N>,
    /// Their accelerations, rad/s² (m/s²).
    pub qdd: SVector<f64, N>,
    /// Joint torques, N·m (N).
    pub tau: SVector<f64, N>,
}

/// Random states of `chain` without end, always the same ones: revolute joints in [−π, π] rad, prismatic ones in [−1, 1] m,
/// rates, accelerations and torques in [−1, 1].
///
/// The generator is `SplitMix64` from seed 0.
pub fn states<const N: usize>(chain: &SerialChain<N>) -> impl Iterator<Item = State<N>> + use<N> {
    let range = SVector::from_fn(|i, _| match chain.joints[i].kind {
        JointKind::Revolute => PI,
        JointKind::Prismatic => 1.0,
    });
    let mut random = SplitMix64::new(0);
    core::iter::repeat_with(move || {
        let mut vector = || SVector::<f64, N>::from_fn(|_, _| random.symmetric());
        State {
            q: vector().component_mul(&range),
            qd: vector(),
            qdd: vector(),
            tau: vector(),
        }
    })
}

/// Runs every method of [`Arm`] on an arm and on its textbook twin, at every one of `states`.
///
/// ```
/// # fn verify<const N: usize>(generated: &impl ulna::Arm<N>, chain: &ulna::SerialChain<N>) {
/// use ulna::proof;
/// let report = proof::compare(generated, chain, proof::states(chain).take(100));
/// assert!(report.passes(), "{report}");
/// # }
/// ```
pub fn compare<const N: usize>(
    candidate: &impl Arm<N>,
    chain: &SerialChain<N>,
    states: impl IntoIterator<Item = State<N>>,
) -> Report {
    compare_with(candidate, chain, chain, states)
}

/// [`compare`] with another reference; `chain` tells how large its quantities can be.
pub fn compare_with<const N: usize>(
    candidate: &impl Arm<N>,
    reference: &impl Arm<N>,
    chain: &SerialChain<N>,
    states: impl IntoIterator<Item = State<N>>,
) -> Report {
    let mut report = Report {
        states: 0,
        deviations: METHODS.map(Deviation::new),
    };
    for state in states {
        report.states += 1;
        let found = errors(candidate, reference, chain, &state);
        for (deviation, (error, tolerance)) in report.deviations.iter_mut().zip(found) {
            deviation.add(error, tolerance);
        }
    }
    report
}

/// The first-order condition number of w_D at `q`: its relative change, at worst, where every entry of J and M changes by ε of the
/// largest that its terms can be, is ε times this. 0 where w_D is 0.
pub fn condition<const N: usize>(
    reference: &impl Arm<N>,
    chain: &SerialChain<N>,
    q: &SVector<f64, N>,
) -> f64 {
    Scale::new(reference, chain, q).condition
}

/// Every method, in the trait's order.
const METHODS: [&str; 15] = [
    "task",
    "rated_torque",
    "forward_kinematics",
    "geometric_jacobian",
    "jacobian_derivatives",
    "mass_matrix",
    "mass_matrix_derivatives",
    "dynamic_manipulability",
    "dynamic_manipulability_gradient",
    "inverse_dynamics",
    "bias_force",
    "gravity_torque",
    "forward_dynamics",
    "mass_matrix_and_derivatives",
    "jacobian_and_gradient",
];

/// What rounding may leave of a quantity, relative to the size of its terms.
const fn rounding(joints: usize) -> f64 {
    8.0 * (joints + 4) as f64 * f64::EPSILON
}

/// The error of each method at `state`, and what is allowed, in the order of [`METHODS`].
fn errors<const N: usize>(
    candidate: &impl Arm<N>,
    reference: &impl Arm<N>,
    chain: &SerialChain<N>,
    state: &State<N>,
) -> [(f64, f64); 15] {
    let State { q, qd, qdd, tau } = state;
    let scale = Scale::new(reference, chain, q);
    let rest = SVector::zeros();
    let equal = |same: bool| (if same { 0.0 } else { f64::INFINITY }, 0.0);
    let rounded = |error: f64| (error, rounding(N));
    let torque = |qd, qdd, found: SVector<f64, N>, expected: SVector<f64, N>| {
        rounded(Scale::torques(&scale.torque(qd, qdd), &(found - expected)))
    };
    // Where the condition number leaves less than two digits, first-order theory says no more.
    let allowed = |tolerance: f64| {
        if tolerance > 1e-2 {
            f64::INFINITY
        } else {
            tolerance
        }
    };
    let conditioned = |error: f64| (error, allowed(rounding(N) * scale.condition));
    // A gradient has the rounding of w_D's dependence on J and M in it, besides that of J and M.
    let twice_conditioned = |error: f64| (error, allowed(4.0 * rounding(N) * scale.condition));
    let (w, gradient) = reference.dynamic_manipulability_gradient(q);
    let manipulability = |found: f64| relative(found - w, w);
    let slopes = |found: (f64, SVector<f64, N>)| {
        let largest = gradient.amax().max(w);
        let difference = found.1 - gradient;
        let entries = (0..N).map(|i| relative(difference[i] * scale.unit(chain, i), largest));
        entries.fold(manipulability(found.0), worse)
    };
    let jacobian = reference.geometric_jacobian(q);
    let twists = |found: SMatrix<f64, 6, N>| scale.twists(&(found - jacobian));
    let mass = reference.mass_matrix(q);
    let masses = |found: SMatrix<f64, N, N>| Scale::masses(&scale.inertia, &(found - mass));
    let mass_derivatives = reference.mass_matrix_derivatives(q);
    let masses_change = |found: &[SMatrix<f64, N, N>; N]| {
        let each = (0..N).map(|i| {
            let sizes = match chain.joints[i].kind {
                JointKind::Revolute => &scale.inertia,
                JointKind::Prismatic => &scale.inertia_ahead,
            };
            let change = (found[i] - mass_derivatives[i]) * scale.unit(chain, i);
            Scale::masses(sizes, &change)
        });
        each.fold(0.0, worse)
    };
    let twists_change = {
        let (found, expected) = (
            candidate.jacobian_derivatives(q),
            reference.jacobian_derivatives(q),
        );
        let each = (0..N).map(|i| scale.twists(&(found[i] - expected[i])) * scale.unit(chain, i));
        each.fold(0.0, worse)
    };
    let both = candidate.mass_matrix_and_derivatives(q);
    let (beside, w_beside, gradient_beside) = candidate.jacobian_and_gradient(q);
    [
        equal(candidate.task() == reference.task()),
        equal(candidate.rated_torque() == reference.rated_torque()),
        rounded(pose_error(
            &candidate.forward_kinematics(q),
            &reference.forward_kinematics(q),
            scale.position,
        )),
        rounded(twists(candidate.geometric_jacobian(q))),
        rounded(twists_change),
        rounded(masses(candidate.mass_matrix(q))),
        rounded(masses_change(&candidate.mass_matrix_derivatives(q))),
        conditioned(manipulability(candidate.dynamic_manipulability(q))),
        twice_conditioned(slopes(candidate.dynamic_manipulability_gradient(q))),
        torque(
            qd,
            qdd,
            candidate.inverse_dynamics(q, qd, qdd),
            reference.inverse_dynamics(q, qd, qdd),
        ),
        torque(
            qd,
            &rest,
            candidate.bias_force(q, qd),
            reference.bias_force(q, qd),
        ),
        torque(
            &rest,
            &rest,
            candidate.gravity_torque(q),
            reference.gravity_torque(q),
        ),
        {
            let found = candidate.forward_dynamics(q, qd, tau);
            let needed = reference.inverse_dynamics(q, qd, &found);
            let sizes = scale.torque(qd, &found) + tau.abs();
            rounded(Scale::torques(&sizes, &(needed - tau)))
        },
        rounded(worse(masses(both.0), masses_change(&both.1))),
        {
            let (jacobian, gradient) = (twists(beside), slopes((w_beside, gradient_beside)));
            let (_, allowed) = twice_conditioned(gradient);
            // J's own error is small enough on its own account, or too large on any.
            let excess = if jacobian <= rounding(N) {
                0.0
            } else {
                f64::INFINITY
            };
            (worse(gradient, excess), allowed)
        },
    ]
}

/// The larger error of a rotation's entry and of a position, relative to `size`.
fn pose_error(found: &IsometryMatrix3<f64>, expected: &IsometryMatrix3<f64>, size: f64) -> f64 {
    let turned = found.rotation.matrix() - expected.rotation.matrix();
    let moved = found.translation.vector - expected.translation.vector;
    let turned = turned.iter().map(|x| x.abs());
    let moved = moved.iter().map(|x| x.abs() / size);
    turned.chain(moved).fold(0.0, worse)
}

/// `difference` relative to `size`; 0 if there is no difference, whatever the size.
fn relative(difference: f64, size: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else {
        difference.abs() / size.abs()
    }
}

/// The larger one, or NaN if one of them is: `f64::max` would lose it.
fn worse(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}
