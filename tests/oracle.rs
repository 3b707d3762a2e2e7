//! Every arm of `arms/` against numbers made outside: Pinocchio's, and mpmath's to 40 digits (`tests/oracle/*.py`).
//!
//! `cargo test --test oracle -- --nocapture` prints the largest errors.

use nalgebra::{SMatrix, SVector};
use serde::Deserialize;
use ulna::{Arm, SerialChain};
use ulna_table::Model;

/// A line of `data/<arm>.jsonl`.
#[derive(Deserialize)]
struct Golden {
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    tau: Vec<f64>,
    pose: Vec<f64>,
    jacobian: Vec<f64>,
    jacobian_rate: Vec<f64>,
    mass_matrix: Vec<f64>,
    mass_matrix_rate: Vec<f64>,
    inverse_dynamics: Vec<f64>,
    bias_force: Vec<f64>,
    gravity_torque: Vec<f64>,
    forward_dynamics: Vec<f64>,
}

/// A line of `data/<arm>.manipulability.jsonl`.
#[derive(Deserialize)]
struct Manipulability {
    w: f64,
    gradient: Vec<f64>,
    inverse_mass_matrix: Vec<f64>,
    condition: f64,
}

/// What rounding may leave of Pinocchio's quantities, relative to the largest entry of each.
const PINOCCHIO: f64 = 1e-12;
/// And of w_D and its gradient.
const MPMATH: f64 = 1e-11;

fn read<Line: for<'a> Deserialize<'a>>(file: &str) -> Vec<Line> {
    let path = format!("{}/oracle/data/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let lines: Vec<Line> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{path}: {error}")))
        .collect();
    assert_eq!(lines.len(), 100, "{path}");
    lines
}

