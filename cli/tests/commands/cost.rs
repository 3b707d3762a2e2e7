//! `ulna cost`.

use serde_json::Value;
use ulna::Method;

use crate::support::{folder_with_bad_table, stderr, stdout, ulna};

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
fn several_arms_stand_side_by_side() {
    let tables = ["arms/ssrms.toml", "arms/planar_2r.toml"];
    let json: Vec<Value> = tables
        .iter()
        .map(|table| {
            let run = ulna(&["cost", table, "--json"]).code(0);
            serde_json::from_str(&stdout(&run)).unwrap()
        })
        .collect();
    let run = ulna(&["cost", tables[0], tables[1], "--json"])
        .code(0)
        .stderr("");
    let both: Value = serde_json::from_str(&stdout(&run)).unwrap();
    assert_eq!(both, Value::from(json.clone()));

    let out = stdout(&ulna(&["cost", tables[0], tables[1]]).code(0).stderr(""));
    let mut lines = out.lines().skip(1);
    let words =
        |line: &str| -> Vec<String> { line.split_whitespace().map(str::to_owned).collect() };
    assert_eq!(
        words(lines.next().unwrap()),
        ["method", "ssrms", "planar_2r"]
    );
    for method in Method::ALL {
        let mut expected = vec![method.name().to_owned()];
        for arm in &json {
            let counts = &arm["quantities"][method.name()];
            expected.extend([
                counts["total"].to_string(),
                "+".to_owned(),
                counts["sin_cos"].to_string(),
            ]);
        }
        assert_eq!(words(lines.next().unwrap()), expected);
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn some_methods_of_several_arms() {
    let run = ulna(&[
        "cost",
        "arms/ssrms.toml",
        "arms/planar_2r.toml",
        "--methods",
        "mass_matrix",
    ]);
    let out = stdout(&run.code(0).stderr(""));
    let lines: Vec<_> = out.lines().collect();
    assert_eq!(lines.len(), 4, "{out}");
    assert!(lines[2].trim().starts_with("mass_matrix "), "{out}");
    assert!(lines[3].starts_with("by the textbook formulas: "), "{out}");
}

#[test]
fn base_parameters_of_several_arms() {
    let tables = ["arms/planar_2r.toml", "arms/ssrms.toml"];
    let one = |table| stdout(&ulna(&["cost", table, "--base-parameters"]).code(0));
    let run = ulna(&["cost", tables[0], tables[1], "--base-parameters"]).code(0);
    assert_eq!(stdout(&run), one(tables[0]) + &one(tables[1]));
    let run = ulna(&["cost", tables[0], tables[1], "--base-parameters", "--json"]).code(0);
    let both: Value = serde_json::from_str(&stdout(&run)).unwrap();
    assert_eq!(
        (&both[0]["arm"], &both[1]["arm"]),
        (&"planar_2r".into(), &"ssrms".into())
    );
}

/// Every bad one is told, and nothing is printed of the good one.
#[test]
fn one_bad_table_of_several_stops_all() {
    let folder = folder_with_bad_table();
    let bad = folder.path().join("bad.toml");
    let absent = folder.path().join("absent.toml");
    let tables = [
        "arms/planar_2r.toml",
        bad.to_str().unwrap(),
        absent.to_str().unwrap(),
    ];
    for option in [None, Some("--json"), Some("--base-parameters")] {
        let arguments: Vec<&str> = ["cost"].into_iter().chain(tables).chain(option).collect();
        let run = ulna(&arguments).code(1).stdout("");
        let told = stderr(&run);
        assert!(
            told.contains("bad.toml") && told.contains("absent.toml"),
            "{told}"
        );
    }
}

#[test]
fn a_bad_table_is_refused() {
    let folder = folder_with_bad_table();
    let table = folder.path().join("bad.toml");
    ulna(&["cost", table.to_str().unwrap(), "--json"])
        .code(1)
        .stdout("");
}
