//! The arm moves as the description says: tool, Jacobian, mass matrix and gravity against homogeneous matrices of the description's own tree.

mod tree;

use approx::assert_relative_eq;
use nalgebra::{Matrix4, SMatrix, SVector, Vector3, Vector6};
use proptest::prelude::*;
use ulna::{Arm, SerialChain};
use ulna_table::Model;
use ulna_urdf::{Import, Imported};

use tree::{Body, Kind, Link, Random, Robot, inertia, origin};

const GRAVITY: f64 = 9.81;

/// What the tree says at `q`.
struct Truth<const N: usize> {
    tool: Matrix4<f64>,
    jacobian: SMatrix<f64, 6, N>,
    mass_matrix: SMatrix<f64, N, N>,
    gravity_torque: SVector<f64, N>,
}

impl<const N: usize> Truth<N> {
    fn of(robot: &Robot, q: &SVector<f64, N>) -> Self {
        let poses = robot.poses(q.as_slice());
        let mut mass_matrix = SMatrix::<f64, N, N>::zeros();
        let mut gravity_torque = SVector::<f64, N>::zeros();
        for (index, link) in robot.links.iter().enumerate() {
            let Some(body) = &link.body else { continue };
            let pose = poses[index] * origin(body.xyz, body.rpy);
            let turn = pose.fixed_view::<3, 3>(0, 0).into_owned();
            let inertia = turn * inertia(body) * turn.transpose();
            let jacobian = Self::jacobian(robot, &poses, index, point(&pose));
            let linear = jacobian.fixed_rows::<3>(0).into_owned();
            let angular = jacobian.fixed_rows::<3>(3).into_owned();
            mass_matrix += linear.transpose() * linear * body.mass;
            mass_matrix += angular.transpose() * inertia * angular;
            gravity_torque += linear.transpose() * Vector3::z() * (body.mass * GRAVITY);
        }
        let tip = robot.links.len() - 1;
        Self {
            tool: poses[tip],
            jacobian: Self::jacobian(robot, &poses, tip, point(&poses[tip])),
            mass_matrix,
            gravity_torque,
        }
    }

    /// The geometric Jacobian of a point of a link.
    fn jacobian(
        robot: &Robot,
        poses: &[Matrix4<f64>],
        link: usize,
        point: Vector3<f64>,
    ) -> SMatrix<f64, 6, N> {
        let mut jacobian = SMatrix::<f64, 6, N>::zeros();
        let mut at = Some(link);
        while let Some(link) = at {
            let Link {
                parent,
                kind,
                axis,
                coordinate,
                ..
            } = &robot.links[link];
            at = *parent;
            let Some(coordinate) = coordinate else {
                continue;
            };
            let pose = &poses[link];
            let axis = (pose.fixed_view::<3, 3>(0, 0) * Vector3::from(*axis)).normalize();
            let arm = point - self::point(pose);
            let (linear, angular) = match kind {
                Kind::Prismatic => (axis, Vector3::zeros()),
                _ => (axis.cross(&arm), axis),
            };
            let column = Vector6::from_iterator(linear.iter().chain(&angular).copied());
            jacobian.set_column(*coordinate, &column);
        }
        jacobian
    }
}

fn point(pose: &Matrix4<f64>) -> Vector3<f64> {
    pose.fixed_view::<3, 1>(0, 3).into_owned()
}

/// The arm; none if two of its axes happen to be so nearly parallel that they are refused.
fn imported(robot: &Robot) -> Option<Imported> {
    let tip = robot.links.len() - 1;
    let text = robot.to_urdf();
    match Import::new()
        .tip(format!("l{tip}"))
        .parse(&text, "random.urdf")
    {
        Ok(arm) => Some(arm),
        Err(found) if found.to_string().contains("lose their digits there") => None,
        Err(found) => panic!("{text}\n{found}"),
    }
}

