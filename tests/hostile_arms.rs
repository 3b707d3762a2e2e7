//! Small arms that a table can describe and that ask for too much: each found something wrong once.

use nalgebra::{SVector, vector};
use ulna::{Arm, SerialChain};
use ulna_codegen::Interpreter;
use ulna_table::Model;

/// A joint of an arm: what stands under its `[[joint]]`, and its link's mass, centroid and inertia.
struct Row {
    joint: &'static str,
    mass: f64,
    com: [f64; 3],
    inertia: [f64; 3],
}

/// A joint whose link is a body of mass 1 and inertia 1 about its centroid, at the joint's origin.
const PLAIN: Row = Row {
    joint: "theta = 0\nd = 0\na = 0\nalpha = 0",
    mass: 1.0,
    com: [0.0; 3],
    inertia: [1.0; 3],
};

fn table(rows: &str, rest: &str, joints: &[Row]) -> String {
    let joints = joints.iter().map(|row| {
        let Row {
            joint,
            mass,
            com: [x, y, z],
            inertia: [xx, yy, zz],
        } = row;
        format!(
            "[[joint]]\n{joint}\n[joint.link]\nmass = {mass:?}\ncom = [{x:?}, {y:?}, {z:?}]\n\
             inertia = {{ xx = {xx:?}, yy = {yy:?}, zz = {zz:?} }}\n"
        )
    });
    format!(
        "name = \"hostile\"\nconvention = \"modified\"\nangle_unit = \"deg\"\n[task]\nrows = {rows}\n{rest}\n{}",
        joints.collect::<String>()
    )
}

fn model(text: &str) -> Model {
    Model::parse(text, "hostile.toml").unwrap_or_else(|errors| panic!("{errors}\n{text}"))
}

/// The textbook, the emitted programs, and the same with twice as many digits.
fn arms<const N: usize>(text: &str) -> (SerialChain<N>, Interpreter<N>, Interpreter<N>) {
    let model = model(text);
    let joints = "the table has as many joints as the test says";
    let programs = Interpreter::new(&model).expect(joints);
    let exact = programs.exact();
    let chain = SerialChain::try_from(&model).expect(joints);
    (chain, programs, exact)
}

fn near<const N: usize>(
    (w, gradient): (f64, SVector<f64, N>),
    (exact_w, exact): (f64, SVector<f64, N>),
    tolerance: f64,
) {
    let size = exact.amax().max(exact_w);
    let error = (gradient - exact).amax().max((w - exact_w).abs()) / size;
    assert!(
        error <= tolerance,
        "off by {error:e}: {w:e} {gradient} for {exact_w:e} {exact}"
    );
}

/// The constants of such a task fold to 0/0.
#[test]
fn a_task_that_is_singular_everywhere_is_all_zeros_and_a_warning() {
    let planar = Row {
        joint: "theta = 0\nd = 0\na = 1\nalpha = 0",
        com: [0.5, 0.0, 0.0],
        ..PLAIN
    };
    let tables = [
        table("[\"x\", \"y\"]", "", &[PLAIN, PLAIN]),
        table("[\"z\", \"rz\"]", "", &[PLAIN, Row { ..planar }]),
        table(
            "[\"rz\", \"rx\"]",
            "[base]\nrpy = [10, 20, 30]",
            &[PLAIN, Row { ..planar }],
        ),
    ];
    for text in tables {
        let generated = ulna_codegen::generate(&model(&text), "hostile.toml");
        let [warning] = generated.warnings() else {
            panic!("{:?}", generated.warnings());
        };
        assert!(
            warning.contains("w_D is 0 in every configuration"),
            "{warning}"
        );
        let source = generated.source();
        assert!(
            !source.contains("NaN") && !source.contains("INFINITY"),
            "{source}"
        );
        let (chain, emitted, _) = arms::<2>(&text);
        let zero = (0.0, SVector::zeros());
        let q = vector![0.3, -0.7];
        assert_eq!(chain.dynamic_manipulability_gradient(&q), zero);
        assert_eq!(emitted.dynamic_manipulability_gradient(&q), zero);
        assert_eq!(emitted.dynamic_manipulability(&q), 0.0);
        let difference = emitted.mass_matrix(&q) - chain.mass_matrix(&q);
        assert!(difference.amax() < 1e-15);
    }
}

