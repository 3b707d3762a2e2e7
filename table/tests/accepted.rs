//! Inertias that no rigid body can have, taken over knowingly.

use ulna_table::diagnostics::Severity;
use ulna_table::{AngleUnit, Model};

const PLANAR: &str = include_str!("../../arms/planar_2r.toml");
const INERTIA: &str =
    "inertia = { xx = 0.0003125, yy = 0.0834895833333333, zz = 0.0834895833333333 }\n";

/// The planar arm with another inertia of its last link, and a line below it.
fn table(inertia: &str, below: &str) -> String {
    let (head, last) = PLANAR.rsplit_once(INERTIA).unwrap();
    format!("{head}inertia = {inertia}\n{below}\n{last}")
}

/// The model of the table and what is warned of.
fn accepted(inertia: &str) -> (Model, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.toml");
    std::fs::write(&path, table(inertia, "accept_inertia = true")).unwrap();
    let (model, found) = Model::lint_in(folder.path(), "arm.toml").unwrap();
    assert!(
        found
            .list()
            .iter()
            .all(|one| one.severity == Severity::Warning)
    );
    (model, found.to_string())
}

#[test]
fn what_no_body_can_have_is_refused_with_its_numbers_and_taken_over_if_the_table_says_so() {
    let long = "{ xx = 0.001, yy = 0.002, zz = 0.004 }";
    let refused = Model::parse(&table(long, ""), "arm.toml").unwrap_err();
    insta::assert_snapshot!("refused", refused.to_string());
    let (model, warned) = accepted(long);
    insta::assert_snapshot!("taken_over", warned);
    assert_eq!(model.accepts_inertia(), [false, true]);
    assert_eq!(model.joints()[1].link.inertia[2][2], 0.004);
}

#[test]
fn a_point_mass_and_a_tensor_that_is_not_definite_are_taken_over_too() {
    for inertia in [
        "{ xx = 0.0, yy = 0.0, zz = 0.0 }",
        "{ xx = -0.001, yy = 0.002, zz = 0.002 }",
    ] {
        let refused = Model::parse(&table(inertia, ""), "arm.toml").unwrap_err();
        assert!(refused.to_string().contains("positive definite"));
        let (_, warned) = accepted(inertia);
        assert!(warned.contains("taken over"), "{warned}");
    }
}

#[test]
fn nothing_is_accepted_that_leaves_no_mass_matrix() {
    let text = table("{ xx = 0.1, yy = 0.1, zz = -0.2 }", "accept_inertia = true");
    let refused = Model::parse(&text, "arm.toml").unwrap_err();
    insta::assert_snapshot!("no_mass_matrix", refused.to_string());
}

#[test]
fn what_needs_no_accepting_is_told() {
    let (_, warned) = accepted("{ xx = 0.001, yy = 0.002, zz = 0.002 }");
    insta::assert_snapshot!("not_needed", warned);
}

#[test]
fn it_stays_in_the_description_and_in_its_table() {
    let (model, _) = accepted("{ xx = 0.001, yy = 0.002, zz = 0.004 }");
    let described = model.description();
    assert_eq!(Model::new(&described).unwrap().description(), described);
    let text = described.to_table(AngleUnit::Degrees).to_string();
    assert_eq!(text.matches("accept_inertia = true\n").count(), 1);
    assert_eq!(
        Model::parse(&text, "arm.toml").unwrap().description(),
        described
    );
    let mut plain = described;
    plain.accept_inertia.clear();
    assert!(Model::new(&plain).is_err());
}
