//! No method returns NaN, at whatever finite coordinates.

use std::f64::consts::FRAC_PI_2;

use nalgebra::SVector;
use ulna::Arm;
use ulna::proof::State;

/// `state`, and its likes where arms are singular, sums of angles round, or coordinates are absurd.
pub(crate) fn special<const N: usize>(state: State<N>) -> Vec<State<N>> {
    let quarters = |i: usize| [0.0, 1.0, -1.0, 2.0][(state.q[i].to_bits() >> 20) as usize % 4];
    let huge = [1e6, 1e9, 1e300].map(|size| state.q.map(|x| x * size));
    let configurations = [
        state.q,
        SVector::zeros(),
        SVector::from_fn(|i, _| quarters(i) * FRAC_PI_2),
        SVector::repeat(FRAC_PI_2),
    ];
    let all = configurations.into_iter().chain(huge);
    all.map(|q| State { q, ..state }).collect()
}

/// Methods that have returned NaN.
#[derive(Default)]
struct Found(Vec<&'static str>);

impl Found {
    fn look<'n>(&mut self, method: &'static str, numbers: impl IntoIterator<Item = &'n f64>) {
        if numbers.into_iter().any(|x| x.is_nan()) {
            self.0.push(method);
        }
    }
}

/// The methods of `arm` that return NaN at `state`.
pub(crate) fn methods_with_nan<const N: usize>(
    arm: &impl Arm<N>,
    state: &State<N>,
) -> Vec<&'static str> {
    let State { q, qd, qdd, tau } = state;
    let mut found = Found::default();

    let pose = arm.forward_kinematics(q).to_homogeneous();
    found.look("forward_kinematics", &pose);
    found.look("geometric_jacobian", &arm.geometric_jacobian(q));
    let derivatives = arm.jacobian_derivatives(q);
    found.look("jacobian_derivatives", derivatives.iter().flatten());
    found.look("mass_matrix", &arm.mass_matrix(q));
    let derivatives = arm.mass_matrix_derivatives(q);
    found.look("mass_matrix_derivatives", derivatives.iter().flatten());
    found.look("dynamic_manipulability", [&arm.dynamic_manipulability(q)]);
    let (w, gradient) = arm.dynamic_manipulability_gradient(q);
    let numbers = gradient.iter().chain([&w]);
    found.look("dynamic_manipulability_gradient", numbers);
    found.look("inverse_dynamics", &arm.inverse_dynamics(q, qd, qdd));
    found.look("bias_force", &arm.bias_force(q, qd));
    found.look("gravity_torque", &arm.gravity_torque(q));
    found.look("forward_dynamics", &arm.forward_dynamics(q, qd, tau));
    let (mass_matrix, derivatives) = arm.mass_matrix_and_derivatives(q);
    let numbers = mass_matrix.iter().chain(derivatives.iter().flatten());
    found.look("mass_matrix_and_derivatives", numbers);
    let (jacobian, w, gradient) = arm.jacobian_and_gradient(q);
    let numbers = jacobian.iter().chain(&gradient).chain([&w]);
    found.look("jacobian_and_gradient", numbers);
    found.0
}