/// Rounding would swallow the lighter link, and M would not be positive definite.
#[test]
fn a_link_too_light_for_what_it_carries_is_refused() {
    let light = Row {
        inertia: [1e-11; 3],
        ..PLAIN
    };
    let heavy = Row {
        inertia: [1e7; 3],
        ..PLAIN
    };
    let text = table("[\"rz\"]", "", &[light, heavy]);
    let errors = Model::parse(&text, "hostile.toml").unwrap_err().to_string();
    assert!(
        errors.contains("drowns in the rounding of what joint 1 carries")
            && errors.contains("hostile.toml:15")
            && errors.contains("at least"),
        "{errors}"
    );
}

/// A gradient whose error once went as one over the square of the last inertia.
#[test]
fn a_light_last_link_costs_no_digits() {
    for inertia in [1e-4, 1e-6, 1e-8, 1e-10] {
        let first = Row {
            joint: "theta = 0\nd = 0.2\na = 0\nalpha = 0",
            mass: 2.0,
            com: [0.3, 0.0, 0.0],
            inertia: [0.1, 0.2, 0.2],
        };
        let last = Row {
            joint: "theta = 0\nd = 0\na = 0.5\nalpha = 90",
            mass: 0.3,
            com: [0.0; 3],
            inertia: [inertia; 3],
        };
        let text = table(
            "[\"x\", \"z\"]",
            "[tool]\nxyz = [0.1, 0.2, 0.3]",
            &[first, last],
        );
        let (chain, emitted, exact) = arms::<2>(&text);
        for state in ulna::proof::states(&chain).take(20) {
            let expected = exact.dynamic_manipulability_gradient(&state.q);
            near(
                emitted.dynamic_manipulability_gradient(&state.q),
                expected,
                1e-12,
            );
            near(
                chain.dynamic_manipulability_gradient(&state.q),
                expected,
                1e-12,
            );
            // What a comparison allows would have found the 6e-9 to 0.32 that were lost here.
            let condition = ulna::proof::condition(&chain, &chain, &state.q);
            assert!(condition < 1e5, "{condition:e}");
        }
    }
}

/// The rule for singular poses once compared rows of H, which have no common unit.
#[test]
fn masses_do_not_make_a_pose_singular() {
    let slide = Row {
        joint: "kind = \"prismatic\"\ntheta = 0\nd = 0\na = 0\nalpha = 0",
        mass: 1000.0,
        ..PLAIN
    };
    let turn = Row {
        mass: 0.01,
        inertia: [1e-8; 3],
        ..PLAIN
    };
    let (chain, emitted, exact) = arms::<2>(&table("[\"z\", \"rz\"]", "", &[slide, turn]));
    let q = vector![0.4, 1.1];
    let expected = 1.0 / (1000.01 * 1e-8);
    assert!((exact.dynamic_manipulability(&q) / expected - 1.0).abs() < 1e-15);
    near(
        emitted.dynamic_manipulability_gradient(&q),
        (expected, SVector::zeros()),
        1e-14,
    );
    near(
        chain.dynamic_manipulability_gradient(&q),
        (expected, SVector::zeros()),
        1e-14,
    );
}

/// However far out a prismatic joint is: M once lost the first joint's own inertia.
#[test]
fn a_prismatic_joint_far_out_leaves_numbers() {
    let slide = Row {
        joint: "kind = \"prismatic\"\ntheta = 0\nd = 0\na = 0\nalpha = 90",
        ..PLAIN
    };
    let (chain, emitted, _) = arms::<3>(&table("[\"x\", \"y\"]", "", &[PLAIN, PLAIN, slide]));
    let (qd, tau) = (vector![0.1, -0.2, 0.3], vector![1.0, 2.0, 3.0]);
    for out in [1e3, 1e6, 1e8, 1e9, 1e300, f64::MAX] {
        for q in [vector![0.0, 0.0, out], vector![0.3, 1.0, -out]] {
            for arm in [&chain as &dyn Arm<3>, &emitted] {
                let acceleration = arm.forward_dynamics(&q, &qd, &tau);
                assert!(
                    acceleration.iter().all(|x| x.is_finite()),
                    "{out:e}: {acceleration}"
                );
                let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
                assert!(
                    w.is_finite() && gradient.iter().all(|x| x.is_finite()),
                    "{out:e}"
                );
            }
        }
    }
}

