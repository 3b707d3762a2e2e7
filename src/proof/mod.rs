//! Two backends side by side: [`compare`] runs every method of [`Arm`] on both at the same states.
//!
//! `ulna verify`, the tests and whoever generates an arm use it to show that an implementation does what
//! the textbook formulas of [`SerialChain`] do.

pub(crate) mod calls;
pub mod differences;
mod judge;
#[doc(hidden)]
pub mod random;
mod report;
mod scale;

use core::f64::consts::PI;

use nalgebra::{SVector, Vector6};

use judge::Judge;
pub use report::{Deviation, Report};
use scale::Scale;

use crate::{Arm, JointKind, Method, MethodSet, Payload, SerialChain};
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
    /// Wrench `[f; n]` on the tool, N and N·m, world axes.
    pub wrench: Vector6<f64>,
}

/// Random states of `chain` without end, always the same ones: revolute joints in [−π, π] rad, prismatic ones in [−1, 1] m,
/// rates, accelerations, torques and wrenches in [−1, 1].
///
/// The generator is `SplitMix64` from seed 0.
pub fn states<const N: usize>(chain: &SerialChain<N>) -> impl Iterator<Item = State<N>> + use<N> {
    let range = SVector::from_fn(|i, _| match chain.joints[i].kind {
        JointKind::Revolute => PI,
        JointKind::Prismatic => 1.0,
    });
    let mut random = SplitMix64::new(0);
    let mut random_wrench = SplitMix64::new(2);
    core::iter::repeat_with(move || {
        let mut vector = || SVector::<f64, N>::from_fn(|_, _| random.symmetric());
        State {
            q: vector().component_mul(&range),
            qd: vector(),
            qdd: vector(),
            tau: vector(),
            wrench: Vector6::from_fn(|_, _| random_wrench.symmetric()),
        }
    })
}

/// A payload to prove an arm with: without any symmetry, as heavy as the last link of `chain`.
pub fn payload<const N: usize>(chain: &SerialChain<N>) -> Payload {
    Payload::example(chain)
}

/// At rest, all coordinates and torques 0.
impl<const N: usize> Default for State<N> {
    fn default() -> Self {
        let zero = SVector::zeros();
        Self {
            q: zero,
            qd: zero,
            qdd: zero,
            tau: zero,
            wrench: Vector6::zeros(),
        }
    }
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
    candidate: &dyn Arm<N>,
    chain: &SerialChain<N>,
    states: impl IntoIterator<Item = State<N>>,
) -> Report {
    compare_with(candidate, chain, chain, states)
}

macro_rules! define_comparison {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        { kernel $($kernel:tt)+ }
        { batch $($batch:tt)+ }
        { error $rule:ident }
        $({ $($rest:tt)* })*
    )+) => {
        /// [`compare`] with another reference; `chain` tells how large its quantities can be.
        pub fn compare_with<const N: usize>(
            candidate: &dyn Arm<N>,
            reference: &dyn Arm<N>,
            chain: &SerialChain<N>,
            states: impl IntoIterator<Item = State<N>>,
        ) -> Report {
            compare_methods(MethodSet::ALL, candidate, reference, chain, states)
        }

        /// [`compare_with`] of some methods alone: no other one of the candidate is called, and of the reference
        /// what tells how large their errors may be.
        pub fn compare_methods<const N: usize>(
            methods: MethodSet,
            candidate: &dyn Arm<N>,
            reference: &dyn Arm<N>,
            chain: &SerialChain<N>,
            states: impl IntoIterator<Item = State<N>>,
        ) -> Report {
            compare_at(methods, candidate, reference, chain, &mut states.into_iter())
        }

        /// Compiled once for each number of joints, whatever the arms.
        fn compare_at<const N: usize>(
            methods: MethodSet,
            candidate: &dyn Arm<N>,
            reference: &dyn Arm<N>,
            chain: &SerialChain<N>,
            states: &mut dyn Iterator<Item = State<N>>,
        ) -> Report {
            let mut report = Report::new(&["task", "rated_torque", $(stringify!($method)),+]);
            let equal = |same: bool| (if same { 0.0 } else { f64::INFINITY }, 0.0);
            for state in states {
                let judge = Judge::new(reference, chain, &state);
                report.add(&[
                    equal(candidate.task() == reference.task()),
                    equal(candidate.rated_torque() == reference.rated_torque()),
                    $(
                        if methods.contains(Method::$variant) {
                            judge.$rule(
                                candidate.$method($(&state.$argument),+),
                                || reference.$method($(&state.$argument),+),
                            )
                        } else {
                            NOT_COMPARED
                        },
                    )+
                ]);
            }
            report.of(methods)
        }
    };
}

/// In the place of a method's error and of what is allowed.
const NOT_COMPARED: (f64, f64) = (0.0, 0.0);

crate::methods! { [N] define_comparison {} }

/// The first-order condition number of w_D at `q`: its relative change, at worst, where every entry of J and M changes by ε of the
/// largest that its terms can be, is ε times this. 0 where w_D is 0.
pub fn condition<const N: usize>(
    reference: &dyn Arm<N>,
    chain: &SerialChain<N>,
    q: &SVector<f64, N>,
) -> f64 {
    Scale::new(chain, q).condition(reference, q)
}

/// What rounding may leave of a quantity, relative to the size of its terms.
const fn rounding(joints: usize) -> f64 {
    8.0 * (joints + 4) as f64 * f64::EPSILON
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
