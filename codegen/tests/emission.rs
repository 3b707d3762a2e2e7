//! The emitted text: in full for the smallest arm, in counts for all.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use ulna_codegen::{
    COptions, Counts, Generated, GeneratedC, Generator, Method, Precision, generate,
};
use ulna_table::Model;

fn arms() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../arms");
    let entries = std::fs::read_dir(folder).expect("the folder of arm tables");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("readable").path())
        .collect();
    paths.retain(|path| {
        path.extension()
            .is_some_and(|extension| extension == "toml")
    });
    paths.sort();
    assert!(paths.len() >= 4);
    paths
}

/// What tests ask of an arm's code.
struct Code {
    model: Model,
    source: String,
    tokens: String,
    counts: Vec<(Method, Counts)>,
}

/// Of every arm, generated once for all tests.
fn every_arm() -> &'static [Code] {
    static ARMS: OnceLock<Vec<Code>> = OnceLock::new();
    let code = |path| {
        let model = Model::load(path).unwrap_or_else(|errors| panic!("{errors}"));
        let generated = generate(&model, "table");
        Code {
            source: generated.source(),
            tokens: generated.tokens().to_string(),
            counts: generated.counts().to_vec(),
            model,
        }
    };
    ARMS.get_or_init(|| arms().into_iter().map(code).collect())
}

fn load(arm: &str) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../arms/{arm}.toml"));
    Model::load(path).unwrap_or_else(|errors| panic!("{errors}"))
}

fn of(arm: &str) -> Generated {
    generate(&load(arm), &format!("arms/{arm}.toml"))
}

#[test]
fn the_planar_arm_in_full() {
    insta::assert_snapshot!(of("planar_2r").source());
}

#[test]
fn the_planar_arm_in_c_in_full() {
    let model = load("planar_2r");
    let c = Generator::new().generate_c(&model, "arms/planar_2r.toml", COptions::new());
    let files = c.files();
    let [(header_name, header), (source_name, source)] = files.as_slice() else {
        panic!("{} files", files.len());
    };
    insta::assert_snapshot!(format!(
        "{header_name}\n\n{header}\n{source_name}\n\n{source}"
    ));
}

/// No function is longer than it may be, but for those that call the parts; what is short has no parts, and no length changes anything else.
#[test]
fn functions_of_c_are_as_short_as_is_asked_for() {
    let model = load("ssrms");
    let compiled = Generator::new().compile(&model);
    let of = |length| {
        GeneratedC::of(
            &model,
            "table",
            &compiled,
            COptions::new().function_length(length),
        )
    };
    let (short, whole) = (of(40), of(1_000_000));
    assert_eq!(short.header(), whole.header());
    assert!(!whole.source().contains("_part_1"));
    assert!(short.source().matches("_part_1(").count() > 20);
    let mut parts = 0;
    for function in short.source().split(")\n{\n").skip(1) {
        let (body, _) = function.split_once("\n}\n").expect("an end");
        let calls = body.contains("_part_1(");
        parts += usize::from(!calls);
        assert!(calls || body.matches(';').count() <= 40, "{body}");
    }
    assert!(parts > 100);
}

/// Whatever the scalar, it goes by its name; numbers are of its type.
#[test]
fn single_precision_is_single_throughout() {
    let model = load("stanford_arm");
    let compiled = Generator::new().compile(&model);
    let options = COptions::new().precision(Precision::Float);
    let c = GeneratedC::of(&model, "table", &compiled, options);
    assert!(c.header().contains("typedef float stanford_arm_real;"));
    let is_comment = |line: &str| line.trim_start().starts_with(['*', '/']);
    let code = c.source().lines().filter(|line| !is_comment(line));
    for line in code {
        for word in line
            .replace("e-", "e")
            .split(|c: char| !(c.is_ascii_alphanumeric() || "._".contains(c)))
        {
            let is_number = word.starts_with(|c: char| c.is_ascii_digit()) && word.contains('.');
            assert!(!is_number || word.ends_with('F'), "{line}");
            assert!(!["double", "sin", "cos", "sqrt"].contains(&word), "{line}");
        }
    }
}

#[test]
fn no_name_of_a_file_ends_the_comment_that_it_stands_in() {
    let names = [
        "a\nfn b() {}\n.toml",
        "a\r\nb.toml",
        "a\rb.toml",
        "a\u{85}b\u{2028}c\u{2029}.toml",
        "a\u{202e}b\u{2066}.toml",
        "a\\nb.toml",
        "it's \"\u{e9}\".toml",
    ];
    let model = load("planar_2r");
    let plain = generate(&model, "plain.toml").source();
    let firsts = names.map(|name| {
        let code = generate(&model, name).source();
        let (first, rest) = code.split_once('\n').unwrap();
        assert_eq!(Some(rest), plain.split_once('\n').map(|(_, rest)| rest));
        let (_, name) = first.split_once(" from ").unwrap();
        name.strip_suffix(": do not edit, generate again.")
            .unwrap()
            .to_owned()
    });
    assert_eq!(
        firsts,
        [
            r"a\nfn b() {}\n.toml",
            r"a\r\nb.toml",
            r"a\rb.toml",
            r"a\u{85}b\u{2028}c\u{2029}.toml",
            r"a\u{202e}b\u{2066}.toml",
            r"a\\nb.toml",
            "it's \"\u{e9}\".toml",
        ]
    );
}

#[test]
fn operations_of_every_arm() {
    let mut table = String::new();
    for Code { model, counts, .. } in every_arm() {
        writeln!(table, "{}", model.name()).unwrap();
        for (method, Counts { total, sin_cos, .. }) in counts {
            writeln!(table, "  {method:32}{total:6}{sin_cos:4}").unwrap();
        }
    }
    insta::assert_snapshot!(table);
}

