//! What the lock loads the structure with: the moments and forces of Eq. 8-11 that no motor feels.

use comfy_table::Table;
use serde::Serialize;
use ulna::JointKind;
use ulna_study::experiment::{LockMechanics, StructureLoad};

use super::words::significant;
use crate::columns::plain;
use crate::rows::file;

/// The columns' titles.
pub(super) const TITLES: [&str; 7] = [
    "joint",
    "along its axis",
    "off-axis moment, N m",
    "about x",
    "about y",
    "off-axis force, N",
    "off-axis / axis",
];

/// The cells of a joint: signed where they are components, after the lock minus before it.
pub(super) fn cells(lock: &LockMechanics, joint: usize) -> [String; 7] {
    let load = &lock.loads[joint];
    let locks = if lock.failed_joints.contains(&joint) {
        " (locks)"
    } else {
        ""
    };
    let unit = match load.kind {
        JointKind::Revolute => "N m",
        JointKind::Prismatic => "N",
    };
    [
        format!("{}{locks}", joint + 1),
        format!("{} {unit}", significant(load.along_axis())),
        significant(load.off_axis_moment()),
        significant(load.moment[0]),
        significant(load.moment[1]),
        significant(load.off_axis_force()),
        ratio(load),
    ]
}

/// How many times the motor's torque the bearings' moment is; nothing where the two have no common unit or there is no torque.
fn ratio(load: &StructureLoad) -> String {
    let along = load.along_axis().abs();
    // Less is rounding.
    if load.kind == JointKind::Prismatic || along <= 1e-9 * load.off_axis_moment() {
        return String::new();
    }
    significant(load.off_axis_moment() / along)
}

/// For the console: a row for each joint.
pub(super) fn table(lock: &LockMechanics) -> String {
    let mut table = Table::new();
    table.set_header(TITLES);
    for joint in 0..lock.loads.len() {
        table.add_row(cells(lock, joint));
    }
    plain(table, &[0])
}

/// A lock and a joint.
#[derive(Default, Serialize)]
struct Row {
    failure_time: f64,
    joint: usize,
    locks: bool,
    along_axis: f64,
    off_axis_moment: f64,
    off_axis_force: f64,
    moment_x: f64,
    moment_y: f64,
    moment_z: f64,
    force_x: f64,
    force_y: f64,
    force_z: f64,
}

/// `structure.csv`.
pub(super) fn csv(locks: &[LockMechanics]) -> anyhow::Result<String> {
    let row = |lock: &LockMechanics, joint: usize| {
        let load = &lock.loads[joint];
        let ([moment_x, moment_y, moment_z], [force_x, force_y, force_z]) =
            (load.moment, load.force);
        Row {
            failure_time: lock.failure_time,
            joint: joint + 1,
            locks: lock.failed_joints.contains(&joint),
            along_axis: load.along_axis(),
            off_axis_moment: load.off_axis_moment(),
            off_axis_force: load.off_axis_force(),
            moment_x,
            moment_y,
            moment_z,
            force_x,
            force_y,
            force_z,
        }
    };
    file(locks.iter().flat_map(|lock| {
        let joints = 0..lock.loads.len();
        joints.map(move |joint| row(lock, joint))
    }))
}
