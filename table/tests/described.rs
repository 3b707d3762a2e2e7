//! Models made by a program: held to the rules of a table, and refused with its words.

use ulna::{Angle, Joint, Placement, TaskRows};
use ulna_table::diagnostics::{Diagnostics, Severity};
use ulna_table::{Convention, Description, Model};

const PLANAR: &str = include_str!("../../arms/planar_2r.toml");

fn planar() -> Description {
    Model::parse(PLANAR, "planar_2r.toml")
        .unwrap()
        .description()
}

/// The planar arm's description with `change` made to it.
fn changed(change: impl FnOnce(&mut Description)) -> Description {
    let mut description = planar();
    change(&mut description);
    description
}

fn refused(change: impl FnOnce(&mut Description)) -> Diagnostics {
    Model::new(&changed(change)).expect_err("the description should be refused")
}

/// What the findings say, without where.
fn words(found: &Diagnostics) -> Vec<(String, String, Option<String>)> {
    let list = found.list().iter();
    list.map(|one| (one.message.clone(), one.label.clone(), one.help.clone()))
        .collect()
}

/// A fault as a program makes it, and as an edit of the table.
type Fault = (fn(&mut Description), &'static str, &'static str);

const NAMES: &[Fault] = &[
    (|arm| arm.name.clear(), "\"planar_2r\"", "\"\""),
    (
        |arm| arm.name = "Planar 2R".into(),
        "\"planar_2r\"",
        "\"Planar 2R\"",
    ),
    (|arm| arm.name = "fn".into(), "\"planar_2r\"", "\"fn\""),
    (
        |arm| arm.name = "\"\\\u{e9}".into(),
        "\"planar_2r\"",
        "\"\\\"\\\\\u{e9}\"",
    ),
    (
        |arm| arm.name = "x\u{1b}[31m".into(),
        "\"planar_2r\"",
        "\"x\\u001b[31m\"",
    ),
];

const NUMBERS: &[Fault] = &[
    (
        |arm| arm.gravity = [0.0, -9810.0, f64::NAN],
        "[0.0, -9.81, 0.0]",
        "[0.0, -9810.0, nan]",
    ),
    (
        |arm| arm.tool.translation[0] = 1000.0,
        "xyz = [1.0, 0.0, 0.0]",
        "xyz = [1000.0, 0.0, 0.0]",
    ),
    (
        |arm| arm.base.translation[2] = f64::NEG_INFINITY,
        "[tool]",
        "[base]\nxyz = [0.0, 0.0, -inf]\n[tool]",
    ),
    (|arm| arm.joints[1].a = 1000.0, "a = 1.0", "a = 1000.0"),
    (|arm| arm.joints[0].d = f64::INFINITY, "d = 0.0", "d = inf"),
    (
        |arm| arm.joints[0].theta.radians = f64::NAN,
        "theta = 0.0",
        "theta = nan",
    ),
    (
        |arm| arm.joints[0].rated_torque = Some(0.0),
        "rated_torque = 40.0",
        "rated_torque = 0.0",
    ),
    (
        |arm| arm.joints[0].rated_torque = Some(f64::INFINITY),
        "rated_torque = 40.0",
        "rated_torque = inf",
    ),
    (
        |arm| arm.joints[0].link.mass = 0.0,
        "mass = 1.0",
        "mass = 0.0",
    ),
    (
        |arm| arm.joints[0].link.mass = f64::NAN,
        "mass = 1.0",
        "mass = nan",
    ),
    (
        |arm| arm.joints[0].link.com[1] = -101.0,
        "com = [0.5, 0.0, 0.0]",
        "com = [0.5, -101.0, 0.0]",
    ),
];

const DRIVES: &[Fault] = &[
    (
        |arm| arm.joint_names = vec![Some("a b".into())],
        "theta = 0.0",
        "name = \"a b\"\ntheta = 0.0",
    ),
    (
        |arm| arm.joints[0].motor.inertia = -1.0,
        "theta = 0.0",
        "motor = { inertia = -1.0, ratio = 1.0 }\ntheta = 0.0",
    ),
    (
        |arm| arm.joints[0].friction.smoothing = 0.0,
        "theta = 0.0",
        "friction = { smoothing = 0.0 }\ntheta = 0.0",
    ),
    (
        |arm| (arm.joints[0].limits.lower, arm.joints[0].limits.upper) = (1.0, 0.5),
        "theta = 0.0",
        "limits = { lower = 1.0, upper = 0.5 }\ntheta = 0.0",
    ),
];

