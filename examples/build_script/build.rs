fn main() -> Result<(), ulna_codegen::Error> {
    ulna_codegen::compile_arms(&["../../arms/planar_2r.toml"])
}
