//! The Puma 560 of `arms/` against what the tests of Corke's Robotics Toolbox, for Python and for Matlab, expect of theirs
//! (`oracle/data/puma_560.published.json`: numbers with the file and the test that they stand in), by the textbook and by the
//! interpreted programs, to the digits that are printed there.
//!
//! What their words mean here:
//! - `inertia` has the rotors, J G^2, on the diagonal, as [`Arm::mass_matrix`] has. `jointdynamics` refers it to the motor's side and
//!   counts the rotor once more: M_ii / G^2 + J.
//! - `coriolis` is Christoffel's matrix, to the last digit, though it is made otherwise.
//! - `gravity` points up there: their 9.81 is this table's -9.81. Torques have the same sign.
//! - `rne` and `accel` count friction, with a Coulomb torque for each way. A table has one for both ways, and so the arm is compared
//!   without friction, and theirs is added: B G^2 q' + |G| Tc.
//! - `fext` is a wrench on the tool that the arm exerts, in the tool's axes: it adds J'w, where a wrench of this library subtracts it.
//! - `inertia_x` and `cinertia` are Λ in the world's axes, at the origin of the last frame.

use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Deserializer};
use ulna::{Arm, Friction, Method, SerialChain};
use ulna_codegen::{Generator, Interpreter};
use ulna_table::Model;

type Vector6 = SVector<f64, 6>;

/// The file.
#[derive(Deserialize)]
struct Published {
    drives: Drives,
    expectations: Vec<Expectation>,
}

fn vector<'text, D: Deserializer<'text>>(text: D) -> Result<Vector6, D::Error> {
    <[f64; 6]>::deserialize(text).map(Vector6::from)
}

/// Motors and friction as given there: at the motor, Coulomb's with a size for each way of the joint.
#[derive(Deserialize)]
struct Drives {
    #[serde(deserialize_with = "vector")]
    ratio: Vector6,
    #[serde(deserialize_with = "vector")]
    rotor_inertia: Vector6,
    #[serde(deserialize_with = "vector")]
    viscous: Vector6,
    #[serde(deserialize_with = "vector")]
    coulomb_forwards: Vector6,
    #[serde(deserialize_with = "vector")]
    coulomb_backwards: Vector6,
}

#[derive(Deserialize)]
struct Expectation {
    source: String,
    quantity: Quantity,
    #[serde(default, deserialize_with = "vector")]
    q: Vector6,
    #[serde(default, deserialize_with = "vector")]
    qd: Vector6,
    #[serde(default, deserialize_with = "vector")]
    qdd: Vector6,
    #[serde(default, deserialize_with = "vector")]
    tau: Vector6,
    /// In the place of `tau`: the motion whose torque, with friction, it is.
    torque_of: Option<Motion>,
    /// In the tool's axes.
    #[serde(default, deserialize_with = "vector")]
    wrench: Vector6,
    /// Of the last digit printed.
    unit: Option<f64>,
    /// In the place of `unit`: how many digits are printed of each number.
    significant: Option<i32>,
    expected: Vec<f64>,
}

#[derive(Deserialize)]
struct Motion {
    #[serde(deserialize_with = "vector")]
    q: Vector6,
    #[serde(deserialize_with = "vector")]
    qd: Vector6,
    #[serde(deserialize_with = "vector")]
    qdd: Vector6,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Quantity {
    MassMatrix,
    /// M_ii / G^2 + J of joints 1 to 3.
    InertiaAtMotor,
    /// Of M_11 over 100 x 100 positions of joints 2 and 3, from -π to π.
    LargestOverLeastWaistInertia,
    CoriolisMatrix,
    GravityTorque,
    /// M q''.
    InertiaTorque,
    InverseDynamics,
    /// Inverse dynamics without gravity.
    WeightlessInverseDynamics,
    /// At rest, the tool exerting a wrench.
    TorqueWithWrench,
    ForwardDynamics,
    TaskSpaceInertia,
    Manipulability,
    ManipulabilityOfTranslation,
    ManipulabilityOfRotation,
}

const METHODS: &[Method] = &[
    Method::ForwardKinematics,
    Method::GeometricJacobian,
    Method::MassMatrix,
    Method::CoriolisMatrix,
    Method::GravityTorque,
    Method::InverseDynamics,
    Method::InverseDynamicsWithWrench,
    Method::ForwardDynamics,
    Method::TaskSpaceInertia,
    Method::ManipulabilityGradient,
];

fn published() -> Published {
    let text = include_str!("oracle/data/puma_560.published.json");
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}"))
}

