//! The doors to generated code, used as a user outside the workspace uses them: build script, macro, checked-in file.

mod outside;

use std::fs;

use outside::{CHECKED_IN, Crate, root};
use ulna_codegen::{Generator, Method};
use ulna_table::Model;

const TABLE: &str = "arms/planar_2r.toml";

/// What a generator writes today.
fn generated(generator: &Generator) -> String {
    let model = Model::load(root().join(TABLE)).unwrap();
    generator.generate(&model, TABLE).source()
}

/// A generator of the methods that are checked in.
fn of_three_methods() -> Generator {
    Generator::new().methods(&[
        Method::MassMatrix,
        Method::InverseDynamics,
        Method::DynamicManipulabilityGradient,
    ])
}

/// Two mistakes in joint 2 of the planar arm.
fn bad_table() -> String {
    let good = fs::read_to_string(root().join(TABLE)).unwrap();
    let (first, second) = good.split_once("[[joint]] # elbow").unwrap();
    let second = second.replace("mass = 1.0", "mass = -1.0");
    format!("{first}[[joint]]{}", second.replace("alpha", "alhpa"))
}

#[test]
fn the_checked_in_file_is_what_the_generator_writes() {
    let path = root().join(CHECKED_IN);
    let new = generated(&of_three_methods());
    if fs::read_to_string(&path).unwrap() != new {
        fs::write(&path, new).unwrap();
        panic!(
            "{CHECKED_IN} was out of date. It has been written anew: read the change and commit it."
        );
    }
}

#[test]
fn the_readme_shows_what_the_generator_writes() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let (_, shown) = readme
        .split_once("becomes, among the rest,\n\n```rust,ignore\n")
        .unwrap();
    let (shown, _) = shown.split_once("```").unwrap();
    let flat = |text: &str| text.lines().map(str::trim).collect::<Vec<_>>().join("\n");
    let generated = flat(&generated(&Generator::new()));
    // The doc comment is shortened to its first line.
    let (doc, code) = shown.split_once('\n').unwrap();
    assert!(generated.contains(doc), "{doc}");
    assert!(generated.contains(flat(code).trim_end()), "{code}");
}

#[test]
fn all_doors_lead_to_the_same_code() {
    let outputs = ["build_script", "macro", "checked_in"].map(|name| {
        let example = Crate::of_repository(&format!("examples/{name}"));
        example.assert_lock_file_fits();
        let build = example.build();
        assert!(build.succeeded, "{name}:\n{}", build.stderr);
        if let Some(out_dir) = build.out_dir {
            assert_eq!(
                fs::read_to_string(out_dir.join("planar_2r.rs")).unwrap(),
                generated(&Generator::new())
            );
        }
        example.run()
    });
    assert!(outputs[0].contains("w_D = "), "{}", outputs[0]);
    assert_eq!(outputs[0], outputs[1]);
    assert_eq!(outputs[0], outputs[2]);
}

/// A row of the example's table: its numbers.
fn row(output: &str, name: &str) -> Vec<f64> {
    let line = output.lines().find(|line| line.starts_with(name));
    let line = line.unwrap_or_else(|| panic!("no row {name:?} in\n{output}"));
    line[22..]
        .split_whitespace()
        .map(|number| number.parse().unwrap())
        .collect()
}

#[test]
fn a_loop_of_ones_own_takes_most_of_the_step() {
    let example = Crate::of_repository("examples/control_loop");
    example.assert_lock_file_fits();
    let output = example.run();
    // Step, peak, force error, U, off plan.
    let [none, recourse, on_line, watched, bent] = [
        "none",
        "recourse",
        "on-line law",
        "joint 3 watched",
        "the same, 5 N",
    ]
    .map(|name| row(&output, name));
    assert!(none[0] > 1.0 && none[3] == 0.0, "{output}");
    for exact in [&recourse, &on_line, &watched] {
        assert!(exact[0] < none[0] && exact[2] == 0.0, "{output}");
    }
    assert!(
        on_line[0] < recourse[0] && watched[0] < on_line[0],
        "{output}"
    );
    assert!(bent[0] < 0.2 * none[0] && bent[2] <= 5.0, "{output}");
}

#[test]
fn a_generated_arm_links_without_the_standard_library() {
    let firmware = Crate::of_repository("tests/no_std");
    firmware.assert_lock_file_fits();
    let build = firmware.build();
    assert!(build.succeeded, "{}", build.stderr);
}

/// Three methods generated and the others by the textbook, beside the same arm in full.
const FEW: &str = r#"
use ulna::nalgebra::Vector2;
use ulna::{Arm, ArmBatch, Method, MethodSet, Unrolled};