/// Closer and closer to a stretched elbow, until the rule says that there is nothing but rounding.
#[test]
fn digits_are_kept_beside_a_singular_pose() {
    let path = format!("{}/../arms/planar_2r.toml", env!("CARGO_MANIFEST_DIR"));
    let (chain, emitted, exact) = arms::<2>(&std::fs::read_to_string(path).expect("the table"));
    for elbow in [1e-3, 1e-6, 1e-9, 1e-10, 1e-12, 1e-13] {
        let q = vector![0.3, elbow];
        let expected = exact.dynamic_manipulability_gradient(&q);
        assert!(expected.0 > 0.0 && expected.1.amax() > 1.0);
        near(emitted.dynamic_manipulability_gradient(&q), expected, 1e-13);
        near(chain.dynamic_manipulability_gradient(&q), expected, 1e-13);
    }
    for elbow in [1e-15, 0.0] {
        let q = vector![0.3, elbow];
        let zero = (0.0, SVector::zeros());
        assert_eq!(emitted.dynamic_manipulability_gradient(&q), zero);
        assert_eq!(chain.dynamic_manipulability_gradient(&q), zero);
    }
}

/// Two axes a thousandth of a degree from parallel; the second turns the tool's direction hardly at all.
#[test]
fn axes_that_are_nearly_parallel_keep_their_digits() {
    let bent = Row {
        joint: "theta = 20\nd = 0.1\na = 0.4\nalpha = 0.001",
        com: [0.2, 0.0, 0.1],
        ..PLAIN
    };
    for rows in ["[\"x\", \"rx\"]", "[\"y\", \"z\"]", "[\"rx\", \"rz\"]"] {
        let joints = [
            Row {
                com: [0.1, 0.2, 0.0],
                ..PLAIN
            },
            Row { ..bent },
        ];
        let text = table(rows, "[tool]\nxyz = [0.3, 0.1, 0.2]", &joints);
        let (chain, emitted, exact) = arms::<2>(&text);
        for state in ulna::proof::states(&chain).take(20) {
            let expected = exact.dynamic_manipulability_gradient(&state.q);
            near(
                emitted.dynamic_manipulability_gradient(&state.q),
                expected,
                1e-9,
            );
            near(
                chain.dynamic_manipulability_gradient(&state.q),
                expected,
                1e-9,
            );
        }
    }
}

/// What is no configuration has no w_D, whatever the backend.
#[test]
fn a_configuration_that_is_no_number_gives_none() {
    let slide = Row {
        joint: "kind = \"prismatic\"\ntheta = 0\nd = 0.5\na = 0.2\nalpha = 90",
        ..PLAIN
    };
    let arm = Row {
        com: [0.1, 0.2, 0.0],
        ..PLAIN
    };
    let (chain, emitted, exact) = arms::<2>(&table("[\"x\", \"y\"]", "", &[arm, slide]));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for q in [vector![bad, 0.5], vector![0.5, bad]] {
            for arm in [&chain as &dyn Arm<2>, &emitted, &exact] {
                let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
                assert!(
                    w.is_nan() && arm.dynamic_manipulability(&q).is_nan(),
                    "{q}: {w}"
                );
                assert!(gradient.iter().any(|x| x.is_nan()), "{q}: {gradient}");
                let acceleration = arm.forward_dynamics(&q, &q, &q);
                assert!(
                    acceleration.iter().any(|x| !x.is_finite()),
                    "{q}: {acceleration}"
                );
            }
        }
    }
}

/// Sums of large angles once cost digits.
#[test]
fn many_turns_cost_no_digits() {
    let path = format!("{}/../arms/ssrms.toml", env!("CARGO_MANIFEST_DIR"));
    let (chain, emitted, exact) = arms::<7>(&std::fs::read_to_string(path).expect("the table"));
    for state in ulna::proof::states(&chain).take(10) {
        for size in [5.0, 1e3, 1e6] {
            let q = state.q * size;
            let expected = exact.geometric_jacobian(&q);
            for found in [emitted.geometric_jacobian(&q), chain.geometric_jacobian(&q)] {
                assert!(
                    (found - expected).amax() < 1e-13 * expected.amax(),
                    "{size:e}"
                );
            }
        }
    }
}
