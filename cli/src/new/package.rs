//! [`Package`]: a new crate, all of it or nothing.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use ulna_table::{is_keyword, name_for};

use super::fill::fill;
use super::table::Table;
use crate::console;
use crate::output::Files;

/// Every file of a new crate but the table, and what it is made of.
const TEMPLATES: [(&str, &str); 10] = [
    ("Cargo.toml", include_str!("template/crate/manifest.toml")),
    (".gitignore", include_str!("template/crate/gitignore")),
    ("README.md", include_str!("template/crate/README.md")),
    ("build.rs", include_str!("template/crate/build.rs")),
    ("src/lib.rs", include_str!("template/crate/src/lib.rs")),
    (
        "src/bin/control_loop/main.rs",
        include_str!("template/crate/src/bin/control_loop/main.rs"),
    ),
    (
        "src/bin/control_loop/plan.rs",
        include_str!("template/crate/src/bin/control_loop/plan.rs"),
    ),
    (
        "src/bin/control_loop/plant.rs",
        include_str!("template/crate/src/bin/control_loop/plant.rs"),
    ),
    (
        "tests/verified.rs",
        include_str!("template/crate/tests/verified.rs"),
    ),
    (
        "benches/dynamics.rs",
        include_str!("template/crate/benches/dynamics.rs"),
    ),
];

/// A crate that is to be written into a folder which has been found to be new or empty.
pub(super) struct Package<'a> {
    folder: &'a Path,
    name: String,
    /// The values of the keys `ulna` and `ulna-codegen` in its manifest.
    ulna: String,
    ulna_codegen: String,
}

impl<'a> Package<'a> {
    /// One named after `folder`, with the crates of a `checkout` or the released ones of this version.
    pub(super) fn new(folder: &'a Path, checkout: Option<&Path>) -> anyhow::Result<Self> {
        let name = name_of(folder)?;
        Ok(Self {
            folder,
            name,
            ulna: dependency(checkout, "ulna", "")?,
            ulna_codegen: dependency(checkout, "ulna-codegen", "codegen")?,
        })
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// Writes it, and returns the paths of its files.
    pub(super) fn write(&self, table: &Table) -> anyhow::Result<Vec<PathBuf>> {
        let values = [
            ("my-package", self.name.as_str()),
            ("my_crate", &self.name.replace('-', "_")),
            ("my_arm", table.name()),
            ("MyArm", &table.type_name()),
            ("\"ULNA\"", &self.ulna),
            ("\"ULNA_CODEGEN\"", &self.ulna_codegen),
            ("0.0.0", env!("CARGO_PKG_RUST_VERSION")),
        ];
        let mut files = Files::default();
        for (path, template) in TEMPLATES {
            files.add(path, fill(template, &values));
        }
        files.add(format!("arms/{}.toml", table.name()), table.text());
        files.write_new_to(self.folder)
    }
}

/// What a package in `folder` is called: as the folder, or where no package can be called so, something like it.
fn name_of(folder: &Path) -> anyhow::Result<String> {
    let shown = folder.display();
    let found = match fs::metadata(folder) {
        Ok(found) if !found.is_dir() => bail!("{shown} is a file: name a new folder"),
        Ok(_) => {
            let is_empty = fs::read_dir(folder).map(|mut entries| entries.next().is_none());
            if !is_empty.with_context(|| format!("cannot read {shown}"))? {
                bail!("the folder {shown} is not empty, and stays as it is: name a new folder");
            }
            // What `.` is called.
            fs::canonicalize(folder).with_context(|| format!("cannot read {shown}"))?
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => folder.to_path_buf(),
        Err(error) => return Err(error).with_context(|| format!("cannot make the folder {shown}")),
    };
    let Some(folder_name) = found.file_name() else {
        bail!("{shown} has no name that a crate could have: name a new folder");
    };
    let folder_name = folder_name.to_string_lossy();
    if can_be_a_package(&folder_name) {
        return Ok(folder_name.into_owned());
    }
    // Names of arms are identifiers; with the suffix none is taken.
    let (snake, _) = name_for(&folder_name);
    let name = if can_be_a_package(&snake) {
        snake
    } else {
        format!("{snake}_robot")
    };
    console::note(&format!(
        "the crate is called `{name}`, since none can be called `{folder_name}`"
    ));
    Ok(name)
}

/// Whether a package with a library can have that name without a warning: a crate in lower case that hides no other.
fn can_be_a_package(name: &str) -> bool {
    /// Crates that it needs, those of the compiler, and folders that cargo keeps for itself.
    const TAKEN: [&str; 13] = [
        "ulna",
        "ulna_codegen",
        "control_loop",
        "alloc",
        "core",
        "proc_macro",
        "std",
        "test",
        "build",
        "deps",
        "examples",
        "incremental",
        "nalgebra",
    ];
    const MAX_LENGTH: usize = 64;

    let identifier = name.replace('-', "_");
    let is_word = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    name.len() <= MAX_LENGTH
        && name.starts_with(|first: char| first.is_ascii_lowercase())
        && identifier.chars().all(is_word)
        && !identifier.contains("__")
        && !is_keyword(&identifier)
        && !TAKEN.contains(&identifier.as_str())
}

/// The value of the manifest's key for a `package` of ours, which a checkout has in `folder`.
fn dependency(checkout: Option<&Path>, package: &str, folder: &str) -> anyhow::Result<String> {
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    let Some(checkout) = checkout else {
        return Ok(format!("\"{VERSION}\""));
    };
    let path = if folder.is_empty() {
        std::path::absolute(checkout)
    } else {
        std::path::absolute(checkout.join(folder))
    };
    let path = path.with_context(|| format!("cannot read {}", checkout.display()))?;
    let manifest = fs::read_to_string(path.join("Cargo.toml")).unwrap_or_default();
    let is_named = |line: &str| line.trim() == format!("name = \"{package}\"");
    if !manifest.lines().any(is_named) {
        bail!(
            "{} is no checkout of ulna: {} is not the manifest of `{package}`; name the root folder of its repository",
            checkout.display(),
            path.join("Cargo.toml").display()
        );
    }
    let Some(path) = path.to_str() else {
        bail!(
            "{}: a manifest can only hold a path in UTF-8",
            path.display()
        );
    };
    // A string of JSON is one of TOML, but for a character that no path should have.
    let path = serde_json::to_string(path)?.replace('\u{7f}', "\\u007f");
    Ok(format!("{{ path = {path}, version = \"{VERSION}\" }}"))
}