/// What rounding may make of numbers up to a few metres and radians, where common normals are as far away as the rows allow, or near by.
const FAR: f64 = 2e-11;
const NEAR: f64 = 2e-12;

/// The imported arm and its table against the tree, at a few configurations.
fn check<const N: usize>(robot: &Robot, tolerance: f64, random: &mut Random) {
    let Some(arm) = imported(robot) else { return };
    let table = Model::parse(&arm.table(), "table.toml").unwrap_or_else(|found| panic!("{found}"));
    for model in [arm.model(), &table] {
        let chain = SerialChain::<N>::try_from(model).unwrap();
        for _ in 0..3 {
            let q = SVector::from_fn(|_, _| random.within(2.0));
            let truth = Truth::<N>::of(robot, &q);
            let text = robot.to_urdf();
            let near = |what: &str, off: f64, scale: f64| {
                assert!(
                    off <= tolerance * scale,
                    "{what}: {off:e} of {scale:e}\n{text}"
                );
            };
            let tool = chain.forward_kinematics(&q).to_homogeneous();
            near("tool", (tool - truth.tool).amax(), 1.0);
            let jacobian = chain.geometric_jacobian(&q);
            near("J", (jacobian - truth.jacobian).amax(), 1.0);
            let mass_matrix = chain.mass_matrix(&q);
            let off = (mass_matrix - truth.mass_matrix).amax();
            near("M", off, truth.mass_matrix.amax());
            let gravity = chain.gravity_torque(&q);
            let weight: f64 = model
                .joints()
                .iter()
                .map(|joint| joint.link.mass * GRAVITY)
                .sum();
            near("gravity", (gravity - truth.gravity_torque).amax(), weight);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Axes and origins anywhere, links fixed between and beside, branches that are frozen.
    #[test]
    fn arbitrary_chains_move_as_described(seed: u64) {
        let mut random = Random::new(seed);
        check::<1>(&Robot::random(1, &mut random), FAR, &mut random);
        check::<2>(&Robot::random(2, &mut random), FAR, &mut random);
        check::<6>(&Robot::random(6, &mut random), FAR, &mut random);
        check::<7>(&Robot::random(7, &mut random), FAR, &mut random);
    }

    /// The same with axes along x, y or z and turns by quarters: parallel, intersecting and in line.
    #[test]
    fn square_chains_move_as_described(seed: u64) {
        let mut random = Random::new(seed);
        check::<3>(&Robot::square(3, &mut random), NEAR, &mut random);
        check::<6>(&Robot::square(6, &mut random), NEAR, &mut random);
    }
}

/// The order, the zero and the sign of q, by hand: a quarter turn about -z, then a way of 0.3 m along x.
#[test]
fn q_is_that_of_the_description() {
    let body = Some(Body {
        mass: 1.0,
        xyz: [0.0; 3],
        rpy: [0.0; 3],
        inertia: [0.1, 0.0, 0.0, 0.1, 0.0, 0.1],
    });
    let link = |parent, kind, axis, xyz, coordinate| Link {
        parent,
        kind,
        xyz,
        rpy: [0.0; 3],
        axis,
        coordinate,
        frozen: 0.0,
        body: body.clone(),
    };
    let x = [1.0, 0.0, 0.0];
    let robot = Robot {
        links: vec![
            link(None, Kind::Fixed, x, [0.0; 3], None),
            link(
                Some(0),
                Kind::Revolute,
                [0.0, 0.0, -1.0],
                [0.0, 0.0, 0.5],
                Some(0),
            ),
            link(Some(1), Kind::Prismatic, x, [0.2, 0.0, 0.0], Some(1)),
        ],
    };
    let arm = SerialChain::<2>::try_from(imported(&robot).unwrap().model()).unwrap();
    let tool = arm.forward_kinematics(&[std::f64::consts::FRAC_PI_2, 0.3].into());
    let expected = Vector3::new(0.0, -0.5, 0.5);
    assert_relative_eq!(tool.translation.vector, expected, epsilon = 1e-15);
}
