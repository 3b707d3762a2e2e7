//! The tables of `arms/`: what is read from them.

use std::f64::consts::{FRAC_PI_2, PI};

use ulna::{Angle, JointKind, TaskRow, TaskRows};
use ulna_table::Model;
use ulna_table::diagnostics::Diagnostics;

fn arm(name: &str) -> Model {
    Model::load(format!("../arms/{name}.toml")).unwrap()
}

fn quarter_turns(turns: &[i32]) -> Vec<Angle> {
    let angle = |quarters: &i32| Angle::from_radians(f64::from(*quarters) * FRAC_PI_2);
    turns.iter().map(angle).collect()
}

/// But for those of inertias that a table takes over as published.
#[test]
fn every_table_is_named_after_its_file_and_has_no_warning() {
    let mut count = 0;
    let tables = std::fs::read_dir("../arms").unwrap();
    let paths = tables.map(|entry| entry.unwrap().path());
    for path in paths.filter(|path| path.extension().is_some_and(|end| end == "toml")) {
        let (model, warnings): (Model, Diagnostics) = Model::lint(&path).unwrap();
        assert_eq!(Some(model.name()), path.file_stem().unwrap().to_str());
        let accepted = model.accepts_inertia().iter().filter(|accepted| **accepted);
        assert_eq!(warnings.list().len(), accepted.count(), "{warnings}");
        count += 1;
    }
    assert!(count >= 12);
}

#[test]
fn ssrms_is_table_1_shifted_by_one_row() {
    let ssrms = arm("ssrms");
    let literal = arm("table1_literal");
    assert_eq!(ssrms.type_name(), "Ssrms");
    assert_eq!(ssrms.task(), TaskRows::POSITION);
    let twists: Vec<_> = ssrms.joints().iter().map(|joint| joint.alpha).collect();
    assert_eq!(twists, quarter_turns(&[0, 1, -1, 0, 0, 1, -1]));
    let angles: Vec<_> = ssrms.joints().iter().map(|joint| joint.theta).collect();
    assert_eq!(angles, quarter_turns(&[0, 1, 0, 0, 0, -1, 0]));
    for (shifted, printed) in ssrms.joints()[1..].iter().zip(literal.joints()) {
        assert_eq!((shifted.a, shifted.alpha), (printed.a, printed.alpha));
    }
    for (shifted, printed) in ssrms.joints().iter().zip(literal.joints()) {
        assert_eq!(shifted.link, printed.link);
        assert_eq!((shifted.d, shifted.theta), (printed.d, printed.theta));
        assert_eq!(shifted.rated_torque, Some(300.0));
    }
    assert_eq!(
        ssrms
            .joints()
            .iter()
            .map(|joint| joint.link.mass)
            .sum::<f64>(),
        352.5
    );
}

#[test]
fn planar_2r_has_a_uniform_rods_inertia() {
    let arm = arm("planar_2r");
    assert_eq!(arm.task(), TaskRows::new(&[TaskRow::X, TaskRow::Y]));
    assert_eq!(arm.gravity(), [0.0, -9.81, 0.0]);
    let radius: f64 = 0.025;
    for joint in arm.joints() {
        let [[xx, ..], [_, yy, _], [.., zz]] = joint.link.inertia;
        approx::assert_relative_eq!(xx, radius.powi(2) / 2.0, epsilon = 1e-15);
        approx::assert_relative_eq!(yy, (3.0 * radius.powi(2) + 1.0) / 12.0, epsilon = 1e-15);
        assert_eq!(yy, zz);
    }
}

#[test]
fn oblique_6_comes_out_in_modified_form() {
    let arm = arm("oblique_6");
    assert_eq!((arm.joints().len(), arm.task().len()), (6, 5));
    assert_eq!(arm.joints()[2].kind, JointKind::Prismatic);
    // Row i's a and alpha stand in row i+1.
    let rows: Vec<_> = arm
        .joints()
        .iter()
        .map(|joint| (joint.a, joint.alpha.radians))
        .collect();
    let own = [
        (0.12, -75.0),
        (0.65, 20.0),
        (0.05, -65.0),
        (0.28, 50.0),
        (0.04, -80.0),
    ];
    assert_eq!(rows[0], (0.0, 0.0));
    assert_eq!(
        rows[1..],
        own.map(|(a, alpha): (f64, f64)| (a, alpha.to_radians()))
    );
    let rated: Vec<_> = arm
        .joints()
        .iter()
        .map(|joint| joint.rated_torque.is_some())
        .collect();
    assert_eq!(rated, [true, true, true, true, false, false]);
    for joint in arm.joints() {
        let tensor = joint.link.inertia;
        assert!((0..3).all(|i| (0..3).all(|j| tensor[i][j] == tensor[j][i])));
    }
}

#[test]
fn quarter_turns_in_radians_are_exact_too() {
    let text = std::fs::read_to_string("../arms/ssrms.toml").unwrap();
    let radians = text
        .replace("\"deg\"", "\"rad\"")
        .replace("-90.0", &(-FRAC_PI_2).to_string())
        .replace("90.0", &FRAC_PI_2.to_string());
    let radians = Model::parse(&radians, "ssrms.toml").unwrap();
    assert_eq!(radians.joints(), arm("ssrms").joints());
}

#[test]
fn base_and_tool_turn_by_fixed_axes_roll_first() {
    let text = std::fs::read_to_string("../arms/planar_2r.toml").unwrap();
    let text = text.replace("[tool]", "[base]\nrpy = [90.0, 0.0, 90.0]\n\n[tool]");
    let model = Model::parse(&text, "a.toml").unwrap();
    // Rz(90) Rx(90): x to y, y to z, z to x.
    assert_eq!(
        model.base().rotation,
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    );
    assert_eq!(model.base().translation, [0.0; 3]);
    assert_eq!(model.tool().translation, [1.0, 0.0, 0.0]);
}

#[test]
fn hash_is_the_sha256_of_the_text() {
    let model = arm("planar_2r");
    assert_eq!(model.table_hash().len(), 64);
    let text = std::fs::read_to_string("../arms/planar_2r.toml").unwrap();
    let other = Model::parse(&format!("{text}#"), "a.toml").unwrap();
    assert_ne!(model.table_hash(), other.table_hash());
    assert_eq!(Model::parse(&text, "b.toml").unwrap(), model);
}

#[test]
fn sines_and_cosines_of_half_turns_are_exact() {
    assert_eq!(Angle::from_radians(PI).sin_cos(), (0.0, -1.0));
    assert_eq!(Angle::from_radians(-FRAC_PI_2).sin_cos(), (-1.0, 0.0));
    assert_eq!(Angle::from_radians(2.0 * PI).quarter_turns(), (4, 0.0));
    let (sin, cos) = Angle::from_radians(1.57).sin_cos();
    assert!(sin < 1.0 && cos != 0.0);
}
