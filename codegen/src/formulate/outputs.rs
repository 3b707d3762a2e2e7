//! Results as kernels return them: the formulas' vectors and matrices, flat and in order, each element with its name.
//!
//! A matrix is an array of its columns.

use ulna::{Parameter, TaskRow};

use super::chain::Chain;
use super::inverse_dynamics::Wrench;
use super::kinematics::{Twist, jacobian_in_world};
use super::regressor::Columns;
use super::{
    Choices, Outputs, centroid, coriolis, energy, friction, inverse_dynamics,
    inverse_dynamics_derivatives, kinematics, links, lock_impacts, mass_matrix,
    mass_matrix_derivatives, rates, regressor, task,
};
use crate::graph::{Expr, Input};
use crate::schedule::{Output, Size};

/// A zero for each joint.
pub(super) fn zeros<'g>(chain: &Chain<'g>) -> Vec<Expr<'g>> {
    vec![chain.graph.constant(0.0); chain.joint_count()]
}

/// Names one value for each joint.
pub(super) fn named<'g>(values: Vec<Expr<'g>>, family: &'static str) -> Vec<Expr<'g>> {
    for (i, x) in values.iter().enumerate() {
        x.named(family, &[i]);
    }
    values
}

/// Names a matrix, by rows.
pub(super) fn named_rows<'g>(rows: Vec<Vec<Expr<'g>>>, family: &'static str) -> Vec<Vec<Expr<'g>>> {
    for (i, row) in rows.iter().enumerate() {
        for (j, x) in row.iter().enumerate() {
            x.named(family, &[i, j]);
        }
    }
    rows
}

/// Names twists of joints j, a list for each i: `dj_1_rx_2` for `dj`.
fn named_twists(twists: &[Vec<Twist<'_>>], family: &'static str) {
    for (i, twists) in twists.iter().enumerate() {
        for (j, twist) in twists.iter().enumerate() {
            for (x, row) in twist.components().into_iter().zip(TaskRow::ALL) {
                let row = row.name();
                x.labelled(family, || format!("{family}_{}_{row}_{}", i + 1, j + 1));
            }
        }
    }
}

/// Twists, one after another.
fn flat<'a, 'g: 'a>(twists: impl IntoIterator<Item = &'a Twist<'g>>) -> Vec<Expr<'g>> {
    let twists = twists.into_iter();
    twists.flat_map(|twist| twist.components()).collect()
}

/// A square matrix, given by rows.
fn by_columns<'g>(name: &'static str, rows: &[Vec<Expr<'g>>]) -> Output<Expr<'g>> {
    let n = rows.len();
    let entries = (0..n).flat_map(|j| rows.iter().map(move |row| row[j]));
    Output::new(name, &[n, n], entries.collect())
}

fn torques<'g>(chain: &Chain<'g>, torques: Vec<Expr<'g>>) -> Outputs<'g> {
    let torques = named(torques, "tau");
    vec![Output::new("torque", &[chain.joint_count()], torques)]
}

pub(super) fn pose<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let (axes, origin) = kinematics::pose(chain);
    for (j, axis) in axes.iter().enumerate() {
        for (i, x) in axis.0.iter().enumerate() {
            x.labelled("pose", || format!("r_{}_{}", i + 1, j + 1));
        }
    }
    origin.labelled("pose", |axis| format!("p_{axis}"));
    let rotation = axes.iter().flat_map(|axis| axis.0).collect();
    let translation = Output::new("translation", &[3], origin.0.to_vec());
    vec![
        Output::new("rotation", &[3, 3], rotation),
        translation.relative_to(Size::LargestOrLength),
    ]
}

/// Of each link the columns of its rotation, and then its place.
pub(super) fn link_poses<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let frames = links::link_frames(chain);
    let columns = frames.iter().enumerate().flat_map(|(i, frame)| {
        let [x, y, z] = frame.axes;
        for (axis, j) in frame.axes.iter().zip(1..) {
            axis.labelled("link_axes", |row| format!("r{row}_{}_{j}", i + 1));
        }
        [x, y, z, frame.origin]
    });
    let elements = columns.flat_map(|column| column.0).collect();
    let poses = Output::new("poses", &[chain.joint_count(), 4, 3], elements);
    vec![poses.relative_to(Size::LargestOrLength)]
}

pub(super) fn jacobian<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let elements = flat(&jacobian_in_world(chain, choices.world));
    vec![Output::new("jacobian", &[chain.joint_count(), 6], elements)]
}

pub(super) fn link_jacobians<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let n = chain.joint_count();
    let jacobians = links::link_jacobians(chain);
    named_twists(&jacobians, "jl");
    let elements = flat(jacobians.iter().flatten());
    vec![Output::new("jacobians", &[n, n, 6], elements)]
}