fn main() {
    let (few, all) = (Planar2r, Planar2rInFull);
    let chosen = [Method::MassMatrix, Method::InverseDynamics, Method::JacobianDerivatives];
    assert_eq!(Planar2r::GENERATED, MethodSet::of(&chosen));
    assert_eq!(Planar2rInFull::GENERATED, MethodSet::ALL);
    let states = ulna::proof::states(&Planar2r::CHAIN).take(50);
    let report = ulna::proof::compare_with(&few, &all, &Planar2r::CHAIN, states);
    assert!(report.passes(), "{report}");

    // What is generated gives the same bits; what is not, the textbook's.
    let q: Vec<Vector2<f64>> = (0..21).map(|i| Vector2::new(0.1 * f64::from(i), 1.2)).collect();
    for q in &q {
        assert_eq!(few.mass_matrix(q), all.mass_matrix(q));
        assert_eq!(few.inverse_dynamics(q, q, q), all.inverse_dynamics(q, q, q));
        assert_eq!(few.gravity_torque(q), Planar2r::CHAIN.gravity_torque(q));
        assert_eq!(few.forward_dynamics(q, q, q), Planar2r::CHAIN.forward_dynamics(q, q, q));
    }
    let mut gravity = vec![Vector2::zeros(); q.len()];
    few.gravity_torque_batch(&q, &mut gravity).unwrap();
    assert!(q.iter().zip(&gravity).all(|(q, g)| *g == few.gravity_torque(q)));
    let mut masses = vec![Default::default(); q.len()];
    few.mass_matrix_batch(&q, &mut masses).unwrap();
    assert!(q.iter().zip(&masses).all(|(q, m)| *m == few.mass_matrix(q)));

    // A kernel that is not there says so.
    let called = std::panic::catch_unwind(|| Planar2r.gravity_torque_kernel(&[0.0, 0.0]));
    let said = called.unwrap_err();
    let said = said.downcast_ref::<String>().unwrap();
    assert!(said.contains("no kernel of `gravity_torque` was generated"), "{said}");
    println!("ok");
}
"#;

fn of_few_methods(name: &str, example: &str) -> Crate {
    let user = Crate::of_user(name, &format!("examples/{example}"));
    let table = fs::read_to_string(root().join(TABLE)).unwrap();
    user.write("arms/planar_2r.toml", &table);
    user.write(
        "arms/planar_2r_in_full.toml",
        &table.replace("\"planar_2r\"", "\"planar_2r_in_full\""),
    );
    user
}

#[test]
fn a_choice_of_methods_by_the_macro() {
    let user = of_few_methods("macro_methods", "macro");
    let calls = "ulna_macros::arm!(\"arms/planar_2r_in_full.toml\");\n\
        ulna_macros::arm!(\"arms/planar_2r.toml\", methods = [mass_matrix, inverse_dynamics, jacobian_derivatives]);\n";
    user.write("src/main.rs", &format!("{calls}{FEW}"));
    let build = user.build();
    assert!(build.succeeded, "{}", build.stderr);
    assert_eq!(user.run(), "ok\n");
}

#[test]
fn a_choice_of_methods_by_the_build_script() {
    let user = of_few_methods("build_script_methods", "build_script");
    user.write(
        "build.rs",
        "use ulna_codegen::{Generator, Method, compile_arms};\n\n\
         fn main() -> Result<(), ulna_codegen::Error> {\n\
             compile_arms(&[\"arms/planar_2r_in_full.toml\"])?;\n\
             let chosen = [Method::MassMatrix, Method::InverseDynamics, Method::JacobianDerivatives];\n\
             Generator::new().methods(&chosen).compile_arms(&[\"arms/planar_2r.toml\"])\n\
         }\n",
    );
    let included = ["planar_2r", "planar_2r_in_full"]
        .map(|arm| format!("include!(concat!(env!(\"OUT_DIR\"), \"/{arm}.rs\"));\n"));
    user.write("src/main.rs", &format!("{}{FEW}", included.concat()));
    let build = user.build();
    assert!(build.succeeded, "{}", build.stderr);
    assert_eq!(user.run(), "ok\n");
}

