//! `ulna check`: reads tables and says what is in them, or what is wrong with them.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use ulna::{Friction, Joint, JointKind, Limits, Motor, TaskRow};
use ulna_table::{AngleUnit, Model};

use crate::{Verdict, console};

/// Read tables: a summary of each arm, or every error with its line
#[derive(Args)]
#[command(
    after_help = "What is legal but suspicious is a warning, which says how the table switches it off; `ulna help table` lists them all.\n\n\
                  The tool is that at q = 0, in the world. The reach is the largest distance of the tool point from the origin of frame 1 \
                  within the joints' limits that is found by stretching the arm, joint by joint, from q = 0 and eight other configurations; \
                  a sliding joint without limits is left at 0. What is held are the torques against gravity at q = 0, without a payload.\n\n\
                  Example:\n  ulna check arms/ssrms.toml arms/planar_2r.toml"
)]
pub(crate) struct Arguments {
    /// Arm tables (TOML)
    #[arg(required = true, value_name = "TABLE")]
    tables: Vec<PathBuf>,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    let mut verdict = Verdict::Pass;
    for path in &arguments.tables {
        match console::examine(path) {
            Ok((_, model)) => summarize(path, &model, out)?,
            Err(errors) => {
                console::report(&errors);
                verdict = Verdict::Fail;
            }
        }
    }
    Ok(verdict)
}

fn summarize(path: &Path, model: &Model, out: &mut dyn Write) -> io::Result<()> {
    let joints = model.joints();
    let kinds: Vec<_> = joints.iter().map(|joint| kind(joint.kind)).collect();
    let rows: Vec<_> = model.task().iter().map(TaskRow::name).collect();
    let mass: f64 = joints.iter().map(|joint| joint.link.mass).sum();
    let rated = joints.iter().filter(|joint| joint.rated_torque.is_some());
    let [x, y, z] = model.gravity();
    writeln!(out, "{}: ok", path.display())?;
    writeln!(
        out,
        "  arm            {}, as a type {}",
        model.name(),
        model.type_name()
    )?;
    writeln!(
        out,
        "  joints         {}: {}",
        joints.len(),
        kinds.join(" ")
    )?;
    writeln!(out, "  task           {}", rows.join(" "))?;
    writeln!(out, "  moving mass    {} kg", rounded(mass))?;
    if model.has_payload() {
        writeln!(out, "  payload        at run time")?;
    }
    writeln!(out, "  gravity        {x} {y} {z} m/s^2")?;
    writeln!(
        out,
        "  rated torque   {} of {} joints",
        rated.count(),
        joints.len()
    )?;
    summarize_drives(model, out)?;
    summarize_pose(model, out)?;
    writeln!(out, "  sha256         {}", model.table_hash())
}

/// What else the table says of the joints, as far as it says anything.
fn summarize_drives(model: &Model, out: &mut dyn Write) -> io::Result<()> {
    let (joints, names) = (model.joints(), model.joint_names());
    let given: Vec<_> = (1..)
        .zip(names)
        .filter(|(number, name)| **name != format!("joint {number}"))
        .map(|(number, name)| format!("{number} {name}"))
        .collect();
    if !given.is_empty() {
        writeln!(out, "  joint names    {}", given.join(", "))?;
    }
    for (what, count) in [
        (
            "limits",
            count(joints, |joint| joint.limits != Limits::NONE),
        ),
        ("motors", count(joints, |joint| joint.motor != Motor::NONE)),
        (
            "friction",
            count(joints, |joint| joint.friction != Friction::NONE),
        ),
    ] {
        if count > 0 {
            writeln!(out, "  {what:14} {count} of {} joints", joints.len())?;
        }
    }
    Ok(())
}

/// What a data sheet says of an arm: where its tool is at q = 0, how far it reaches, and what its joints hold.
fn summarize_pose(model: &Model, out: &mut dyn Write) -> io::Result<()> {
    let pose = model.pose(&[]);
    let tool = pose.tool();
    let [x, y, z] = tool.translation.vector.map(decimals).into();
    let (roll, pitch, yaw) = tool.rotation.euler_angles();
    let (scale, unit) = match model.angle_unit() {
        AngleUnit::Degrees => (1_f64.to_degrees(), "deg"),
        AngleUnit::Radians => (1.0, "rad"),
    };
    let [roll, pitch, yaw] = [roll, pitch, yaw].map(|angle| decimals(angle * scale));
    writeln!(
        out,
        "  tool at q = 0  {x} {y} {z} m, rpy {roll} {pitch} {yaw} {unit}, in the world"
    )?;
    writeln!(
        out,
        "  reach          {} m, the farthest found of the tool from the origin of frame 1",
        decimals(model.reach())
    )?;
    if model.gravity() == [0.0; 3] {
        return Ok(());
    }
    let torques = pose.gravity_torque(model.gravity());
    let rows = model.joints().iter().zip(model.joint_names()).zip(torques);
    let held: Vec<_> = rows
        .map(|((joint, name), torque)| {
            let unit = match joint.kind {
                JointKind::Revolute => "N m",
                JointKind::Prismatic => "N",
            };
            format!("{name} {} {unit}", decimals(torque))
        })
        .collect();
    writeln!(out, "  held at q = 0  {}", held.join(", "))
}

/// A number to four decimals, without zeros at its end; those of a rounded 0 have no sign.
fn decimals(number: f64) -> f64 {
    (number * 1e4).round() / 1e4 + 0.0
}

fn count(joints: &[Joint], has: impl Fn(&Joint) -> bool) -> usize {
    joints.iter().filter(|joint| has(joint)).count()
}

/// A sum of numbers that were written in decimals, without the digits that only rounding has put there.
fn rounded(sum: f64) -> f64 {
    /// One less than a double is sure to hold, and a place for each power of ten in the number of joints.
    const DIGITS: usize = 12;
    // What `{:e}` has written can be read.
    format!("{sum:.DIGITS$e}").parse().unwrap_or(sum)
}

fn kind(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "R",
        JointKind::Prismatic => "P",
    }
}