fn chain<const N: usize>(name: &str) -> SerialChain<N> {
    let path = format!("{}/../arms/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let model = Model::load(path).unwrap_or_else(|errors| panic!("{errors}"));
    SerialChain::try_from(&model).unwrap_or_else(|error| panic!("{error}"))
}

/// The largest errors seen, by quantity.
#[derive(Default)]
struct Errors(Vec<(&'static str, f64)>);

impl Errors {
    /// The largest difference, relative to the largest expected entry (to 1 where all of them are 0).
    fn record(
        &mut self,
        quantity: &'static str,
        actual: impl IntoIterator<Item = f64>,
        expected: &[f64],
    ) {
        let actual: Vec<f64> = actual.into_iter().collect();
        assert_eq!(actual.len(), expected.len(), "{quantity}");
        let scale = expected.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
        let difference = actual.iter().zip(expected).fold(0.0_f64, |max, (a, e)| {
            assert!(!a.is_nan(), "{quantity} is NaN");
            max.max((a - e).abs())
        });
        let error = if scale == 0.0 {
            difference
        } else {
            difference / scale
        };
        match self.0.iter_mut().find(|(name, _)| *name == quantity) {
            Some((_, largest)) => *largest = largest.max(error),
            None => self.0.push((quantity, error)),
        }
    }

    #[track_caller]
    fn check(&self, arm: &str, tolerance: f64) {
        for (quantity, error) in &self.0 {
            println!("{arm:28} {quantity:18} {error:8.1e}");
        }
        for (quantity, error) in &self.0 {
            assert!(
                *error <= tolerance,
                "{arm}: {quantity} is off by {error:.1e}"
            );
        }
    }
}

fn row_by_row<const R: usize, const C: usize>(matrix: &SMatrix<f64, R, C>) -> Vec<f64> {
    matrix.transpose().iter().copied().collect()
}

fn upper_triangle<const N: usize>(matrix: &SMatrix<f64, N, N>) -> Vec<f64> {
    let entries = (0..N).flat_map(|r| (r..N).map(move |c| (r, c)));
    entries.map(|entry| matrix[entry]).collect()
}

fn agrees_with_pinocchio<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let mut errors = Errors::default();
    for golden in read::<Golden>(&format!("{name}.jsonl")) {
        let [q, qd, qdd, tau] = [&golden.q, &golden.qd, &golden.qdd, &golden.tau]
            .map(|values| SVector::<f64, N>::from_column_slice(values));
        let pose = arm.forward_kinematics(&q).to_homogeneous();
        errors.record(
            "pose",
            row_by_row(&pose.fixed_rows::<3>(0).into_owned()),
            &golden.pose,
        );
        errors.record(
            "J",
            row_by_row(&arm.geometric_jacobian(&q)),
            &golden.jacobian,
        );
        let dj = arm.jacobian_derivatives(&q);
        let rate: SMatrix<f64, 6, N> = (0..N).map(|i| dj[i] * qd[i]).sum();
        errors.record("dJ along qd", row_by_row(&rate), &golden.jacobian_rate);
        errors.record(
            "M",
            upper_triangle(&arm.mass_matrix(&q)),
            &golden.mass_matrix,
        );
        let dm = arm.mass_matrix_derivatives(&q);
        let rate: SMatrix<f64, N, N> = (0..N).map(|i| dm[i] * qd[i]).sum();
        errors.record(
            "dM along qd",
            upper_triangle(&rate),
            &golden.mass_matrix_rate,
        );
        let vectors = [
            (
                "inverse dynamics",
                arm.inverse_dynamics(&q, &qd, &qdd),
                &golden.inverse_dynamics,
            ),
            ("bias force", arm.bias_force(&q, &qd), &golden.bias_force),
            (
                "gravity torque",
                arm.gravity_torque(&q),
                &golden.gravity_torque,
            ),
            (
                "forward dynamics",
                arm.forward_dynamics(&q, &qd, &tau),
                &golden.forward_dynamics,
            ),
        ];
        for (quantity, actual, expected) in vectors {
            errors.record(quantity, actual.iter().copied(), expected);
        }
    }
    errors.check(&format!("{backend} {name}"), PINOCCHIO);
}

fn agrees_with_40_digits<const N: usize>(backend: &str, name: &str, arm: &impl Arm<N>) {
    let configurations = read::<Golden>(&format!("{name}.jsonl"));
    let exact = read::<Manipulability>(&format!("{name}.manipulability.jsonl"));
    let mut errors = Errors::default();
    let mut worst_condition = 0.0_f64;
    for (golden, exact) in configurations.iter().zip(exact) {
        let q = SVector::<f64, N>::from_column_slice(&golden.q);
        let (w, gradient) = arm.dynamic_manipulability_gradient(&q);
        errors.record("w_D", [arm.dynamic_manipulability(&q)], &[exact.w]);
        errors.record("w_D with gradient", [w], &[exact.w]);
        errors.record("grad w_D", gradient.iter().copied(), &exact.gradient);
        errors.record(
            "inverse of M",
            upper_triangle(&arm.inverse_mass_matrix(&q)),
            &exact.inverse_mass_matrix,
        );
        worst_condition = worst_condition.max(exact.condition);
    }
    println!("{backend} {name}: condition of H up to {worst_condition:.0}");
    errors.check(&format!("{backend} {name}"), MPMATH);
}

macro_rules! backends {
    ($(($Type:ident, $name:ident, $n:literal))*) => {
        mod generic {
            $(mod $name {
                crate::both!("generic", stringify!($name), crate::chain::<$n>(stringify!($name)));
            })*
        }

        mod generated {
            $(mod $name {
                crate::both!("generated", stringify!($name), ulna_generated::$Type);
            })*
        }
    };
}

macro_rules! both {
    ($backend:literal, $name:expr, $arm:expr) => {
        #[test]
        fn agrees_with_pinocchio() {
            crate::agrees_with_pinocchio($backend, $name, &$arm);
        }

        #[test]
        fn agrees_with_40_digits() {
            crate::agrees_with_40_digits($backend, $name, &$arm);
        }
    };
}
use both;

ulna_generated::for_each_arm!(backends);
