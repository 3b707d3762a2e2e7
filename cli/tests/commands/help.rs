//! `--help`: the examples in it work.

use crate::support::{stdout, ulna};

/// The lines of the help of `command` that show how it is called.
fn examples(command: &str) -> Vec<String> {
    let help = stdout(&ulna(&[command, "--help"]).code(0).stderr(""));
    let (_, examples) = help
        .split_once("Example")
        .unwrap_or_else(|| panic!("no example:\n{help}"));
    let calls = examples
        .lines()
        .filter_map(|line| line.trim().strip_prefix("ulna "));
    calls.map(str::to_owned).collect()
}

#[test]
fn every_example_of_a_quick_command_works() {
    for command in ["check", "generate", "verify", "cost", "campaign"] {
        let examples = examples(command);
        assert!(!examples.is_empty(), "{command}");
        for example in examples {
            assert!(example.starts_with(command), "{example}");
            ulna(&example.split(' ').collect::<Vec<_>>()).code(0);
        }
    }
}

/// A scenario takes its time without optimization: its example runs beside the others.
#[test]
fn the_example_of_reproduce_works() {
    for example in examples("reproduce") {
        ulna(&example.split(' ').collect::<Vec<_>>()).code(0);
    }
}
