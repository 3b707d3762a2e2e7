//! Bad descriptions: every error at once, each at its line, with what to do; never a panic.

use proptest::prelude::*;
use ulna_table::diagnostics::Diagnostics;
use ulna_urdf::Import;

const ARM: &str = include_str!("robots/arm_with_gripper.urdf");

/// The arm's description with the first `from` replaced by `to`.
fn edited(from: &str, to: &str) -> String {
    assert!(ARM.contains(from), "the description has no {from:?}");
    ARM.replacen(from, to, 1)
}

fn refused(import: &Import, text: &str) -> Diagnostics {
    import
        .parse(text, "arm.urdf")
        .expect_err("the description should be refused")
}

/// To the hand, as most of the tests have it.
fn to_hand() -> Import {
    Import::new().tip("hand")
}

/// The messages for each edit, one after the other.
fn messages(import: &Import, edits: &[(&str, &str)]) -> String {
    let blocks = edits.iter().map(|(from, to)| {
        let title = format!("{from:.60} -> {to:.60}").replace('\n', "\\n");
        format!("==== {title}\n\n{}\n", refused(import, &edited(from, to)))
    });
    blocks.collect::<Vec<_>>().join("\n")
}

/// The messages for each text.
fn messages_of(texts: &[&str]) -> String {
    let blocks = texts.iter().map(|text| {
        let title = format!("{text:.70}").replace('\n', "\\n");
        format!("==== {title}\n\n{}\n", refused(&Import::new(), text))
    });
    blocks.collect::<Vec<_>>().join("\n")
}

#[test]
fn what_is_not_xml() {
    insta::assert_snapshot!(messages_of(&[
        "",
        " \n\n",
        "solid mesh",
        "[[joint]]\ntheta = 0.0\n",
        "<robot name=\"a\">\n<link name=\"a\"/>\n",
        "<robot name=\"a\">\n<link name=\"a\">\n</robot>",
        "<robot name=\"a\">\n<link name=\"a\" name=\"b\"/></robot>",
        "<robot name=\"a\">\n<link name=\"a & b\"/></robot>",
        "<robot name=\"a\">\n<link name=\"&tool;\"/></robot>",
        "<robot name=\"a\">\n<link name=a/></robot>",
        "<robot name=\"a\">\n<link name=\"<a>\"/></robot>",
        "<robot name=\"a\">\n<sensor:camera/></robot>",
        "<!-- nothing -->",
        "<?xml version=\"1.0\"?>\n<!DOCTYPE robot [<!ENTITY a \"b\">]>\n<robot name=\"&a;\"/>",
        "<!DOCTYPE robot [<!ENTITY x SYSTEM \"file:///etc/passwd\">]>\n<robot name=\"&x;\"/>",
    ]));
}

#[test]
fn what_is_not_urdf() {
    insta::assert_snapshot!(messages_of(&[
        "<sdf version=\"1.7\"><model name=\"a\"/></sdf>",
        "<mujoco model=\"a\"><worldbody/></mujoco>",
        "<COLLADA/>",
        "<html><body/></html>",
        "<robot/>",
        "<robot name=\"a\"><Link name=\"a\"/></robot>",
        "<robot name=\"a\"><link name=\"a\"/></robot>",
    ]));
}

#[test]
fn what_xacro_has_not_expanded() {
    insta::assert_snapshot!(messages_of(&[
        "<robot name=\"a\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n  <xacro:include filename=\"b\"/>\n  <xacro:b/>\n</robot>",
        "<robot name=\"a\">\n  <xacro:include filename=\"b\"/>\n</robot>",
        "<robot name=\"${robot}\">\n<link name=\"a\"/>\n</robot>",
        "<robot name=\"a\">\n<link name=\"${prefix}a\"><inertial><mass value=\"${m}\"/></inertial></link>\n</robot>",
        "<robot name=\"a\">\n<link name=\"a\"/><link name=\"b\"/>\n<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/>\
         <child link=\"b\"/><origin xyz=\"0 0 $(arg height)\"/></joint></robot>",
    ]));
}