#[test]
fn the_ssrms_needs_few_operations() {
    let generated = of("ssrms");
    let total = |method: &str| {
        let found = generated
            .counts()
            .iter()
            .find(|(counted, _)| counted.name() == method);
        found.map_or(usize::MAX, |(_, counts)| counts.total)
    };
    assert!(total("mass_matrix") <= 280);
    assert!(total("mass_matrix_derivatives") <= 850);
    assert!(total("mass_matrix_and_derivatives") <= 1_000);
    assert!(total("dynamic_manipulability_gradient") <= 1_940);
    assert!(total("geometric_jacobian") <= 130);
}

/// What is not asked for is not there, and what is asked for is the same as in the whole.
#[test]
fn a_choice_of_methods_leaves_out_the_others() {
    let chosen = [Method::InverseDynamics, Method::MassMatrix];
    let generator = Generator::new().methods(&chosen);
    for (arm, most) in [("planar_2r", 120), ("ssrms", 570), ("oblique_6", 1_260)] {
        let model = load(arm);
        let source = generator.generate(&model, "table").source();
        let whole = of(arm).source();
        let kernel = |source: &str, method: Method| {
            let (_, rest) = source.split_once(&format!("fn {}<", method.kernel()))?;
            let (body, _) = rest.split_once("\n    }\n")?;
            Some(body.to_owned())
        };
        let count = |method: &str| source.matches(method).count();
        for method in Method::ALL {
            if chosen.contains(method) {
                let body = kernel(&source, *method);
                assert!(
                    body.is_some() && body == kernel(&whole, *method),
                    "{method}"
                );
            } else {
                assert_eq!(count(method.kernel()), 0, "{arm}: {method}");
                assert!(count(&format!("`{method}`")) > 0, "{arm}: {method}");
            }
        }
        let counted: Vec<Method> = generator
            .generate(&model, "table")
            .counts()
            .iter()
            .map(|(method, _)| *method)
            .collect();
        assert_eq!(counted, [Method::MassMatrix, Method::InverseDynamics]);
        // Comments list what is left out, and are the longer the more methods there are.
        let is_code = |line: &&str| !line.trim_start().starts_with("//");
        let lines = source.lines().filter(is_code).count();
        assert!(lines < most, "{arm}: {lines} lines of code");
    }
}

/// Three quarters, at least, of what is named in kernels says what it is, or of which sum it is a part.
#[test]
fn most_values_have_a_name() {
    for arm in ["planar_2r", "ssrms", "oblique_6"] {
        let source = of(arm).source();
        let assigned = source.lines().filter_map(|line| {
            let (name, _) = line.trim_start().split_once(" = ")?;
            let name = name.strip_prefix("let ").unwrap_or(name);
            let is_name = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            is_name.then_some(name)
        });
        let is_number = |name: &str| {
            let digits = name.strip_prefix('t');
            digits.is_some_and(|digits| digits.parse::<usize>().is_ok())
        };
        let (unnamed, named): (Vec<&str>, Vec<&str>) = assigned.partition(|name| is_number(name));
        assert!(
            3 * unnamed.len() <= named.len(),
            "{arm}: {} and {}",
            unnamed.len(),
            named.len()
        );
    }
}

#[test]
fn same_table_same_bytes() {
    for arm in ["geared_6", "planar_2r", "ssrms", "stanford_arm"] {
        let found = every_arm().iter().find(|code| code.model.name() == arm);
        let again = generate(&load(arm), "table").source();
        assert!(found.expect(arm).source == again, "{arm}");
    }
}

#[test]
fn the_code_keeps_its_promises() {
    for code in every_arm() {
        let (arm, source) = (code.model.name(), &code.source);
        syn::parse_file(source).expect("Rust");
        // The proof is a test, and may end in a panic.
        let (tokens, _) = code.tokens.split_once("# [cfg (test)]").expect("a proof");
        for banned in [
            "unsafe", "allow", "panic", "unwrap", "expect (", "Box", "Vec",
        ] {
            assert!(!tokens.contains(banned), "{arm}: {banned}");
        }
        assert!(source.starts_with("// @generated by ulna"));
        assert!(source.contains(code.model.table_hash()));
        let shallow = source.matches("let ").count();
        assert!(shallow < 2_000, "{arm}: {shallow} scopes");
    }
}

/// An arm of `joints` revolute joints with oblique twists and full tensors: as little folds as can be.
fn oblique(joints: usize) -> Model {
    let mut table = String::from(
        "name = \"long_arm\"\nconvention = \"modified\"\nangle_unit = \"deg\"\n[task]\nrows = \"position\"\n",
    );
    for i in 0..joints {
        writeln!(
            table,
            "[[joint]]\ntheta = 10.0\nd = 0.1\na = 0.2\nalpha = {}.0\n[joint.link]\nmass = 2.0\n\
             com = [0.1, 0.02, 0.03]\ninertia = {{ xx = 0.02, yy = 0.03, zz = 0.025, xy = 0.001, xz = 0.002, yz = 0.003 }}",
            20 + i
        )
        .unwrap();
    }
    Model::parse(&table, "long").unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn long_programs_stay_shallow() {
    let source = generate(&oblique(10), "long").source();
    let deepest = source
        .split("fn ")
        .map(|function| function.matches("let ").count())
        .max();
    assert!(source.lines().count() > 10_000);
    assert!(deepest < Some(300), "{deepest:?} scopes in one function");
}