const PHYSICS: &[Fault] = &[
    (
        |arm| arm.joints[0].link.inertia[0][0] = -1.0,
        "xx = 0.0003125",
        "xx = -1.0",
    ),
    (
        |arm| arm.joints[0].link.inertia[0][0] = 1e10,
        "xx = 0.0003125",
        "xx = 1e10",
    ),
    (
        |arm| arm.joints[0].link.inertia[0][0] = f64::NAN,
        "xx = 0.0003125",
        "xx = nan",
    ),
    (
        |arm| arm.joints[0].link.inertia[2][2] = 1.0,
        "zz = 0.0834895833333333",
        "zz = 1.0",
    ),
    (
        |arm| {
            arm.joints[0].link.inertia[1][2] = 1.5;
            arm.joints[0].link.inertia[2][1] = 1.5;
        },
        "zz = 0.0834895833333333",
        "zz = 0.0834895833333333, yz = 1.5",
    ),
    // A milligram carries a thousand tons.
    (
        |arm| {
            let link = &mut arm.joints[0].link;
            (link.mass, link.com) = (1e-6, [0.0; 3]);
            link.inertia = [[1e-11, 0.0, 0.0], [0.0, 1e-11, 0.0], [0.0, 0.0, 1e-11]];
            arm.joints[1].link.mass = 1e6;
        },
        "mass = 1.0\ncom = [0.5, 0.0, 0.0]\ninertia = { xx = 0.0003125, yy = 0.0834895833333333, zz = 0.0834895833333333 }\n\n[[joint]] # elbow\n\
        theta = 0.0\nd = 0.0\na = 1.0\nalpha = 0.0\nrated_torque = 15.0\n[joint.link]\nmass = 1.0",
        "mass = 1e-6\ncom = [0.0, 0.0, 0.0]\ninertia = { xx = 1e-11, yy = 1e-11, zz = 1e-11 }\n\n[[joint]] # elbow\n\
        theta = 0.0\nd = 0.0\na = 1.0\nalpha = 0.0\nrated_torque = 15.0\n[joint.link]\nmass = 1e6",
    ),
];

const TASKS: &[Fault] = &[
    (
        |arm| arm.task = TaskRows::new(&[]),
        "rows = [\"x\", \"y\"]",
        "rows = []",
    ),
    (
        |arm| arm.task = TaskRows::POSE,
        "rows = [\"x\", \"y\"]",
        "rows = \"pose\"",
    ),
];

#[test]
fn a_fault_is_refused_with_the_words_that_a_table_is_refused_with() {
    for (change, from, to) in [NAMES, NUMBERS, DRIVES, PHYSICS, TASKS].concat() {
        assert!(PLANAR.contains(from), "the table has no {from:?}");
        let text = PLANAR.replacen(from, to, 1);
        let table = Model::parse(&text, "bad.toml").expect_err("the table should be refused");
        assert_eq!(words(&refused(change)), words(&table), "{from} -> {to}");
    }
}

#[test]
fn joints_are_counted() {
    let (head, joint) = PLANAR.rsplit_once("[[joint]]").unwrap();
    let table = format!("{head}{}", format!("[[joint]]{joint}").repeat(49));
    let table = Model::parse(&table, "bad.toml").unwrap_err();
    let many = |arm: &mut Description| arm.joints = vec![arm.joints[1]; 50];
    assert_eq!(words(&refused(many)), words(&table));

    let table = PLANAR.split("[tool]").next().unwrap();
    let table = table.replace("[task]", "joint = []\n[task]");
    let table = Model::parse(&table, "bad.toml").unwrap_err();
    assert_eq!(words(&refused(|arm| arm.joints.clear())), words(&table));
}

#[test]
fn a_programs_angles_are_radians() {
    let found = refused(|arm| arm.joints[1].alpha = Angle::from_radians(90.0));
    let table = PLANAR.replace("\"deg\"", "\"rad\"");
    let (start, end) = table.rsplit_once("alpha = 0.0").unwrap();
    let table = Model::parse(&format!("{start}alpha = 90.0{end}"), "bad.toml").unwrap_err();
    let [(message, label, help)] = &words(&found)[..] else {
        panic!("{found}");
    };
    assert_eq!((message, label), (&words(&table)[0].0, &words(&table)[0].1));
    assert_eq!(
        help.as_deref(),
        Some("give angles in radians, within a full turn")
    );
}

