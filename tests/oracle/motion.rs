//! Links, rates and energies against Pinocchio, and what the tool feels of the arm against 80 digits (`golden_motion.py`).

use nalgebra::{Quaternion, UnitQuaternion};
use serde::Deserialize;
use ulna::proof::State;
use ulna::{Arm, TaskRow};

use crate::{Errors, read, row_by_row, states};

/// A line of `data/<arm>.motion.jsonl`.
#[derive(Deserialize)]
struct Motion {
    link_poses: Vec<f64>,
    link_velocities: Vec<f64>,
    center_of_mass: Vec<f64>,
    bias_acceleration: Vec<f64>,
    coriolis_matrix: Vec<f64>,
    kinetic_energy: f64,
    potential_energy: f64,
    task_space_inertia: Vec<f64>,
    consistent_inverse: Vec<f64>,
    w: f64,
    gradient: Vec<f64>,
}

/// Of a line of `data/<arm>.jsonl`.
#[derive(Deserialize)]
struct Rate {
    jacobian_rate: Vec<f64>,
}

/// What rounding may leave, relative to the largest entry of each quantity.
const TOLERANCE: f64 = 1e-12;

/// The same of what has a condition number, w's 1e4 at the worst of these configurations.
const TOLERANCE_OF_TASK: f64 = 1e-11;

pub(crate) fn agrees<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let (mut errors, mut of_task) = (Errors::default(), Errors::default());
    let rates = read::<Rate>(&format!("{name}.jsonl"));
    let golden = read::<Motion>(&format!("{name}.motion.jsonl"));
    for ((state, rate), golden) in states(name).into_iter().zip(rates).zip(golden) {
        let State { q, qd, .. } = state;
        links(&mut errors, arm, &state, &golden);
        errors.record(
            "rate of J",
            row_by_row(&arm.jacobian_rate(&q, &qd)),
            &rate.jacobian_rate,
        );
        errors.record(
            "bias acceleration",
            arm.bias_acceleration(&q, &qd).iter().copied(),
            &golden.bias_acceleration,
        );
        errors.record(
            "Coriolis matrix",
            row_by_row(&arm.coriolis_matrix(&q, &qd)),
            &golden.coriolis_matrix,
        );
        let (kinetic, potential) = (arm.kinetic_energy(&q, &qd), arm.potential_energy(&q));
        errors.record("kinetic energy", [kinetic], &[golden.kinetic_energy]);
        errors.record("potential energy", [potential], &[golden.potential_energy]);
        task(&mut of_task, arm, &state, &golden);
    }
    let arm = format!("{backend} {name}");
    errors.check(&arm, TOLERANCE);
    of_task.check(&arm, TOLERANCE_OF_TASK);
}

fn links<const N: usize>(
    errors: &mut Errors,
    arm: &impl Arm<N>,
    State { q, qd, .. }: &State<N>,
    golden: &Motion,
) {
    let (origins, rotations): (Vec<[f64; 3]>, Vec<[f64; 9]>) = golden
        .link_poses
        .chunks(7)
        .map(|pose| {
            let turn = Quaternion::new(pose[6], pose[3], pose[4], pose[5]);
            let turn = UnitQuaternion::from_quaternion(turn).to_rotation_matrix();
            let mut entries = [0.0; 9];
            entries.copy_from_slice(turn.matrix().as_slice());
            ([pose[0], pose[1], pose[2]], entries)
        })
        .unzip();
    let poses = arm.link_poses(q);
    let actual = poses
        .iter()
        .flat_map(|pose| pose.translation.vector.data.0[0]);
    errors.record("link origins", actual, &origins.concat());
    let actual = poses
        .iter()
        .flat_map(|pose| pose.rotation.matrix().data.0.concat());
    errors.record("link rotations", actual, &rotations.concat());
    let jacobians = arm.link_jacobians(q);
    let actual = jacobians
        .iter()
        .flat_map(|jacobian| (jacobian * qd).data.0[0]);
    errors.record("link Jacobians", actual, &golden.link_velocities);
    errors.record(
        "centre of mass",
        arm.center_of_mass(q).iter().copied(),
        &golden.center_of_mass,
    );
}

fn task<const N: usize>(
    errors: &mut Errors,
    arm: &impl Arm<N>,
    State { q, .. }: &State<N>,
    golden: &Motion,
) {
    let rows: Vec<usize> = arm.task().iter().map(TaskRow::index).collect();
    let inertia = arm.task_space_inertia(q);
    let upper = rows.iter().enumerate().flat_map(|(place, row)| {
        let columns = rows[place..].iter();
        columns.map(|column| inertia[(*row, *column)])
    });
    errors.record("task-space inertia", upper, &golden.task_space_inertia);
    let inverse = arm.dynamically_consistent_inverse(q);
    let entries = (0..N).flat_map(|i| rows.iter().map(move |row| inverse[(i, *row)]));
    errors.record("consistent inverse", entries, &golden.consistent_inverse);
    let outside = (0..6).filter(|row| !rows.contains(row));
    for row in outside {
        let zeros =
            inertia.column(row).amax() + inertia.row(row).amax() + inverse.column(row).amax();
        errors.record("outside the task", [zeros], &[0.0]);
    }
    let (w, gradient) = arm.manipulability_gradient(q);
    errors.record("w", [w], &[golden.w]);
    errors.record("grad w", gradient.iter().copied(), &golden.gradient);
}
