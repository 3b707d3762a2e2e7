//! An arm's derivatives against central differences of its own J, M and w_D.

use nalgebra::SVector;

use super::scale::Scale;
use super::{NOT_COMPARED, Report, State, relative, rounding, worse};
use crate::{Arm, Method, MethodSet, SerialChain};

/// Step, in rad or in lengths of the chain: the truncation of the difference and the rounding of what it is taken of are about alike.
const STEP: f64 = 1e-5;
/// What the step leaves of a smooth function's difference.
const TRUNCATION: f64 = 1e-8;
/// Distance of a singular pose, in steps, within which ∇w_D is not compared: w_D has a kink there, which a difference averages over.
const KINK: f64 = 1e3;

/// What is compared with differences.
const COMPARED: [Method; 3] = [
    Method::JacobianDerivatives,
    Method::MassMatrixDerivatives,
    Method::DynamicManipulabilityGradient,
];

/// The errors of ∂J/∂q_i, ∂M/∂q_i and ∇w_D at `states`, each at the state where it comes nearest to what is allowed:
/// 1e-8, and what the differences themselves are unsure of. That is the rounding of what they are taken of,
/// over the step, and twice what they change by when the step is doubled. Beside a singular pose ∇w_D is left out.
pub fn compare<const N: usize>(
    arm: &dyn Arm<N>,
    chain: &SerialChain<N>,
    states: impl IntoIterator<Item = State<N>>,
) -> Report {
    compare_methods(MethodSet::ALL, arm, chain, states)
}

/// [`compare`] of those of the three that are among `methods`.
pub fn compare_methods<const N: usize>(
    methods: MethodSet,
    arm: &dyn Arm<N>,
    chain: &SerialChain<N>,
    states: impl IntoIterator<Item = State<N>>,
) -> Report {
    let mut report = Report::new(&COMPARED.map(Method::name));
    for State { q, .. } in states {
        report.add(&errors(methods, arm, chain, &q));
    }
    report.of(methods)
}

/// What errors they have, in the order of [`COMPARED`]; of those outside `methods` none.
fn errors<const N: usize>(
    methods: MethodSet,
    arm: &dyn Arm<N>,
    chain: &SerialChain<N>,
    q: &SVector<f64, N>,
) -> [(f64, f64); 3] {
    let differences = Differences {
        arm,
        chain,
        q,
        scale: Scale::new(chain, q),
    };
    COMPARED.map(|method| match method {
        _ if !methods.contains(method) => NOT_COMPARED,
        Method::JacobianDerivatives => differences.of_jacobian(),
        Method::MassMatrixDerivatives => differences.of_mass_matrix(),
        _ => differences.of_manipulability(),
    })
}

/// An arm at a configuration.
struct Differences<'a, const N: usize> {
    arm: &'a dyn Arm<N>,
    chain: &'a SerialChain<N>,
    q: &'a SVector<f64, N>,
    scale: Scale<N>,
}

/// Where a difference by a joint is taken: over one step to each side and over two, and how wide each is.
struct Stencil<const N: usize> {
    near: [SVector<f64, N>; 2],
    far: [SVector<f64, N>; 2],
    width: f64,
    far_width: f64,
}

/// The largest error, and the largest change with the step.
#[derive(Clone, Copy, Default)]
struct Largest {
    error: f64,
    change: f64,
}

impl Largest {
    fn add(&mut self, error: f64, change: f64) {
        self.error = worse(self.error, error);
        self.change = worse(self.change, change);
    }

    /// With what is allowed, where rounding leaves `rounded` of a difference.
    fn allowed(self, rounded: f64) -> (f64, f64) {
        (self.error, TRUNCATION + 2.0 * self.change + rounded)
    }
}

impl<const N: usize> Differences<'_, N> {
    /// By joint `i`.
    fn stencil(&self, i: usize) -> Stencil<N> {
        let unit = self.scale.unit(self.chain, i);
        let at = |steps: f64| {
            let mut shifted = *self.q;
            shifted[i] += steps * STEP * unit;
            shifted
        };
        let width = |[ahead, behind]: &[SVector<f64, N>; 2]| (ahead[i] - behind[i]) / unit;
        let (near, far) = ([1.0, -1.0].map(at), [2.0, -2.0].map(at));
        Stencil {
            width: width(&near),
            far_width: width(&far),
            near,
            far,
        }
    }

    fn of_jacobian(&self) -> (f64, f64) {
        let derivatives = self.arm.jacobian_derivatives(self.q);
        let difference = |[ahead, behind]: &[SVector<f64, N>; 2], width| {
            (self.arm.geometric_jacobian(ahead) - self.arm.geometric_jacobian(behind)) / width
        };
        let mut largest = Largest::default();
        for (i, derivative) in derivatives.iter().enumerate() {
            let stencil = self.stencil(i);
            let near = difference(&stencil.near, stencil.width);
            let far = difference(&stencil.far, stencil.far_width);
            largest.add(
                self.scale
                    .twists(&(derivative * self.scale.unit(self.chain, i) - near)),
                self.scale.twists(&(far - near)),
            );
        }
        largest.allowed(rounding(N) / STEP)
    }

    fn of_mass_matrix(&self) -> (f64, f64) {
        let derivatives = self.arm.mass_matrix_derivatives(self.q);
        let difference = |[ahead, behind]: &[SVector<f64, N>; 2], width| {
            (self.arm.mass_matrix(ahead) - self.arm.mass_matrix(behind)) / width
        };
        let sizes = &self.scale.inertia_ahead;
        let mut largest = Largest::default();
        for (i, derivative) in derivatives.iter().enumerate() {
            let stencil = self.stencil(i);
            let near = difference(&stencil.near, stencil.width);
            let far = difference(&stencil.far, stencil.far_width);
            let unit = self.scale.unit(self.chain, i);
            largest.add(
                Scale::masses(sizes, &(derivative * unit - near)),
                Scale::masses(sizes, &(far - near)),
            );
        }
        largest.allowed(rounding(N) / STEP)
    }

    /// Beside a singular pose ∇w_D is not compared.
    fn of_manipulability(&self) -> (f64, f64) {
        let (manipulability, gradient) = self.arm.dynamic_manipulability_gradient(self.q);
        let size = gradient.amax().max(manipulability);
        let unit = |i: usize| self.scale.unit(self.chain, i);
        let steepest = (0..N).fold(0.0, |steepest, i| {
            worse(steepest, (gradient[i] * unit(i)).abs())
        });
        let mut largest = Largest::default();
        if manipulability > KINK * STEP * steepest {
            for i in 0..N {
                let stencil = self.stencil(i);
                let difference = |[ahead, behind]: [SVector<f64, N>; 2], width| {
                    let at = |q: &SVector<f64, N>| self.arm.dynamic_manipulability(q);
                    (at(&ahead) - at(&behind)) / width
                };
                let near = difference(stencil.near, stencil.width);
                let far = difference(stencil.far, stencil.far_width);
                largest.add(
                    relative(gradient[i] * unit(i) - near, size),
                    relative(far - near, size),
                );
            }
        }
        let condition = self.scale.condition(self.arm, self.q);
        largest.allowed(rounding(N) / STEP * condition)
    }
}
