//! Names, limits, motors and friction of joints: read, written again, and every error of theirs at once.

use ulna::{Friction, Joint, Limits, Motor};
use ulna_table::diagnostics::Diagnostics;
use ulna_table::{Convention, Description, Model};

const PLANAR: &str = include_str!("../../arms/planar_2r.toml");

/// The planar arm's table with `keys` in the rows of its joints.
fn with(shoulder: &str, elbow: &str) -> String {
    let text = PLANAR.replacen("alpha = 0.0", &format!("alpha = 0.0\n{shoulder}"), 1);
    let (head, tail) = text.rsplit_once("alpha = 0.0").unwrap();
    format!("{head}alpha = 0.0\n{elbow}{tail}")
}

fn read(shoulder: &str, elbow: &str) -> Model {
    Model::parse(&with(shoulder, elbow), "a.toml").unwrap_or_else(|errors| panic!("{errors}"))
}

fn refused(shoulder: &str, elbow: &str) -> Diagnostics {
    Model::parse(&with(shoulder, elbow), "bad.toml").expect_err("the table should be refused")
}

const ALL: &str = "name = \"elbow\"
limits = { lower = -90.0, upper = 180, velocity = 45.0 }
motor = { inertia = 1e-4, ratio = 100.0 }
friction = { viscous = 0.5, coulomb = 2.0, smoothing = 0.25 }";

#[test]
fn a_table_without_the_keys_means_what_it_meant() {
    let model = Model::parse(PLANAR, "a.toml").unwrap();
    assert_eq!(model.joint_names(), ["joint 1", "joint 2"]);
    for joint in model.joints() {
        assert_eq!(joint.limits, Limits::NONE);
        assert_eq!(joint.motor, Motor::NONE);
        assert_eq!(joint.friction, Friction::NONE);
    }
    assert_eq!(Motor::NONE.reflected_inertia(), 0.0);
    assert_eq!(Friction::NONE.torque(3.0), 0.0);
}

#[test]
fn all_keys_are_read_in_their_units() {
    let model = read("", ALL);
    assert_eq!(model.joint_names(), ["joint 1", "elbow"]);
    let elbow = &model.joints()[1];
    let limits = Limits {
        lower: -std::f64::consts::FRAC_PI_2,
        upper: std::f64::consts::PI,
        velocity: std::f64::consts::FRAC_PI_4,
    };
    assert_eq!(elbow.limits, limits);
    assert_eq!(elbow.motor.reflected_inertia(), 1e-4 * 100.0 * 100.0);
    // In rad whatever the table's unit is.
    let friction = Friction {
        viscous: 0.5,
        coulomb: 2.0,
        smoothing: 0.25,
    };
    assert_eq!(elbow.friction, friction);
}

#[test]
fn metres_are_metres_whatever_the_angles_are_in() {
    let limits = "kind = \"prismatic\"\nlimits = { lower = -0.5, velocity = 0.25 }";
    let limits = read(limits, "").joints()[0].limits;
    let expected = Limits {
        lower: -0.5,
        velocity: 0.25,
        ..Limits::NONE
    };
    assert_eq!(limits, expected);
}

#[test]
fn each_part_is_optional_but_a_rotors_inertia() {
    let model = read(
        "limits = {}\nfriction = {}",
        "motor = { inertia = 0.25 }\nfriction = { coulomb = 3 }",
    );
    let [shoulder, elbow]: &[Joint; 2] = model.joints().try_into().unwrap();
    assert_eq!(
        (shoulder.limits, shoulder.friction),
        (Limits::NONE, Friction::NONE)
    );
    assert_eq!(elbow.motor.reflected_inertia(), 0.25);
    assert_eq!(elbow.friction.smoothing, Friction::SMOOTHING);
    assert!(
        refused("motor = { ratio = 2.0 }", "")
            .to_string()
            .contains("missing key `inertia`")
    );
}

#[test]
fn headers_do_as_well_as_inline_tables() {
    let headers = "[joint.motor]\ninertia = 1e-4\nratio = 100.0\n[joint.friction]\nviscous = 0.5\n";
    let text = with("", "");
    let (head, link) = text.rsplit_once("[joint.link]").unwrap();
    let model = Model::parse(&format!("{head}{headers}[joint.link]{link}"), "a.toml").unwrap();
    assert_eq!(model.joints()[1].motor.ratio, 100.0);
}