#[test]
fn what_is_no_method_stops_the_macro_with_what_there_is() {
    let user = of_few_methods("macro_methods_misuse", "macro");
    let calls = [
        "methods = [mass_matirx, torque]",
        "method = [mass_matrix]",
        "methods = mass_matrix",
    ];
    let calls = calls.map(|rest| format!("ulna_macros::arm!(\"arms/planar_2r.toml\", {rest});\n"));
    user.write(
        "src/main.rs",
        &format!("{}fn main() {{}}\n", calls.concat()),
    );
    let build = user.build();
    assert!(!build.succeeded);
    let stderr = build.stderr;
    assert!(
        stderr.contains("unknown method `mass_matirx`: did you mean `mass_matrix`?"),
        "{stderr}"
    );
    assert!(stderr.contains("unknown method `torque`"), "{stderr}");
    assert!(
        stderr.contains("the methods are forward_kinematics, "),
        "{stderr}"
    );
    assert!(stderr.contains("expected `methods = [...]`"), "{stderr}");
    assert!(stderr.contains("expected square brackets"), "{stderr}");
}

#[test]
fn a_bad_table_stops_the_macro_at_its_path() {
    let user = Crate::of_user("macro_errors", "examples/macro");
    user.write("arms/planar_2r.toml", &bad_table());
    let build = user.build();
    assert!(!build.succeeded);
    let stderr = build.stderr;
    insta::assert_snapshot!(stderr);
}

#[test]
fn what_is_not_a_path_of_a_table_stops_the_macro() {
    let user = Crate::of_user("macro_misuse", "examples/macro");
    user.write("arms/planar_2r.toml", &bad_table());
    let calls = [
        "ssrms",
        "\"arms/planar_2.toml\"",
        "\"arms\"",
        "\"a.toml\", \"b.toml\"",
        "",
    ];
    let calls = calls.map(|call| format!("ulna_macros::arm!({call});\n"));
    user.write(
        "src/main.rs",
        &format!("{}fn main() {{}}\n", calls.concat()),
    );
    let build = user.build();
    assert!(!build.succeeded);
    let stderr = build.stderr;
    insta::assert_snapshot!(stderr);
}

/// An arm's type may be called like what its code needs from elsewhere.
#[test]
fn no_name_of_an_arm_hides_what_its_code_needs() {
    let user = Crate::of_user("names", "examples/macro");
    let table = fs::read_to_string(root().join(TABLE)).unwrap();
    let names = [
        "s_matrix",
        "s_vector",
        "isometry_matrix3",
        "unrolled",
        "state",
        "part",
        "method",
    ];
    let mut main = String::new();
    for name in names {
        let path = format!("arms/{name}.toml");
        user.write(&path, &table.replace("planar_2r", name));
        main += &format!("ulna_macros::arm!(\"{path}\");\n");
    }
    main +=
        "fn main() {\n    assert_eq!(ulna::Arm::task(&SMatrix), ulna::Arm::task(&Method));\n}\n";
    user.write("src/main.rs", &main);
    let build = user.build();
    assert!(build.succeeded, "{}", build.stderr);
}

#[test]
fn a_bad_table_stops_the_build_script_with_the_same_text() {
    let user = Crate::of_user("build_script_errors", "examples/build_script");
    user.write("arms/planar_2r.toml", &bad_table());
    let build = user.build();
    assert!(!build.succeeded);
    for line in Model::load(user.path("arms/planar_2r.toml"))
        .unwrap_err()
        .to_string()
        .lines()
    {
        let line = line.replace(user.path("").to_str().unwrap(), "");
        assert!(
            build.stderr.contains(&line),
            "{line:?} is missing in:\n{}",
            build.stderr
        );
    }
    assert!(!build.stderr.contains("panicked"), "{}", build.stderr);
}

#[test]
fn a_changed_table_is_compiled_again() {
    for (name, example) in [
        ("macro_change", "macro"),
        ("build_script_change", "build_script"),
    ] {
        let user = Crate::of_user(name, &format!("examples/{example}"));
        let good = fs::read_to_string(root().join(TABLE)).unwrap();
        user.write("arms/planar_2r.toml", &good);
        assert!(user.build().succeeded);
        let before = user.run();
        user.write(
            "arms/planar_2r.toml",
            &good.replace("mass = 1.0", "mass = 2.0"),
        );
        assert!(user.build().succeeded);
        assert_ne!(user.run(), before, "{example}");
    }
}

/// A planar arm cannot move across its plane.
#[test]
fn a_task_that_is_singular_everywhere_is_a_warning_at_every_door() {
    for (name, example) in [
        ("macro_warning", "macro"),
        ("build_script_warning", "build_script"),
    ] {
        let user = Crate::of_user(name, &format!("examples/{example}"));
        let table = fs::read_to_string(root().join(TABLE)).unwrap();
        let table = table.replace("rows = [\"x\", \"y\"]", "rows = [\"z\"]");
        user.write("arms/planar_2r.toml", &table);
        let messages = user.messages();
        assert!(
            messages.contains("arms/planar_2r.toml: w_D is 0 in every configuration"),
            "{example}:\n{messages}"
        );
    }
}
