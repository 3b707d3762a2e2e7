//! `ulna import`: a robot description in, a table out.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use ulna_urdf::{Import, Imported};

use crate::output::{refuse_special, write_whole};
use crate::{Verdict, console};

/// Make an arm's table of a robot description (URDF)
///
/// A serial chain from a base to a tip. What is fixed to its links counts with them; what could move beside it is frozen at 0
/// and counts too. Every liberty that is taken is told in a note, on stderr and in the table.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  ulna import urdf/tests/robots/arm_with_gripper.urdf --tip hand\n  \
                  ulna import urdf/tests/robots/arm_with_gripper.urdf --tip hand --output target/arm.toml\n  \
                  ulna import urdf/tests/robots/arm_with_gripper.urdf --drop hand --name bare_arm"
)]
pub(crate) struct Arguments {
    /// The robot description; it is the only file that is opened
    #[arg(value_name = "URDF")]
    urdf: PathBuf,
    /// The link at which the arm begins, whose frame becomes the world's [default: the robot's root]
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// The link at which the arm ends, whose frame becomes the tool's [default: the end of the only chain of joints]
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// Leave this link out, with all that hangs on it; may be repeated
    #[arg(long, value_name = "LINK")]
    drop: Vec<String>,
    /// Take over the inertia of this link although no rigid body can have it; may be repeated
    #[arg(long, value_name = "LINK")]
    accept_inertia: Vec<String>,
    /// Take the axis of this joint as parallel to that of the joint before, if they are almost; may be repeated
    #[arg(long, value_name = "JOINT")]
    parallel: Vec<String>,
    /// The arm's name [default: the robot's]
    #[arg(long)]
    name: Option<String>,
    /// The file to write, whole or not at all; without it the table goes to stdout.
    /// A symbolic link stays, and the file that it leads to is written; a device, pipe or socket is refused
    #[arg(long, short, value_name = "TABLE")]
    output: Option<PathBuf>,
}

pub(crate) fn run(arguments: &Arguments, out: &mut dyn Write) -> anyhow::Result<Verdict> {
    if let Some(file) = &arguments.output {
        refuse_special(file)?;
    }
    let imported = import(arguments).load(&arguments.urdf)?;
    let table = imported.table();
    match &arguments.output {
        None => out.write_all(table.as_bytes())?,
        Some(file) => write_whole(file, table.as_bytes())?,
    }
    console::report(imported.warnings());
    for note in imported.notes() {
        console::note(&format!("note: {note}"));
    }
    if let Some(file) = &arguments.output {
        console::note(&summary(&imported, file));
    }
    Ok(Verdict::Pass)
}

fn import(arguments: &Arguments) -> Import {
    let mut import = Import::new();
    if let Some(link) = &arguments.base {
        import = import.base(link);
    }
    if let Some(link) = &arguments.tip {
        import = import.tip(link);
    }
    if let Some(name) = &arguments.name {
        import = import.name(name);
    }
    for link in &arguments.drop {
        import = import.drop(link);
    }
    for link in &arguments.accept_inertia {
        import = import.accept_inertia(link);
    }
    for joint in &arguments.parallel {
        import = import.parallel(joint);
    }
    import
}

/// What has been written, and what to do with it.
fn summary(imported: &Imported, file: &Path) -> String {
    let (model, file) = (imported.model(), file.display());
    let mass: f64 = model.joints().iter().map(|joint| joint.link.mass).sum();
    let mut text = format!(
        "\n{file}: the arm {}, {} joints from {} to {}, {mass:.3} kg\n",
        model.name(),
        model.joints().len(),
        imported.base(),
        imported.tip(),
    );
    for (number, joint) in (1..).zip(imported.joints()) {
        text.push_str(&format!("  {number:2} {} moves {}", joint.name, joint.link));
        if !joint.merged.is_empty() {
            text.push_str(&format!(" with {}", joint.merged.join(", ")));
        }
        text.push('\n');
    }
    text.push_str(&format!(
        "Next:\n  ulna check {file}\n  ulna verify {file}\n  ulna generate {file} --output {0}.rs, or a crate around it: ulna new --crate {0} {file}",
        model.name()
    ));
    text
}
