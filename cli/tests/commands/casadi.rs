//! `ulna generate --language c --abi casadi`.

use std::fs;

use crate::support::{stderr, ulna};

const FLAGS: [&str; 6] = [
    "generate",
    "arms/planar_2r.toml",
    "--language",
    "c",
    "--abi",
    "casadi",
];

#[test]
fn casadis_functions_are_files_beside_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let output = ["--output", folder.path().to_str().unwrap()];
    ulna(&[&FLAGS[..], &output].concat()).code(0);
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("planar_2r_casadi.h").contains("jac_tau_qd[2x2, 3 entries]"));
    assert!(read("planar_2r_casadi.c").contains("#include \"planar_2r.h\""));
    assert!(!read("planar_2r.c").contains("casadi"));
    ulna(&[&FLAGS[..], &output, &["--check"]].concat()).code(0);
    fs::write(folder.path().join("planar_2r_casadi.c"), "").unwrap();
    let old = ulna(&[&FLAGS[..], &output, &["--check"]].concat()).code(1);
    assert!(stderr(&old).contains("planar_2r_casadi.c is out of date"));
}

#[test]
fn what_casadi_cannot_have_is_a_usage_error() {
    let folder = tempfile::tempdir().unwrap();
    let output = ["--output", folder.path().to_str().unwrap()];
    let wrong: [(&[&str], &str); 2] = [
        (
            &["--precision", "float"],
            "`--abi casadi` is in double precision, as CasADi is: leave out `--precision float`",
        ),
        (
            &["--methods", "inverse_dynamics,mass_matrix"],
            "add inverse_dynamics_derivatives,forward_dynamics,forward_dynamics_derivatives to `--methods`",
        ),
    ];
    for (arguments, message) in wrong {
        let run = ulna(&[&FLAGS[..], &output, arguments].concat()).code(2);
        assert!(stderr(&run).contains(message), "{}", stderr(&run));
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