#[test]
fn elements_and_attributes() {
    insta::assert_snapshot!(messages(
        &to_hand(),
        &[
            ("<link name=\"column\">", "<link>"),
            (
                "<joint name=\"shoulder\" type=\"revolute\">",
                "<joint name=\"shoulder\">"
            ),
            (
                "<joint name=\"shoulder\" type=\"revolute\">",
                "<joint type=\"revolute\">"
            ),
            ("type=\"revolute\"", "type=\"revolut\""),
            ("type=\"revolute\"", "type=\"ball\""),
            ("<parent link=\"column\"/>", ""),
            ("<child link=\"upper_arm\"/>", "<child/>"),
            ("<mass value=\"5\"/>", ""),
            ("<mass value=\"5\"/>", "<mass/>"),
            (
                "<inertia ixx=\"0.03\" ixy=\"0.001\"",
                "<inertia ixx=\"0.03\""
            ),
            (
                "<mass value=\"5\"/>",
                "<mass value=\"5\"/><mass value=\"6\"/>"
            ),
            ("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 0\"/>"),
            (
                "<origin xyz=\"0 0 0.2\"/>",
                "<origin xyz=\"0 0 0.2\" quat_xyzw=\"0 0 0 1\"/>"
            ),
            ("<dynamics damping=\"0.8\"", "<dynamics damping=\"-0.8\""),
            ("<mimic joint=\"finger_1\"", "<mimic"),
        ]
    ));
}

#[test]
fn numbers() {
    insta::assert_snapshot!(messages(
        &to_hand(),
        &[
            ("<mass value=\"5\"/>", "<mass value=\"5,0\"/>"),
            ("<mass value=\"5\"/>", "<mass value=\"5 kg\"/>"),
            ("<mass value=\"5\"/>", "<mass value=\"\"/>"),
            ("<mass value=\"5\"/>", "<mass value=\"-5\"/>"),
            ("<mass value=\"5\"/>", "<mass value=\"nan\"/>"),
            ("<mass value=\"5\"/>", "<mass value=\"inf\"/>"),
            ("<mass value=\"5\"/>", "<mass value=\"1e999\"/>"),
            ("xyz=\"0.05 0 0.15\"", "xyz=\"0.05 0\""),
            ("xyz=\"0.05 0 0.15\"", "xyz=\"0.05, 0, 0.15\""),
            ("xyz=\"0.05 0 0.15\"", "xyz=\"0.05,0,0.15\""),
            ("xyz=\"0.05 0 0.15\"", "xyz=\"0.05 0 x\""),
            ("lower=\"-2\" upper=\"2\"", "lower=\"2\" upper=\"-2\""),
        ]
    ));
}

#[test]
fn trees() {
    insta::assert_snapshot!(messages(
        &to_hand(),
        &[
            ("<link name=\"column\">", "<link name=\"flange\">"),
            ("<joint name=\"elbow\"", "<joint name=\"shoulder\""),
            ("<parent link=\"column\"/>", "<parent link=\"colum\"/>"),
            ("<child link=\"flange\"/>", "<child link=\"forearm\"/>"),
            ("<parent link=\"base_link\"/>", "<parent link=\"hand\"/>"),
            ("<parent link=\"column\"/>", "<parent link=\"hand\"/>"),
            (
                "<link name=\"flange\"/>",
                "<link name=\"flange\"/><link name=\"camera\"/>"
            ),
            ("<mimic joint=\"finger_1\"", "<mimic joint=\"finger_3\""),
            ("<mimic joint=\"finger_1\"", "<mimic joint=\"finger_2\""),
        ]
    ));
}

