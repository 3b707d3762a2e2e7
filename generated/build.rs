//! Generates the arms that features ask for, and the list of them.
//!
//! The folder is a link to the repository's, which packaging follows.

use std::path::{Path, PathBuf};

use ulna_codegen::{Error, compile_folder, compile_listed};

const FOLDER: &str = "arms";

fn main() -> Result<(), Error> {
    let (mut names, mut all) = (Vec::new(), false);
    for (key, _) in std::env::vars_os() {
        match key
            .to_str()
            .and_then(|key| key.strip_prefix("CARGO_FEATURE_"))
        {
            None | Some("DEFAULT") => {}
            Some("ALL") => all = true,
            // Arms have lower-case names, and no feature has a hyphen.
            Some(name) => names.push(name.to_ascii_lowercase()),
        }
    }
    names.sort();
    let table = |name: &String| Path::new(FOLDER).join(name).with_extension("toml");
    let tables: Vec<PathBuf> = names.iter().map(table).collect();
    for (name, table) in names.iter().zip(&tables) {
        if !table.exists() {
            // Cargo gathers these, and stops.
            println!(
                "cargo::error=the feature `{name}` has no table: write {}, or take the feature out of Cargo.toml",
                table.display()
            );
        }
    }
    if all {
        compile_folder(FOLDER)
    } else {
        let tables: Vec<_> = tables.iter().filter(|table| table.exists()).collect();
        compile_listed(&tables)
    }
}
