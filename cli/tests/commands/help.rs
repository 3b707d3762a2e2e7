//! `--help`, `help`, `--version`, `completions` and `man`: what they print is right, and the examples in it work.
//! That of `reproduce` is in its own tests.

use std::fs;

use crate::support::{examples, root, stderr, stdout, ulna};

#[test]
fn every_example_works() {
    // What an older version of the program has left there, this one would not go on with.
    for name in ["campaign", "shards"] {
        let folder = root().join("target").join(name);
        if folder.exists() {
            fs::remove_dir_all(folder).unwrap();
        }
    }
    for command in [
        "",
        "check",
        "generate",
        "import",
        "verify",
        "cost",
        "campaign",
        "merge",
        "help",
        "completions",
        "man",
    ] {
        let examples = examples(command);
        assert!(!examples.is_empty(), "{command}");
        for example in examples {
            assert!(example.starts_with(command), "{example}");
            ulna(&example.split(' ').collect::<Vec<_>>()).code(0);
        }
    }
}

#[test]
fn the_version_is_that_of_ulna() {
    let version = concat!("ulna ", env!("CARGO_PKG_VERSION"), "\n");
    ulna(&["--version"]).code(0).stdout(version).stderr("");
}

#[test]
fn help_shows_the_formats_of_the_files() {
    for topic in ["table", "scenario"] {
        let checked_in = fs::read_to_string(root().join(format!("docs/{topic}.md"))).unwrap();
        ulna(&["help", topic]).code(0).stdout(checked_in).stderr("");
    }
}

#[test]
fn help_shows_commands_as_they_do_themselves() {
    let program = stdout(&ulna(&["help"]).code(0).stderr(""));
    assert_eq!(program, stdout(&ulna(&["--help"])));
    for command in ["check", "help", "man"] {
        let help = stdout(&ulna(&["help", command]).code(0).stderr(""));
        assert_eq!(help, stdout(&ulna(&[command, "--help"])), "{command}");
        assert!(help.contains(&format!("Usage: ulna {command}")), "{help}");
    }
}

#[test]
fn what_there_is_no_help_on_is_a_wrong_command_line() {
    for command in ["help", "man"] {
        let err = stderr(&ulna(&[command, "chekc"]).code(2).stdout(""));
        assert!(err.contains("did you mean 'check'?"), "{err}");
        let err = stderr(&ulna(&[command, "x\u{1b}y"]).code(2).stdout(""));
        assert!(
            err.contains("write one of reproduce, ") && !err.contains('\u{1b}'),
            "{err}"
        );
    }
    ulna(&["completions", "sh"]).code(2).stdout("");
}

#[test]
fn completions_and_manual_know_every_command() {
    let help = stdout(&ulna(&["--help"]));
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let commands = commands.lines().take_while(|line| !line.is_empty());
    let named = commands.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let named: Vec<_> = named.filter(|name| !name.is_empty()).collect();
    assert!(named.len() > 7, "{named:?}");
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = stdout(&ulna(&["completions", shell]).code(0).stderr(""));
        for name in &named {
            assert!(script.contains(name), "{shell} does not know {name}");
        }
    }
    let manual = stdout(&ulna(&["man"]).code(0).stderr(""));
    for name in named {
        assert!(manual.contains(&format!("ulna\\-{name}(1)")), "{name}");
        let page = stdout(&ulna(&["man", name]).code(0).stderr(""));
        assert!(page.contains(&format!("ulna\\-{name} ")), "{page}");
    }
}
