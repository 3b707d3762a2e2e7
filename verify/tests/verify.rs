//! What is right passes, at any number of joints; what is broken does not.

use ulna::proof::{self, differences};
use ulna::{Method, SerialChain};
use ulna_codegen::{Generator, Interpreter};
use ulna_table::Model;
use ulna_verify::verify;

/// The elbow of `planar_2r` again and again.
fn long_arm(joints: usize) -> Model {
    let planar = include_str!("../../arms/planar_2r.toml");
    let (head, joint) = planar.rsplit_once("[[joint]]").unwrap();
    let elbows = format!("[[joint]]{joint}").repeat(joints - 1);
    Model::parse(&format!("{head}{elbows}"), "long.toml").unwrap()
}

/// Whatever is done side by side, and in however many batches.
#[test]
fn reports_are_those_of_one_state_after_another() {
    const SAMPLES: usize = 70;
    let model = Model::load("../arms/planar_2r.toml").unwrap();
    let generator = Generator::new().methods(&[
        Method::MassMatrix,
        Method::JacobianDerivatives,
        Method::DynamicManipulabilityGradient,
    ]);
    let found = verify(&model, generator.compile(&model), SAMPLES, &|| ()).unwrap();
    let chain = SerialChain::<2>::try_from(&model).unwrap();
    let emitted = Interpreter::<2>::of(&model, generator.compile(&model)).unwrap();
    let (exact, methods) = (emitted.exact(), generator.chosen());
    let states = || proof::states(&chain).take(SAMPLES);
    assert_eq!(
        found.emitted,
        proof::compare_with(&emitted, &exact, &chain, states()).of(methods)
    );
    assert_eq!(
        found.textbook,
        proof::compare_with(&chain, &exact, &chain, states()).of(methods)
    );
    assert_eq!(
        found.differences,
        differences::compare(&emitted, &chain, states()).of(methods)
    );
    assert!(found.passes());
}

#[test]
fn every_number_of_joints_is_compared() {
    let generator = Generator::new().methods(&[Method::GeometricJacobian]);
    // The task has two rows, for which one joint is not enough.
    for joints in 2..=Model::MAX_JOINTS {
        let model = long_arm(joints);
        let found = verify(&model, generator.compile(&model), 2, &|| ()).unwrap();
        assert!(found.passes(), "{joints} joints: {}", found.textbook);
        assert_eq!(found.textbook.states(), 2);
    }
}

/// Two entries of M in each other's place.
#[test]
fn a_broken_program_does_not_pass() {
    for joints in [3, 13] {
        let model = long_arm(joints);
        let generator = Generator::new().methods(&[Method::MassMatrix]);
        let mut compiled = generator.compile(&model);
        compiled.methods[0].program.outputs[0].elements.swap(0, 1);
        let found = verify(&model, compiled, 2, &|| ()).unwrap();
        assert!(found.emitted.passes() && !found.textbook.passes());
        assert!(!found.passes());
    }
}
