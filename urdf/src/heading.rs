//! What a table says at its top of where it comes from.

use ulna_table::diagnostics::Diagnostics;

use crate::note::Note;
use crate::tree::Tree;

/// The comments before the table's keys.
pub(crate) fn heading(file: &str, tree: &Tree, base: &str, tip: &str, notes: &[Note]) -> String {
    let robot = match &tree.robot.name {
        Some(name) => format!("the robot `{name}` in {file}"),
        None => file.to_owned(),
    };
    let mut text = format!(
        "Imported by ulna from {robot}.\n\
         World: the frame of the link `{base}`. Tool: the frame of the link `{tip}`.\n\
         q is the description's: the same zero, the same sign, base to tip.\n"
    );
    for note in notes {
        text.push_str(&format!("- {note}\n"));
    }
    text
}

/// The warnings, a line for each.
pub(crate) fn warned(warnings: &Diagnostics) -> String {
    let lines = warnings.list().iter().map(|warning| {
        let label = match warning.label.as_str() {
            "" => String::new(),
            label => format!(": {label}"),
        };
        let line = match warning.position {
            Some(position) => format!(" (line {})", position.line),
            None => String::new(),
        };
        format!("- warning: {}{label}{line}\n", warning.message)
    });
    lines.collect()
}
