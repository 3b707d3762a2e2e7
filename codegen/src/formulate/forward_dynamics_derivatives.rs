//! ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ from those of the inverse dynamics at the motion that the torques make:
//! `τ = ID(q, q̇, FD(q, q̇, τ))` differentiated gives −M⁻¹ ∂τ/∂q, −M⁻¹ ∂τ/∂q̇ and M⁻¹
//! (Carpentier and Mansard, Analytical Derivatives of Rigid Body Dynamics Algorithms, RSS 2018).
//!
//! The motion needs no inverse dynamics of its own. What velocities do to τ is homogeneous in them, of the second degree, so that by Euler's
//! theorem it is ½ (∂τ/∂q̇) q̇, and no acceleration is in that; what gravity does is the moment of composite bodies. That took a seventh
//! of the operations of oblique_6 away; an arm of two joints is shorter without.
//!
//! Each column is solved for with M's factors: a product with M⁻¹, which is there anyway, takes 0.98 to 1.11 times the operations, and where
//! a light link carries a heavy one (M's condition 2e9) the torques of its accelerations are off by 3e-12 and not by 2e-14.

use ulna::JointKind;

use super::chain::Chain;
use super::friction::with_friction;
use super::inverse_dynamics::{outward, unloaded};
use super::inverse_dynamics_derivatives::{frictionless, inverse_dynamics_derivatives};
use super::mass_matrix::stations;
use super::outputs::{named, zeros};
use super::{Choices, Outputs, driving, factors};
use crate::graph::{Expr, Input};
use crate::schedule::Output;

/// The three of them.
pub(super) fn outputs<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let n = chain.joint_count();
    let factors = factors(chain, choices);
    let qd = chain.inputs(Input::Qd);
    let driving = if choices.by_slopes {
        driving_by_slopes(chain, &qd, choices.meeting)
    } else {
        driving(chain, unloaded(chain))
    };
    let qdd = named(factors.solve(&driving), "qdd");
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

/// What of the torques accelerates.
fn driving_by_slopes<'g>(chain: &Chain<'g>, qd: &[Expr<'g>], meeting: usize) -> Vec<Expr<'g>> {
    let [_, by_velocity] = frictionless(chain, qd, &zeros(chain), meeting);
    let half: Vec<Expr<'g>> = qd.iter().map(|rate| rate.of(0.5) * *rate).collect();
    let rows = by_velocity.iter().zip(gravity(chain));
    let bias = rows.map(|(row, gravity)| {
        let pairs = row.iter().zip(&half);
        pairs.fold(gravity, |sum, (slope, rate)| sum + *slope * *rate)
    });
    let bias = named(with_friction(chain, qd, bias.collect()), "bias");
    let pairs = chain.inputs(Input::Tau).into_iter().zip(bias);
    named(pairs.map(|(tau, bias)| tau - bias).collect(), "net")
}

/// What gravity takes of each joint's torque.
fn gravity<'g>(chain: &Chain<'g>) -> Vec<Expr<'g>> {
    let at_rest = outward(chain, &zeros(chain), &zeros(chain));
    let joints = chain.joints.iter().zip(stations(chain)).zip(at_rest);
    joints
        .map(|((joint, station), motion)| match joint.kind {
            JointKind::Revolute => {
                let moment = station.composite.moment.cross(motion.acceleration);
                moment.0[2]
            }
            JointKind::Prismatic => station.composite.mass * motion.acceleration.0[2],
        })
        .collect()
}
