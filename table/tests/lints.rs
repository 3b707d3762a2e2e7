//! What is legal in a table and rarely meant: each lint on a table that it warns of, and on one close by that it leaves alone.

use ulna_table::diagnostics::Severity;
use ulna_table::{Lint, Model};

const PLANAR: &str = include_str!("../../arms/planar_2r.toml");
const SSRMS: &str = include_str!("../../arms/ssrms.toml");
const OBLIQUE: &str = include_str!("../../arms/oblique_6.toml");
const GEARED: &str = include_str!("../../arms/geared_6.toml");
const LITERAL: &str = include_str!("../../arms/table1_literal.toml");

/// `text` with each of `edits` made once.
fn edited(text: &str, edits: &[(&str, &str)]) -> String {
    edits.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from:?} is not in the table");
        text.replacen(from, to, 1)
    })
}

/// The warnings of a table, and the lints that they are of.
fn warnings(text: &str) -> (String, Vec<&'static str>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.toml");
    std::fs::write(&path, text).unwrap();
    let (_, found) = Model::lint(&path).unwrap();
    assert!(
        found
            .list()
            .iter()
            .all(|one| one.severity == Severity::Warning)
    );
    let lints = found.list().iter().map(|one| one.lint.unwrap()).collect();
    let shown = found
        .to_string()
        .replace(folder.path().to_str().unwrap(), "DIR");
    (shown, lints)
}

/// The text of the warnings, which are of `lint` alone.
fn fires(lint: Lint, text: &str) -> String {
    let (shown, lints) = warnings(text);
    assert!(!lints.is_empty(), "no {lint:?}");
    assert!(lints.iter().all(|name| *name == lint.name()), "{shown}");
    // Switched off by its name it says nothing.
    let allowed = format!("allow = [\"{}\"]\n{text}", lint.name());
    assert_eq!(warnings(&allowed).0, "", "{lint:?}");
    shown
}

fn is_silent(text: &str) {
    assert_eq!(warnings(text).0, "");
}

