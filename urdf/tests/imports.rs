//! What becomes of a description: merged, frozen, left out, renamed, and told.

use ulna::{Friction, JointKind, Limits, TaskRow};
use ulna_table::Model;
use ulna_urdf::{Import, Imported};

const ARM: &str = include_str!("robots/arm_with_gripper.urdf");

fn edited(from: &str, to: &str) -> String {
    assert!(ARM.contains(from), "the description has no {from:?}");
    ARM.replacen(from, to, 1)
}

fn imported(import: &Import, text: &str) -> Imported {
    let arm = import.parse(text, "robots/arm.urdf");
    arm.unwrap_or_else(|found| panic!("{found}"))
}

fn to_hand(text: &str) -> Imported {
    imported(&Import::new().tip("hand"), text)
}

/// Everything that is said, warnings first.
fn said(arm: &Imported) -> String {
    let notes: Vec<_> = arm
        .notes()
        .iter()
        .map(|note| format!("note: {note}"))
        .collect();
    format!("{}\n\n{}\n", arm.warnings(), notes.join("\n"))
}

#[test]
fn the_table_in_full() {
    insta::assert_snapshot!(to_hand(ARM).table());
}

#[test]
fn what_is_said() {
    let of =
        |import: Import, text: &str| format!("{import:?}\n\n{}", said(&imported(&import, text)));
    let hand = || Import::new().tip("hand");
    let blocks = [
        of(Import::new().tip("finger_left"), ARM),
        of(Import::new().drop("finger_left").drop("finger_right"), ARM),
        of(Import::new().tip("flange").drop("hand"), ARM),
        of(Import::new().tip("upper_arm"), ARM),
        of(
            Import::new()
                .base("column")
                .tip("hand")
                .accept_inertia("hand"),
            ARM,
        ),
        of(hand().accept_inertia("base_link").name("my_arm"), ARM),
        // A finger that is closed at 0.01, and one that opens by a turn.
        of(
            hand(),
            &edited(
                "lower=\"0\" upper=\"0.04\"",
                "lower=\"0.01\" upper=\"0.04\"",
            ),
        ),
        of(
            hand(),
            &edited("<mimic joint=\"finger_1\"", "<mimic joint=\"elbow\""),
        ),
        of(
            hand(),
            &edited(
                "<joint name=\"finger_1\" type=\"prismatic\"",
                "<joint name=\"finger_1\" type=\"floating\"",
            ),
        ),
        of(
            hand(),
            &edited("<joint name=\"turn\"", "<joint name=\"turn-1\"")
                .replace("\"elbow\"", "\"turn_1\""),
        ),
        of(
            hand(),
            &edited("lower=\"-2\" upper=\"2\" effort=\"120\"", "effort=\"0\"")
                .replace("velocity=\"3\"", "velocity=\"1e9\""),
        ),
        of(
            hand(),
            &edited(
                "<limit effort=\"120\"",
                "<limit lower=\"-3\" upper=\"3\" effort=\"1e16\"",
            ),
        ),
        of(
            hand(),
            &edited(
                "<limit lower=\"-2\" upper=\"2\" effort=\"120\" velocity=\"2.5\"/>",
                "",
            ),
        ),
    ];
    insta::assert_snapshot!(blocks.join("\n"));
}

#[test]
fn what_looks_wrong() {
    let edits = [
        ("<mass value=\"5\"/>", "<mass value=\"5000\"/>"),
        ("xyz=\"0.05 0 0.15\"", "xyz=\"50 0 0.15\""),
        ("rpy=\"-1.5707963267948966 0 0\"", "rpy=\"-90 0 0\""),
        ("lower=\"-2\" upper=\"2\"", "lower=\"-114\" upper=\"114\""),
        ("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 100\"/>"),
        (
            "xyz=\"0.45 0 0.03\"",
            "xyz=\"0.45 0 0.03\" rpy=\"0 4e-6 0\"",
        ),
        (
            "<origin xyz=\"0.15 0.01 0\"/>",
            "<origin xyz=\"35 0.01 0\"/>",
        ),
    ];
    let blocks = edits.map(|(from, to)| {
        let arm = to_hand(&edited(from, to));
        format!("==== {from} -> {to}\n\n{}\n", arm.warnings())
    });
    insta::assert_snapshot!(blocks.join("\n"));
}

