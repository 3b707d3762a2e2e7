//! Two ways to ∂q̈, one value.

use std::path::Path;

use ulna::{Method, Payload};
use ulna_codegen::DoubleDouble;
use ulna_codegen::internal::{Arguments, Chain, Choices, Graph, Scalar, formulate, schedule};
use ulna_table::Model;

#[test]
fn slopes_of_torques_or_an_inverse_dynamics_lead_to_the_same_derivatives() {
    for arm in [
        "planar_2r",
        "ssrms",
        "oblique_6",
        "table1_literal",
        "geared_6",
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../arms/{arm}.toml"));
        let model = Model::load(path).unwrap_or_else(|errors| panic!("{errors}"));
        let wave = |speed: f64| -> Vec<f64> {
            let joints = 0..model.joints().len();
            joints.map(|i| ((i as f64 + 1.3) * speed).sin()).collect()
        };
        let (q, qd, tau) = (wave(1.7), wave(2.3), wave(0.77));
        let run = |by_slopes: bool| {
            let choices = Choices {
                by_slopes,
                ..Choices::default()
            };
            let graph = Graph::new();
            let chain = Chain::new(&graph, &model);
            let outputs = formulate(Method::ForwardDynamicsDerivatives, &chain, choices);
            let program = schedule(&graph, &outputs);
            println!(
                "{arm}, by slopes {by_slopes}: {} operations",
                program.steps.len()
            );
            let arguments = Arguments {
                q: &q,
                qd: &qd,
                tau: &tau,
                payload: &[0.0; Payload::PARAMETERS],
                ..Arguments::default()
            };
            DoubleDouble::run(&program, arguments)
        };
        let expected = run(false);
        let largest = expected.iter().fold(0.0_f64, |all, x| all.max(x.abs()));
        for (found, expected) in run(true).iter().zip(&expected) {
            assert!(
                (found - expected).abs() <= 1e-14 * largest,
                "{arm}: {found} for {expected}"
            );
        }
    }
}
