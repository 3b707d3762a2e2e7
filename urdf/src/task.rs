//! [`task`]: rows of the Jacobian that the arm can move in.

use nalgebra::{SVector, Vector3, Vector6};
use ulna::{JointKind, TaskRow, TaskRows};

use crate::frame::Frame;
use crate::motion::{frames, generic};
use crate::rows::Moving;

/// Rows for w_D that are not dependent at every configuration: of six joints or more all that can move, of fewer the
/// position's, and where that cannot move the orientation's.
///
/// There is always one: a joint moves the tool or turns it. A row is taken if it adds to those before it at one of several configurations without any symmetry.
pub(crate) fn task(kinds: &[JointKind], joints: &[Moving], tool: &Frame) -> TaskRows {
    const CONFIGURATIONS: usize = 5;
    let (linear, angular) = TaskRow::ALL.split_at(3);
    let jacobians: Vec<_> = (0..CONFIGURATIONS)
        .map(|k| jacobian(kinds, joints, tool, &generic(k, joints.len())))
        .collect();
    let mut chosen = Vec::new();
    for row in linear {
        add(*row, &mut chosen, &jacobians);
    }
    if joints.len() >= 6 || chosen.is_empty() {
        for row in angular {
            add(*row, &mut chosen, &jacobians);
        }
    }
    TaskRows::new(&chosen)
}

/// Adds `row` where it is independent of those chosen, at one configuration at least.
fn add(row: TaskRow, chosen: &mut Vec<TaskRow>, jacobians: &[Vec<Vector6<f64>>]) {
    /// Share of a row's length that has to be its own.
    const OWN: f64 = 1e-3;
    let independent = |jacobian: &Vec<Vector6<f64>>| {
        let entries = |row: TaskRow| -> Vec<f64> {
            jacobian.iter().map(|column| column[row.index()]).collect()
        };
        // Of the rows of one unit: metres and radians cannot be compared.
        let alike = TaskRow::ALL
            .into_iter()
            .filter(|other| other.index() / 3 == row.index() / 3);
        let largest = alike.map(|row| norm(&entries(row))).fold(0.0, f64::max);
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let mut rest = 0.0;
        for row in chosen.iter().copied().chain([row]) {
            let mut vector = entries(row);
            for unit in &basis {
                let along: f64 = unit.iter().zip(&vector).map(|(a, b)| a * b).sum();
                vector
                    .iter_mut()
                    .zip(unit)
                    .for_each(|(v, u)| *v -= along * u);
            }
            rest = norm(&vector);
            if rest > 0.0 {
                vector.iter_mut().for_each(|v| *v /= rest);
                basis.push(vector);
            }
        }
        rest > OWN * largest
    };
    if jacobians.iter().any(independent) {
        chosen.push(row);
    }
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The columns of the geometric Jacobian at the tool, in the base's axes.
fn jacobian(
    kinds: &[JointKind],
    joints: &[Moving],
    tool: &Frame,
    q: &[f64],
) -> Vec<SVector<f64, 6>> {
    let (frames, tool) = frames(kinds, joints, tool, q);
    let column = |(kind, (frame, joint)): (&JointKind, (&Frame, &Moving))| {
        let axis = frame.rotation * joint.axis;
        let (linear, angular) = match kind {
            JointKind::Revolute => {
                let arm = tool.translation - frame.translation;
                (axis.cross(&arm), axis)
            }
            JointKind::Prismatic => (axis, Vector3::zeros()),
        };
        Vector6::new(
            linear.x, linear.y, linear.z, angular.x, angular.y, angular.z,
        )
    };
    kinds
        .iter()
        .zip(frames.iter().zip(joints))
        .map(column)
        .collect()
}
