//! [`describe`]: the bodies that were put together, as an arm.

use std::path::Path;

use ulna::{Angle, Joint, JointKind, Link, Motor, Placement, TaskRow, TaskRows};
use ulna_table::diagnostics::{Diagnostic, Diagnostics, Sink};
use ulna_table::{Convention, Description, Model, name_for};

use crate::chain::Chain;
use crate::drive::{Drive, drive};
use crate::frame::Frame;
use crate::heading::heading;
use crate::import::Import;
use crate::imported::{Imported, ImportedJoint};
use crate::merge::{Assembly, Segment};
use crate::motion::distance;
use crate::names::{joint_names, robot_name};
use crate::note::NoteKind;
use crate::parallel::{doubts, parallel};
use crate::report::Report;
use crate::robot::{JointElement, Motion};
use crate::rows::{Moving, Rows, rows};
use crate::task::task;
use crate::tidied;
use crate::tree::Tree;

/// The arm that the bodies of `assembly` make. `None` if something has been reported.
pub(crate) fn describe(
    import: &Import,
    source_name: &str,
    tree: &Tree,
    chain: &Chain,
    assembly: Option<Assembly>,
    mut report: Report,
) -> Option<Imported> {
    let elements: Vec<_> = chain
        .joints
        .iter()
        .map(|joint| tree.joint(*joint))
        .collect();
    let drives: Vec<_> = elements
        .iter()
        .map(|joint| drive(joint, &mut report))
        .collect();
    let name = name(import, tree, &mut report);
    let Assembly { segments, tool } = assembly?;
    let moving = moving(tree, &segments);
    let parallel = parallel(import, tree, chain, &report);
    let rows = rows(&moving, &tool, |joint| parallel.contains(&joint));
    doubts(tree, chain, &rows, &report);
    let rows = rows.ok()?;
    let rows = Rows {
        base: tidied::frame(&rows.base),
        tool: tidied::frame(&rows.tool),
        ..rows
    };
    let (name, drives) = (name?, drives.into_iter().collect::<Option<Vec<_>>>()?);
    let names = joint_names(&elements, &mut report);
    let kinds: Vec<JointKind> = elements.iter().map(|joint| kind(joint)).collect();
    say_rounding(distance(&kinds, &moving, &tool, &rows), &mut report);
    let task = task(&kinds, &moving, &tool);
    say_task(task, &mut report);
    gravity(tree, chain, &mut report);
    let joints = segments.iter().zip(&kinds).zip(&drives).enumerate();
    let description = Description {
        name,
        convention: Convention::Modified,
        gravity: [0.0, 0.0, -9.81],
        task,
        base: placement(&rows.base),
        tool: placement(&rows.tool),
        payload: false,
        joints: joints
            .map(|(i, ((segment, kind), drive))| joint(i, segment, *kind, drive, &rows))
            .collect(),
        joint_names: names.iter().cloned().map(Some).collect(),
        accept_inertia: segments.iter().map(|segment| segment.accepted).collect(),
        allow: Vec::new(),
    };
    let model = match Model::new(&description) {
        Ok(model) => model,
        Err(errors) => {
            refused(tree, chain, &errors, &report);
            return None;
        }
    };
    let joints = segments.iter().zip(names).map(|(segment, name)| {
        let element = tree.joint(segment.joint);
        ImportedJoint {
            name,
            urdf_name: element.name.clone(),
            line: report.line(&element.span),
            link: tree.link(tree.child_link(segment.joint)).name.clone(),
            merged: segment.merged.clone(),
        }
    });
    let (base, tip) = (&tree.link(chain.base).name, &tree.link(chain.tip).name);
    let file = Path::new(source_name).file_name();
    let file = file.map_or(source_name.into(), |name| name.to_string_lossy());
    Some(Imported {
        heading: heading(&file, tree, base, tip, &report.notes),
        description,
        model,
        base: base.clone(),
        tip: tip.clone(),
        joints: joints.collect(),
        notes: report.notes,
        warnings: Sink::new(source_name, "").finish(),
    })
}

fn kind(joint: &JointElement) -> JointKind {
    match joint.motion {
        Motion::Prismatic => JointKind::Prismatic,
        _ => JointKind::Revolute,
    }
}

/// What the joints' rows are made of.
fn moving(tree: &Tree, segments: &[Segment]) -> Vec<Moving> {
    let moving = segments.iter().map(|segment| Moving {
        placement: segment.placement,
        axis: tree.joint(segment.joint).axis.unit,
    });
    moving.collect()
}

