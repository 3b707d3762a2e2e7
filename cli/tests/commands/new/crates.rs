//! The crate that is made: complete, formatted, and without a warning it builds, tests, measures and runs, offline.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{files_of, new_in};
use crate::support::{root, stderr};

/// A new crate called `name` in the target folder, of the table at `table` and this checkout. Its dependencies are those of the examples,
/// in the versions of the workspace.
fn make(name: &str, table: &str) -> PathBuf {
    let parent = Path::new(env!("CARGO_TARGET_TMPDIR")).join("new");
    let folder = parent.join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder).unwrap();
    }
    fs::create_dir_all(&parent).unwrap();
    let checkout = root().to_str().unwrap();
    let arguments = ["--crate", name, table, "--path", checkout];
    new_in(&parent, &arguments).code(0);
    fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    folder
}

/// What cargo's `command` prints in `folder`; it must succeed.
fn cargo(folder: &Path, command: &[&str]) -> String {
    let output = Command::new(env!("CARGO"))
        .args(command)
        .current_dir(folder)
        .env(
            "CARGO_TARGET_DIR",
            Path::new(env!("CARGO_TARGET_TMPDIR")).join("outside"),
        )
        .env("CARGO_TERM_COLOR", "never")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{command:?}\n{printed}\n{said}");
    printed.into_owned()
}

/// Joints, the rows of the loop's table (time, off plan, torque), and the steps at the lock, if a joint has locked: with suppression and without.
type Loop = (usize, Vec<[f64; 3]>, Option<[f64; 2]>);

fn parse(printed: &str) -> Loop {
    let mut rows = Vec::new();
    let mut lock = None;
    let numbers = |line: &str| -> Vec<f64> {
        let words = line.split([' ', ',']);
        words.filter_map(|word| word.parse().ok()).collect()
    };
    let (first, table) = printed.split_once('\n').unwrap();
    for line in table.lines().skip(1) {
        match numbers(line).as_slice() {
            [_, _, with, without] if line.contains("has locked") => lock = Some([*with, *without]),
            [time, off_plan, torque] => rows.push([*time, *off_plan, *torque]),
            _ => panic!("{line:?} in\n{printed}"),
        }
    }
    (numbers(first)[0] as usize, rows, lock)
}

/// Two arms of the repository beside the template's: a small one whose task takes all joints, and one with all that a table can say.
#[test]
fn a_new_crate_builds_tests_measures_and_runs_at_once() {
    let arms = root().join("arms");
    let arm = |name: &str| arms.join(name).to_str().unwrap().to_owned();
    for (name, table, joints) in [
        ("new_template", "my_arm.toml".to_owned(), 4),
        ("new_planar_2r", arm("planar_2r.toml"), 2),
        ("new_geared_6", arm("geared_6.toml"), 6),
    ] {
        let folder = make(name, &table);
        cargo(&folder, &["fmt", "--check"]);
        let offline = |command: &str, options: &[&str]| {
            cargo(
                &folder,
                &[&[command, "--offline", "--quiet"], options].concat(),
            )
        };
        offline("clippy", &["--all-targets", "--", "--deny", "warnings"]);
        let tests = offline("test", &["--all-targets"]);
        // Of the generated file, and of tests/verified.rs.
        for passed in ["ok. 1 passed; 0 failed", "ok. 2 passed; 0 failed"] {
            assert_eq!(tests.matches(passed).count(), 1, "{tests}");
        }
        // A bench, run as a test, measures once.
        assert!(tests.contains("\nforward_dynamics "), "{tests}");

        let printed = offline("run", &[]);
        let (count, rows, lock) = parse(&printed);
        assert_eq!((count, rows.len()), (joints, 11), "{printed}");
        // Before any lock the error falls at every row, to less than a thousandth at last.
        let before: Vec<f64> = rows.iter().map(|row| row[1]).take(6).collect();
        assert!(before.windows(2).all(|pair| pair[1] < pair[0]), "{printed}");
        assert!(before[5] < 1e-3 * before[0], "{printed}");
        assert!(rows.iter().all(|row| row[2] > 0.0), "{printed}");
        // One joint to spare: of those arms the template's alone.
        assert_eq!(lock.is_some(), name == "new_template", "{printed}");
        if let Some([with, without]) = lock {
            assert!(without > 0.1 && with < 0.1 * without, "{printed}");
        }
    }
}

const FILES: [&str; 10] = [
    ".gitignore",
    "Cargo.toml",
    "README.md",
    "benches/dynamics.rs",
    "build.rs",
    "src/bin/control_loop/main.rs",
    "src/bin/control_loop/plan.rs",
    "src/bin/control_loop/plant.rs",
    "src/lib.rs",
    "tests/verified.rs",
];

