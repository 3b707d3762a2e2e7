//! What rows are of one campaign: those that are the same bits.

use std::path::Path;

use ulna::Instructions;
use ulna_campaign::{Campaign, Row};
use ulna_experiments::{CompiledFor, Copies, Subject, by_table};
use ulna_study::Scenario;
use ulna_study::scenario::ScenarioArm;

const CASES: u64 = 3;

fn scenario() -> Scenario {
    let text = include_str!("../../scenarios/paper_like.toml");
    let text = text.replacen("arm = \"ssrms\"", "arm = \"ssrms.toml\"", 1);
    Scenario::parse(&text, "paper_like.toml", Path::new("../arms"), &[]).unwrap()
}

fn rows(campaign: &Campaign<'_>) -> Vec<Row> {
    (0..CASES).map(|index| campaign.row(index)).collect()
}

/// One test, because the instructions are those of the whole process.
#[test]
fn rows_of_one_identity_are_the_same_bits_and_others_may_not_be() {
    let scenario = scenario();
    let ScenarioArm::Table { model, .. } = scenario.arm() else {
        panic!("{:?}", scenario.arm());
    };
    let made_now = || by_table(model).unwrap().subject;
    let own = made_now();
    let own = Campaign::new(&*own, &scenario).unwrap();
    let expected = rows(&own);

    // Compiled by rustc.
    let compiled: Box<dyn Subject> = Copies::subject(
        Box::new(ulna_generated::Ssrms),
        ulna_generated::Ssrms::CHAIN,
    );
    let compiled = Campaign::new(&*compiled, &scenario).unwrap();
    assert_eq!(compiled.identity(), own.identity());
    assert!(rows(&compiled) == expected);

    // The textbook.
    let book = Copies::textbook(ulna_generated::Ssrms::CHAIN);
    let book = Campaign::new(&*book, &scenario).unwrap();
    let difference = own.identity().difference(book.identity()).unwrap();
    assert!(difference.contains("textbook"), "{difference}");
    assert!(rows(&book) != expected);

    // A machine without fused multiply-adds.
    if Instructions::of_machine() == Instructions::Compiled {
        eprintln!("this machine has one kind of arithmetic");
        return;
    }
    Instructions::Compiled.limit();
    let plain = made_now();
    let plain = Campaign::new(&*plain, &scenario).unwrap();
    let difference = own.identity().difference(plain.identity()).unwrap();
    assert!(
        difference.contains("(plain multiply-adds, ") && difference.contains("not fused"),
        "{difference}"
    );
    assert!(rows(&plain) != expected);
    assert!(
        rows(&compiled) == rows(&plain),
        "compiled code does as well"
    );
}
