//! Bad tables: every error at once, each at its line, with what to write instead; never a panic.

use proptest::prelude::*;
use ulna_table::Model;
use ulna_table::diagnostics::{Diagnostics, Severity};

const PLANAR: &str = include_str!("../../arms/planar_2r.toml");
const OBLIQUE: &str = include_str!("../../arms/oblique_6.toml");

/// The planar arm's table with the first `from` replaced by `to`.
fn edited(from: &str, to: &str) -> String {
    assert!(PLANAR.contains(from), "the table has no {from:?}");
    PLANAR.replacen(from, to, 1)
}

fn refused(text: &str) -> Diagnostics {
    Model::parse(text, "arms/bad.toml").expect_err("the table should be refused")
}

/// The messages for each edit, one after the other.
fn messages(edits: &[(&str, &str)]) -> String {
    let blocks = edits.iter().map(|(from, to)| {
        let title = format!("{from:.60} -> {to:.60}").replace('\n', "\\n");
        format!("==== {title}\n\n{}\n", refused(&edited(from, to)))
    });
    blocks.collect::<Vec<_>>().join("\n")
}

#[test]
fn syntax() {
    let messages = messages(&[
        ("name = \"planar_2r\"", "name = planar_2r"),
        ("theta = 0.0", "theta 0.0"),
        ("[task]", "[task"),
        ("theta = 0.0", "theta = 0.0\ntheta = 1.0"),
        ("mass = 1.0", "mass = 1..0\ncom = [0.0, 0.0"),
    ]);
    insta::assert_snapshot!(messages);
}

/// What is no TOML, but tells what was meant.
#[test]
fn slips_of_the_pen() {
    let messages = messages(&[
        ("com = [0.5, 0.0, 0.0]", "com = [0.5 0.0, 0.0]"),
        ("xx = 0.0003125, yy", "xx = 0.0003125 yy"),
        ("alpha = 0.0", "alpha = pi/2"),
        ("alpha = 0.0", "alpha = \"-pi/2\""),
        ("mass = 1.0", "mass = 3,761"),
        ("xx = 0.0003125, yy", "xx = 0,0003125, yy"),
        ("com = [0.5, 0.0, 0.0]", "com = [0,5, 0,0, 0,0]"),
        ("mass = 1.0", "mass = 1.0 kg"),
        ("mass = 1.0", "mass = 1 000"),
        ("mass = 1.0", "mass = 10^3"),
        ("name = \"planar_2r\"", "name = nice_arm"),
        ("mass = 1.0", "mass = .5"),
        ("mass = 1.0", "mass: 1.0"),
        ("mass = 1.0", "mass = 1.0 // kg"),
        ("angle_unit = \"deg\"", "angle_unit = \u{201c}deg\u{201d}"),
        ("rows = [\"x\", \"y\"]", "rows = [x, y]"),
        ("# Two", "{ # Two"),
        ("# Two", "<robot name=\"two\"/> <!-- Two -->\n#"),
    ]);
    insta::assert_snapshot!(messages);
}

/// One mistake in a header, one error.
#[test]
fn headers() {
    let edits = [
        ("[[joint]]", "[joint]"),
        ("[[joint]]", "[[Joint]]"),
        ("[[joint]] # shoulder", ""),
        ("[[joint]] # shoulder", "[joint] # shoulder"),
        ("[joint.link]", "[link]"),
    ];
    let blocks = edits.map(|(from, to)| {
        let found = refused(&PLANAR.replace(from, to));
        assert_eq!(found.list().len(), 1, "{found}");
        format!("==== {from} -> {to}\n\n{found}\n")
    });
    insta::assert_snapshot!(blocks.join("\n"));
}