fn table() -> Model {
    Model::load("../arms/puma_560.toml").unwrap_or_else(|errors| panic!("{errors}"))
}

fn without_friction() -> Model {
    let mut description = table().description();
    for joint in &mut description.joints {
        joint.friction = Friction::NONE;
    }
    Model::new(&description).unwrap_or_else(|errors| panic!("{errors}"))
}

impl Drives {
    /// Theirs, at the joints: none of Coulomb's at rest.
    fn friction(&self, qd: &Vector6) -> Vector6 {
        Vector6::from_fn(|i, _| {
            let coulomb = match qd[i] {
                rate if rate > 0.0 => self.coulomb_forwards[i],
                rate if rate < 0.0 => -self.coulomb_backwards[i],
                _ => 0.0,
            };
            self.ratio[i] * (self.viscous[i] * self.ratio[i] * qd[i] + coulomb)
        })
    }
}

impl Expectation {
    /// Half a unit of the last digit that is printed of a number.
    fn tolerance(&self, expected: f64) -> f64 {
        let unit = match (self.unit, self.significant) {
            (Some(unit), None) => unit,
            (None, Some(digits)) => {
                10.0_f64.powi(expected.abs().log10().floor() as i32 + 1 - digits)
            }
            _ => panic!("{}: either `unit` or `significant`", self.source),
        };
        0.5 * unit * (1.0 + 1e-6)
    }

    fn actual(&self, arm: &impl Arm<6>, drives: &Drives) -> Vec<f64> {
        let Self { q, qd, qdd, .. } = self;
        let volume =
            |jacobian: &SMatrix<f64, 3, 6>| (jacobian * jacobian.transpose()).determinant().sqrt();
        match self.quantity {
            Quantity::MassMatrix => rows(&arm.mass_matrix(q)),
            Quantity::InertiaAtMotor => {
                let m = arm.mass_matrix(q);
                let at_motor = |i| m[(i, i)] / drives.ratio[i].powi(2) + drives.rotor_inertia[i];
                (0..3).map(at_motor).collect()
            }
            Quantity::LargestOverLeastWaistInertia => vec![largest_over_least_waist_inertia(arm)],
            Quantity::CoriolisMatrix => rows(&arm.coriolis_matrix(q, qd)),
            Quantity::GravityTorque => entries(&arm.gravity_torque(q)),
            Quantity::InertiaTorque => {
                entries(&(arm.inverse_dynamics(q, &Vector6::zeros(), qdd) - arm.gravity_torque(q)))
            }
            Quantity::InverseDynamics => entries(&torque(arm, drives, q, qd, qdd)),
            Quantity::WeightlessInverseDynamics => {
                entries(&(torque(arm, drives, q, qd, qdd) - arm.gravity_torque(q)))
            }
            Quantity::TorqueWithWrench => {
                let axes = arm.forward_kinematics(q).rotation;
                let mut exerted = Vector6::zeros();
                for first in [0, 3] {
                    let part = axes * self.wrench.fixed_rows::<3>(first);
                    exerted.fixed_rows_mut::<3>(first).copy_from(&part);
                }
                entries(&arm.inverse_dynamics_with_wrench(q, qd, qdd, &-exerted))
            }
            Quantity::ForwardDynamics => {
                let tau = match &self.torque_of {
                    Some(Motion { q, qd, qdd }) => torque(arm, drives, q, qd, qdd),
                    None => self.tau,
                };
                entries(&arm.forward_dynamics(q, qd, &(tau - drives.friction(qd))))
            }
            Quantity::TaskSpaceInertia => rows(&arm.task_space_inertia(q)),
            Quantity::Manipulability => vec![arm.manipulability_gradient(q).0],
            Quantity::ManipulabilityOfTranslation => {
                vec![volume(
                    &arm.geometric_jacobian(q).fixed_rows::<3>(0).into_owned(),
                )]
            }
            Quantity::ManipulabilityOfRotation => {
                vec![volume(
                    &arm.geometric_jacobian(q).fixed_rows::<3>(3).into_owned(),
                )]
            }
        }
    }
}

