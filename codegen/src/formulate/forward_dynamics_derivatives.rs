//! ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ from those of the inverse dynamics at the motion that the torques make:
//! `τ = ID(q, q̇, FD(q, q̇, τ))` differentiated gives −M⁻¹ ∂τ/∂q, −M⁻¹ ∂τ/∂q̇ and M⁻¹
//! (Carpentier and Mansard, Analytical Derivatives of Rigid Body Dynamics Algorithms, RSS 2018).
//!
//! Each column is solved for with M's factors: a product with M⁻¹, which is there anyway, takes as many operations and is less exact.

use super::chain::Chain;
use super::inverse_dynamics::unloaded;
use super::inverse_dynamics_derivatives::inverse_dynamics_derivatives;
use super::{Choices, Outputs, driving, factors};
use crate::graph::{Expr, Input};
use crate::schedule::Output;

/// The three of them.
pub(super) fn outputs<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let n = chain.joint_count();
    let driving = driving(chain, unloaded(chain));
    let factors = factors(chain, choices);
    let qdd = factors.solve(&driving);
    let qd = chain.inputs(Input::Qd);
    let torques = inverse_dynamics_derivatives(chain, &qd, &qdd, choices.meeting);
    let [by_position, by_velocity] = torques.map(|rows| {
        let column = |j: usize| {
            let driving: Vec<Expr<'g>> = rows.iter().map(|row| -row[j]).collect();
            factors.solve(&driving)
        };
        (0..n).flat_map(column).collect()
    });
    let shape = [n, n];
    vec![
        Output::new("by_position", &shape, by_position),
        Output::new("by_velocity", &shape, by_velocity),
        Output::new("by_torque", &shape, factors.inverse().concat()),
    ]
}
