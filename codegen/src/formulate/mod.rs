//! Formulas: from a model to the named results of every method of [`ulna::Arm`], as expressions on a graph.
//!
//! Written for few operations, from other formulas than the generic path where those are cheaper. Where several ways
//! lead to the same values, each is a candidate, and the driver keeps the one that comes out cheapest for the arm at hand.

pub(crate) mod articulated;
pub(crate) mod body;
pub(crate) mod centroid;
pub(crate) mod chain;
pub(crate) mod energy;
pub(crate) mod factorization;
pub(crate) mod inverse_dynamics;
pub(crate) mod kinematic_manipulability;
pub(crate) mod kinematics;
pub(crate) mod links;
pub(crate) mod manipulability;
pub(crate) mod mass_matrix;
pub(crate) mod mass_matrix_derivatives;
pub(crate) mod rates;
pub(crate) mod task;
pub(crate) mod task_space;
pub(crate) mod vector;

use ulna::Method;

use self::chain::Chain;
use self::inverse_dynamics::inverse_dynamics;
use self::kinematics::{jacobian_derivatives, jacobian_in_world, pose};
use self::mass_matrix::mass_matrix;
use self::mass_matrix_derivatives::mass_matrix_derivatives;
use self::task::{manipulability_alone, manipulability_and_gradient};
use crate::graph::{Expr, Input};
use crate::schedule::{Output, Size};

/// Results of one method.
pub(crate) type Outputs<'g> = Vec<Output<Expr<'g>>>;

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
        }
    }
}

/// The results of `method`, which are those of its kernel.
pub fn formulate<'g>(method: Method, chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    match method {
        Method::ForwardKinematics => forward_kinematics(chain),
        Method::GeometricJacobian => vec![jacobian(chain, choices)],
        Method::JacobianDerivatives => vec![derivatives_of_jacobian(chain, choices)],
        Method::MassMatrix => vec![mass(chain)],
        Method::MassMatrixDerivatives => vec![derivatives_of_mass(chain)],
        Method::InverseMassMatrix => vec![inverse_mass(chain, choices)],
        Method::DynamicManipulability => manipulability_alone(chain, choices),
        Method::DynamicManipulabilityGradient => manipulability_and_gradient(chain, choices),
        Method::InverseDynamics => {
            let (qd, qdd) = (chain.inputs(Input::Qd), chain.inputs(Input::Qdd));
            vec![torque(chain, &qd, &qdd)]
        }
        Method::BiasForce => vec![torque(chain, &chain.inputs(Input::Qd), &zeros(chain))],
        Method::GravityTorque => vec![torque(chain, &zeros(chain), &zeros(chain))],
        Method::ForwardDynamics => forward_dynamics(chain),
        Method::MassMatrixAndDerivatives => vec![mass(chain), derivatives_of_mass(chain)],
        Method::JacobianAndGradient => {
            let mut outputs = vec![jacobian(chain, choices)];
            outputs.extend(manipulability_and_gradient(chain, choices));
            outputs
        }
        Method::LinkPoses => vec![poses_of_links(chain)],
        Method::LinkJacobians => vec![jacobians_of_links(chain)],
        Method::CenterOfMass => {
            let centroid = centroid::center_of_mass(chain).0.to_vec();
            vec![Output::new("centroid", &[3], centroid).relative_to(Size::LargestOrLength)]
        }
        Method::JacobianRate => vec![rate_of_jacobian(chain, choices)],
        Method::BiasAcceleration => {
            let acceleration = rates::bias_acceleration(chain, &chain.inputs(Input::Qd));
            let elements = acceleration.components().to_vec();
            vec![Output::new("acceleration", &[6], elements)]
        }
        Method::KineticEnergy => {
            let energy = energy::kinetic_energy(chain, &chain.inputs(Input::Qd));
            vec![Output::new("energy", &[], vec![energy])]
        }
        Method::PotentialEnergy => {
            let energy = centroid::potential_energy(chain);
            vec![Output::new("energy", &[], vec![energy])]
        }
        Method::TaskSpaceInertia => task_space::task_space_inertia(chain, choices),
        Method::DynamicallyConsistentInverse => {
            task_space::dynamically_consistent_inverse(chain, choices)
        }
        Method::ManipulabilityGradient => {
            kinematic_manipulability::kinematic_manipulability(chain, choices)
        }
    }
}

