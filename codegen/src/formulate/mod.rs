//! Formulas: from a model to the named results of every method of [`ulna::Arm`], as expressions on a graph.
//!
//! Written for few operations, from other formulas than the generic path where those are cheaper. Where several ways
//! lead to the same values, each is a candidate, and the driver keeps the one that comes out cheapest for the arm at hand.

pub(crate) mod articulated;
pub(crate) mod body;
pub(crate) mod centroid;
pub(crate) mod chain;
pub(crate) mod coriolis;
pub(crate) mod energy;
pub(crate) mod factorization;
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
pub(crate) mod rates;
pub(crate) mod regressor;
pub(crate) mod task;
pub(crate) mod task_space;
pub(crate) mod vector;
mod velocity_products;

use ulna::{Method, Parameter, TaskRow};

use self::chain::Chain;
use self::factorization::Factors;
use self::friction::{friction, with_friction};
use self::inverse_dynamics::{
    Wrench, inverse_dynamics, inverse_dynamics_with_load, load_of_wrench, unloaded,
};
use self::inverse_dynamics_derivatives::inverse_dynamics_derivatives;
use self::kinematics::{jacobian_derivatives, jacobian_in_world, pose};
use self::lock_impacts::lock_impacts;
use self::mass_matrix::mass_matrix;
use self::mass_matrix_derivatives::mass_matrix_derivatives;
use self::regressor::{Columns, regressor_columns};
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

/// The choices that a method's formulas depend on. One that is not listed may depend on all of them:
/// that costs a search where only such methods are generated, and nothing else.
pub(crate) fn depends_on(method: Method) -> &'static [Chosen] {
    match method {
        Method::ForwardKinematics
        | Method::MassMatrix
        | Method::MassMatrixDerivatives
        | Method::InverseDynamics
        | Method::BiasForce
        | Method::GravityTorque
        | Method::ForwardDynamics
        | Method::InverseDynamicsWithWrench
        | Method::ForwardDynamicsWithWrench
        | Method::FrictionTorque
        | Method::MassMatrixAndDerivatives => &[],
        Method::GeometricJacobian | Method::JacobianDerivatives => &[Chosen::World],
        Method::InverseDynamicsDerivatives => &[Chosen::Meeting],
        Method::ForwardDynamicsDerivatives => {
            &[Chosen::Task, Chosen::Meeting, Chosen::Accelerations]
        }
        _ => &[Chosen::World, Chosen::Task],
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
            let torque = inverse_dynamics(chain, &qd, &qdd);
            vec![torques(chain, with_friction(chain, &qd, torque))]
        }
        Method::BiasForce => {
            let bias = inverse_dynamics(chain, &chain.inputs(Input::Qd), &zeros(chain));
            vec![torques(chain, bias)]
        }
        Method::GravityTorque => {
            let gravity = inverse_dynamics(chain, &zeros(chain), &zeros(chain));
            vec![torques(chain, gravity)]
        }
        Method::ForwardDynamics => forward_dynamics(chain, unloaded(chain)),
        Method::InverseDynamicsWithWrench => {
            let (qd, qdd) = (chain.inputs(Input::Qd), chain.inputs(Input::Qdd));
            let torque = inverse_dynamics_with_load(chain, &qd, &qdd, load_of_wrench(chain));
            vec![torques(chain, with_friction(chain, &qd, torque))]
        }
        Method::ForwardDynamicsWithWrench => forward_dynamics(chain, load_of_wrench(chain)),
        Method::FrictionTorque => {
            let friction = friction(chain, &chain.inputs(Input::Qd));
            vec![torques(chain, named(friction, "friction"))]
        }
        Method::LockImpacts => vec![impacts(chain)],
        Method::InverseDynamicsDerivatives => torque_derivatives(chain, choices),
        Method::ForwardDynamicsDerivatives => forward_dynamics_derivatives::outputs(chain, choices),
        Method::MassMatrixAndDerivatives => vec![mass(chain), derivatives_of_mass(chain)],
        Method::JacobianAndGradient => {
            let mut outputs = vec![jacobian(chain, choices)];
            outputs.extend(manipulability_and_gradient(chain, choices));
            outputs
        }
        Method::Regressor => vec![regressor(chain, Columns::default())],
        Method::BaseRegressor => vec![regressor(chain, choices.base)],
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
        Method::CoriolisMatrix => {
            let rows = coriolis::coriolis_matrix(chain, &chain.inputs(Input::Qd));
            vec![by_columns("coriolis", &rows)]
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
    for (j, axis) in axes.iter().enumerate() {
        for (i, x) in axis.0.iter().enumerate() {
            x.labelled("pose", || format!("r_{}_{}", i + 1, j + 1));
        }
    }
    origin.labelled("pose", |axis| format!("p_{axis}"));
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
    for (i, twists) in derivatives.iter().enumerate() {
        for (j, twist) in twists.iter().enumerate() {
            for (x, row) in twist.components().into_iter().zip(TaskRow::ALL) {
                x.labelled("dj", || format!("dj_{}_{}_{}", i + 1, row.name(), j + 1));
            }
        }
    }
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
    let inverse = named_square(factors(chain, choices).inverse(), "m_inv");
    Output::new("inverse", &[n, n], inverse.concat())
}