pub(super) fn jacobian_derivatives<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let n = chain.joint_count();
    let columns = jacobian_in_world(chain, choices.world);
    let derivatives = kinematics::jacobian_derivatives(chain, &columns);
    named_twists(&derivatives, "dj");
    let elements = flat(derivatives.iter().flatten());
    vec![Output::new("derivatives", &[n, n, 6], elements)]
}

pub(super) fn jacobian_rate<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let qd = chain.inputs(Input::Qd);
    let elements = flat(&rates::jacobian_rate(chain, &qd, choices.world));
    vec![Output::new("rate", &[chain.joint_count(), 6], elements)]
}

pub(super) fn bias_acceleration<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let acceleration = rates::bias_acceleration(chain, &chain.inputs(Input::Qd));
    let elements = flat([&acceleration]);
    for (x, row) in elements.iter().zip(TaskRow::ALL) {
        x.labelled("jdqd", || format!("jdqd_{}", row.name()));
    }
    vec![Output::new("acceleration", &[6], elements)]
}

pub(super) fn center_of_mass<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let centroid = centroid::center_of_mass(chain);
    centroid.labelled("com", |axis| format!("c_{axis}"));
    let centroid = Output::new("centroid", &[3], centroid.0.to_vec());
    vec![centroid.relative_to(Size::LargestOrLength)]
}

pub(super) fn mass_matrix<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let n = chain.joint_count();
    let elements = mass_matrix::mass_matrix(chain).concat();
    vec![Output::new("mass", &[n, n], elements)]
}

pub(super) fn mass_matrix_derivatives<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let n = chain.joint_count();
    let derivatives = mass_matrix_derivatives::mass_matrix_derivatives(chain);
    let elements = derivatives.concat().concat();
    vec![Output::new("derivatives", &[n, n, n], elements)]
}

pub(super) fn mass_matrix_and_derivatives<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    [mass_matrix(chain), mass_matrix_derivatives(chain)].concat()
}

pub(super) fn coriolis_matrix<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let rows = coriolis::coriolis_matrix(chain, &chain.inputs(Input::Qd));
    vec![by_columns("coriolis", &named_rows(rows, "cor"))]
}

pub(super) fn kinetic_energy<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let energy = energy::kinetic_energy(chain, &chain.inputs(Input::Qd));
    vec![task::number("energy", energy)]
}

pub(super) fn potential_energy<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    vec![task::number("energy", centroid::potential_energy(chain))]
}

/// τ with friction, the last link bearing `load`.
pub(super) fn inverse_dynamics<'g>(chain: &Chain<'g>, load: Wrench<'g>) -> Outputs<'g> {
    let (qd, qdd) = (chain.inputs(Input::Qd), chain.inputs(Input::Qdd));
    let torque = inverse_dynamics::inverse_dynamics_with_load(chain, &qd, &qdd, load);
    torques(chain, friction::with_friction(chain, &qd, torque))
}

pub(super) fn bias_force<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let qd = chain.inputs(Input::Qd);
    let bias = inverse_dynamics::inverse_dynamics(chain, &qd, &zeros(chain));
    torques(chain, bias)
}

pub(super) fn gravity_torque<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let gravity = inverse_dynamics::inverse_dynamics(chain, &zeros(chain), &zeros(chain));
    torques(chain, gravity)
}

pub(super) fn friction_torque<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let friction = friction::friction(chain, &chain.inputs(Input::Qd));
    torques(chain, friction)
}

pub(super) fn torque_derivatives<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let (qd, qdd) = (chain.inputs(Input::Qd), chain.inputs(Input::Qdd));
    let [by_position, by_velocity] = inverse_dynamics_derivatives::inverse_dynamics_derivatives(
        chain,
        &qd,
        &qdd,
        choices.meeting,
    );
    vec![
        by_columns("by_position", &by_position),
        by_columns("by_velocity", &by_velocity),
    ]
}

/// Of each link, of each of its parameters, the torques of all joints.
pub(super) fn regressor<'g>(chain: &Chain<'g>, columns: Columns) -> Outputs<'g> {
    let n = chain.joint_count();
    let blocks = regressor::regressor_columns(chain, columns);
    let elements = blocks.concat().concat();
    vec![Output::new(
        "regressor",
        &[n, Parameter::COUNT, n],
        elements,
    )]
}

pub(super) fn lock_impacts<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let n = chain.joint_count();
    let columns = lock_impacts::lock_impacts(chain);
    vec![Output::new("impacts", &[n, n], columns.concat())]
}

/// J, and then w_D, ∇w_D and det(JJᵀ).
pub(super) fn jacobian_and_gradient<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let jacobian = jacobian(chain, choices);
    let gradient = task::manipulability_and_gradient(chain, choices);
    [jacobian, gradient].concat()
}
