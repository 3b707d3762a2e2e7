//! Random arms: everything that a table may hold, in all its combinations, against the textbook.
//!
//! `cargo test --test random_arms` takes a few dozen arms, always the same ones. A failure prints the smallest table that
//! still fails in the same way. Environment variables make more of it (`--release` is several times faster):
//!
//! | variable | |
//! |---|---|
//! | `ULNA_RANDOM_ARMS=2000` | takes so many arms, and prints a summary with the hundred worst (`-- --nocapture`) |
//! | `ULNA_RANDOM_ARMS_SEED=1` | takes others |
//! | `ULNA_RANDOM_ARMS_RECORD=arms.jsonl` | writes w_D and ∇w_D at twenty configurations of each for `tests/oracle/judge_random_arms.py` |

mod arms;
mod bodies;
mod campaign;
mod caught;
mod condition;
mod examination;
mod geometry;
mod judge;
mod minimal;
mod record;
mod summary;
mod table;
mod totality;

use ulna_table::Model;
use ulna_table::diagnostics::{Diagnostics, Severity};

use arms::{arm, tree};

/// Random tables are read, or refused with the place of what is wrong; and few are refused.
#[test]
fn every_table_is_read_or_refused_in_its_place() {
    const TABLES: u64 = 500;
    let mut refused = 0;
    for index in 0..TABLES {
        let text = tree(&arm(), 0, index).current().table.to_string();
        if let Err(errors) = Model::parse(&text, "random.toml") {
            assert!(is_located(&errors), "{errors}\n\n{text}");
            refused += 1;
        }
    }
    assert!(refused < TABLES / 5, "{refused} of {TABLES} are refused");
}

fn is_located(errors: &Diagnostics) -> bool {
    let mut list = errors.list().iter();
    errors.has_errors()
        && list.all(|found| found.severity == Severity::Warning || found.position.is_some())
}

#[test]
fn the_same_seed_gives_the_same_tables() {
    let texts = |seed| [0, 1, 2].map(|index| tree(&arm(), seed, index).current().table.to_string());
    assert_eq!(texts(7), texts(7));
    assert_ne!(texts(7), texts(8));
}

#[test]
fn programs_do_what_the_textbook_does() {
    campaign::run(&campaign::Settings::from_environment());
}
