//! Two backends side by side: [`compare`] runs every method of [`Arm`] on both at the same states.
//!
//! `ulna verify`, the tests and whoever generates an arm use it to show that an implementation does what
//! the textbook formulas of [`SerialChain`] do.

pub mod differences;

use core::f64::consts::PI;
use core::fmt;

use nalgebra::{IsometryMatrix3, SMatrix, SVector};

use crate::random::SplitMix64;
use crate::{Arm, JointKind, SerialChain};

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

/// How far a method of the candidate is from the reference's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The method of [`Arm`].
    pub method: &'static str,
    /// The largest relative error over the states: the largest difference of two entries, divided by the reference's
    /// largest entry at that state. What can vanish while its terms do not is measured beside a quantity that does not:
    /// ∇w_D beside w_D, dJ beside J, dM beside M, bias force and gravity torque beside the inverse dynamics.
    pub error: f64,
    /// What rounding alone may leave when the reference is a [`SerialChain`], at states like those of [`states`].
    ///
    /// Forward dynamics and w_D have M⁻¹ and J's inverse in them: rounding grows by those condition numbers.
    pub tolerance: f64,
}

impl Deviation {
    /// Whether the error is within the tolerance; a NaN is not.
    pub fn passes(&self) -> bool {
        self.error <= self.tolerance
    }
}

/// The outcome of [`compare`]: a line for each method of [`Arm`]. Prints as a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// How many states were compared.
    pub states: usize,
    /// One for each method, in the trait's order.
    pub deviations: [Deviation; 15],
}

impl Report {
    /// Whether every method is within its tolerance, at one state at least.
    pub fn passes(&self) -> bool {
        self.states > 0 && self.deviations.iter().all(Deviation::passes)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let states = self.states;
        writeln!(
            f,
            "{:34} {:>9}  {:>9}   ({states} states)",
            "method", "error", "allowed"
        )?;
        for deviation in &self.deviations {
            let Deviation {
                method,
                error,
                tolerance,
            } = deviation;
            let verdict = if deviation.passes() { "ok" } else { "WRONG" };
            writeln!(f, "{method:34} {error:9.1e}  {tolerance:9.0e}   {verdict}")?;
        }
        Ok(())
    }
}

/// Runs every method of [`Arm`] on both at every one of `states`.
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
    reference: &impl Arm<N>,
    states: impl IntoIterator<Item = State<N>>,
) -> Report {
    let mut report = Report {
        states: 0,
        deviations: METHODS.map(|(method, tolerance)| Deviation {
            method,
            error: 0.0,
            tolerance,
        }),
    };
    for state in states {
        report.states += 1;
        let errors = errors(candidate, reference, &state);
        for (deviation, error) in report.deviations.iter_mut().zip(errors) {
            deviation.error = worse(deviation.error, error);
        }
    }
    report
}

/// Every method and what rounding may leave of it.
const METHODS: [(&str, f64); 15] = [
    ("task", 0.0),
    ("rated_torque", 0.0),
    ("forward_kinematics", 1e-13),
    ("geometric_jacobian", 1e-13),
    ("jacobian_derivatives", 1e-13),
    ("mass_matrix", 1e-13),
    ("mass_matrix_derivatives", 1e-13),
    ("dynamic_manipulability", 1e-9),
    ("dynamic_manipulability_gradient", 1e-9),
    ("inverse_dynamics", 1e-12),
    ("bias_force", 1e-12),
    ("gravity_torque", 1e-12),
    ("forward_dynamics", 1e-10),
    ("mass_matrix_and_derivatives", 1e-13),
    ("jacobian_and_gradient", 1e-9),
];

