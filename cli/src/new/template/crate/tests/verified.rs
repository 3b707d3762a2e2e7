//! The arm's code against the textbook's formulas, and its derivatives against differences. What is allowed is what rounding explains.

use ulna::{Unrolled, proof};

use my_crate::arm;

#[test]
fn the_code_agrees_with_the_textbook_at_random_states() {
    let chain = arm().chain();
    let states = proof::states(&chain).take(50);
    let report = proof::compare(&arm(), &chain, states);
    println!("{report}");
    assert!(report.passes(), "{report}");
}

#[test]
fn derivatives_agree_with_differences() {
    let chain = arm().chain();
    let states = proof::states(&chain).take(10);
    let report = proof::differences::compare(&arm(), &chain, states);
    println!("{report}");
    assert!(report.passes(), "{report}");
}
