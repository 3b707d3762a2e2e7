//! The option `--methods` of `generate`, `cost` and `verify`.

use crate::support::{stderr, stdout, ulna};

const TABLE: &str = "arms/planar_2r.toml";
const CHOSEN: &str = "mass_matrix,inverse_dynamics";

#[test]
fn code_of_chosen_methods_has_no_others() {
    let code = stdout(
        &ulna(&["generate", TABLE, "--methods", CHOSEN])
            .code(0)
            .stderr(""),
    );
    assert!(code.contains("fn mass_matrix_kernel<"), "{code}");
    assert!(code.contains("fn inverse_dynamics_kernel<"), "{code}");
    assert!(!code.contains("geometric_jacobian_kernel"), "{code}");
    let header = code.split("\n\n").next().unwrap();
    assert!(
        header.contains("// Not generated, but computed by the textbook"),
        "{header}"
    );
    assert!(header.contains("geometric_jacobian"), "{header}");
}

#[test]
fn a_file_that_is_out_of_date_is_told_with_the_option() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("planar_2r.rs");
    let path = file.to_str().unwrap();
    let chosen = ["generate", TABLE, "--methods", CHOSEN, "--output", path];
    let check = [&chosen[..], &["--check"]].concat();
    ulna(&chosen).code(0).stdout("").stderr("");
    ulna(&check).code(0).stdout("").stderr("");
    ulna(&["generate", TABLE, "--output", path, "--check"]).code(1);
    ulna(&["generate", TABLE, "--output", path]).code(0);
    let stale = stderr(&ulna(&check).code(1));
    assert!(
        stale.contains(&format!(
            "`ulna generate {TABLE} --methods {CHOSEN} --output"
        )),
        "{stale}"
    );
}

#[test]
fn costs_and_proof_are_of_what_is_generated() {
    let cost = stdout(&ulna(&["cost", TABLE, "--methods", CHOSEN]).code(0));
    assert!(cost.contains("inverse_dynamics "), "{cost}");
    assert!(
        cost.contains("by the textbook formulas: forward_kinematics, "),
        "{cost}"
    );
    let json = stdout(&ulna(&["cost", TABLE, "--methods", CHOSEN, "--json"]).code(0));
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["quantities"].as_object().unwrap().len(), 2);
    let verify = ["verify", TABLE, "--samples", "3", "--methods", CHOSEN];
    let verified = stdout(&ulna(&verify).code(0).stderr(""));
    // Both reports, and none of finite differences: neither is a derivative.
    assert_eq!(
        verified.matches("inverse_dynamics  ").count(),
        2,
        "{verified}"
    );
    assert!(!verified.contains("central differences"), "{verified}");
    assert!(
        verified.contains("not generated, and not compared: forward_kinematics, "),
        "{verified}"
    );
}

#[test]
fn an_unknown_method_is_a_usage_error_with_the_list() {
    for command in ["generate", "cost", "verify"] {
        let run = ulna(&[command, TABLE, "--methods", "mass_matirx"])
            .code(2)
            .stdout("");
        let said = stderr(&run);
        assert!(said.contains("mass_matirx"), "{said}");
        assert!(
            said.contains("a similar value exists: 'mass_matrix'"),
            "{said}"
        );
        assert!(
            said.contains("forward_kinematics, link_poses, geometric_jacobian"),
            "{said}"
        );
    }
}
