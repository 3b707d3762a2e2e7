//! A table that only makes sense in the other Denavit-Hartenberg convention.
//!
//! The last row of a standard table rarely turns or shifts anything, `a = 0` and `alpha = 0`, and nor does the first of a
//! modified one: read in the other convention such a row makes two neighbouring joints turn about one axis. Where the last row of
//! a standard table holds a length, modified form has no place for it: the tool is on the last axis, and the base is shifted instead.

use nalgebra::{DMatrix, Vector3};

use super::subject::{Subject, called};
use crate::diagnostics::Diagnostic;
use crate::model::standard_to_modified;
use crate::pose::Pose;
use crate::table::Convention;
use ulna::internal::random::SplitMix64;
use ulna::{Angle, Joint, JointKind, Placement, TaskRows};

/// What counts as 0 of a sine, or of a length beside the arm's.
const ROUNDING: f64 = 1e-9;
/// The task is singular everywhere if it is at so many states at random.
const STATES: usize = 3;

pub(super) fn find(arm: &Subject<'_>) -> Vec<Diagnostic> {
    let model = arm.model;
    let task = model.task();
    let (joints, tool) = (model.joints(), model.tool());
    let coaxial = coaxial(joints);
    let Some(fault) = coaxial
        .map(|index| {
            let both = [called(model, index), called(model, index + 1)];
            let moves = match joints[index].kind {
                JointKind::Revolute => "turn about one axis",
                JointKind::Prismatic => "slide along one direction",
            };
            format!("as such {} and {} {moves}", both[0], both[1])
        })
        .or_else(|| {
            let singular = begins_with_a_link(arm)
                && ends_on_its_axis(joints, tool)
                && is_singular_everywhere(joints, model.base(), tool, task);
            singular.then(|| "as such the tool is on the last axis, and the task singular in every configuration".to_owned())
        })
    else {
        return Vec::new();
    };
    let (joints, tool) = read_otherwise(arm);
    if self::coaxial(&joints).is_some()
        || is_singular_everywhere(&joints, model.base(), &tool, task)
    {
        return Vec::new();
    }
    let (own, other, holds) = match arm.places.is_standard() {
        true => ("standard", "modified", "a_{i-1} and alpha_{i-1}"),
        false => ("modified", "standard", "a_i and alpha_i"),
    };
    let message =
        format!("the rows make an arm in the {other} convention, and hardly one in the {own}");
    let help = format!("if each row holds {holds}, write `convention = \"{other}\"`");
    let place = arm.places.convention.0.clone();
    vec![Diagnostic::warning(place, message).label(fault).help(help)]
}

/// The first of two neighbouring joints of which the second only repeats what the first does.
fn coaxial(joints: &[Joint]) -> Option<usize> {
    joints.windows(2).position(|pair| {
        let parallel = pair[1].alpha.sin_cos().0.abs() <= ROUNDING;
        match (pair[0].kind, pair[1].kind) {
            (JointKind::Revolute, JointKind::Revolute) => parallel && pair[1].a.abs() <= ROUNDING,
            (JointKind::Prismatic, JointKind::Prismatic) => parallel,
            _ => false,
        }
    })
}

/// Whether a modified table's first row shifts or turns anything: `a` and `alpha` of what stands still are rarely written there.
fn begins_with_a_link(arm: &Subject<'_>) -> bool {
    let first = arm.model.joints().first();
    !arm.places.is_standard() && first.is_some_and(|row| row.a != 0.0 || row.alpha.radians != 0.0)
}

/// Whether the last joint only turns the tool about itself.
fn ends_on_its_axis(joints: &[Joint], tool: &Placement) -> bool {
    let turns = |joint: &Joint| joint.kind == JointKind::Revolute;
    joints.last().is_some_and(turns) && tool.translation[0] == 0.0 && tool.translation[1] == 0.0
}

/// The chain that the rows make in the other convention, in modified form: how its joints stand, not what they carry.
fn read_otherwise(arm: &Subject<'_>) -> (Vec<Joint>, Placement) {
    let (mut joints, mut tool) = (arm.model.joints().to_vec(), *arm.model.tool());
    if arm.places.convention.1 == Some(Convention::Modified) {
        standard_to_modified(&mut joints, &mut tool);
        return (joints, tool);
    }
    let own = |(joint, row): (&mut Joint, &super::places::JointPlaces)| {
        (joint.a, joint.alpha) = (row.a, Angle::from_radians(row.alpha));
        (row.a, joint.alpha)
    };
    let rows = joints.iter_mut().zip(&arm.places.joints).map(own);
    if let Some((a, alpha)) = rows.last() {
        // The model's tool stands behind Tx(a) Rx(alpha) of the last row. How it is turned does not matter here but to the task's axes, which are the world's.
        let (sin, cos) = alpha.sin_cos();
        let [x, y, z] = tool.translation;
        let point = Vector3::new(x - a, cos * y + sin * z, cos * z - sin * y);
        tool.translation = point.into();
    }
    (joints, tool)
}

/// Whether the task's rows of J depend on each other wherever the arm is.
fn is_singular_everywhere(
    joints: &[Joint],
    base: &Placement,
    tool: &Placement,
    task: TaskRows,
) -> bool {
    let mut random = SplitMix64::new(1);
    (0..STATES).all(|_| {
        let q: Vec<f64> = joints.iter().map(|_| 3.0 * random.symmetric()).collect();
        let columns = Pose::of_chain(joints, base, tool, &q).jacobian();
        let mut rows = DMatrix::from_fn(task.len(), joints.len(), |row, joint| {
            let row = task.iter().nth(row).map_or(0, |row| row as usize);
            columns[joint][row]
        });
        // Rows of unlike units: each by its own length.
        for mut row in rows.row_iter_mut() {
            let length = row.norm();
            if length > 0.0 {
                row /= length;
            }
        }
        let singular = rows.singular_values();
        singular.min() <= ROUNDING * singular.max()
    })
}
