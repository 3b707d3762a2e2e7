//! CasADi's interface, called from C as `casadi.external` calls it. Python is not needed here; `examples/casadi` lets CasADi itself do it.

use std::fs;
use std::process::Command;

use ulna::Method;
use ulna_codegen::{Abi, COptions, Generator, Precision};
use ulna_table::Model;

fn model(arm: &str) -> Model {
    Model::load(format!("../arms/{arm}.toml")).unwrap()
}

fn generated(arm: &str, options: COptions) -> ulna_codegen::GeneratedC {
    let methods = Abi::Casadi.methods(model(arm).has_payload());
    let generator = Generator::new().methods(&methods);
    generator.generate_c(&model(arm), &format!("{arm}.toml"), options)
}

fn has_casadi(c: &ulna_codegen::GeneratedC) -> bool {
    let files = c.files();
    let named = files.iter().filter(|(name, _)| name.contains("casadi"));
    matches!(named.count(), 2) && files.len() == 4
}

/// Names and sparsities, values, Jacobians beside differences, what is NULL: an arm with structural zeros, one with a payload and
/// prismatic joints beside revolute ones, one without anything special.
#[test]
fn an_arm_is_what_casadi_looks_for() {
    for arm in ["planar_2r", "ssrms", "geared_6", "stanford_arm"] {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in generated(arm, COptions::new().abi(Abi::Casadi)).files() {
            fs::write(folder.path().join(name), text).unwrap();
        }
        let driver = folder.path().join("driver");
        let model = model(arm);
        let compiled = Command::new("cc")
            .args([
                "-std=c99",
                "-Wall",
                "-Wextra",
                "-Wpedantic",
                "-Wconversion",
                "-Werror",
                "-O1",
            ])
            .arg(format!("-DARM={arm}"))
            .arg(format!("-DHEADER=\"{arm}_casadi.h\""))
            .arg(format!("-DOTHER=\"{arm}.h\""))
            .arg(format!("-DJOINTS={}", model.joints().len()))
            .arg(format!("-DPAYLOAD={}", u8::from(model.has_payload())))
            .arg("-I")
            .arg(folder.path())
            .arg("-o")
            .arg(&driver)
            .args(
                [format!("{arm}.c"), format!("{arm}_casadi.c")]
                    .map(|file| folder.path().join(file)),
            )
            .arg("tests/casadi/driver.c")
            .arg("-lm")
            .output()
            .unwrap();
        assert!(
            compiled.status.success(),
            "{arm}: {}",
            String::from_utf8_lossy(&compiled.stderr)
        );
        let run = Command::new(&driver).output().unwrap();
        assert!(
            run.status.success(),
            "{arm}:\n{}",
            String::from_utf8_lossy(&run.stdout)
        );
    }
}

/// CasADi's numbers are doubles, and its Jacobians come from methods of their own.
#[test]
fn there_is_none_in_single_precision_or_without_its_methods() {
    let casadi = COptions::new().abi(Abi::Casadi);
    assert!(has_casadi(&generated("planar_2r", casadi)));
    let single = generated("planar_2r", casadi.precision(Precision::Float));
    assert!(!has_casadi(&single));
    let arm = model("planar_2r");
    for left_out in Abi::Casadi.methods(false) {
        let mut methods = Abi::Casadi.methods(false);
        methods.retain(|method| *method != left_out);
        let generator = Generator::new().methods(&methods);
        let c = generator.generate_c(&arm, "planar_2r.toml", casadi);
        assert!(!has_casadi(&c), "{left_out}");
    }
    assert_eq!(Abi::Casadi.methods(true).last(), Some(&Method::Regressor));
}
