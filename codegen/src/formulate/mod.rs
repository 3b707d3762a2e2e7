//! Formulas: from a model to the named results of every method of [`ulna::Arm`], as expressions on a graph.
//!
//! Written for few operations, from other formulas than the generic path where those are cheaper. Where several ways
//! lead to the same values, each is a candidate, and the driver keeps the one that comes out cheapest for the arm at hand.

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
use self::manipulability::manipulability;
use self::mass_matrix::mass_matrix;
use self::mass_matrix_derivatives::mass_matrix_derivatives;
use crate::graph::{Expr, Input};
use crate::schedule::Output;

/// Results of one method.
pub type Outputs<'g> = Vec<Output<Expr<'g>>>;

/// Frames in which a Jacobian is built, each free to choose; 0 is the base, k the last frame of the k-th group.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Frames {
    /// Where J in world axes switches from turning down joint by joint to the frame's world axes.
    pub world: usize,
    /// The axes of J within w_D.
    pub task: usize,
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
    pub formulate: for<'g> fn(&Chain<'g>, Frames) -> Outputs<'g>,
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
               doc: "w_D over the task's rows of J (Eq. 15), and its margins.",
               formulate: |c, f| without_gradient(manipulability_and_gradient(c, f)) },
    Quantity { method: "dynamic_manipulability_gradient", arguments: &["q"],
               doc: "w_D, ∇w_D (Eq. 22–27), and the margins of w_D.",
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
               doc: "Geometric Jacobian, w_D, ∇w_D, and the margins of w_D.",
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

fn jacobian<'g>(chain: &Chain<'g>, frames: Frames) -> Output<Expr<'g>> {
    let columns = jacobian_in_world(chain, frames.world);
    Output {
        name: "jacobian",
        shape: vec![chain.joint_count(), 6],
        elements: columns
            .iter()
            .flat_map(|twist| twist.components())
            .collect(),
    }
}

fn derivatives_of_jacobian<'g>(chain: &Chain<'g>, frames: Frames) -> Output<Expr<'g>> {
    let derivatives = jacobian_derivatives(chain, &jacobian_in_world(chain, frames.world));
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
    rows_of_each_kind(task).iter().all(|rows| rows % 3 == 0)
}

/// How many linear and how many angular rows.
fn rows_of_each_kind(task: TaskRows) -> [usize; 2] {
    let linear = task.iter().filter(|row| row.index() < 3).count();
    [linear, task.len() - linear]
}

/// Pivots and lengths, each filled up to six by repeating the first, so that all arms' kernels have one signature.
fn margins<'g>(pivots: &[Expr<'g>], lengths: &[Expr<'g>]) -> Output<Expr<'g>> {
    let six = |row: &[Expr<'g>]| -> Vec<Expr<'g>> {
        (0..6).map(|i| *row.get(i).unwrap_or(&row[0])).collect()
    };
    Output {
        name: "margins",
        shape: vec![2, 6],
        elements: [six(pivots), six(lengths)].concat(),
    }
}

fn without_gradient(mut outputs: Outputs<'_>) -> Outputs<'_> {
    outputs.retain(|output| output.name != "gradient");
    outputs
}

fn manipulability_and_gradient<'g>(chain: &Chain<'g>, frames: Frames) -> Outputs<'g> {
    let columns = if is_of_whole_triplets(chain.task) {
        jacobian_in_group(chain, frames.task)
    } else {
        jacobian_in_world(chain, frames.task)
    };
    let row = |row: TaskRow| {
        columns
            .iter()
            .map(|c| c.components()[row.index()])
            .collect()
    };
    let rows: Vec<Vec<Expr<'g>>> = chain.task.iter().map(row).collect();
    let passes = rows_of_each_kind(chain.task)
        .iter()
        .filter(|rows| **rows > 0)
        .count();
    let found = manipulability(&rows, &mass_matrix(chain), passes);
    let vector = |name, elements: Vec<Expr<'g>>| Output {
        name,
        shape: vec![elements.len()],
        elements,
    };
    let value = Output {
        name: "value",
        shape: vec![],
        elements: vec![found.value],
    };
    vec![
        value,
        vector("gradient", found.gradient),
        margins(&found.pivots, &found.lengths),
    ]
}
