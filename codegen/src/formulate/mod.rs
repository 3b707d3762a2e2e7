//! Formulas: from a model to the named results of every method of [`ulna::Arm`], as expressions on a graph.
//!
//! Written for few operations, from other formulas than the generic path where those are cheaper. Where several ways
//! lead to the same values, each is a candidate, and the driver keeps the one that comes out cheapest for the arm at hand.

pub mod articulated;
pub mod body;
pub mod chain;
pub mod factorization;
pub mod inverse_dynamics;
pub mod kinematics;
pub mod manipulability;
pub mod mass_matrix;
pub mod mass_matrix_derivatives;
pub mod vector;

use ulna::{TaskRow, TaskRows};

use self::chain::Chain;
use self::inverse_dynamics::inverse_dynamics;
use self::kinematics::{jacobian_derivatives, jacobian_in_group, jacobian_in_world, pose};
use self::manipulability::Manipulability;
use self::mass_matrix::mass_matrix;
use self::mass_matrix_derivatives::mass_matrix_derivatives;
use crate::graph::{Expr, Input};
use crate::schedule::Output;

/// Results of one method.
pub type Outputs<'g> = Vec<Output<Expr<'g>>>;

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
pub const IN_ORDER: [usize; 6] = [0, 1, 2, 3, 4, 5];

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

/// A method of [`ulna::Arm`] and its formulation.
pub struct Quantity {
    /// The method's name.
    pub method: &'static str,
    /// What it returns, for the generated documentation.
    pub doc: &'static str,
    /// Its arguments: some of `q`, `qd`, `qdd`, `tau`.
    pub arguments: &'static [&'static str],
    /// Its results.
    pub formulate: for<'g> fn(&Chain<'g>, Choices) -> Outputs<'g>,
}

/// Every method that code is generated for.
#[rustfmt::skip]
pub const QUANTITIES: [Quantity; 13] = [
    Quantity { method: "forward_kinematics", arguments: &["q"],
               doc: "`world_from_tool`: the rotation's columns, and the translation in m.",
               formulate: |c, _| forward_kinematics(c) },
    Quantity { method: "geometric_jacobian", arguments: &["q"],
               doc: "Geometric Jacobian, 6×N: columns `[v; ω]` in world axes, at the tool point.",
               formulate: |c, f| vec![jacobian(c, f)] },
    Quantity { method: "jacobian_derivatives", arguments: &["q"],
               doc: "∂J/∂q_i, 6×N for each i: columns `[v; ω]` in world axes, at the tool point.",
               formulate: |c, f| vec![derivatives_of_jacobian(c, f)] },
    Quantity { method: "mass_matrix", arguments: &["q"],
               doc: "Mass matrix, N×N, kg·m².",
               formulate: |c, _| vec![mass(c)] },
    Quantity { method: "mass_matrix_derivatives", arguments: &["q"],
               doc: "∂M/∂q_i, N×N for each i, kg·m²/rad.",
               formulate: |c, _| vec![derivatives_of_mass(c)] },
    Quantity { method: "dynamic_manipulability", arguments: &["q"],
               doc: "w_D over the task's rows of J (Eq. 15), and det(JJᵀ) over them.",
               formulate: |c, f| without_gradient(manipulability_and_gradient(c, f)) },
    Quantity { method: "dynamic_manipulability_gradient", arguments: &["q"],
               doc: "w_D, ∇w_D (Eq. 22–27), and det(JJᵀ) over the task's rows.",
               formulate: manipulability_and_gradient },
    Quantity { method: "inverse_dynamics", arguments: &["q", "qd", "qdd"],
               doc: "Joint torques, N·m, for the accelerations `qdd`.",
               formulate: |c, _| vec![torque(c, &c.inputs(Input::Qd), &c.inputs(Input::Qdd))] },
    Quantity { method: "bias_force", arguments: &["q", "qd"],
               doc: "Joint torques, N·m, at zero acceleration.",
               formulate: |c, _| vec![torque(c, &c.inputs(Input::Qd), &zeros(c))] },
    Quantity { method: "gravity_torque", arguments: &["q"],
               doc: "Joint torques, N·m, at rest.",
               formulate: |c, _| vec![torque(c, &zeros(c), &zeros(c))] },
    Quantity { method: "forward_dynamics", arguments: &["q", "qd", "tau"],
               doc: "Joint accelerations, rad/s², under the torques `tau`.",
               formulate: |c, _| forward_dynamics(c) },
    Quantity { method: "mass_matrix_and_derivatives", arguments: &["q"],
               doc: "Mass matrix, and its derivatives by each joint.",
               formulate: |c, _| vec![mass(c), derivatives_of_mass(c)] },
    Quantity { method: "jacobian_and_gradient", arguments: &["q"],
               doc: "Geometric Jacobian, w_D, ∇w_D, and det(JJᵀ) over the task's rows.",
               formulate: |c, f| [vec![jacobian(c, f)], manipulability_and_gradient(c, f)].into_iter().flatten().collect() },
];

fn zeros<'g>(chain: &Chain<'g>) -> Vec<Expr<'g>> {
    vec![chain.graph.constant(0.0); chain.joint_count()]
}

fn forward_kinematics<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let (axes, origin) = pose(chain);
    vec![
        Output {
            name: "rotation",
            shape: vec![3, 3],
            elements: axes.iter().flat_map(|axis| axis.0).collect(),
        },
        Output {
            name: "translation",
            shape: vec![3],
            elements: origin.0.to_vec(),
        },
    ]
}