#[test]
fn a_key_under_another_header_is_told_its_place() {
    let messages = messages(&[
        ("[task]\n", ""),
        ("inertia = {", "rated_torque = 3.0\ninertia = {"),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn a_scenario_is_told_from_a_table() {
    let scenario = include_str!("../../scenarios/paper_like.toml");
    let found = refused(scenario);
    insta::assert_snapshot!(found);
}

#[test]
fn keys() {
    let messages = messages(&[
        ("alpha = 0.0", "alhpa = 0.0"),
        ("alpha = 0.0\n", ""),
        ("rated_torque = 40.0", "colour = \"red\""),
        ("name = \"planar_2r\"\n", ""),
        ("convention = \"modified\"\n", "gravitation = 1\n"),
        ("[task]\nrows = [\"x\", \"y\"]\n", ""),
        ("[joint.link]\nmass", "[joint.lnk]\nmass"),
        ("xx = 0.0003125, ", "xx = 0.0003125, ixy = 0.0, "),
        ("[tool]", "[tool]\nxzy = [0.0, 0.0, 0.0]"),
        ("[[joint]] # shoulder", "[[joint]]\n[[joints]]"),
        (
            "[joint.link]\nmass = 1.0\n",
            "[joint.link]\nmass\u{1b}x = 1.0\n",
        ),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn payloads() {
    let messages = messages(&[
        ("[tool]", "[payload]\nruntime = 1\n[tool]"),
        ("[tool]", "[payload]\nruntime = \"true\"\n[tool]"),
        ("[tool]", "[payload]\nmass = 2.0\n[tool]"),
        ("[task]", "payload = true\n[task]"),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn types_and_lengths() {
    let messages = messages(&[
        ("mass = 1.0", "mass = \"1.0\""),
        ("mass = 1.0", "mass = [1.0]"),
        ("com = [0.5, 0.0, 0.0]", "com = [0.5, 0.0]"),
        ("com = [0.5, 0.0, 0.0]", "com = [true, 0.0, \"x\"]"),
        ("gravity = [0.0, -9.81, 0.0]", "gravity = -9.81"),
        ("inertia = {", "inertia = 1.0 # {"),
        ("name = \"planar_2r\"", "name = 2"),
        ("[tool]\nxyz", "[tool.xyz]\nx"),
        ("[[joint]] # shoulder", "[joint] # shoulder\n[[jiont]]"),
        ("convention = \"modified\"", "convention = \"modfied\""),
        ("angle_unit = \"deg\"", "angle_unit = \"gon\""),
        ("[[joint]] # shoulder", "[[joint]]\nkind = \"spherical\""),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn numbers() {
    let messages = messages(&[
        ("mass = 1.0", "mass = nan"),
        ("mass = 1.0", "mass = 0.0"),
        ("mass = 1.0", "mass = -1"),
        ("mass = 1.0", "mass = 1e300"),
        ("d = 0.0", "d = -inf"),
        ("d = 0.0", "d = 1e400"),
        ("a = 1.0", "a = 1000"),
        (
            "a = 1.0",
            "a = 170141183460469231731687303715884105728170141183460469231731687",
        ),
        ("theta = 0.0", "theta = 1080.0"),
        (
            "angle_unit = \"deg\"",
            "angle_unit = \"rad\"\nbase.rpy = [90.0, nan, 0.0]",
        ),
        (
            "gravity = [0.0, -9.81, 0.0]",
            "gravity = [0.0, -9810.0, nan]",
        ),
        ("rated_torque = 40.0", "rated_torque = inf"),
        ("rated_torque = 40.0", "rated_torque = 0.0"),
        ("xyz = [1.0, 0.0, 0.0]", "xyz = [1000.0, 0.0, 0.0]"),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn physics() {
    let inertia = "inertia = { xx = 0.0003125, yy = 0.0834895833333333, zz = 0.0834895833333333 }";
    let messages = messages(&[
        (inertia, "inertia = { xx = 0.0, yy = 0.1, zz = 0.1 }"),
        (inertia, "inertia = { xx = -1.0, yy = 1.0, zz = 1.0 }"),
        (
            inertia,
            "inertia = { xx = 1.0, yy = 1.0, zz = 1.0, xy = 1.5 }",
        ),
        (inertia, "inertia = { xx = 1.0, yy = 1.0, zz = 2.1 }"),
        (
            inertia,
            "inertia = { xx = 1e-300, yy = 1e-300, zz = 1e-300 }",
        ),
        (inertia, "inertia = { xx = 1e10, yy = 1e10, zz = 1e10 }"),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn task_rows() {
    let rows = "rows = [\"x\", \"y\"]";
    let messages = messages(&[
        (rows, "rows = []"),
        (rows, "rows = [\"x\", \"y\", \"x\"]"),
        (rows, "rows = [\"x\", \"w\"]"),
        (rows, "rows = [\"x\", 2]"),
        (rows, "rows = \"positon\""),
        (rows, "rows = \"pose\""),
        (rows, "rows = 2"),
        (rows, ""),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn names() {
    let name = "name = \"planar_2r\"";
    let messages = messages(&[
        (name, "name = \"\""),
        (name, "name = \"Planar 2R\""),
        (name, "name = \"fn\""),
        (name, "name = \"r#fn\""),
        (name, "name = \"2r\""),
        (name, "name = \"vec\""),
        (name, "name = \"bras_\u{e9}lanc\u{e9}\""),
        (name, "name = \"a; fn main() { evil() }\""),
        (name, "name = \"x\\u001b[31m\""),
        (
            name,
            "name = \"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\"",
        ),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn no_joints() {
    let (head, _) = PLANAR.split_once("[[joint]]").unwrap();
    let empty = head.replace("[task]", "joint = []\n[task]");
    let single = PLANAR.split("[[joint]] # elbow").next().unwrap();
    let single = single.replace("[[joint]]", "[joint]");
    let messages = [head, &empty, &single, ""].map(|text| refused(text).to_string());
    let messages = messages.join("\n\n");
    insta::assert_snapshot!(messages);
}

#[test]
fn too_many_joints() {
    let joints = |count: usize| {
        let (head, joint) = PLANAR.rsplit_once("[[joint]]").unwrap();
        format!("{head}{}", format!("[[joint]]{joint}").repeat(count))
    };
    let longest = Model::parse(&joints(31), "long.toml").unwrap();
    assert_eq!(longest.joints().len(), 32);
    let found = refused(&joints(3000));
    assert_eq!(found.list().len(), 1);
    assert!(
        found.to_string().contains("3001 joints; 32 are the most"),
        "{found}"
    );
}

#[test]
fn every_error_at_once_in_the_order_of_the_text() {
    let text = edited("name = \"planar_2r\"", "name = \"Planar 2R\"")
        .replace("modified", "modifed")
        .replace("[0.0, -9.81, 0.0]", "[0.0, -9.81]")
        .replacen("mass = 1.0", "mass = -1.0", 1)
        .replacen("alpha = 0.0", "alpha = nan", 1)
        .replace("zz = 0.0834895833333333", "zz = 1.0")
        .replace("rated_torque = 15.0", "rated_torqe = 15.0");
    let found = refused(&text);
    let message = found.to_string();
    insta::assert_snapshot!(message);
    let lines: Vec<_> = found
        .list()
        .iter()
        .map(|one| one.position.unwrap().line)
        .collect();
    assert!(lines.is_sorted(), "{lines:?}");
    for one in found.list() {
        let line = text.lines().nth(one.position.unwrap().line - 1).unwrap();
        assert!(
            !line.is_empty() && one.severity == Severity::Error,
            "{one:?}"
        );
    }
}

#[test]
fn debug_is_the_readable_text_that_a_build_script_prints() {
    let found = refused(&edited("mass = 1.0", "mass = 0.0"));
    let debug = format!("{found:?}");
    assert!(debug.ends_with(&found.to_string()), "{debug}");
    assert!(debug.starts_with("arms/bad.toml is refused\n"), "{debug}");
}

#[test]
fn files() {
    let folder = tempfile::tempdir().unwrap();
    let message = |name: &str| {
        let found = Model::load(folder.path().join(name))
            .unwrap_err()
            .to_string();
        found.replace(folder.path().to_str().unwrap(), "DIR")
    };
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    write("latin1.toml", b"# ok\nname = \"\xe9lan\"\n");
    write("utf16.toml", b"\xff\xfen\0a\0");
    write("huge.toml", &vec![b'#'; 300 * 1024]);
    write("binary.toml", b"\0\x01\x02");
    write("ssrms.toml", b"");
    std::fs::create_dir(folder.path().join("folder.toml")).unwrap();
    let names = [
        "latin1.toml",
        "utf16.toml",
        "huge.toml",
        "binary.toml",
        "folder.toml",
        "absent.toml",
        "srms.toml",
        "ssrms.toml/x",
        "ssrms.toml",
    ];
    let messages = names.map(message).join("\n\n");
    insta::assert_snapshot!(messages);
}

#[test]
#[cfg(unix)]
fn what_is_no_regular_file_is_refused_and_not_waited_for() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.toml");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    let socket = folder.path().join("socket.toml");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    let link = folder.path().join("link.toml");
    std::os::unix::fs::symlink(&pipe, &link).unwrap();
    for path in [pipe.as_path(), &socket, &link, "/dev/zero".as_ref()] {
        let text = Model::load(path).unwrap_err().to_string();
        assert!(text.contains("is no regular file"), "{text}");
        assert!(text.contains(path.to_str().unwrap()), "{text}");
        assert!(text.contains("help: save the text in a file"), "{text}");
    }
}

#[test]
fn messages_are_short_however_long_the_table() {
    let long = "x".repeat(200_000);
    for (from, to) in [
        ("name = \"planar_2r\"", format!("name = \"{long}\"")),
        (
            "convention = \"modified\"",
            format!("convention = \"{long}\""),
        ),
        ("theta = 0.0", format!("theta = 0.0\n{long} = 1")),
        ("theta = 0.0", format!("theta = \"{long}\"")),
        ("theta = 0.0", format!("theta = 0.{long}")),
        (
            "theta = 0.0",
            format!("theta = 0.0 # {long}\nthet = 1 # {long}"),
        ),
    ] {
        let text = refused(&edited(from, &to)).to_string();
        assert!(text.len() < 10_000, "{} bytes: {text:.1000}", text.len());
    }
}

#[test]
fn warnings_do_not_refuse() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rounded.toml");
    let text = edited("\"deg\"", "\"rad\"").replacen("alpha = 0.0", "alpha = 1.5708", 1);
    std::fs::write(&path, text).unwrap();
    let (_, found) = Model::lint(&path).unwrap();
    let rounded = found
        .to_string()
        .replace(folder.path().to_str().unwrap(), "DIR");

    std::fs::write(&path, edited("alpha = 0.0", "alpha = -1.5708")).unwrap();
    let (_, found) = Model::lint(&path).unwrap();
    let unit = found
        .to_string()
        .replace(folder.path().to_str().unwrap(), "DIR");
    let messages = format!("{rounded}\n\n{unit}");
    insta::assert_snapshot!(messages);
}

/// Bytes, pieces and whole lines of a table cut out, doubled, or replaced by what tables are made of and what they are not.
fn mutated() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        Just("[".to_owned()),
        Just("]".to_owned()),
        Just("[[joint]]\n".to_owned()),
        Just("{".to_owned()),
        Just("}".to_owned()),
        Just("\"".to_owned()),
        Just("'''".to_owned()),
        Just("=".to_owned()),
        Just("\n".to_owned()),
        Just("\r\n".to_owned()),
        Just(".".to_owned()),
        Just("nan".to_owned()),
        Just("-inf".to_owned()),
        Just("1e308".to_owned()),
        Just("0x".to_owned()),
        Just("-0.0".to_owned()),
        Just("1979-05-27".to_owned()),
        Just("true".to_owned()),
        Just("\\u0000".to_owned()),
        Just("joint.link.mass = 1\n".to_owned()),
        Just("[joint.link]\n".to_owned()),
        Just(String::new()),
        any::<f64>().prop_map(|x| x.to_string()),
        "\\PC{1,8}",
        any::<char>().prop_map(String::from),
    ];
    let edit = (any::<prop::sample::Index>(), 0_usize..40, piece);
    let base = prop_oneof![Just(PLANAR), Just(OBLIQUE)];
    (base, prop::collection::vec(edit, 1..8)).prop_map(|(base, edits)| {
        let mut text: Vec<char> = base.chars().collect();
        for (at, length, piece) in edits {
            let start = at.index(text.len() + 1);
            let end = (start + length).min(text.len());
            text.splice(start..end, piece.chars());
        }
        text.into_iter().collect()
    })
}

/// What a reader of any text may count on.
fn assert_sound(text: &str) {
    match Model::parse(text, "a.toml") {
        Ok(model) => {
            assert!(!model.joints().is_empty() && !model.task().is_empty());
            assert!(model.task().len() <= model.joints().len());
            let numbers = model.joints().iter().flat_map(|joint| {
                let tensor = joint.link.inertia.into_iter().flatten();
                tensor
                    .chain(joint.link.com)
                    .chain([joint.a, joint.d, joint.link.mass])
            });
            assert!(numbers.into_iter().all(f64::is_finite));
        }
        Err(found) => {
            assert!(found.has_errors());
            assert!(!found.to_string().is_empty() && !found.to_coloured_string().is_empty());
            for one in found.list() {
                let position = one.position.expect("an error in a text has a place in it");
                assert!(position.line <= text.split('\n').count(), "{one:?}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_mutated_table_never_panics(text in mutated()) {
        assert_sound(&text);
    }

    #[test]
    fn no_text_panics(text in "(\\PC|\n|\r|\t|\0|[\\[\\]{}=\".#]){0,60}") {
        assert_sound(&text);
    }
}

#[test]
fn a_byte_order_mark_and_windows_lines_are_fine() {
    let text = format!("\u{feff}{}", PLANAR.replace('\n', "\r\n"));
    let arm = Model::parse(&text, "a.toml").unwrap();
    assert_eq!(
        arm.joints(),
        Model::parse(PLANAR, "a.toml").unwrap().joints()
    );
    let found = refused(&text.replacen("mass = 1.0", "mass = 0.0", 1));
    let unix = refused(&edited("mass = 1.0", "mass = 0.0"));
    assert_eq!(found.to_string(), unix.to_string());
}
