//! What the lock loads the structure with, in words and tables.

use std::fmt::{self, Write};

use ulna_study::experiment::{LockMechanics, StructureLoad};

use crate::reproduce::drawings::STRUCTURE;
use crate::reproduce::structure::{TITLES, cells};
use crate::reproduce::words::significant;

/// The off-axis moments and forces at each lock.
pub(super) fn write(page: &mut String, locks: &[LockMechanics]) -> fmt::Result {
    writeln!(
        page,
        "## What the structure bears\n\n\
         A joint's motor feels one component of what the lock changes; bearings and links feel the others (Eq. 8-11), and no law suppresses those. \
         Steps, after the lock minus before it, while the healthy joints keep to their plan; x, y and z are those of the joint's frame, z its axis.\n"
    )?;
    for lock in locks {
        let moments = lock.loads.iter().map(StructureLoad::off_axis_moment);
        let worst = moments.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((joint, moment)) = worst.filter(|(_, moment)| *moment > 1e-9) {
            writeln!(
                page,
                "Lock at {} s: joint {} bears most off its axis, a moment of {} N·m, {} along it.\n",
                lock.failure_time,
                joint + 1,
                significant(moment),
                cells(lock, joint)[1].replace("N m", "N·m"),
            )?;
        } else {
            writeln!(
                page,
                "Lock at {} s: no joint bears a moment off its axis.\n",
                lock.failure_time
            )?;
        }
        writeln!(
            page,
            "| {} |\n|{}",
            TITLES.join(" | ").replace("N m", "N·m"),
            "---|".repeat(TITLES.len())
        )?;
        for joint in 0..lock.loads.len() {
            let row = cells(lock, joint).join(" | ").replace("N m", "N·m");
            writeln!(page, "| {row} |")?;
        }
        writeln!(page)?;
    }
    let caption = "Steps of moments and forces at each joint, along its axis and off it";
    writeln!(
        page,
        "![{caption}](figures/{STRUCTURE}.svg)\n\n*{caption}.*\n"
    )
}
