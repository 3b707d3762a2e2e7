//! Whether the mass matrix of an arm with an accepted inertia is positive definite.

use nalgebra::{DMatrix, Matrix3, Vector3};

use crate::pose::Pose;
use ulna::{Joint, JointKind, Placement};

/// Configurations that are tried.
const SAMPLES: u32 = 200;

/// A configuration at which M is not positive definite, of those tried: spread evenly over full turns, or over the arm's
/// length where a joint slides.
///
/// Links that a rigid body can have make M positive definite everywhere. One inertia that none can have may not: its
/// deficit may outweigh what the other links add.
pub(super) fn indefinite_at(joints: &[Joint]) -> Option<Vec<f64>> {
    let length: f64 = joints.iter().map(|joint| joint.a.hypot(joint.d)).sum();
    let configuration = |sample: u32| -> Vec<f64> {
        let coordinate = |(index, joint): (usize, &Joint)| {
            let share = spread(sample, index) - 0.5;
            match joint.kind {
                JointKind::Revolute => share * std::f64::consts::TAU,
                JointKind::Prismatic => share * length.max(1.0),
            }
        };
        joints.iter().enumerate().map(coordinate).collect()
    };
    (0..SAMPLES)
        .map(configuration)
        .find(|q| !is_positive_definite(&mass_matrix(joints, q)))
}

/// A number from 0 to 1 for each sample and coordinate, evenly spread: multiples of an irrational number of the coordinate's own.
fn spread(sample: u32, coordinate: usize) -> f64 {
    // Square roots of numbers that are not squares.
    let irrational = (coordinate as f64 + 1.25).sqrt() * 0.754_877_666_246_693;
    (0.5 + f64::from(sample) * irrational).fract()
}

/// M as the sum of each link's share, m Jvᵀ Jv + Jwᵀ I Jw (Siciliano et al., Robotics, 7.1.1).
fn mass_matrix(joints: &[Joint], q: &[f64]) -> DMatrix<f64> {
    let mut mass = DMatrix::zeros(joints.len(), joints.len());
    let pose = Pose::of_chain(joints, &Placement::IDENTITY, &Placement::IDENTITY, q);
    let mut axes: Vec<(JointKind, Vector3<f64>, Vector3<f64>)> = Vec::new();
    for (joint, frame) in joints.iter().zip(pose.links()) {
        let axis = frame.rotation * Vector3::z();
        axes.push((joint.kind, axis, frame.translation.vector));
        let link = &joint.link;
        let centroid = frame * nalgebra::Point3::from(link.com);
        let turn = frame.rotation.into_inner();
        let inertia = turn * Matrix3::from_fn(|i, j| link.inertia[i][j]) * turn.transpose();
        let columns: Vec<(Vector3<f64>, Vector3<f64>)> = axes
            .iter()
            .map(|(kind, axis, origin)| match kind {
                JointKind::Revolute => (axis.cross(&(centroid.coords - origin)), *axis),
                JointKind::Prismatic => (*axis, Vector3::zeros()),
            })
            .collect();
        for (i, (v_i, w_i)) in columns.iter().enumerate() {
            for (j, (v_j, w_j)) in columns.iter().enumerate() {
                mass[(i, j)] += link.mass * v_i.dot(v_j) + w_i.dot(&(inertia * w_j));
            }
        }
    }
    for (i, joint) in joints.iter().enumerate() {
        mass[(i, i)] += joint.motor.reflected_inertia();
    }
    mass
}

/// By Cholesky's factorization. What rounding leaves of nothing is not positive.
fn is_positive_definite(matrix: &DMatrix<f64>) -> bool {
    matrix.clone().cholesky().is_some_and(|factor| {
        let pivots = factor.l_dirty().diagonal().map(|root| root * root);
        let diagonal = matrix.diagonal();
        let mut entries = pivots.iter().zip(diagonal.iter());
        entries.all(|(pivot, entry)| *pivot > 1e-14 * entry.abs())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Model;
    use ulna::{Arm, SerialChain, nalgebra::SVector};

    #[test]
    fn the_mass_matrix_is_the_textbooks() {
        let model = Model::load("../arms/geared_6.toml").unwrap();
        let chain = SerialChain::<6>::try_from(&model).unwrap();
        let q = [0.3, -0.2, 1.1, -0.7, 0.5, 2.0];
        let ours = mass_matrix(model.joints(), &q);
        let theirs = chain.mass_matrix(&SVector::from(q));
        for i in 0..6 {
            for j in 0..6 {
                assert!((ours[(i, j)] - theirs[(i, j)]).abs() < 1e-12 * theirs.amax());
            }
        }
        assert_eq!(indefinite_at(model.joints()), None);
    }

    #[test]
    fn a_deficit_that_outweighs_the_rest_is_found() {
        let model = Model::load("../arms/planar_2r.toml").unwrap();
        let mut joints = model.joints().to_vec();
        joints[1].link.inertia[2][2] = -0.01;
        assert_eq!(indefinite_at(&joints), None);
        // Beside m c^2 = 0.25 it still leaves the joint's own entry positive.
        joints[1].link.inertia[2][2] = -0.2;
        assert!(indefinite_at(&joints).is_some());
    }
}