/// The relative error of each method at `state`, in the order of [`METHODS`].
fn errors<const N: usize>(
    candidate: &impl Arm<N>,
    reference: &impl Arm<N>,
    state: &State<N>,
) -> [f64; 15] {
    let State { q, qd, qdd, tau } = state;
    macro_rules! both {
        ($method:ident($($argument:expr),*)) => {
            candidate.$method($($argument),*).error(&reference.$method($($argument),*))
        };
    }
    macro_rules! beside {
        ($scale:expr, $method:ident($($argument:expr),*)) => {
            ($scale, candidate.$method($($argument),*)).error(&($scale, reference.$method($($argument),*)))
        };
    }
    let jacobian = reference.geometric_jacobian(q);
    let mass = reference.mass_matrix(q);
    let torque = reference.inverse_dynamics(q, qd, qdd);
    let equal = |same: bool| if same { 0.0 } else { f64::INFINITY };
    [
        equal(candidate.task() == reference.task()),
        equal(candidate.rated_torque() == reference.rated_torque()),
        both!(forward_kinematics(q)),
        both!(geometric_jacobian(q)),
        beside!(jacobian, jacobian_derivatives(q)),
        both!(mass_matrix(q)),
        beside!(mass, mass_matrix_derivatives(q)),
        both!(dynamic_manipulability(q)),
        both!(dynamic_manipulability_gradient(q)),
        both!(inverse_dynamics(q, qd, qdd)),
        beside!(torque, bias_force(q, qd)),
        beside!(torque, gravity_torque(q)),
        both!(forward_dynamics(q, qd, tau)),
        both!(mass_matrix_and_derivatives(q)),
        both!(jacobian_and_gradient(q)),
    ]
}

/// What a method of [`Arm`] returns.
trait Quantity {
    /// The relative error against `reference`.
    fn error(&self, reference: &Self) -> f64;
}

impl Quantity for f64 {
    fn error(&self, reference: &Self) -> f64 {
        relative([(*self, *reference)])
    }
}

impl<const R: usize, const C: usize> Quantity for SMatrix<f64, R, C> {
    fn error(&self, reference: &Self) -> f64 {
        relative(pairs(self, reference))
    }
}

/// A vector beside one of the same kind.
impl<const R: usize, const C: usize> Quantity for (SMatrix<f64, R, C>, SMatrix<f64, R, C>) {
    fn error(&self, reference: &Self) -> f64 {
        relative(pairs(&self.0, &reference.0).chain(pairs(&self.1, &reference.1)))
    }
}

/// A matrix and its derivatives.
impl<const R: usize, const C: usize, const K: usize> Quantity
    for (SMatrix<f64, R, C>, [SMatrix<f64, R, C>; K])
{
    fn error(&self, reference: &Self) -> f64 {
        let derivatives = self.1.iter().zip(&reference.1);
        let derivatives = derivatives.flat_map(|(a, b)| pairs(a, b));
        relative(pairs(&self.0, &reference.0).chain(derivatives))
    }
}

impl Quantity for IsometryMatrix3<f64> {
    fn error(&self, reference: &Self) -> f64 {
        self.to_homogeneous().error(&reference.to_homogeneous())
    }
}

/// w_D and ∇w_D.
impl<const N: usize> Quantity for (f64, SVector<f64, N>) {
    fn error(&self, reference: &Self) -> f64 {
        relative(pairs(&self.1, &reference.1).chain([(self.0, reference.0)]))
    }
}

/// J, w_D and ∇w_D.
impl<const N: usize> Quantity for (SMatrix<f64, 6, N>, f64, SVector<f64, N>) {
    fn error(&self, reference: &Self) -> f64 {
        let gradient = (self.1, self.2).error(&(reference.1, reference.2));
        worse(self.0.error(&reference.0), gradient)
    }
}

fn pairs<'a, const R: usize, const C: usize>(
    a: &'a SMatrix<f64, R, C>,
    b: &'a SMatrix<f64, R, C>,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    a.iter().copied().zip(b.iter().copied())
}

/// The largest difference of a pair, divided by the largest second of a pair; the difference itself where all those are 0.
fn relative(pairs: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let (difference, scale) = pairs
        .into_iter()
        .fold((0.0, 0.0), |(difference, scale), (a, b)| {
            (worse(difference, (a - b).abs()), worse(scale, b.abs()))
        });
    if scale == 0.0 {
        difference
    } else {
        difference / scale
    }
}

/// The larger one, or NaN if one of them is: `f64::max` would lose it.
fn worse(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}
