//! Numbers of an arm for programs in other languages, by both of our roads: the generated program, run without a compiler, and the textbook.
//!
//! ```text
//! cargo run -p ulna-codegen --example evaluate -- TABLE < STATES > VALUES
//! ```
//!
//! Reads a state a line, `{"q": [...], "qd": [...], "qdd": [...]}`, of N numbers each, SI and radians. Writes a line for each:
//! `{"generated": {...}, "textbook": {...}}`, both with
//!
//! - `pose`: world_from_tool, the first three rows of the 4×4 matrix;
//! - `jacobian`: geometric, 6×N, `[v; ω]` in world axes at the tool point;
//! - `mass_matrix`: N×N; `inverse_dynamics` at q, qd, qdd, with friction; `gravity_torque`.
//!
//! Matrices are lists of rows. `urdf/public/run.py` compares them with Pinocchio's.

use std::error::Error;
use std::io::{self, BufRead, Write};

use nalgebra::{DimName, Matrix, RawStorage, SVector};
use serde_json::{Value, json};
use ulna::{Arm, Method, SerialChain};
use ulna_codegen::{Generator, Interpreter};
use ulna_table::Model;

/// The arguments of a method, in the order in which a state names them.
const ARGUMENTS: [&str; 3] = ["q", "qd", "qdd"];

fn main() -> Result<(), Box<dyn Error>> {
    let table = std::env::args_os()
        .nth(1)
        .ok_or("usage: evaluate TABLE < STATES > VALUES")?;
    let model = Model::load(table)?;
    macro_rules! dispatch {
        ($($joints:literal)+) => {
            match model.joints().len() {
                $($joints => evaluate::<$joints>(&model),)+
                joints => Err(format!("arm `{}` has {joints} joints; this example goes to 16", model.name()).into()),
            }
        };
    }
    dispatch!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16)
}

fn evaluate<const N: usize>(model: &Model) -> Result<(), Box<dyn Error>> {
    let methods = [
        Method::ForwardKinematics,
        Method::GeometricJacobian,
        Method::MassMatrix,
        Method::InverseDynamics,
        Method::GravityTorque,
    ];
    let generator = Generator::new().methods(&methods);
    let generated = Interpreter::<N>::of(model, generator.compile(model))?;
    let textbook = SerialChain::<N>::try_from(model)?;
    let mut out = io::stdout().lock();
    for (number, line) in (1..).zip(io::stdin().lock().lines()) {
        let state = state(&line?).map_err(|wrong| format!("line {number}: {wrong}"))?;
        let values = json!({ "generated": values(&generated, &state), "textbook": values(&textbook, &state) });
        writeln!(out, "{values}")?;
    }
    Ok(())
}

/// A line's vectors, in the order of [`ARGUMENTS`].
fn state<const N: usize>(line: &str) -> Result<[SVector<f64, N>; 3], String> {
    let state: Value = serde_json::from_str(line).map_err(|error| error.to_string())?;
    let mut vectors = [SVector::<f64, N>::zeros(); 3];
    for (vector, name) in vectors.iter_mut().zip(ARGUMENTS) {
        let numbers: Option<Vec<f64>> = state[name]
            .as_array()
            .and_then(|list| list.iter().map(Value::as_f64).collect());
        let numbers = numbers.filter(|numbers| numbers.len() == N);
        let numbers = numbers.ok_or_else(|| format!("`{name}` is not a list of {N} numbers"))?;
        vector.copy_from_slice(&numbers);
    }
    Ok(vectors)
}

fn values<const N: usize>(arm: &impl Arm<N>, [q, qd, qdd]: &[SVector<f64, N>; 3]) -> Value {
    let pose = arm.forward_kinematics(q).to_homogeneous();
    json!({
        "pose": rows(&pose.fixed_rows::<3>(0).into_owned()),
        "jacobian": rows(&arm.geometric_jacobian(q)),
        "mass_matrix": rows(&arm.mass_matrix(q)),
        "inverse_dynamics": arm.inverse_dynamics(q, qd, qdd).as_slice(),
        "gravity_torque": arm.gravity_torque(q).as_slice(),
    })
}

/// A matrix as the list of its rows.
fn rows<R: DimName, C: DimName, S: RawStorage<f64, R, C>>(
    matrix: &Matrix<f64, R, C, S>,
) -> Vec<Vec<f64>> {
    matrix
        .row_iter()
        .map(|row| row.iter().copied().collect())
        .collect()
}
