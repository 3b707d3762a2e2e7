//! Generates every arm of `../arms`, and the list of them.

fn main() -> Result<(), ulna_codegen::Error> {
    ulna_codegen::compile_folder("../arms")
}
