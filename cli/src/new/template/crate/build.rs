//! Compiles the table of the arm into `$OUT_DIR/my_arm.rs`, again whenever the table changes.

use ulna_codegen::{Generator, Method};

const TABLE: &str = "arms/my_arm.toml";

/// What becomes code. Every other method of `ulna::Arm` can be called all the same, and runs by the textbook formulas, slower:
/// add what your loop calls. `Generator::new()` without a list makes code of all, which takes longer to compile.
const METHODS: &[Method] = &[
    Method::ForwardKinematics,
    Method::GeometricJacobian,
    Method::MassMatrix,
    Method::BiasForce,
    Method::GravityTorque,
    Method::FrictionTorque,
    Method::InverseDynamics,
    Method::ForwardDynamics,
    // What the suppression of failures looks at in every cycle.
    Method::JacobianAndGradient,
    Method::LockImpacts,
];

fn main() -> Result<(), ulna_codegen::Error> {
    Generator::new().methods(METHODS).compile_arms(&[TABLE])
}