/// M's factors, from M or, where that would lose a light link, from articulated bodies.
fn factors<'g>(chain: &Chain<'g>, choices: Choices) -> Factors<'g> {
    if choices.articulated {
        articulated::factors(chain)
    } else {
        factorization::factor(&mass_matrix(chain))
    }
}

/// Names one value for each joint.
fn named<'g>(values: Vec<Expr<'g>>, family: &'static str) -> Vec<Expr<'g>> {
    for (i, x) in values.iter().enumerate() {
        x.named(family, &[i]);
    }
    values
}

/// Names a square matrix, by rows.
fn named_square<'g>(rows: Vec<Vec<Expr<'g>>>, family: &'static str) -> Vec<Vec<Expr<'g>>> {
    for (i, row) in rows.iter().enumerate() {
        for (j, x) in row.iter().enumerate() {
            x.named(family, &[i, j]);
        }
    }
    rows
}

fn torques<'g>(chain: &Chain<'g>, elements: Vec<Expr<'g>>) -> Output<Expr<'g>> {
    let elements = named(elements, "tau");
    Output::new("torque", &[chain.joint_count()], elements)
}

fn impacts<'g>(chain: &Chain<'g>) -> Output<Expr<'g>> {
    let n = chain.joint_count();
    Output::new("impacts", &[n, n], lock_impacts(chain).concat())
}

fn torque_derivatives<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let (qd, qdd) = (chain.inputs(Input::Qd), chain.inputs(Input::Qdd));
    let [by_position, by_velocity] =
        inverse_dynamics_derivatives(chain, &qd, &qdd, choices.meeting);
    vec![
        by_columns("by_position", &by_position),
        by_columns("by_velocity", &by_velocity),
    ]
}

/// A square matrix, given by rows.
fn by_columns<'g>(name: &'static str, rows: &[Vec<Expr<'g>>]) -> Output<Expr<'g>> {
    let n = rows.len();
    let entries = (0..n).flat_map(|j| rows.iter().map(move |row| row[j]));
    Output::new(name, &[n, n], entries.collect())
}

fn forward_dynamics<'g>(chain: &Chain<'g>, load: Wrench<'g>) -> Outputs<'g> {
    let driving = driving(chain, load);
    let elements = factorization::factor(&mass_matrix(chain)).solve(&driving);
    let elements = named(elements, "qdd");
    vec![Output::new(
        "acceleration",
        &[chain.joint_count()],
        elements,
    )]
}

fn regressor<'g>(chain: &Chain<'g>, columns: Columns) -> Output<Expr<'g>> {
    let n = chain.joint_count();
    let elements = regressor_columns(chain, columns).concat().concat();
    Output::new("regressor", &[n, Parameter::COUNT, n], elements)
}

/// What of the torques accelerates: τ − c − g − f, and what the last link bears.
fn driving<'g>(chain: &Chain<'g>, load: Wrench<'g>) -> Vec<Expr<'g>> {
    let qd = chain.inputs(Input::Qd);
    let bias = inverse_dynamics_with_load(chain, &qd, &zeros(chain), load);
    let bias = named(with_friction(chain, &qd, bias), "bias");
    let pairs = chain.inputs(Input::Tau).into_iter().zip(bias);
    named(pairs.map(|(tau, bias)| tau - bias).collect(), "net")
}
