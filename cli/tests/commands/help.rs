//! `--help`: the examples in it work. That of `reproduce` is in its own tests.

use std::fs;

use crate::support::{examples, root, ulna};

#[test]
fn every_example_works() {
    // What an older version of the program has left there, this one would not go on with.
    let campaign = root().join("target/campaign");
    if campaign.exists() {
        fs::remove_dir_all(campaign).unwrap();
    }
    for command in ["", "check", "generate", "verify", "cost", "campaign"] {
        let examples = examples(command);
        assert!(!examples.is_empty(), "{command}");
        for example in examples {
            assert!(example.starts_with(command), "{example}");
            ulna(&example.split(' ').collect::<Vec<_>>()).code(0);
        }
    }
}