/// `text` with every number after one of `keys` times `factor`, of the masses and the inertias.
fn scaled(text: &str, keys: &[&str], factor: f64) -> String {
    let line = |line: &str| {
        let mut line = line.to_owned();
        let of_link = line.starts_with("mass") || line.starts_with("inertia");
        for key in keys.iter().filter(|_| of_link) {
            let Some(start) = line.find(&format!("{key} = ")) else {
                continue;
            };
            let start = start + key.len() + 3;
            let length = line[start..]
                .find([',', ' ', '}'])
                .unwrap_or(line.len() - start);
            let number: f64 = line[start..start + length].parse().unwrap();
            line.replace_range(start..start + length, &format!("{:e}", number * factor));
        }
        line
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

const TENSOR: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

#[test]
fn gravity_that_is_missing() {
    let without = edited(PLANAR, &[("gravity = [0.0, -9.81, 0.0]\n", "")]);
    insta::assert_snapshot!(fires(Lint::MissingGravity, &without));
    is_silent(&edited(PLANAR, &[("0.0, -9.81, 0.0", "0.0, 0.0, 0.0")]));
}

#[test]
fn gravity_that_points_up() {
    let up = ("0.0, 0.0, -9.81", "0.0, 0.0, 9.81");
    insta::assert_snapshot!(fires(Lint::UpwardGravity, &edited(GEARED, &[up])));
    // A world whose z points down, and an arm that stands in it.
    let turned = ("rpy = [6.0, -4.0, 30.0]", "rpy = [174.0, -4.0, 30.0]");
    is_silent(&edited(GEARED, &[up, turned]));
    // An arm that hangs.
    is_silent(&edited(GEARED, &[turned]));
    // On a wall, or in a world whose y points up.
    is_silent(&edited(GEARED, &[("0.0, 0.0, -9.81", "9.81, 0.0, 0.0")]));
}

#[test]
fn gravity_of_no_planet() {
    let of = |size: &str| edited(PLANAR, &[("-9.81", size)]);
    let shown = ["-1.0", "-98.1", "-32.2"].map(|size| fires(Lint::OddGravity, &of(size)));
    insta::assert_snapshot!(shown.join("\n\n"));
    for size in ["-1.62", "-3.7", "-9.832", "-24.8"] {
        is_silent(&of(size));
    }
}

#[test]
fn a_table_of_the_other_convention() {
    let literal = edited(
        LITERAL,
        &[(
            "allow = [\"other_convention\", \"inertia_across\"]",
            "allow = [\"inertia_across\"]",
        )],
    );
    let (literal, lints) = warnings(&literal);
    assert_eq!(lints, ["other_convention"]);
    // The modified table of the same arm, called standard: alpha and a of its first row are 0.
    let standard = edited(SSRMS, &[("\"modified\"", "\"standard\"")]);
    let (standard, lints) = warnings(&standard);
    assert!(lints.contains(&"other_convention"), "{standard}");
    let standard = standard.split("\n\n").next().unwrap();
    // a_1 and a_2 of standard form, read as a_0 and a_1: the tool point is on the last axis.
    let planar = edited(
        PLANAR,
        &[
            (
                "[tool]\nxyz = [1.0, 0.0, 0.0]",
                "[tool]\nxyz = [0.0, 0.0, 0.0]",
            ),
            ("\na = 0.0", "\na = 1.0"),
        ],
    );
    let planar_shown = fires(Lint::OtherConvention, &planar);
    insta::assert_snapshot!([&literal, standard, &planar_shown].join("\n\n"));
    let centroids = [("0.5, 0.0, 0.0", "-0.5, 0.0, 0.0"); 2];
    let right = edited(&planar, &[("\"modified\"", "\"standard\"")]);
    is_silent(&centroids.iter().fold(right, |text, (from, to)| {
        text.replace(&format!("[{from}"), &format!("[{to}"))
    }));
    // An arm with two coaxial joints in the middle has them in both conventions.
    is_silent(&edited(
        SSRMS,
        &[(
            "alpha = -90.0\nrated_torque = 300.0\n[joint.link]\nmass = 70.0",
            "alpha = 0.0\nrated_torque = 300.0\n[joint.link]\nmass = 70.0",
        )],
    ));
}

#[test]
fn angles_that_look_like_the_other_unit() {
    let fraction = edited(PLANAR, &[("alpha = 0.0", "alpha = 0.785")]);
    let limits = "rated_torque = 40.0\nlimits = { lower = -2.9, upper = 2.9 }";
    let narrow = edited(PLANAR, &[("rated_torque = 40.0", limits)]);
    let wide = edited(
        PLANAR,
        &[
            ("\"deg\"", "\"rad\""),
            ("rated_torque = 40.0", &limits.replace("2.9", "170.0")),
        ],
    );
    let shown = [&fraction, &narrow, &wide].map(|text| fires(Lint::OtherAngleUnit, text));
    insta::assert_snapshot!(shown.join("\n\n"));
    let full = edited(PLANAR, &[("alpha = 0.0", "alpha = -1.5707963267948966")]);
    fires(Lint::OtherAngleUnit, &full);
    // What a calibration finds of parallel axes, and the limits of one joint among larger ones.
    is_silent(&edited(
        PLANAR,
        &[
            ("alpha = 0.0", "alpha = 0.0512"),
            ("theta = 0.0", "theta = -0.7731"),
        ],
    ));
    is_silent(&edited(
        PLANAR,
        &[(
            "rated_torque = 40.0",
            &limits.replace("lower = -2.9", "lower = -90.0"),
        )],
    ));
    is_silent(&edited(
        &wide,
        &[(
            "lower = -170.0, upper = 170.0",
            "lower = -12.6, upper = 12.6",
        )],
    ));
}

#[test]
fn rounded_angles() {
    let rounded = edited(
        PLANAR,
        &[("\"deg\"", "\"rad\""), ("alpha = 0.0", "alpha = 1.571")],
    );
    insta::assert_snapshot!(fires(Lint::RoundedAngle, &rounded));
    is_silent(&edited(&rounded, &[("1.571", "1.5707963267948966")]));
}

#[test]
fn centroids_far_from_their_links() {
    let millimetres = edited(OBLIQUE, &[("[0.004, -0.02, 0.03]", "[4.0, -20.0, 30.0]")]);
    let elsewhere = edited(
        PLANAR,
        &[("com = [0.5, 0.0, 0.0]", "com = [0.5, 2.2, 0.0]")],
    );
    let shown = [&millimetres, &elsewhere].map(|text| fires(Lint::FarCentroid, text));
    insta::assert_snapshot!(shown.join("\n\n"));
    // A counterweight behind the shoulder.
    is_silent(&edited(
        PLANAR,
        &[("com = [0.5, 0.0, 0.0]", "com = [-0.4, 0.3, 0.0]")],
    ));
    // A pendulum without a tool has no length at all.
    is_silent(PENDULUM);
    fires(Lint::FarCentroid, &edited(PENDULUM, &[("[0.5,", "[25.0,")]));
}

const PENDULUM: &str = r#"
name = "pendulum"
convention = "modified"
angle_unit = "deg"
gravity = [0.0, -9.81, 0.0]
[task]
rows = ["rz"]
[[joint]]
theta = 0.0
d = 0.0
a = 0.0
alpha = 0.0
[joint.link]
mass = 1.0
com = [0.5, 0.0, 0.0]
inertia = { xx = 0.001, yy = 0.083, zz = 0.083 }
"#;

#[test]
fn masses_in_grams() {
    // The mass alone, or the inertia with it: denser than osmium.
    let dense = scaled(GEARED, &["mass"], 1e3);
    let (dense, lints) = warnings(&dense);
    assert!(lints.contains(&"heavy_link"), "{dense}");
    let dense = dense
        .split("\n\n")
        .find(|one| one.contains("denser"))
        .unwrap();
    let both = scaled(&scaled(GEARED, &["mass"], 1e3), &TENSOR, 1e3);
    fires(Lint::HeavyLink, &both);
    // Blocks that steel could be, in an arm of two metres.
    let heavy = PLANAR.replace("mass = 1.0", "mass = 9000.0").replace(
        "xx = 0.0003125, yy = 0.0834895833333333, zz = 0.0834895833333333",
        "xx = 800.0, yy = 900.0, zz = 900.0",
    );
    let heavy = fires(Lint::HeavyLink, &heavy);
    insta::assert_snapshot!([dense, &heavy].join("\n\n"));
    // A heavy arm of its size: ten times the mass.
    is_silent(&scaled(&scaled(OBLIQUE, &["mass"], 10.0), &TENSOR, 10.0));
}

#[test]
fn inertias_of_the_wrong_order() {
    let link = "inertia = { xx = 0.0651417, yy = 0.5913387, zz = 0.6007930, xy = -0.0463202, xz = -0.0376931, yz = -0.0043039 }";
    assert!(GEARED.contains(link));
    let times = |factor: f64| GEARED.replace(link, &scaled(link, &TENSOR, factor));
    let large = [1e6, 1e9].map(|factor| fires(Lint::LargeInertia, &times(factor)));
    let small = fires(Lint::SmallInertia, &times(1e-4));
    insta::assert_snapshot!(
        [&large[0], &large[1], &small]
            .map(String::as_str)
            .join("\n\n")
    );
    for factor in [0.05, 0.3, 4.0] {
        is_silent(&times(factor));
    }
}

#[test]
fn inertias_about_the_frames_origin() {
    // m l^2 / 3 of a rod, in place of m l^2 / 12.
    let rods = PLANAR.replace("0.0834895833333333", "0.3334895833333333");
    let rods = fires(Lint::InertiaAboutOrigin, &rods);
    // In standard form the origin is at the far end of a link.
    let oblique = about_origin(OBLIQUE);
    let found = fires(Lint::InertiaAboutOrigin, &oblique);
    // What is proposed is what was there.
    assert!(found.contains("xx = 1.9522e-1, yy = 1.3065e0, zz = 1.3484e0, xy = 2.4721e-1, xz = 1.6884e-1, yz = -3.7108e-2"), "{found}");
    insta::assert_snapshot!(rods);
    is_silent(&OBLIQUE.replace("mass = 24.5", "mass = 26.5"));
    // One of two links alone.
    is_silent(&edited(
        PLANAR,
        &[(
            "0.0834895833333333, zz = 0.0834895833333333",
            "0.3334895833333333, zz = 0.3334895833333333",
        )],
    ));
}

/// Every tensor of a table about its frame's origin: with m (c^2 1 - c c^T).
fn about_origin(text: &str) -> String {
    let (mut mass, mut com) = (0.0, [0.0; 3]);
    let line = |line: &str| {
        if let Some(number) = line.strip_prefix("mass = ") {
            mass = number.parse().unwrap();
        } else if let Some(numbers) = line.strip_prefix("com = [") {
            let numbers = numbers.trim_end_matches(']').split(", ");
            com = numbers
                .map(|number| number.parse().unwrap())
                .collect::<Vec<f64>>()
                .try_into()
                .unwrap();
        } else if line.starts_with("inertia = ") {
            let [x, y, z] = com;
            let steiner = [
                y * y + z * z,
                x * x + z * z,
                x * x + y * y,
                -x * y,
                -x * z,
                -y * z,
            ];
            let numbers = line
                .split([',', '}'])
                .filter_map(|part| part.rsplit_once("= "));
            let numbers: Vec<f64> = numbers
                .map(|(_, number)| number.trim().parse().unwrap())
                .collect();
            let entries = TENSOR.iter().zip(numbers).zip(steiner);
            let entries: Vec<_> = entries
                .map(|((key, number), steiner)| format!("{key} = {:?}", number + mass * steiner))
                .collect();
            return format!("inertia = {{ {} }}", entries.join(", "));
        }
        line.to_owned()
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn inertias_in_other_axes() {
    let rod = "{ xx = 0.0003125, yy = 0.0834895833333333, zz = 0.0834895833333333 }";
    let across = "{ xx = 0.0834895833333333, yy = 0.0003125, zz = 0.0834895833333333 }";
    insta::assert_snapshot!(fires(
        Lint::InertiaAcross,
        &edited(PLANAR, &[(rod, across)])
    ));
    // A flat link is not long in any direction that it does not go.
    is_silent(&edited(
        PLANAR,
        &[(rod, "{ xx = 0.02, yy = 0.0834895833333333, zz = 0.1 }")],
    ));
}

#[test]
fn names_that_are_no_lints() {
    let allow = |names: &str| format!("allow = {names}\n{PLANAR}");
    let shown = [
        "[\"missing_gravitation\", \"far_centriod\", 3]",
        "\"far_centroid\"",
    ]
    .map(|names| {
        Model::parse(&allow(names), "arm.toml")
            .unwrap_err()
            .to_string()
    });
    insta::assert_snapshot!(shown.join("\n\n"));
    // What would not fire, and what is there twice, is fine.
    is_silent(&allow("[\"far_centroid\", \"far_centroid\"]"));
    is_silent(&allow("[]"));
}

#[test]
fn a_model_says_what_is_allowed_and_hands_it_on() {
    let literal = Model::parse(LITERAL, "literal.toml").unwrap();
    assert_eq!(
        literal.allow(),
        [Lint::OtherConvention, Lint::InertiaAcross]
    );
    assert!(literal.allows(Lint::InertiaAcross) && !literal.allows(Lint::FarCentroid));
    let mut description = literal.description();
    let (again, found) = Model::lint_description(&description).unwrap();
    assert_eq!((again.allow(), found.is_empty()), (literal.allow(), true));
    // A program is warned as a person is.
    description.allow.clear();
    let (_, found) = Model::lint_description(&description).unwrap();
    let lints: Vec<_> = found.list().iter().map(|one| one.lint).collect();
    assert_eq!(lints, [Some("other_convention"), Some("inertia_across")]);
    assert!(found.list().iter().all(|one| one.position.is_some()));
}

#[test]
fn every_lint_has_a_name_of_its_own_and_says_why() {
    let mut names: Vec<_> = Lint::ALL.iter().map(|lint| lint.name()).collect();
    assert!(
        names
            .iter()
            .all(|name| name.chars().all(|c| c == '_' || c.is_ascii_lowercase()))
    );
    assert!(Lint::ALL.iter().all(|lint| lint.meaning().len() > 40));
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), Lint::ALL.len());
}