#[test]
fn every_error_at_once() {
    let found = refused(
        "name = \"shoulder pan\"
limits = { lower = 1.0, upper = 1.0, velocity = 0.0, effort = 40.0 }
motor = { inertia = -1e-4, ratio = 0.0 }
friction = { viscous = -0.5, coulomb = nan, smoothing = 0.0 }",
        "name = \"elbow\"
limits = { lower = 1e6, upper = \"1\", velocity = inf }
motor = { inertia = 1e4, ratio = -100.0, gear = 2 }
friction = { viscous = 1e8, coulomb = -1.0, smoothing = 1e4, stiction = 3.0 }
mss = 3.0",
    );
    insta::assert_snapshot!(found.to_string());
}

#[test]
fn names_are_words_and_no_two_the_same() {
    let cases = [
        ("name = \"elbow\"", "name = \"elbow\""),
        ("name = \"\"", "name = \"joint 1\""),
        ("name = 1", "name = \"7\""),
        ("name = \"\u{e9}paule\"", "name = \"x\\u001b[31m\""),
        (
            "name = \"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\"",
            "nam = \"elbow\"",
        ),
    ];
    let messages = cases.map(|(shoulder, elbow)| refused(shoulder, elbow).to_string());
    insta::assert_snapshot!(messages.join("\n\n"));
    // Case tells names apart.
    let model = read("name = \"J1\"", "name = \"j1\"");
    assert_eq!(model.joint_names(), ["J1", "j1"]);
}

#[test]
fn messages_call_a_joint_by_its_name() {
    let text = with("", "name = \"elbow\"").replace("mass = 1.0", "mass = -1.0");
    let found = Model::parse(&text, "bad.toml").unwrap_err().to_string();
    assert!(
        found.contains("`mass` of joint 1 is out of bounds"),
        "{found}"
    );
    assert!(
        found.contains("`mass` of joint 2 (elbow) is out of bounds"),
        "{found}"
    );
}

#[test]
fn a_rotor_counts_where_a_link_is_light() {
    let light =
        "mass = 1e-6\ncom = [0.0, 0.0, 0.0]\ninertia = { xx = 1e-11, yy = 1e-11, zz = 1e-11 }";
    let link = "mass = 1.0\ncom = [0.5, 0.0, 0.0]\ninertia = { xx = 0.0003125, yy = 0.0834895833333333, zz = 0.0834895833333333 }";
    let table = |motor: &str| {
        let text = with(motor, "").replacen(link, light, 1);
        let (head, tail) = text.rsplit_once("mass = 1.0").unwrap();
        Model::parse(&format!("{head}mass = 1e6{tail}"), "a.toml")
    };
    let found = table("").unwrap_err().to_string();
    assert!(found.contains("drowns in the rounding"), "{found}");
    assert!(table("motor = { inertia = 1e-4, ratio = 100.0 }").is_ok());
}

/// A description with all of it, each number of its own.
fn described() -> Description {
    let mut description =
        read("name = \"shoulder\"\nlimits = { upper = 100.0 }", ALL).description();
    description.joints[0].friction.viscous = 1.0 / 3.0;
    description.joints[0].motor.inertia = 1e-5;
    description
}

#[test]
fn descriptions_go_round() {
    let described = described();
    let made = Model::new(&described).unwrap();
    assert_eq!(made.description(), described);
    assert_eq!(Model::new(&made.description()).unwrap(), made);
    assert_eq!(made.joint_names(), ["shoulder", "elbow"]);
    // Names left out at the end are none.
    let unnamed = Description {
        joint_names: Vec::new(),
        ..described
    };
    let unnamed = Model::new(&unnamed).unwrap();
    assert_eq!(unnamed.joint_names(), ["joint 1", "joint 2"]);
    assert_eq!(unnamed.description().joint_names, [None, None]);
    assert_ne!(unnamed.table_hash(), made.table_hash());
}

#[test]
fn the_convention_leaves_a_drive_alone() {
    let standard = Description {
        convention: Convention::Standard,
        ..described()
    };
    let (modified, made) = (described().joints, Model::new(&standard).unwrap());
    for (standard, modified) in made.joints().iter().zip(&modified) {
        let drive = |joint: &Joint| (joint.limits, joint.motor, joint.friction);
        assert_eq!(drive(standard), drive(modified));
    }
    assert_eq!(made.joint_names(), ["shoulder", "elbow"]);
}

#[test]
fn what_a_program_gives_is_held_to_the_same_rules() {
    let mut bad = described();
    bad.joint_names = vec![Some("a b".into()), None, Some("wrist".into())];
    bad.joints[0].limits = Limits {
        lower: f64::INFINITY,
        upper: 0.0,
        velocity: f64::NAN,
    };
    bad.joints[1].motor.ratio = -1.0;
    bad.joints[1].friction.smoothing = 0.0;
    let found = Model::new(&bad).unwrap_err();
    insta::assert_snapshot!(found.to_string());
}