#[test]
fn drives_are_kept() {
    let arm = to_hand(ARM);
    let [turn, shoulder, elbow] = arm.model().joints() else {
        panic!("{arm:?}");
    };
    assert_eq!(
        turn.limits,
        Limits {
            velocity: 2.5,
            ..Limits::NONE
        }
    );
    assert_eq!((turn.friction.viscous, turn.friction.coulomb), (0.8, 1.5));
    assert_eq!(turn.friction.smoothing, Friction::SMOOTHING);
    let expected = Limits {
        lower: -2.0,
        upper: 2.0,
        velocity: 2.5,
    };
    assert_eq!(
        (shoulder.limits, shoulder.friction),
        (expected, Friction::NONE)
    );
    assert_eq!(elbow.rated_torque, Some(60.0));
    assert_eq!(arm.model().joint_names(), ["turn", "shoulder", "elbow"]);
}

/// The whole arm weighs what its moving links weigh, whatever is fixed or frozen; what is dropped does not count.
#[test]
fn every_body_counts_once() {
    let mass = |arm: &Imported| -> f64 { arm.model().joints().iter().map(|j| j.link.mass).sum() };
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{a} {b}");
    close(mass(&to_hand(ARM)), 5.0 + 3.5 + 2.0 + 0.6 + 0.04);
    let left = Import::new().tip("finger_left");
    let left = imported(&left, ARM);
    close(mass(&left), 5.0 + 3.5 + 2.0 + 0.6 + 0.04);
    assert_eq!(left.model().joints()[3].kind, JointKind::Prismatic);
    let dropped = Import::new().tip("hand").drop("finger_left");
    close(mass(&imported(&dropped, ARM)), 5.0 + 3.5 + 2.0 + 0.6 + 0.02);
    // What was changed counts: a link that is accepted, and its key in the table.
    let impossible = edited("izz=\"0.02\"", "izz=\"0.0001\"");
    let arm = imported(
        &Import::new().tip("hand").accept_inertia("column"),
        &impossible,
    );
    assert_eq!(arm.model().accepts_inertia(), [true, false, false]);
    let table = arm.table();
    assert!(table.contains("accept_inertia = true\n"), "{table}");
    assert!(
        table.contains("# - warning: the inertia of link `column`"),
        "{table}"
    );
    assert!(
        table.contains("beyond the sum by 9.9 % (line 26)\n"),
        "{table}"
    );
    insta::assert_snapshot!(said(&arm));
}

/// An impossible part of a body that is possible as a whole leaves no mark in the table.
#[test]
fn what_is_possible_in_the_end_is_not_accepted_in_the_table() {
    let impossible = edited("izz=\"0.0007\"", "izz=\"0.003\"");
    let arm = imported(
        &Import::new().tip("hand").accept_inertia("hand"),
        &impossible,
    );
    assert_eq!(arm.model().accepts_inertia(), [false; 3]);
    assert!(
        arm.warnings().to_string().contains("link `hand`"),
        "{}",
        arm.warnings()
    );
}

/// Line ends, byte order marks, namespaces, prefixes and what simulators add change nothing.
#[test]
fn dressings_change_nothing() {
    let plain = to_hand(ARM);
    let dressed = [
        ARM.replace('\n', "\r\n"),
        format!("\u{feff}{ARM}"),
        edited(
            "<robot ",
            "<robot xmlns=\"http://www.ros.org\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\" ",
        ),
        edited(
            "<link name=\"flange\"/>",
            "<gazebo reference=\"hand\"><link name=\"hand\"/></gazebo><link name=\"flange\"/>",
        ),
        edited("<robot ", "<robot xmlns:sensor=\"http://sensor\" ").replace(
            "<link name=\"flange\"/>",
            "<link name=\"flange\"><sensor:inertial/></link><sensor:joint/><sensor:sensor/>",
        ),
        edited("<robot ", "<robot xmlns:link=\"http://link\" ").replace(
            "<link name=\"flange\"/>",
            "<link name=\"flange\"/><link:link name=\"hand\"/>",
        ),
        edited("xyz=\"0.05 0 0.15\"", "xyz=\" 5e-2\t+0  .15 \""),
    ];
    for text in dressed {
        assert_eq!(to_hand(&text).description(), plain.description());
    }
}

