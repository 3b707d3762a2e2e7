fn main() -> Result<(), ulna_codegen::Error> {
    ulna_codegen::compile_arms(&["bench_arm.toml"])
}