/// What a table cannot say at all.
#[test]
fn rotations_are_rotations_and_inertias_symmetric() {
    let found = refused(|arm| {
        arm.base.rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 1e-8], [0.0, 0.0, 1.0]];
        arm.tool.rotation = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        arm.joints[0].link.inertia[1][0] = 1e-4;
        arm.joints[1].link.inertia[2][0] = f64::INFINITY;
    });
    insta::assert_snapshot!(found.to_string());

    for entry in [f64::NAN, f64::INFINITY, f64::MAX] {
        let found = refused(|arm| arm.tool.rotation[2][2] = entry);
        assert_eq!(found.list().len(), 1, "{found}");
        assert!(found.list()[0].message.contains("`rotation` of [tool]"));
    }
}

#[test]
fn every_error_at_once_each_at_its_line() {
    let found = refused(|arm| {
        arm.name = "fn".into();
        arm.joints[0].link.mass = -1.0;
        arm.joints[1].link.com[2] = f64::NAN;
        arm.joints[1].link.inertia[0][0] = 1.0;
    });
    insta::assert_snapshot!(found.to_string());
    let debug = format!("{:?}", refused(|arm| arm.joints[0].link.mass = -1.0));
    let refusal = "the description of planar_2r is refused\n";
    assert!(debug.starts_with(refusal), "{debug}");
}

#[test]
fn a_loaded_arm_described_and_made_again_is_the_same() {
    let tables = std::fs::read_dir("../arms").unwrap();
    let paths = tables.map(|entry| entry.unwrap().path());
    for path in paths.filter(|path| path.extension().is_some_and(|end| end == "toml")) {
        let (loaded, of_the_table) = Model::lint(path).unwrap();
        let (made, warnings) = Model::lint_description(&loaded.description()).unwrap();
        assert_eq!(
            warnings.list().len(),
            of_the_table.list().len(),
            "{warnings}"
        );
        assert_eq!(made.description(), loaded.description());
        assert_eq!(made.type_name(), loaded.type_name());
        assert_ne!(made.table_hash(), loaded.table_hash());
        assert_eq!(Model::new(&made.description()).unwrap(), made);
    }
}

#[test]
fn standard_rows_are_rewritten_as_those_of_a_table() {
    let rows = |convention: &str| {
        let text = PLANAR.replace("\"modified\"", convention);
        Model::parse(&text.replace("alpha = 0.0", "alpha = 90.0"), "a.toml").unwrap()
    };
    let mut description = rows("\"modified\"").description();
    description.convention = Convention::Standard;
    let made = Model::new(&description).unwrap();
    assert_eq!(made.description(), rows("\"standard\"").description());
}

/// As it came out once: it may not depend on the machine, and generated files name it.
#[test]
fn the_hash_is_that_of_the_numbers() {
    let hash = |description: &Description| Model::new(description).unwrap().table_hash().to_owned();
    insta::assert_snapshot!(hash(&planar()));
    let zero = changed(|arm| (arm.gravity[0], arm.joints[0].d) = (-0.0, -0.0));
    assert_eq!(hash(&zero), hash(&planar()));
    let last_bit = changed(|arm| arm.joints[0].link.mass = 1.0_f64.next_up());
    assert_ne!(hash(&last_bit), hash(&planar()));
}

#[test]
fn warnings_do_not_refuse() {
    let rounded = changed(|arm| arm.joints[1].alpha = Angle::from_radians(1.571));
    let (model, found) = Model::lint_description(&rounded).unwrap();
    assert_eq!(model.joints()[1].alpha.radians, 1.571);
    assert_eq!(found.list().len(), 1);
    assert_eq!(found.list()[0].severity, Severity::Warning);
}

/// Rotations as programs compute them are not exact, and are kept as they are.
#[test]
fn rounding_does_not_refuse() {
    let third = 1.0_f64 / 3.0;
    let (sin, cos) = third.sin_cos();
    let tool = Placement {
        rotation: [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]],
        translation: [third; 3],
    };
    let description = changed(|arm| {
        arm.tool = tool;
        arm.joints[0].link.inertia[1][2] = 1e-17;
    });
    let model = Model::new(&description).unwrap();
    assert_eq!(*model.tool(), tool);
    let [_, [_, _, yz], [_, zy, _]] = model.joints()[0].link.inertia;
    assert_eq!((yz, zy), (1e-17, 1e-17));
    let joints: &[Joint] = model.joints();
    assert_eq!(joints[1], description.joints[1]);
}