fn zeros<'g>(chain: &Chain<'g>) -> Vec<Expr<'g>> {
    vec![chain.graph.constant(0.0); chain.joint_count()]
}

fn forward_kinematics<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let (axes, origin) = pose(chain);
    let rotation = axes.iter().flat_map(|axis| axis.0).collect();
    vec![
        Output::new("rotation", &[3, 3], rotation),
        Output::new("translation", &[3], origin.0.to_vec()).relative_to(Size::LargestOrLength),
    ]
}

fn jacobian<'g>(chain: &Chain<'g>, choices: Choices) -> Output<Expr<'g>> {
    let columns = jacobian_in_world(chain, choices.world);
    let elements = columns.iter().flat_map(|twist| twist.components());
    Output::new("jacobian", &[chain.joint_count(), 6], elements.collect())
}

fn derivatives_of_jacobian<'g>(chain: &Chain<'g>, choices: Choices) -> Output<Expr<'g>> {
    let n = chain.joint_count();
    let derivatives = jacobian_derivatives(chain, &jacobian_in_world(chain, choices.world));
    let twists = derivatives.iter().flatten();
    let elements = twists.flat_map(|twist| twist.components());
    Output::new("derivatives", &[n, n, 6], elements.collect())
}

fn poses_of_links<'g>(chain: &Chain<'g>) -> Output<Expr<'g>> {
    let frames = links::link_frames(chain);
    let columns = frames.iter().flat_map(|frame| {
        let [x, y, z] = frame.axes;
        [x, y, z, frame.origin]
    });
    let elements = columns.flat_map(|column| column.0).collect();
    Output::new("poses", &[chain.joint_count(), 4, 3], elements).relative_to(Size::LargestOrLength)
}

fn jacobians_of_links<'g>(chain: &Chain<'g>) -> Output<Expr<'g>> {
    let n = chain.joint_count();
    let jacobians = links::link_jacobians(chain);
    let twists = jacobians.iter().flatten();
    let elements = twists.flat_map(|twist| twist.components()).collect();
    Output::new("jacobians", &[n, n, 6], elements)
}

fn rate_of_jacobian<'g>(chain: &Chain<'g>, choices: Choices) -> Output<Expr<'g>> {
    let columns = rates::jacobian_rate(chain, &chain.inputs(Input::Qd), choices.world);
    let elements = columns.iter().flat_map(|twist| twist.components());
    Output::new("rate", &[chain.joint_count(), 6], elements.collect())
}

fn mass<'g>(chain: &Chain<'g>) -> Output<Expr<'g>> {
    let n = chain.joint_count();
    Output::new("mass", &[n, n], mass_matrix(chain).concat())
}

fn derivatives_of_mass<'g>(chain: &Chain<'g>) -> Output<Expr<'g>> {
    let n = chain.joint_count();
    let elements = mass_matrix_derivatives(chain).concat().concat();
    Output::new("derivatives", &[n, n, n], elements)
}

fn inverse_mass<'g>(chain: &Chain<'g>, choices: Choices) -> Output<Expr<'g>> {
    let n = chain.joint_count();
    let factors = if choices.articulated {
        articulated::factors(chain)
    } else {
        factorization::factor(&mass_matrix(chain))
    };
    Output::new("inverse", &[n, n], factors.inverse().concat())
}

fn torque<'g>(chain: &Chain<'g>, qd: &[Expr<'g>], qdd: &[Expr<'g>]) -> Output<Expr<'g>> {
    let elements = inverse_dynamics(chain, qd, qdd);
    Output::new("torque", &[chain.joint_count()], elements)
}

fn forward_dynamics<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let bias = inverse_dynamics(chain, &chain.inputs(Input::Qd), &zeros(chain));
    let driving = chain.inputs(Input::Tau).into_iter().zip(bias);
    let driving: Vec<Expr<'g>> = driving.map(|(tau, bias)| tau - bias).collect();
    let elements = factorization::factor(&mass_matrix(chain)).solve(&driving);
    vec![Output::new(
        "acceleration",
        &[chain.joint_count()],
        elements,
    )]
}
