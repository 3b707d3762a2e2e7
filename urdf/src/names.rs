//! Names that a table admits, made of those that a description has.

use ulna_table::{joint_name, name_for};

use crate::note::NoteKind;
use crate::report::Report;
use crate::robot::JointElement;

/// The longest part of a name that is kept where a number is put behind it.
const STEM: usize = 48;

/// Names for the joints, each another one: their own as far as a table admits them.
pub(crate) fn joint_names(joints: &[&JointElement], report: &mut Report) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for (number, joint) in (1..).zip(joints) {
        let proper = if joint.name.contains(|c: char| c.is_ascii_alphanumeric()) {
            joint_name(&joint.name)
        } else {
            format!("joint_{number}")
        };
        let taken = |name: &String| {
            let others = joints
                .iter()
                .any(|other| other.name == *name && other.name != joint.name);
            others || names.contains(name)
        };
        let stem: String = proper.chars().take(STEM).collect();
        let numbered = (2..).map(|number| format!("{stem}_{number}"));
        let name = std::iter::once(proper.clone())
            .chain(numbered)
            .find(|name| !taken(name))
            .unwrap_or(proper);
        if name != joint.name {
            let message = format!("joint `{}` is called `{name}` in the table", joint.name);
            report.note_at(&joint.span, NoteKind::Renamed, message);
        }
        names.push(name);
    }
    names
}

/// A name for the arm: that of the robot, as far as a table admits it.
pub(crate) fn robot_name(robot: Option<&str>, report: &mut Report) -> String {
    let written = robot.unwrap_or_default();
    let (name, _) = name_for(written);
    if name != written {
        let message = if written.is_empty() {
            format!("the robot has no name: the arm is called `{name}`; `--name` gives it another")
        } else {
            format!(
                "the robot `{written}` is called `{name}` in the table; `--name` gives it another name"
            )
        };
        report.note(NoteKind::Renamed, message);
    }
    name
}
