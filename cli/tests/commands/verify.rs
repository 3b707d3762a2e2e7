//! `ulna verify`.

use crate::support::{folder_with_bad_table, long_arm, stderr, stdout, ulna};

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

/// Of as many joints as a table may have, and of one more than experiments go to.
#[test]
fn long_arms_are_compared_like_short_ones() {
    let folder = tempfile::tempdir().unwrap();
    for (joints, methods) in [
        (13, "mass_matrix,jacobian_derivatives"),
        (32, "inverse_dynamics,mass_matrix"),
    ] {
        let table = long_arm(folder.path(), joints);
        let run = ulna(&["verify", &table, "--methods", methods, "--samples", "3"])
            .code(0)
            .stderr("");
        let out = stdout(&run);
        assert!(
            out.contains("(3 states)") && !out.contains("WRONG"),
            "{out}"
        );
        for method in methods.split(',') {
            let lines = out.lines().filter(|line| line.starts_with(method));
            let least = if method.contains("derivatives") { 3 } else { 2 };
            assert_eq!(lines.count(), least, "{method}: {out}");
        }
    }
}

/// Unless as many states are asked for.
#[test]
fn long_arms_are_compared_at_fewer_states() {
    let folder = tempfile::tempdir().unwrap();
    let table = long_arm(folder.path(), 24);
    let run = ulna(&["verify", &table, "--methods", "gravity_torque"]).code(0);
    assert!(stdout(&run).contains("(12 states)"));
}

#[test]
fn one_joint_too_many_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let table = long_arm(folder.path(), 33);
    let run = ulna(&["verify", &table]).code(1).stdout("");
    let err = stderr(&run);
    assert!(err.contains("32"), "{err}");
}
