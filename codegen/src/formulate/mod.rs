//! Formulas: from a model to the named results of every method of [`ulna::Arm`], as expressions on a graph.
//!
//! Written for few operations, from other formulas than the generic path where those are cheaper. Where several ways
//! lead to the same values, each is a candidate, and the driver keeps the one that comes out cheapest for the arm at hand.

pub(crate) mod articulated;
pub(crate) mod body;
pub(crate) mod centroid;
pub(crate) mod chain;
mod choices;
pub(crate) mod coriolis;
pub(crate) mod energy;
pub(crate) mod factorization;
mod forward_dynamics;
pub(crate) mod forward_dynamics_derivatives;
pub(crate) mod friction;
pub(crate) mod inverse_dynamics;
pub(crate) mod inverse_dynamics_derivatives;
pub(crate) mod kinematic_manipulability;
pub(crate) mod kinematics;
pub(crate) mod legend;
pub(crate) mod links;
pub(crate) mod lock_impacts;
pub(crate) mod manipulability;
pub(crate) mod mass_matrix;
pub(crate) mod mass_matrix_derivatives;
mod matrix;
mod origins;
mod outputs;
pub(crate) mod rates;
pub(crate) mod regressor;
pub(crate) mod task;
pub(crate) mod task_space;
pub(crate) mod vector;
mod velocity_products;

use ulna::Method;

use self::chain::Chain;
pub use self::choices::Choices;
pub(crate) use self::choices::{Chosen, IN_ORDER, depends_on};
use self::forward_dynamics::{driving, factors};
use self::inverse_dynamics::{load_of_wrench, unloaded};
use self::regressor::Columns;
use crate::graph::Expr;
use crate::schedule::Output;

/// Results of one method.
pub(crate) type Outputs<'g> = Vec<Output<Expr<'g>>>;

/// The results of `method`, which are those of its kernel.
pub fn formulate<'g>(method: Method, chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    match method {
        // Kinematics.
        Method::ForwardKinematics => outputs::pose(chain),
        Method::LinkPoses => outputs::link_poses(chain),
        Method::GeometricJacobian => outputs::jacobian(chain, choices),
        Method::LinkJacobians => outputs::link_jacobians(chain),
        Method::JacobianDerivatives => outputs::jacobian_derivatives(chain, choices),
        Method::JacobianRate => outputs::jacobian_rate(chain, choices),
        Method::BiasAcceleration => outputs::bias_acceleration(chain),
        Method::CenterOfMass => outputs::center_of_mass(chain),
        // The mass matrix and what is made of it.
        Method::MassMatrix => outputs::mass_matrix(chain),
        Method::MassMatrixDerivatives => outputs::mass_matrix_derivatives(chain),
        Method::InverseMassMatrix => forward_dynamics::inverse_mass_matrix(chain, choices),
        Method::CoriolisMatrix => outputs::coriolis_matrix(chain),
        Method::KineticEnergy => outputs::kinetic_energy(chain),
        Method::PotentialEnergy => outputs::potential_energy(chain),
        // Torques and accelerations.
        Method::InverseDynamics => outputs::inverse_dynamics(chain, unloaded(chain)),
        Method::InverseDynamicsWithWrench => {
            outputs::inverse_dynamics(chain, load_of_wrench(chain))
        }
        Method::BiasForce => outputs::bias_force(chain),
        Method::GravityTorque => outputs::gravity_torque(chain),
        Method::FrictionTorque => outputs::friction_torque(chain),
        Method::ForwardDynamics => forward_dynamics::outputs(chain, unloaded(chain)),
        Method::ForwardDynamicsWithWrench => {
            forward_dynamics::outputs(chain, load_of_wrench(chain))
        }
        Method::InverseDynamicsDerivatives => outputs::torque_derivatives(chain, choices),
        Method::ForwardDynamicsDerivatives => forward_dynamics_derivatives::outputs(chain, choices),
        Method::Regressor => outputs::regressor(chain, Columns::default()),
        Method::BaseRegressor => outputs::regressor(chain, choices.base),
        Method::LockImpacts => outputs::lock_impacts(chain),
        // The task.
        Method::DynamicManipulability => task::manipulability_alone(chain, choices),
        Method::DynamicManipulabilityGradient => task::manipulability_and_gradient(chain, choices),
        Method::ManipulabilityGradient => kinematic_manipulability::outputs(chain, choices),
        Method::TaskSpaceInertia => task_space::task_space_inertia(chain, choices),
        Method::DynamicallyConsistentInverse => {
            task_space::dynamically_consistent_inverse(chain, choices)
        }
        // Several in one.
        Method::MassMatrixAndDerivatives => outputs::mass_matrix_and_derivatives(chain),
        Method::JacobianAndGradient => outputs::jacobian_and_gradient(chain, choices),
    }
}