/// The rows of w_D are those that the arm can move in.
#[test]
fn tasks() {
    let rows = |tip: &str, text: &str| -> Vec<&str> {
        let arm = imported(&Import::new().tip(tip), text);
        arm.model().task().iter().map(TaskRow::name).collect()
    };
    assert_eq!(rows("hand", ARM), ["x", "y", "z"]);
    // A joint does not move a frame on its own axis.
    assert_eq!(rows("forearm", ARM), ["x", "y"]);
    assert_eq!(rows("upper_arm", ARM), ["x"]);
    // On the axis of the only joint nothing moves, but it turns.
    let on_axis = edited("xyz=\"0.05 0 0.15\"", "xyz=\"0 0 0.15\"");
    let column = Import::new().tip("column");
    let column = imported(&column, &on_axis);
    assert_eq!(
        column.model().task().iter().collect::<Vec<_>>(),
        [TaskRow::Rz]
    );
}

/// What is written as a quarter turn to eleven digits becomes one, and that is told; exact ones are not worth a word.
#[test]
fn rounded_quarter_turns_are_told() {
    let rounded = to_hand(&edited(
        "rpy=\"-1.5707963267948966 0 0\"",
        "rpy=\"-1.57079632679 0 0\"",
    ));
    assert_eq!(
        rounded.description().joints,
        to_hand(ARM).description().joints
    );
    let told = |arm: &Imported| {
        arm.notes()
            .iter()
            .any(|note| note.message.contains("are taken as whole"))
    };
    assert!(told(&rounded), "{:?}", rounded.notes());
    assert!(!told(&to_hand(ARM)));
}

/// A base that is not the root, and does not stand upright.
#[test]
fn a_tilted_base_is_told() {
    let tilted = edited(
        "<origin xyz=\"0 0 0.2\"/>",
        "<origin xyz=\"0 0 0.2\" rpy=\"0.5 0 0\"/>",
    );
    let arm = imported(&Import::new().base("column").tip("hand"), &tilted);
    insta::assert_snapshot!(arm.warnings());
    let upright = imported(&Import::new().base("column").tip("hand"), ARM);
    assert!(upright.warnings().is_empty(), "{}", upright.warnings());
}

/// The model is that of the table, and where the file lies leaves no trace in it.
#[test]
fn the_table_is_the_arm() {
    let arm = to_hand(ARM);
    let table = Model::parse(&arm.table(), "arm.toml").unwrap();
    assert_eq!(table.joints(), arm.model().joints());
    assert_eq!(table.joint_names(), arm.model().joint_names());
    assert!(!arm.table().contains("robots/"), "{}", arm.table());
    let joints = arm.joints();
    assert_eq!(joints[2].urdf_name, "elbow");
    assert_eq!(joints[2].link, "forearm");
    assert_eq!(
        joints[2].merged,
        ["flange", "hand", "finger_left", "finger_right"]
    );
}

/// A calibrated arm: the elbow's axis is a milliradian off the shoulder's.
#[test]
fn almost_parallel_axes_are_taken_as_parallel_where_that_is_asked_for() {
    let text = edited(
        "xyz=\"0.45 0 0.03\"",
        "xyz=\"0.45 0 0.03\" rpy=\"0 0.001 0\"",
    );
    let arm = imported(&Import::new().tip("hand").parallel("elbow"), &text);
    insta::assert_snapshot!(arm.warnings().to_string());
    assert_eq!(arm.model().joints()[2].alpha.radians, 0.0);
    let told = |note: &&ulna_urdf::Note| note.message.contains("the tool is up to");
    let told = arm.notes().iter().find(told).expect("how far off it is");
    assert!(told.message.contains("e-3 m and rad"), "{told}");
}
