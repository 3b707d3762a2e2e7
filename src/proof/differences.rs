//! An arm's derivatives against central differences of its own J, M and w_D.

use nalgebra::SVector;

use super::scale::Scale;
use super::{Report, State, relative, rounding, worse};
use crate::{Arm, Method, SerialChain};

/// Step, in rad or in lengths of the chain: the truncation of the difference and the rounding of what it is taken of are about alike.
const STEP: f64 = 1e-5;
/// What the step leaves of a smooth function's difference.
const TRUNCATION: f64 = 1e-8;
/// Distance of a singular pose, in steps, within which ∇w_D is not compared: w_D has a kink there, which a difference averages over.
const KINK: f64 = 1e3;

/// The errors of ∂J/∂q_i, ∂M/∂q_i and ∇w_D at `states`, each at the state where it comes nearest to what is allowed:
/// 1e-8, and what the differences themselves are unsure of. That is the rounding of what they are taken of,
/// over the step, and twice what they change by when the step is doubled. Beside a singular pose ∇w_D is left out.
pub fn compare<const N: usize>(
    arm: &dyn Arm<N>,
    chain: &SerialChain<N>,
    states: impl IntoIterator<Item = State<N>>,
) -> Report {
    let mut report = Report::new(&[
        Method::JacobianDerivatives.name(),
        Method::MassMatrixDerivatives.name(),
        Method::DynamicManipulabilityGradient.name(),
    ]);
    for State { q, .. } in states {
        report.add(&errors(arm, chain, &q));
    }
    report
}

fn errors<const N: usize>(
    arm: &dyn Arm<N>,
    chain: &SerialChain<N>,
    q: &SVector<f64, N>,
) -> [(f64, f64); 3] {
    let scale = Scale::new(arm, chain, q);
    let jacobian_derivatives = arm.jacobian_derivatives(q);
    let mass_derivatives = arm.mass_matrix_derivatives(q);
    let (manipulability, gradient) = arm.dynamic_manipulability_gradient(q);
    let size = gradient.amax().max(manipulability);
    let steepest = (0..N).fold(0.0, |steepest, i| {
        worse(steepest, (gradient[i] * scale.unit(chain, i)).abs())
    });
    let smooth = manipulability > KINK * STEP * steepest;
    let (mut jacobian, mut mass, mut slope) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    for i in 0..N {
        let unit = scale.unit(chain, i);
        let sizes = &scale.inertia_ahead;
        let at = |steps: f64| {
            let mut shifted = *q;
            shifted[i] += steps * STEP * unit;
            shifted
        };
        let [ahead, behind, far_ahead, far_behind] = [1.0, -1.0, 2.0, -2.0].map(at);
        let width = (ahead[i] - behind[i]) / unit;
        let far_width = (far_ahead[i] - far_behind[i]) / unit;

        let near = (arm.geometric_jacobian(&ahead) - arm.geometric_jacobian(&behind)) / width;
        let far =
            (arm.geometric_jacobian(&far_ahead) - arm.geometric_jacobian(&far_behind)) / far_width;
        add(
            &mut jacobian,
            scale.twists(&(jacobian_derivatives[i] * unit - near)),
            scale.twists(&(far - near)),
        );
        let near = (arm.mass_matrix(&ahead) - arm.mass_matrix(&behind)) / width;
        let far = (arm.mass_matrix(&far_ahead) - arm.mass_matrix(&far_behind)) / far_width;
        add(
            &mut mass,
            Scale::masses(sizes, &(mass_derivatives[i] * unit - near)),
            Scale::masses(sizes, &(far - near)),
        );
        if smooth {
            let [ahead, behind, far_ahead, far_behind] =
                [ahead, behind, far_ahead, far_behind].map(|q| arm.dynamic_manipulability(&q));
            let (near, far) = (
                (ahead - behind) / width,
                (far_ahead - far_behind) / far_width,
            );
            add(
                &mut slope,
                relative(gradient[i] * unit - near, size),
                relative(far - near, size),
            );
        }
    }
    let rounded = rounding(N) / STEP;
    let allowed =
        |[error, unsure]: [f64; 2], rounded: f64| (error, TRUNCATION + 2.0 * unsure + rounded);
    [
        allowed(jacobian, rounded),
        allowed(mass, rounded),
        allowed(slope, rounded * scale.condition),
    ]
}

/// Keeps the larger error, and the larger change with the step.
fn add(largest: &mut [f64; 2], error: f64, change: f64) {
    largest[0] = worse(largest[0], error);
    largest[1] = worse(largest[1], change);
}
