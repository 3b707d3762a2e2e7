//! Scenarios whose arm is a table: the program was not compiled with it, and makes its code when it runs.

use std::fs;

use tempfile::TempDir;

use crate::support::{folder_with_my_arm, short_scenario, stderr, ulna};

/// What is said of an arm that runs by the textbook, because its machine has no code.
pub(crate) const TOLD: &str = "runs by the textbook formulas";

/// What a campaign of a short motion of `arm` writes: its rows, and what it says. `my_arm.toml` is the table of planar_2r.
fn campaign(arm: &str) -> (TempDir, String, String) {
    let folder = folder_with_my_arm();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (scenario, output) = (path("short.toml"), path("out"));
    fs::write(&scenario, short_scenario(arm, "[10, 60]", "[40, 20]")).unwrap();
    let run = ulna(&["campaign", &scenario, "--output", &output, "--cases", "40"]);
    let told = stderr(&run.code(0));
    let rows = fs::read_to_string(folder.path().join("out/campaign.csv")).unwrap();
    (folder, rows, told)
}

#[test]
fn an_arm_of_a_table_is_machine_code_and_its_numbers_are_those_of_the_compiled_arm() {
    let (_own_folder, own, told) = campaign("my_arm.toml");
    assert!(!told.contains(TOLD), "{told}");
    let (_folder, compiled, _) = campaign("planar_2r");
    assert_eq!(own.lines().count(), 41, "{own}");
    assert_eq!(own.lines().next(), compiled.lines().next());
    let cells = |rows: &str| -> Vec<String> {
        let cells = rows.lines().skip(1).flat_map(|row| row.split(','));
        cells.map(str::to_owned).collect()
    };
    let (own, compiled) = (cells(&own), cells(&compiled));
    assert_eq!(own.len(), compiled.len());
    let mut numbers = 0;
    for (own, compiled) in own.iter().zip(&compiled) {
        match (own.parse::<f64>(), compiled.parse::<f64>()) {
            (Ok(own), Ok(compiled)) => {
                numbers += 1;
                let rounding = 1e-9 * (1.0 + compiled.abs());
                assert!((own - compiled).abs() <= rounding, "{own} {compiled}");
            }
            _ => assert_eq!(own, compiled),
        }
    }
    assert!(numbers > 200, "{numbers}");
}
