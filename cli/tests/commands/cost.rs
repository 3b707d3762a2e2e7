//! `ulna cost`.

use serde_json::Value;
use ulna::Method;

use crate::support::{folder_with_bad_table, stdout, ulna};

#[test]
fn json_has_every_method_and_every_operation() {
    let run = ulna(&["cost", "arms/ssrms.toml", "--json"])
        .code(0)
        .stderr("");
    let cost: Value = serde_json::from_str(&stdout(&run)).unwrap();
    let keys = |value: &Value| {
        value
            .as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect::<Vec<_>>()
    };
    assert_eq!(keys(&cost), ["arm", "quantities"]);
    assert_eq!(cost["arm"], "ssrms");
    let methods: Vec<_> = Method::ALL.iter().map(|method| method.name()).collect();
    assert_eq!(keys(&cost["quantities"]), methods);
    for method in methods {
        let counts = &cost["quantities"][method];
        let mut names = keys(counts);
        names.sort();
        assert_eq!(
            names,
            [
                "add", "div", "mul", "neg", "sin_cos", "sqrt", "sub", "total"
            ]
        );
        let count = |name: &str| counts[name].as_u64().unwrap();
        let operations = ["add", "sub", "mul", "neg", "div", "sqrt"];
        assert_eq!(
            count("total"),
            operations.into_iter().map(count).sum::<u64>()
        );
        assert!(count("sin_cos") <= 7);
    }
    assert!(cost["quantities"]["mass_matrix"]["total"].as_u64().unwrap() > 0);
}

#[test]
fn the_table_has_lines_and_seconds_too() {
    let out = stdout(&ulna(&["cost", "arms/planar_2r.toml"]).code(0).stderr(""));
    let first = out.lines().next().unwrap();
    assert!(
        first.starts_with("planar_2r: ") && first.contains(" lines, generated in "),
        "{out}"
    );
    let listed = Method::ALL.iter().all(|method| out.contains(method.name()));
    assert!(listed, "{out}");
}

#[test]
fn base_parameters_are_listed_with_what_is_grouped_into_them() {
    let run = ulna(&["cost", "arms/planar_2r.toml", "--base-parameters"])
        .code(0)
        .stderr("");
    // A point mass on the second joint's axis is one on the first link, a metre out.
    let expected = "\
planar_2r: 6 base parameters of 20 inertial ones, about the origins of the links' frames
mx1 + m2
my1
Izz1 + m2
mx2
my2
Izz2
";
    assert_eq!(stdout(&run), expected);
    let run = ulna(&["cost", "arms/planar_2r.toml", "--base-parameters", "--json"])
        .code(0)
        .stderr("");
    let listed: Value = serde_json::from_str(&stdout(&run)).unwrap();
    assert_eq!(listed["arm"], "planar_2r");
    let first = &listed["base_parameters"][0];
    assert_eq!(
        (&first["link"], &first["parameter"]),
        (&1.into(), &"mx".into())
    );
    let grouped = serde_json::json!([{ "coefficient": 1.0, "link": 2, "parameter": "m" }]);
    assert_eq!(first["grouped"], grouped);
    assert_eq!(listed["base_parameters"].as_array().unwrap().len(), 6);
}

#[test]
fn a_bad_table_is_refused() {
    let folder = folder_with_bad_table();
    let table = folder.path().join("bad.toml");
    ulna(&["cost", table.to_str().unwrap(), "--json"])
        .code(1)
        .stdout("");
}
