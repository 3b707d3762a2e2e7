//! Arms of `arms/` that were converted from a maker's or a package's description, against Pinocchio on that description itself
//! (`oracle/golden_library.py`): a frame, a sign or a shift that went wrong on the way into the table would show.
//!
//! `cargo test --test oracle_library -- --nocapture` prints the largest errors.

use nalgebra::{SMatrix, SVector};
use serde::Deserialize;
use ulna::{Arm, Method, Parameter, SerialChain};
use ulna_codegen::{Generator, Interpreter};
use ulna_table::Model;

/// A line of `oracle/data/library/<arm>.jsonl`.
#[derive(Deserialize)]
struct Golden {
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    pose: Vec<f64>,
    mass_matrix: Vec<f64>,
    inverse_dynamics: Vec<f64>,
    gravity_torque: Vec<f64>,
}

const METHODS: &[Method] = &[
    Method::ForwardKinematics,
    Method::MassMatrix,
    Method::InverseDynamics,
    Method::GravityTorque,
];

/// What rounding may leave, relative to the largest entry of each quantity.
const TOLERANCE: f64 = 1e-13;

fn model(name: &str) -> Model {
    Model::load(format!("../arms/{name}.toml")).unwrap_or_else(|errors| panic!("{errors}"))
}

fn golden(name: &str) -> Vec<Golden> {
    let path = format!("oracle/data/library/{name}.jsonl");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let lines: Vec<_> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{path}: {error}")))
        .collect();
    assert_eq!(lines.len(), 10, "{path}");
    lines
}

fn equal(what: &str, actual: impl IntoIterator<Item = f64>, expected: &[f64]) -> f64 {
    let actual: Vec<f64> = actual.into_iter().collect();
    assert_eq!(actual.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
    let error = actual.iter().zip(expected).map(|(a, e)| (a - e).abs());
    let error = error.fold(0.0, f64::max) / scale;
    assert!(error <= TOLERANCE, "{what} is off by {error:.1e}");
    error
}

fn agrees<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let vector = |numbers: &[f64]| SVector::<f64, N>::from_column_slice(numbers);
    let upper = |matrix: SMatrix<f64, N, N>| {
        (0..N).flat_map(move |row| (row..N).map(move |column| matrix[(row, column)]))
    };
    let mut largest = 0.0_f64;
    for golden in golden(name) {
        let (q, qd, qdd) = (vector(&golden.q), vector(&golden.qd), vector(&golden.qdd));
        let what = |quantity| format!("{name}, {backend}: {quantity}");
        let pose = arm.forward_kinematics(&q).to_homogeneous();
        let pose = pose.fixed_rows::<3>(0).transpose();
        let errors = [
            equal(&what("pose"), pose.iter().copied(), &golden.pose),
            equal(&what("M"), upper(arm.mass_matrix(&q)), &golden.mass_matrix),
            equal(
                &what("inverse dynamics"),
                arm.inverse_dynamics(&q, &qd, &qdd).iter().copied(),
                &golden.inverse_dynamics,
            ),
            equal(
                &what("gravity torque"),
                arm.gravity_torque(&q).iter().copied(),
                &golden.gravity_torque,
            ),
        ];
        largest = errors.into_iter().fold(largest, f64::max);
    }
    println!("{name:14} {backend:10} {largest:8.1e}");
}

fn both<const N: usize>(name: &str) {
    let model = model(name);
    agrees(
        "textbook",
        name,
        &SerialChain::<N>::try_from(&model).unwrap(),
    );
    let compiled = Generator::new().methods(METHODS).compile(&model);
    agrees(
        "programs",
        name,
        &Interpreter::<N>::of(&model, compiled).unwrap(),
    );
}

#[test]
fn ur5e() {
    both::<6>("ur5e");
}

#[test]
fn franka_panda() {
    both::<7>("franka_panda");
}

#[test]
fn iiwa_14() {
    both::<7>("iiwa_14");
}

#[test]
fn gen3() {
    both::<7>("gen3");
}

/// The Stanford arm's moments of inertia are published about the origins of its links' frames; its table has them about the centroids.
#[test]
fn stanford_arm_has_pauls_moments_about_the_origins() {
    let published = [
        [0.276, 0.255, 0.071],
        [0.108, 0.018, 0.100],
        [2.51, 2.51, 0.006],
        [0.002, 0.001, 0.001],
        [0.003, 0.003, 0.0004],
        [0.013, 0.013, 0.0003],
    ];
    let model = model("stanford_arm");
    assert_eq!(model.joints().len(), published.len());
    let twists = [true, true, false, true, true, false]; // a quarter turn, after joint i
    for ((joint, published), twisted) in model.joints().iter().zip(published).zip(twists) {
        let parameters = joint.link.parameters();
        let moment = |moment: Parameter| parameters[moment.index()];
        // The model is in modified form, whose frame i is that of standard DH before the row's twist about x.
        let [xx, yy, zz] = [Parameter::Ixx, Parameter::Iyy, Parameter::Izz].map(moment);
        let moments = if twisted { [xx, zz, yy] } else { [xx, yy, zz] };
        equal("moments about the origin", moments, &published);
    }
}
