//! Two ways to M's factors, one gradient.

use std::path::Path;

use ulna::{JointKind, Method, Payload};
use ulna_codegen::internal::{Arguments, Chain, Choices, Graph, Scalar, formulate, schedule};
use ulna_codegen::{DoubleDouble, Program};
use ulna_table::Model;

fn gradient(model: &Model, articulated: bool) -> Program {
    let choices = Choices {
        articulated,
        ..Choices::default()
    };
    let graph = Graph::new();
    let chain = Chain::new(&graph, model);
    let outputs = formulate(Method::DynamicManipulabilityGradient, &chain, choices);
    schedule(&graph, &outputs)
}

fn run<R: Scalar>(program: &Program, q: &[f64]) -> Vec<f64> {
    let arguments = Arguments {
        q,
        payload: &[0.0; Payload::PARAMETERS],
        ..Arguments::default()
    };
    R::run(program, arguments)
}

/// The largest difference, relative to the largest value.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let largest = b.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let pairs = a.iter().zip(b);
    pairs.fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs())) / largest
}

fn configurations(model: &Model) -> Vec<Vec<f64>> {
    let q = |k: usize| {
        let joints = model.joints().iter().enumerate();
        joints.map(move |(i, joint)| {
            let x = ((k * 7 + i * 3) as f64 * 0.618_033_988_749_894_9).fract() - 0.5;
            match joint.kind {
                JointKind::Revolute => 6.0 * x,
                JointKind::Prismatic => x,
            }
        })
    };
    (1..6).map(|k| q(k).collect()).collect()
}

#[test]
fn articulated_bodies_lead_to_the_same_gradient() {
    for arm in [
        "planar_2r",
        "ssrms",
        "oblique_6",
        "table1_literal",
        "geared_6",
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../arms/{arm}.toml"));
        let model = Model::load(path).unwrap_or_else(|errors| panic!("{errors}"));
        let (by_mass, by_bodies) = (gradient(&model, false), gradient(&model, true));
        println!(
            "{arm}: {} and {} operations",
            by_mass.steps.len(),
            by_bodies.steps.len()
        );
        for q in configurations(&model) {
            let expected = run::<DoubleDouble>(&by_mass, &q);
            let found = run::<DoubleDouble>(&by_bodies, &q);
            assert!(
                difference(&found, &expected) < 1e-15,
                "{arm}: {found:?} for {expected:?}"
            );
        }
    }
}

/// A wrist of dummy links with a heavy hand: beside the pose where its first and last axes are one line, M loses the first link.
#[test]
fn light_links_that_carry_a_heavy_one_keep_their_digits() {
    keep_their_digits("");
}

/// A rotor holds a share of what its joint takes off, however small it is, and costs no digit.
#[test]
fn light_rotors_keep_their_digits_too() {
    for inertia in [1e-12, 1e-9] {
        keep_their_digits(&format!("motor = {{ inertia = {inertia:?} }}\n"));
    }
}

fn keep_their_digits(motor: &str) {
    let joint = |theta: f64, alpha: f64, mass: f64, inertia: f64| {
        format!(
            "[[joint]]\n{motor}theta = {theta}\nd = 0.0\na = 0.0\nalpha = {alpha}\n[joint.link]\nmass = {mass}\n\
             com = [0.0, 0.0, 0.0]\ninertia = {{ xx = {inertia:?}, yy = {inertia:?}, zz = {inertia:?} }}\n"
        )
    };
    let text = format!(
        "name = \"wrist\"\nconvention = \"modified\"\nangle_unit = \"deg\"\n[task]\nrows = [\"rx\", \"rz\"]\n{}{}{}",
        joint(0.0, 0.0, 1e-3, 1e-9),
        joint(0.0, 90.0, 1e-3, 1e-9),
        joint(0.0, -90.0, 50.0, 3.0),
    );
    let model = Model::parse(&text, "wrist.toml").unwrap_or_else(|errors| panic!("{errors}"));
    let (by_mass, by_bodies) = (gradient(&model, false), gradient(&model, true));
    let mut worst = 0.0_f64;
    for bend in [1.0, 1e-2, 1e-4] {
        let q = [0.3, bend, -0.4];
        let exact = run::<DoubleDouble>(&by_bodies, &q);
        let [mass, bodies] =
            [&by_mass, &by_bodies].map(|program| difference(&run::<f64>(program, &q), &exact));
        println!("bend {bend:e}: by M {mass:e}, by articulated bodies {bodies:e}");
        assert!(bodies < 1e-14, "{bodies:e} at {bend:e}");
        worst = worst.max(mass);
    }
    assert!(worst > 1e-10, "M keeps the light link after all: {worst:e}");
}
