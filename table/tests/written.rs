//! Tables for people, written by a program.

use ulna_table::{AngleUnit, Model};

fn arms() -> impl Iterator<Item = Model> {
    let tables = std::fs::read_dir("../arms").unwrap();
    let paths = tables.map(|entry| entry.unwrap().path());
    let tables = paths.filter(|path| path.extension().is_some_and(|end| end == "toml"));
    tables.map(|path| Model::load(path).unwrap())
}

/// Every row comes back as it was; placements but for rounding.
#[test]
fn every_arm_comes_back_from_its_table_in_either_unit() {
    for arm in arms() {
        for unit in [AngleUnit::Degrees, AngleUnit::Radians] {
            let text = arm.description().to_table(unit).to_string();
            let again = Model::parse(&text, "again.toml").unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(again.joints(), arm.joints(), "{}", arm.name());
            assert_eq!(again.joint_names(), arm.joint_names());
            assert_eq!((again.task(), again.gravity()), (arm.task(), arm.gravity()));
            assert_eq!(again.has_payload(), arm.has_payload());
            assert_eq!(again.angle_unit(), unit);
            for (again, arm) in [(again.base(), arm.base()), (again.tool(), arm.tool())] {
                assert_eq!(again.translation, arm.translation);
                let off = |i: usize, j: usize| again.rotation[i][j] - arm.rotation[i][j];
                for i in 0..3 {
                    assert!((0..3).all(|j| off(i, j).abs() < 4e-15));
                }
            }
        }
    }
}

#[test]
fn a_table_is_written_as_people_write_them() {
    let mut arm = Model::load("../arms/geared_6.toml").unwrap().description();
    arm.joints.truncate(2);
    arm.joint_names.truncate(2);
    arm.task = ulna::TaskRows::new(&[ulna::TaskRow::Z]);
    let text = arm
        .to_table(AngleUnit::Degrees)
        .heading("Two joints of it.\n\nMore in geared_6.toml.\u{7}")
        .joint_remarks(&["turns\nrows = []".to_owned()]);
    insta::assert_snapshot!(text.to_string());
    Model::parse(&text.to_string(), "written.toml").unwrap();
}
