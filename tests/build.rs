//! Lists the tables of `arms/` for tests that run on every one of them, compiled into `ulna-generated` or not.
//!
//! - `tables.rs`: `for_each_table!(callback)` expands to `callback! { (name, joints) … }`.
//! - `measured.rs`: `if_measured! { name { items } }` is the items if numbers from outside stand in `oracle/data/<name>.jsonl`.

use std::fs;
use std::path::{Path, PathBuf};

use ulna_table::Model;

const TABLES: &str = "../arms";
const NUMBERS: &str = "oracle/data";

fn main() {
    for folder in [TABLES, NUMBERS] {
        println!("cargo::rerun-if-changed={folder}");
    }
    let arms: Vec<(String, usize)> = tables().iter().map(|table| named(table)).collect();
    let entries: String = arms
        .iter()
        .map(|(name, joints)| format!(" ({name}, {joints})"))
        .collect();
    write(
        "tables.rs",
        &format!(
            "macro_rules! for_each_table {{\n    ($callback:ident) => {{ $callback! {{{entries} }} }};\n}}\n"
        ),
    );
    let measured: String = arms
        .iter()
        .filter(|(name, _)| Path::new(NUMBERS).join(format!("{name}.jsonl")).exists())
        .map(|(name, _)| format!("    ({name} {{ $($item:item)* }}) => {{ $($item)* }};\n"))
        .collect();
    write(
        "measured.rs",
        &format!(
            "macro_rules! if_measured {{\n{measured}    ($name:ident {{ $($item:item)* }}) => {{}};\n}}\n"
        ),
    );
}

/// In alphabetical order.
fn tables() -> Vec<PathBuf> {
    let entries = fs::read_dir(TABLES).expect("the repository has arms/");
    let mut tables: Vec<PathBuf> = entries
        .map(|entry| entry.expect("arms/ can be read").path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "toml")
        })
        .collect();
    tables.sort();
    tables
}

/// The arm's name, which is the file's too, and its number of joints.
fn named(table: &Path) -> (String, usize) {
    let model = Model::load(table).unwrap_or_else(|errors| panic!("{errors}"));
    let file = table.file_stem().unwrap_or_default();
    assert_eq!(
        file,
        model.name(),
        "{}: write the arm's name for the file's, or the other way round",
        table.display()
    );
    (model.name().to_owned(), model.joints().len())
}

fn write(file: &str, text: &str) {
    let folder = std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
    fs::write(Path::new(&folder).join(file), text).expect("OUT_DIR can be written");
}