/// The arm's name: as it is asked for, or after the robot. `None` if no arm can be called so, which has been reported.
fn name(import: &Import, tree: &Tree, report: &mut Report) -> Option<String> {
    let Some(name) = &import.name else {
        return Some(robot_name(tree.robot.name.as_deref(), report));
    };
    let (proper, _) = name_for(name);
    if proper != *name {
        let message = format!("no arm can be called `{name}`");
        report.push(Diagnostic::file_error(message).help(format!(
            "it becomes a file, a module and a type: write for example `--name {proper}`"
        )));
        return None;
    }
    Some(proper)
}

fn joint(index: usize, segment: &Segment, kind: JointKind, drive: &Drive, rows: &Rows) -> Joint {
    let row = &rows.rows[index];
    let row_from_joint = rows.in_joint_frame[index].inverse();
    let body = tidied::body(&segment.body.seen_from(&row_from_joint));
    Joint {
        kind,
        alpha: Angle::from_radians(row.alpha),
        a: row.a,
        theta: Angle::from_radians(row.theta),
        d: row.d,
        rated_torque: drive.rated_torque,
        limits: drive.limits,
        motor: Motor::NONE,
        friction: drive.friction,
        link: Link {
            mass: body.mass,
            com: body.com.into(),
            inertia: body.inertia_rows(),
        },
    }
}

fn placement(frame: &Frame) -> Placement {
    Placement {
        rotation: frame.rotation.transpose().into(),
        translation: frame.translation.into(),
    }
}

/// Says how far from the description's the tool is by the rows, if that is more than the rounding of doubles.
fn say_rounding(distance: f64, report: &mut Report) {
    const ROUNDING: f64 = 1e-12;
    if distance > ROUNDING {
        let message = format!(
            "by the table's rows the tool is up to {distance:.1e} m and rad from where the description has it: quarter turns that are written to ten digits or more are taken as whole, axes as parallel where that is told, and digits beyond 1e-13 left out"
        );
        report.note(NoteKind::Assumed, message);
    }
}

fn say_task(task: TaskRows, report: &mut Report) {
    let rows: Vec<&str> = task.iter().map(TaskRow::name).collect();
    let message = format!(
        "the task, the rows of J in w_D, is yours to choose; here it is {}, in which the arm can move",
        rows.join(" ")
    );
    report.note(NoteKind::Chosen, message);
}

/// What is assumed of gravity; and whether the base stands upright in the robot.
fn gravity(tree: &Tree, chain: &Chain, report: &mut Report) {
    const UPRIGHT: f64 = 1e-9;
    let base = &tree.link(chain.base).name;
    let message = format!(
        "a URDF says nothing of gravity: 9.81 m/s^2 along -z of the base `{base}` is assumed"
    );
    report.note(NoteKind::Assumed, message);
    let path = tree.path(tree.root, chain.base).unwrap_or_default();
    let frame = path.iter().fold(Frame::identity(), |frame, joint| {
        frame.times(&tree.joint(*joint).origin.frame)
    });
    let up = frame.rotation.row(2);
    if up[2] < 1.0 - UPRIGHT {
        let down: Vec<String> = up
            .iter()
            // Rounded first, and 0 added: no -0.
            .map(|x| format!("{:.6}", (-9.81e6 * x).round() / 1e6 + 0.0))
            .collect();
        let message = format!(
            "the base `{base}` does not stand upright on the root `{}`: where the root's z points up, gravity is [{}]",
            tree.link(tree.root).name,
            down.join(", ")
        );
        report.push(
            Diagnostic::warning(tree.link(chain.base).span.clone(), message)
                .help("write that as `gravity` into the table, if the root stands upright"),
        );
    }
}

/// Hands on what a table refuses, at the joints of the description.
fn refused(tree: &Tree, chain: &Chain, errors: &Diagnostics, report: &Report) {
    for error in errors.list() {
        let joint = error.message.split_once("joint ").and_then(|(_, rest)| {
            let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
            let number: usize = digits.parse().ok()?;
            chain.joints.get(number.checked_sub(1)?)
        });
        let message = format!("as a table: {}", error.message);
        let mut own = match joint {
            Some(joint) => {
                let element = tree.joint(*joint);
                let label = match error.label.is_empty() {
                    true => format!("joint `{}`", element.name),
                    false => format!("joint `{}`: {}", element.name, error.label),
                };
                Diagnostic::error(element.span.clone(), message).label(label)
            }
            None => Diagnostic::file_error(message),
        };
        own.severity = error.severity;
        own.help.clone_from(&error.help);
        report.push(own);
    }
}