/// With their friction.
fn torque(arm: &impl Arm<6>, drives: &Drives, q: &Vector6, qd: &Vector6, qdd: &Vector6) -> Vector6 {
    arm.inverse_dynamics(q, qd, qdd) + drives.friction(qd)
}

fn largest_over_least_waist_inertia(arm: &impl Arm<6>) -> f64 {
    let position =
        |i: u32| f64::from(i).mul_add(std::f64::consts::TAU / 99.0, -std::f64::consts::PI);
    let positions = (0..100).flat_map(|i| (0..100).map(move |j| (i, j)));
    let (least, largest) = positions.fold((f64::INFINITY, 0.0_f64), |(least, largest), (i, j)| {
        let q = Vector6::from([0.0, position(i), position(j), 0.0, 0.0, 0.0]);
        let inertia = arm.mass_matrix(&q)[(0, 0)];
        (least.min(inertia), largest.max(inertia))
    });
    largest / least
}

fn rows(matrix: &SMatrix<f64, 6, 6>) -> Vec<f64> {
    matrix.transpose().iter().copied().collect()
}

fn entries(vector: &Vector6) -> Vec<f64> {
    vector.iter().copied().collect()
}

fn agrees(backend: &str, arm: &impl Arm<6>) {
    let Published {
        drives,
        expectations,
    } = published();
    assert_eq!(expectations.len(), 30);
    let mut faults = Vec::new();
    for expectation in &expectations {
        let actual = expectation.actual(arm, &drives);
        assert_eq!(
            actual.len(),
            expectation.expected.len(),
            "{}",
            expectation.source
        );
        for (actual, expected) in actual.iter().zip(&expectation.expected) {
            let within = (actual - expected).abs() <= expectation.tolerance(*expected);
            if !within {
                let Expectation {
                    source, quantity, ..
                } = expectation;
                faults.push(format!(
                    "{backend}: {quantity:?} of {source}: {actual} for {expected}"
                ));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_textbook_equals_what_is_published() {
    let chain = SerialChain::<6>::try_from(&without_friction()).unwrap();
    agrees("textbook", &chain);
}

#[test]
fn the_programs_equal_what_is_published() {
    let model = without_friction();
    let compiled = Generator::new().methods(METHODS).compile(&model);
    agrees("programs", &Interpreter::<6>::of(&model, compiled).unwrap());
}

/// The table's friction is theirs at the joint, with the mean of Coulomb's two sizes; its rotors are theirs.
#[test]
fn friction_is_the_mean_of_both_ways() {
    let drives = published().drives;
    let model = table();
    for (i, joint) in model.joints().iter().enumerate() {
        let motor = joint.motor;
        assert_eq!(motor.ratio, drives.ratio[i]);
        assert_eq!(motor.inertia, drives.rotor_inertia[i]);
    }
    let chain = SerialChain::<6>::try_from(&model).unwrap();
    let forwards = Vector6::repeat(1.0);
    let odd = 0.5 * (drives.friction(&forwards) - drives.friction(&-forwards));
    // Coulomb's friction is smoothed: at 1 rad/s it lacks half a millionth.
    let relative = (chain.friction_torque(&forwards) - odd).component_div(&odd);
    assert!(relative.amax() < 1e-6, "{relative}");
}