#[test]
fn a_crate_is_made_of_the_table_that_there_is() {
    let folder = tempfile::tempdir().unwrap();
    let table = fs::read(root().join("arms/planar_2r.toml")).unwrap();
    fs::write(folder.path().join("arm.toml"), &table).unwrap();
    fs::create_dir(folder.path().join("the-robot")).unwrap();
    let said = stderr(&new_in(folder.path(), &["--crate", "the-robot", "arm.toml"]).code(0));
    assert!(
        said.starts_with("written: the crate `the-robot` around the arm `planar_2r`\n"),
        "{said}"
    );
    assert!(
        said.contains("\nnext:\n  cd the-robot\n  cargo run "),
        "{said}"
    );
    let made = folder.path().join("the-robot");
    let found = files_of(&made);
    let (tables, others): (Vec<_>, Vec<_>) =
        found.iter().partition(|file| file.ends_with("r.toml"));
    assert_eq!(tables, ["arms/planar_2r.toml"]);
    assert_eq!(others, FILES);
    assert_eq!(fs::read(made.join("arms/planar_2r.toml")).unwrap(), table);
    for file in FILES {
        assert!(
            said.contains(&format!("  the-robot/{file}\n")),
            "{file}\n{said}"
        );
        let text = fs::read_to_string(made.join(file)).unwrap();
        for placeholder in ["my_arm", "MyArm", "my_crate", "my-package", "ULNA", "0.0.0"] {
            assert!(!text.contains(placeholder), "{placeholder} in {file}");
        }
        assert!(text.ends_with('\n'), "{file}");
    }
    let read = |file: &str| fs::read_to_string(made.join(file)).unwrap();
    assert!(read("Cargo.toml").starts_with("[package]\nname = \"the-robot\"\n"));
    let version = env!("CARGO_PKG_VERSION");
    assert!(read("Cargo.toml").contains(&format!("\nulna = \"{version}\"\n")));
    assert!(read("Cargo.toml").contains(&format!("\nulna-codegen = \"{version}\"\n")));
    assert!(read("src/lib.rs").contains("pub fn arm() -> Planar2r {"));
    assert!(read("tests/verified.rs").contains("use the_robot::arm;"));
}

#[test]
fn what_is_odd_about_a_table_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let table = fs::read_to_string(root().join("arms/planar_2r.toml")).unwrap();
    let table = table.replace("rows = [\"x\", \"y\"]", "rows = [\"z\"]");
    fs::write(folder.path().join("arm.toml"), table).unwrap();
    let said = stderr(&new_in(folder.path(), &["--crate", "robot", "arm.toml"]).code(0));
    assert!(said.contains("w_D is 0 in every configuration"), "{said}");
}

#[test]
fn a_crate_is_called_after_its_folder_as_far_as_it_can_be() {
    for (name, package) in [
        ("robot", "robot"),
        ("my-robot2", "my-robot2"),
        ("My Robot", "my_robot"),
        ("7dof", "arm_7dof"),
        ("fn", "arm_fn"),
        ("test", "test_robot"),
        ("ulna", "ulna_robot"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let said = stderr(&new_in(folder.path(), &["--crate", name, "ur5e.toml"]).code(0));
        assert_eq!(
            said.contains("the crate is called"),
            name != package,
            "{said}"
        );
        assert!(said.contains("there is no file ur5e.toml"), "{said}");
        let manifest = fs::read_to_string(folder.path().join(name).join("Cargo.toml")).unwrap();
        assert!(
            manifest.contains(&format!("name = \"{package}\"\n")),
            "{manifest}"
        );
        assert!(folder.path().join(name).join("arms/ur5e.toml").exists());
    }
    // The folder in which it runs.
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("robot");
    fs::create_dir(&folder).unwrap();
    new_in(&folder, &["--crate", ".", "my_arm.toml"]).code(0);
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
    assert!(manifest.contains("name = \"robot\"\n"), "{manifest}");
}

/// Lines are broken where rustfmt breaks them, whether the names are short or long. (One longer than 28 characters makes it break a line more.)
#[test]
fn a_crate_is_formatted_whatever_it_is_called() {
    let long = "an_arm_whose_name_is_28_long";
    assert_eq!(long.len(), 28);
    for (name, table) in [("z", "ab.toml".to_owned()), (long, format!("{long}.toml"))] {
        let folder = make(name, &table);
        cargo(&folder, &["fmt", "--check"]);
    }
}
