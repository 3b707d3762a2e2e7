//! What is settled before an arm's formulas are written down, and which methods it matters to.

use ulna::Method;

use super::regressor::Columns;

/// What is settled before the formulas are written down. A frame is free to choose;
/// 0 is the base, k the last frame of the k-th group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choices {
    /// Where J in world axes switches from turning down joint by joint to the frame's world axes.
    pub world: usize,
    /// The axes of J within w_D.
    pub task: usize,
    /// In which order the task's rows are made orthogonal: their places in the task, each once.
    pub order: [usize; 6],
    /// How often H's rows are made orthogonal.
    pub passes: usize,
    /// Whether w_D takes M's factors from articulated bodies, and not from M.
    pub articulated: bool,
    /// Whether the task is singular in every configuration, so that w_D is 0 there.
    pub singular: bool,
    /// Which columns of the regressor are those of base parameters.
    pub base: Columns,
    /// The joint at which twists and wrenches meet in ∂τ/∂q and ∂τ/∂q̇.
    pub meeting: usize,
    /// Whether ∂q̈ takes what velocities do to τ from ∂τ/∂q̇, and not from an inverse dynamics.
    pub by_slopes: bool,
}

/// As the table says.
pub(crate) const IN_ORDER: [usize; 6] = [0, 1, 2, 3, 4, 5];

impl Default for Choices {
    fn default() -> Self {
        Self {
            world: 0,
            task: 0,
            order: IN_ORDER,
            passes: 2,
            articulated: false,
            singular: false,
            base: Columns::default(),
            meeting: 0,
            by_slopes: false,
        }
    }
}

/// What of the [`Choices`] is looked for apart from the rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Chosen {
    /// [`Choices::world`].
    World,
    /// How w_D and M's inverse are computed.
    Task,
    /// [`Choices::meeting`].
    Meeting,
    /// [`Choices::by_slopes`].
    Accelerations,
}

/// The choices that a method's formulas depend on. One that is not listed may depend on how w_D and J are computed:
/// that costs a search where only such methods are generated, and nothing else.
pub(crate) fn depends_on(method: Method) -> &'static [Chosen] {
    match method {
        Method::ForwardKinematics
        | Method::LinkPoses
        | Method::LinkJacobians
        | Method::BiasAcceleration
        | Method::CenterOfMass
        | Method::MassMatrix
        | Method::MassMatrixDerivatives
        | Method::MassMatrixAndDerivatives
        | Method::CoriolisMatrix
        | Method::KineticEnergy
        | Method::PotentialEnergy
        | Method::InverseDynamics
        | Method::InverseDynamicsWithWrench
        | Method::BiasForce
        | Method::GravityTorque
        | Method::FrictionTorque
        | Method::ForwardDynamics
        | Method::ForwardDynamicsWithWrench
        | Method::Regressor
        | Method::BaseRegressor
        | Method::LockImpacts => &[],
        Method::GeometricJacobian | Method::JacobianDerivatives | Method::JacobianRate => {
            &[Chosen::World]
        }
        Method::InverseMassMatrix
        | Method::DynamicManipulability
        | Method::DynamicManipulabilityGradient
        | Method::ManipulabilityGradient => &[Chosen::Task],
        Method::InverseDynamicsDerivatives => &[Chosen::Meeting],
        Method::ForwardDynamicsDerivatives => {
            &[Chosen::Task, Chosen::Meeting, Chosen::Accelerations]
        }
        _ => &[Chosen::World, Chosen::Task],
    }
}
