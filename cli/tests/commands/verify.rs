//! `ulna verify`.

use crate::support::{folder_with_bad_table, stdout, ulna};

#[test]
fn emitted_code_is_compared_method_by_method() {
    let run = ulna(&["verify", "arms/planar_2r.toml", "--samples", "10"])
        .code(0)
        .stderr("");
    let out = stdout(&run);
    assert!(out.contains("(10 states)"), "{out}");
    for method in [
        "mass_matrix ",
        "jacobian_derivatives",
        "dynamic_manipulability_gradient",
    ] {
        assert!(out.contains(method), "{out}");
    }
    assert!(
        out.contains("central differences") && !out.contains("WRONG"),
        "{out}"
    );
}

#[test]
fn samples_are_a_positive_number() {
    for samples in ["0", "-1", "many"] {
        ulna(&["verify", "arms/planar_2r.toml", "--samples", samples])
            .code(2)
            .stdout("");
    }
}

#[test]
fn a_bad_table_is_refused() {
    let folder = folder_with_bad_table();
    let table = folder.path().join("bad.toml");
    ulna(&["verify", table.to_str().unwrap()])
        .code(1)
        .stdout("");
}

#[test]
fn an_arm_with_too_many_joints_is_told_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let planar = include_str!("../../../arms/planar_2r.toml");
    let (head, joint) = planar.rsplit_once("[[joint]]").unwrap();
    let long = format!("{head}{}", format!("[[joint]]{joint}").repeat(20));
    let table = folder.path().join("long.toml");
    std::fs::write(&table, long).unwrap();
    let run = ulna(&["verify", table.to_str().unwrap()])
        .code(1)
        .stdout("");
    let err = crate::support::stderr(&run);
    assert!(
        err.contains("21 joints") && err.contains("ulna::proof::compare::<21>"),
        "{err}"
    );
}