fn jacobian<'g>(chain: &Chain<'g>, choices: Choices) -> Output<Expr<'g>> {
    let columns = jacobian_in_world(chain, choices.world);
    Output {
        name: "jacobian",
        shape: vec![chain.joint_count(), 6],
        elements: columns
            .iter()
            .flat_map(|twist| twist.components())
            .collect(),
    }
}

fn derivatives_of_jacobian<'g>(chain: &Chain<'g>, choices: Choices) -> Output<Expr<'g>> {
    let derivatives = jacobian_derivatives(chain, &jacobian_in_world(chain, choices.world));
    Output {
        name: "derivatives",
        shape: vec![chain.joint_count(), chain.joint_count(), 6],
        elements: derivatives
            .iter()
            .flatten()
            .flat_map(|twist| twist.components())
            .collect(),
    }
}

fn mass<'g>(chain: &Chain<'g>) -> Output<Expr<'g>> {
    Output {
        name: "mass",
        shape: vec![chain.joint_count(), chain.joint_count()],
        elements: mass_matrix(chain).concat(),
    }
}

fn derivatives_of_mass<'g>(chain: &Chain<'g>) -> Output<Expr<'g>> {
    Output {
        name: "derivatives",
        shape: vec![chain.joint_count(); 3],
        elements: mass_matrix_derivatives(chain).concat().concat(),
    }
}

fn torque<'g>(chain: &Chain<'g>, qd: &[Expr<'g>], qdd: &[Expr<'g>]) -> Output<Expr<'g>> {
    Output {
        name: "torque",
        shape: vec![chain.joint_count()],
        elements: inverse_dynamics(chain, qd, qdd),
    }
}

fn forward_dynamics<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let bias = inverse_dynamics(chain, &chain.inputs(Input::Qd), &zeros(chain));
    let driving = chain.inputs(Input::Tau).into_iter().zip(bias);
    let driving: Vec<Expr<'g>> = driving.map(|(tau, bias)| tau - bias).collect();
    vec![Output {
        name: "acceleration",
        shape: vec![chain.joint_count()],
        elements: factorization::factor(&mass_matrix(chain)).solve(&driving),
    }]
}

/// w_D does not change when all of a triplet of J's rows is turned; a task of whole triplets may be taken in any axes.
fn is_of_whole_triplets(task: TaskRows) -> bool {
    [
        TaskRows::POSITION,
        TaskRows::POSE,
        TaskRows::new(&TaskRow::ALL[3..]),
    ]
    .contains(&task)
}

/// The task's rows of J, in whatever axes are chosen.
fn task_rows<'g>(chain: &Chain<'g>, choices: Choices) -> Vec<Vec<Expr<'g>>> {
    let columns = if is_of_whole_triplets(chain.task) {
        jacobian_in_group(chain, choices.task)
    } else {
        jacobian_in_world(chain, choices.task)
    };
    let row = |row: TaskRow| {
        let components = columns.iter().map(|twist| twist.components()[row.index()]);
        components.collect()
    };
    let rows: Vec<_> = chain.task.iter().map(row).collect();
    let order = choices.order.iter().filter_map(|place| rows.get(*place));
    order.cloned().collect()
}

/// det(JJᵀ) over the task's rows, and the product of the rows' squared lengths: how near to singular the task is.
pub fn relative_volume<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let rows = task_rows(chain, Choices::default());
    let lengths = rows.iter().map(|row| {
        let zero = chain.graph.constant(0.0);
        row.iter().fold(zero, |sum, x| sum + *x * *x)
    });
    let lengths = lengths.fold(chain.graph.constant(1.0), |product, x| product * x);
    vec![
        number("volume", manipulability::volume_squared(&rows)),
        number("lengths", lengths),
    ]
}

/// The squared lengths of H's rows, in the order that is chosen.
pub fn squared_lengths<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let lengths = manipulability::squared_lengths(&task_rows(chain, choices), &mass_matrix(chain));
    vec![Output {
        name: "lengths",
        shape: vec![lengths.len()],
        elements: lengths,
    }]
}

/// How ln w_D depends on the entries of J's rows, as the table names them, and on M's.
pub fn sensitivity<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let found = manipulability::sensitivity(
        &task_rows(chain, choices),
        &mass_matrix(chain),
        choices.passes,
    );
    let matrix = |name, rows: Vec<Vec<Expr<'g>>>| Output {
        name,
        shape: vec![rows.len(), chain.joint_count()],
        elements: rows.concat(),
    };
    vec![
        matrix("by_jacobian", found.by_jacobian),
        matrix("by_mass", found.by_mass),
    ]
}

fn number<'g>(name: &'static str, value: Expr<'g>) -> Output<Expr<'g>> {
    Output {
        name,
        shape: vec![],
        elements: vec![value],
    }
}

fn without_gradient(mut outputs: Outputs<'_>) -> Outputs<'_> {
    outputs.retain(|output| output.name != "gradient");
    outputs
}

fn manipulability_and_gradient<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let found = if choices.singular {
        Manipulability::zero(chain.graph.constant(0.0), chain.joint_count())
    } else if choices.articulated {
        let factors = articulated::factors(chain);
        manipulability::manipulability_by_factors(
            &task_rows(chain, choices),
            &factors,
            choices.passes,
        )
    } else {
        manipulability::manipulability(
            &task_rows(chain, choices),
            &mass_matrix(chain),
            choices.passes,
        )
    };
    vec![
        number("value", found.value),
        Output {
            name: "gradient",
            shape: vec![chain.joint_count()],
            elements: found.gradient,
        },
        number("volume", found.volume_squared),
    ]
}
