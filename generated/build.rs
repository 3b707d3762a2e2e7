//! Generates every arm of `arms/`, and the list of them.
//!
//! The folder is a link to the repository's, which packaging follows.

fn main() -> Result<(), ulna_codegen::Error> {
    ulna_codegen::compile_folder("arms")
}
