//! What is solved for with M's factors: the accelerations that torques make, and M⁻¹.

use super::chain::Chain;
use super::factorization::{Factors, factor};
use super::friction::with_friction;
use super::inverse_dynamics::{Wrench, inverse_dynamics_with_load};
use super::mass_matrix::mass_matrix;
use super::outputs::{named, zeros};
use super::{Choices, Outputs, articulated};
use crate::graph::{Expr, Input};
use crate::schedule::Output;

/// q̈, the last link bearing `load`.
pub(super) fn outputs<'g>(chain: &Chain<'g>, load: Wrench<'g>) -> Outputs<'g> {
    let driving = driving(chain, load);
    let accelerations = factor(&mass_matrix(chain)).solve(&driving);
    let accelerations = named(accelerations, "qdd");
    let shape = [chain.joint_count()];
    vec![Output::new("acceleration", &shape, accelerations)]
}

/// M⁻¹, full and symmetric.
pub(super) fn inverse_mass_matrix<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let n = chain.joint_count();
    let inverse = factors(chain, choices).inverse();
    vec![Output::new("inverse", &[n, n], inverse.concat())]
}

/// M's factors, from M or, where that would lose a light link, from articulated bodies.
pub(super) fn factors<'g>(chain: &Chain<'g>, choices: Choices) -> Factors<'g> {
    if choices.articulated {
        articulated::factors(chain)
    } else {
        factor(&mass_matrix(chain))
    }
}

/// What of the torques accelerates: τ − c − g − f, and what the last link bears.
pub(super) fn driving<'g>(chain: &Chain<'g>, load: Wrench<'g>) -> Vec<Expr<'g>> {
    let qd = chain.inputs(Input::Qd);
    let bias = inverse_dynamics_with_load(chain, &qd, &zeros(chain), load);
    let bias = named(with_friction(chain, &qd, bias), "bias");
    let pairs = chain.inputs(Input::Tau).into_iter().zip(bias);
    named(pairs.map(|(tau, bias)| tau - bias).collect(), "net")
}
