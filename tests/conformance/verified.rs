//! What `ulna verify` asks of a table, at fewer states.

use ulna::SerialChain;
use ulna::proof::{self, Report, differences};
use ulna_codegen::Interpreter;

/// `ulna verify` takes a hundred unless it is told otherwise.
const STATES: usize = 6;

/// The programs against themselves in 106 bits, the textbook against that, and derivatives against differences.
pub(crate) fn passes<const N: usize>(
    programs: &Interpreter<N>,
    chain: &SerialChain<N>,
    has_payload: bool,
) {
    let (mut programs, mut chain) = (programs.clone(), *chain);
    if has_payload {
        let payload = proof::payload(&chain);
        programs = programs.carrying(&payload);
        chain = chain.carrying(&payload);
    }
    let exact = programs.exact();
    let states = || proof::states(&chain).take(STATES);
    let pass = |what: &str, report: &Report| assert!(report.passes(), "{what}\n{report}");
    let emitted = proof::compare_with(&programs, &exact, &chain, states());
    pass("the programs", &emitted);
    let textbook = proof::compare_with(&chain, &exact, &chain, states());
    pass("the textbook", &textbook);
    let slopes = differences::compare(&programs, &chain, states());
    pass("derivatives beside differences", &slopes);
}