#[test]
fn every_error_at_once() {
    let text = ARM
        .replacen("<mass value=\"5\"/>", "<mass value=\"five\"/>", 1)
        .replacen("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0\"/>", 1)
        .replacen("<child link=\"hand\"/>", "", 1);
    let found = refused(&to_hand(), &text);
    let lines: Vec<_> = found
        .list()
        .iter()
        .map(|error| error.position.unwrap().line)
        .collect();
    assert_eq!(lines, [18, 25, 66], "{found}");
}

#[test]
fn chains() {
    let of = |import: Import, text: &str| format!("{import:?}\n\n{}\n", refused(&import, text));
    let floating = edited("type=\"continuous\"", "type=\"floating\"");
    let planar = edited("type=\"continuous\"", "type=\"planar\"");
    let many = long_chain(33);
    let blocks = [
        of(Import::new(), ARM),
        of(Import::new().tip("hnd"), ARM),
        of(
            Import::new()
                .base("a")
                .tip("b")
                .drop("c")
                .accept_inertia("d"),
            ARM,
        ),
        of(Import::new().tip("finger_right"), ARM),
        of(Import::new().base("forearm").tip("hand"), ARM),
        of(Import::new().base("hand").tip("forearm"), ARM),
        of(Import::new().base("finger_left").tip("finger_right"), ARM),
        of(Import::new().drop("forearm").tip("hand"), ARM),
        of(Import::new().drop("base_link"), ARM),
        of(Import::new().drop("column"), ARM),
        of(to_hand(), &floating),
        of(to_hand(), &planar),
        of(to_hand().name("7 Joints"), ARM),
        of(Import::new(), &many),
    ];
    insta::assert_snapshot!(blocks.join("\n"));
}

/// A chain of `joints` revolute joints, each link as the one before.
fn long_chain(joints: usize) -> String {
    let mut text = "<robot name=\"snake\">\n<link name=\"l0\"/>\n".to_owned();
    for joint in 1..=joints {
        let before = joint - 1;
        text.push_str(&format!(
            "<joint name=\"j{joint}\" type=\"continuous\"><parent link=\"l{before}\"/><child link=\"l{joint}\"/>\
             <origin xyz=\"0.1 0 0\" rpy=\"0.5 0 0\"/></joint>\n\
             <link name=\"l{joint}\"><inertial><mass value=\"1\"/>\
             <inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>\n"
        ));
    }
    text + "</robot>"
}

#[test]
fn thirty_two_joints_are_an_arm() {
    let arm = Import::new().parse(&long_chain(32), "snake.urdf").unwrap();
    assert_eq!(arm.model().joints().len(), 32);
}

#[test]
fn bodies() {
    let massless = ARM
        .replace("<mass value=\"3.5\"/>", "<mass value=\"0\"/>")
        .replace(
            "ixx=\"0.006\" ixy=\"0\" ixz=\"0.001\" iyy=\"0.05\" iyz=\"0\" izz=\"0.049\"",
            "ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"",
        );
    let kinematics = without_inertials(ARM);
    let blocks = [
        messages(
            &to_hand(),
            &[
                // The triangle inequality, positive definiteness, and a frame that somebody gave an inertia.
                ("ixx=\"0.03\"", "ixx=\"0.06\""),
                ("izz=\"0.02\"", "izz=\"-0.02\""),
                ("ixy=\"0.0002\"", "ixy=\"0.2\""),
                ("<mass value=\"0.6\"/>", "<mass value=\"0\"/>"),
                // Only a moving link needs inertia about every axis.
                (
                    "ixx=\"0.03\" ixy=\"0.001\" ixz=\"0\" iyy=\"0.028\" iyz=\"0\" izz=\"0.02\"",
                    "ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"",
                ),
            ],
        ),
        format!(
            "==== a link of mass 0\n\n{}\n",
            refused(&to_hand(), &massless)
        ),
        format!(
            "==== no masses at all\n\n{}\n",
            refused(&to_hand(), &kinematics)
        ),
    ];
    insta::assert_snapshot!(blocks.join("\n"));
}

