//! For build scripts: tables in, one Rust file each into `OUT_DIR`.

use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use ulna_table::{Model, TableErrors};

use crate::Generator;

/// The file of the list: a name that no arm may have.
const LIST: &str = "arms";

/// Why a build script could not write its arms.
#[derive(thiserror::Error)]
pub enum Error {
    /// Tables have errors, each told with its file and line.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n"))]
    Tables(Vec<TableErrors>),
    /// Two arms would become the same type: the second would hide or replace the first.
    #[error("{second} would become the type `{name}`, as {first} does: rename one of the arms", first = .first.display(), second = .second.display())]
    SameType {
        /// The type's name.
        name: String,
        /// The table that has it first.
        first: PathBuf,
        /// The table that repeats it.
        second: PathBuf,
    },
    /// `OUT_DIR` is not set: this is no build script.
    #[error("OUT_DIR is not set: call compile_arms from a build script, or use `ulna generate`")]
    NoOutDir,
    /// The folder of tables could not be read.
    #[error("cannot read {path}: {source}", path = .path.display())]
    Read {
        /// The folder.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A generated file could not be written.
    #[error("cannot write {path}: {source}", path = .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

/// `main` of a build script prints its error with `Debug`, and cargo shows that: the text for people then.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Self::Tables(_) = self {
            f.write_str("no code for tables with errors\n\n")?;
        }
        fmt::Display::fmt(self, f)
    }
}

/// Generates code for `tables` and writes each arm to `$OUT_DIR/<name>.rs`, for a build script.
///
/// ```no_run
/// // build.rs
/// fn main() -> Result<(), ulna_codegen::Error> {
///     ulna_codegen::compile_arms(&["arms/ssrms.toml"])
/// }
/// // src/lib.rs:  include!(concat!(env!("OUT_DIR"), "/ssrms.rs"));
/// ```
///
/// Paths are relative to the package's root, where cargo runs build scripts. The script runs again when a table changes.
///
/// # Errors
/// All errors of all tables at once, for `main` to return: cargo shows them and stops. Nothing is written then.
pub fn compile_arms(tables: &[impl AsRef<Path>]) -> Result<(), Error> {
    Generator::new().compile_arms(tables)
}

/// [`compile_arms`] by `generator`.
pub(crate) fn compile_arms_with(
    generator: &Generator,
    tables: &[impl AsRef<Path>],
) -> Result<(), Error> {
    watch(tables);
    compile_into_out_dir(generator, &load_all(tables)?)
}

/// Tells cargo to run the script again when one of `tables` changes.
fn watch(tables: &[impl AsRef<Path>]) {
    for table in tables {
        println!(
            "cargo::rerun-if-changed={}",
            watched(table.as_ref()).display()
        );
    }
}

/// What cargo is told to watch for `table`: its folder if there is a line break in its name, because what follows one
/// would be another instruction to cargo.
fn watched(table: &Path) -> &Path {
    let one_line = |path: &&Path| !path.to_string_lossy().contains(['\n', '\r']);
    match table.ancestors().find(one_line) {
        Some(path) if !path.as_os_str().is_empty() => path,
        _ => Path::new("."),
    }
}

/// [`compile_arms`], and `$OUT_DIR/arms.rs` over `tables`, in their order: it includes every arm, and defines a macro that lists them.
///
/// `for_each_arm!(callback)` expands to `callback! { (Ssrms, ssrms, 7) … }`: type, name and joints of each.
/// `Ssrms::default()` is a value of any such type, whether or not it holds a payload.
///
/// # Errors
/// As [`compile_arms`].
pub fn compile_listed(tables: &[impl AsRef<Path>]) -> Result<(), Error> {
    Generator::new().compile_listed(tables)
}

/// [`compile_listed`] by `generator`.
pub(crate) fn compile_listed_with(
    generator: &Generator,
    tables: &[impl AsRef<Path>],
) -> Result<(), Error> {
    watch(tables);
    list_into_out_dir(generator, tables)
}

/// [`compile_listed`] for every table of a folder, in alphabetical order. The script runs again when anything in the folder changes.
///
/// # Errors
/// As [`compile_listed`], and if the folder cannot be read.
pub fn compile_folder(folder: impl AsRef<Path>) -> Result<(), Error> {
    Generator::new().compile_folder(folder)
}

/// [`compile_folder`] by `generator`.
pub(crate) fn compile_folder_with(generator: &Generator, folder: &Path) -> Result<(), Error> {
    watch(&[folder]);
    list_into_out_dir(generator, &tables_of(folder)?)
}

