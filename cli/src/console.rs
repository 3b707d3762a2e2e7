//! What goes to stderr. Colours only on a terminal that wants them: `anstream` looks at it and at `NO_COLOR`.

use std::borrow::Cow;
use std::path::Path;

use clap::builder::styling::{AnsiColor, Style};
use ulna_table::diagnostics::Diagnostics;
use ulna_table::{Model, TableErrors};

const ERROR: Style = AnsiColor::Red.on_default().bold();
const WARNING: Style = AnsiColor::Yellow.on_default().bold();

/// Everything that was found in a table.
pub(crate) fn report(found: &Diagnostics) {
    if !found.is_empty() {
        anstream::eprintln!("{}\n", found.to_coloured_string());
    }
}

/// Reads the table at `path`, and reports what is allowed in it but rarely meant.
pub(crate) fn load(path: &Path) -> Result<Model, TableErrors> {
    let (model, warnings) = Model::lint(path)?;
    report(&warnings);
    Ok(model)
}

/// [`load`], with what the generator says of the arm reported too, and the table's text.
pub(crate) fn examine(path: &Path) -> Result<(String, Model), TableErrors> {
    let text = Model::read_in("", path)?;
    let (model, found) = Model::lint_text(&text, &path.display().to_string())?;
    report(&found);
    warnings(path, &ulna_codegen::warnings(&model));
    Ok((text, model))
}

/// One error that is not about a place in a table.
pub(crate) fn error(message: &str) {
    anstream::eprintln!("{ERROR}error{ERROR:#}: {}", plain(message));
}

/// One warning that is not about a place in a table.
pub(crate) fn warning(message: &str) {
    anstream::eprintln!("{WARNING}warning{WARNING:#}: {}", plain(message));
}

/// What the generator says of the arm whose table stands at `path`.
pub(crate) fn warnings(path: &Path, sentences: &[String]) {
    for sentence in sentences {
        warning(&format!("{}: {sentence}", path.display()));
    }
}

/// What has been done.
pub(crate) fn note(message: &str) {
    anstream::eprintln!("{}", plain(message));
}

/// A message without what a terminal would obey: the name of a file in it may be anything.
fn plain(message: &str) -> Cow<'_, str> {
    let obeyed = |c: char| c.is_control() && c != '\n';
    if !message.contains(obeyed) {
        return message.into();
    }
    let parts = message.chars().map(|c| match c {
        c if obeyed(c) => c.escape_debug().to_string(),
        c => c.to_string(),
    });
    parts.collect()
}