fn without_inertials(text: &str) -> String {
    let mut parts = text.split("<inertial>");
    let mut out = parts.next().unwrap().to_owned();
    for part in parts {
        out.push_str(part.split_once("</inertial>").unwrap().1);
    }
    out
}

#[test]
fn what_a_table_refuses_is_told_at_the_joint() {
    let text = edited("xyz=\"0.45 0 0.03\"", "xyz=\"450 0 30\"");
    insta::assert_snapshot!(refused(&to_hand(), &text));
}

#[test]
fn axes_that_are_neither_parallel_nor_not() {
    let text = edited(
        "xyz=\"0.45 0 0.03\"",
        "xyz=\"0.45 0 0.03\" rpy=\"0 0.001 0\"",
    );
    insta::assert_snapshot!(refused(&to_hand(), &text));
    let missed = to_hand().parallel("elbo");
    insta::assert_snapshot!("no_such_joint_is_parallel", refused(&missed, &text));
}

#[test]
fn files() {
    let folder = tempfile::tempdir().unwrap();
    let load = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        Import::new().load(&path).unwrap_err().to_string()
    };
    let latin = load("latin.urdf", b"<robot name=\"\xe4\"/>");
    assert!(latin.contains("the file is not UTF-8"), "{latin}");
    let large = load("large.urdf", &vec![b' '; 16 * 1024 * 1024 + 1]);
    assert!(large.contains("larger than 16384 KiB"), "{large}");
    let absent = Import::new()
        .load(folder.path().join("lage.urdf"))
        .unwrap_err();
    assert!(absent.to_string().contains("did you mean"), "{absent}");
}

/// Deep and wide texts, and loops of joints, take neither the stack nor for ever.
#[test]
fn hostile_texts_are_refused_in_good_time() {
    let deep = format!(
        "<robot>{}{}</robot>",
        "<link>".repeat(200_000),
        "</link>".repeat(200_000)
    );
    refused(&Import::new(), &deep);
    let mut ring = "<robot name=\"ring\">".to_owned();
    for link in 0..9_000 {
        let next = (link + 1) % 9_000;
        ring.push_str(&format!(
            "<link name=\"l{link}\"/><joint name=\"j{link}\" type=\"fixed\"><parent link=\"l{link}\"/><child link=\"l{next}\"/></joint>"
        ));
    }
    let found = refused(&Import::new(), &(ring + "</robot>"));
    assert!(found.to_string().contains("loop of joints"), "{found}");
    let wide = format!("<robot>{}</robot>", "<joint/>".repeat(50_000));
    let found = refused(&Import::new(), &wide);
    assert!(found.to_string().contains("more than 10000"), "{found}");
    let huge = ARM
        .replace("ixx=\"0.03\"", "ixx=\"1e29\"")
        .replace("xyz=\"0.01 0 0.08\"", "xyz=\"1e29 1e29 1e29\"");
    refused(&to_hand(), &huge);
}

proptest! {
    /// Whatever is done to a description, something comes back.
    #[test]
    fn no_edit_panics(
        cut in 0..ARM.len(),
        length in 0..40_usize,
        insert in "[<>/\"'& a-z0-9.=\\-\u{e9}\n]{0,12}",
        tip in prop::option::of(prop::sample::select(vec!["hand", "finger_left", "finger_right", "flange", "column"])),
    ) {
        prop_assume!(ARM.is_char_boundary(cut));
        let end = (cut + length).min(ARM.len());
        let text = format!("{}{insert}{}", &ARM[..cut], &ARM[end..]);
        let import = tip.map_or_else(Import::new, |tip| Import::new().tip(tip));
        match import.parse(&text, "arm.urdf") {
            Ok(arm) => prop_assert!(ulna_table::Model::parse(&arm.table(), "arm.toml").is_ok()),
            Err(found) => prop_assert!(found.has_errors()),
        }
    }
}