fn tables_of(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let unreadable = |source| Error::Read {
        path: folder.to_path_buf(),
        source,
    };
    let mut tables = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            tables.push(path);
        }
    }
    tables.sort();
    Ok(tables)
}

fn list(models: &[(&Path, Model)]) -> String {
    let includes = models
        .iter()
        .map(|(_, model)| format!("include!(\"{}.rs\");\n", model.name()));
    let entries = models.iter().map(|(_, model)| {
        let joints = model.joints().len();
        format!(" ({}, {}, {joints})", model.type_name(), model.name())
    });
    format!(
        "{}\n/// Expands to `callback! {{ (Type, name, joints) … }}` over every arm that is compiled.\n\
         #[macro_export]\nmacro_rules! for_each_arm {{\n    \
         ($callback:ident) => {{ $callback! {{{} }} }};\n}}\n",
        includes.collect::<String>(),
        entries.collect::<String>(),
    )
}

fn list_into_out_dir(generator: &Generator, tables: &[impl AsRef<Path>]) -> Result<(), Error> {
    let models = load_all(tables)?;
    compile_into_out_dir(generator, &models)?;
    write_to_out_dir(LIST, &list(&models))
}

fn compile_into_out_dir(generator: &Generator, models: &[(&Path, Model)]) -> Result<(), Error> {
    for (path, model) in models {
        let generated = generator.generate(model, &path.display().to_string());
        for sentence in generated.warnings() {
            warn(&format!("{}: {sentence}", path.display()));
        }
        write_to_out_dir(model.name(), &generated.source())?;
    }
    Ok(())
}

/// Writes `$OUT_DIR/<name>.rs` whole or not at all.
fn write_to_out_dir(name: &str, text: &str) -> Result<(), Error> {
    let out_dir = std::env::var_os("OUT_DIR").ok_or(Error::NoOutDir)?;
    let path = Path::new(&out_dir).join(format!("{name}.rs"));
    let partial = path.with_extension("rs.partial");
    fs::write(&partial, text)
        .and_then(|()| fs::rename(&partial, &path))
        .map_err(|source| Error::Write { path, source })
}

/// A warning, line by line as cargo wants it.
fn warn(text: &str) {
    for line in text.lines() {
        println!("cargo::warning={line}");
    }
}

fn load_all(tables: &[impl AsRef<Path>]) -> Result<Vec<(&Path, Model)>, Error> {
    let mut models: Vec<(&Path, Model)> = Vec::new();
    let mut errors = Vec::new();
    for table in tables.iter().map(AsRef::as_ref) {
        match Model::lint(table) {
            Ok((model, found)) => {
                if !found.is_empty() {
                    warn(&found.to_string());
                }
                models.push((table, model));
            }
            Err(error) => errors.push(error),
        }
    }
    if !errors.is_empty() {
        return Err(Error::Tables(errors));
    }
    for (i, (second, model)) in models.iter().enumerate() {
        if let Some((first, _)) = models[..i]
            .iter()
            .find(|(_, other)| other.type_name() == model.type_name())
        {
            return Err(Error::SameType {
                name: model.type_name(),
                first: first.to_path_buf(),
                second: second.to_path_buf(),
            });
        }
    }
    Ok(models)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arms_of_one_type_are_refused() {
        let table = "../arms/planar_2r.toml";
        let error = load_all(&[table, "../arms/ssrms.toml", table]).unwrap_err();
        assert!(matches!(&error, Error::SameType { name, .. } if name == "Planar2r"));
        assert!(error.to_string().contains("rename one of the arms"));
    }

    #[test]
    fn no_path_is_an_instruction_to_cargo() {
        let watched = |path| watched(Path::new(path));
        assert_eq!(watched("arms/a.toml"), Path::new("arms/a.toml"));
        assert_eq!(
            watched("arms/a\ncargo::rustc-cfg=b.toml"),
            Path::new("arms")
        );
        assert_eq!(watched("a\rb.toml"), Path::new("."));
    }

    #[test]
    fn every_bad_table_is_told() {
        let Error::Tables(errors) = load_all(&["no_such.toml", "../arms"]).unwrap_err() else {
            panic!("absent tables are another error");
        };
        assert_eq!(errors.len(), 2);
        // What cargo shows of `main`'s error.
        let shown = format!("{:?}", Error::Tables(errors));
        assert!(
            shown.contains("no_such.toml") && shown.contains("../arms"),
            "{shown}"
        );
    }
}
