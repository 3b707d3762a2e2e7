//! What is compared with what, and how far apart they may be. The only file that knows.

use ulna::proof::{State, compare};
use ulna::{Arm as _, SerialChain};
use ulna_codegen::Interpreter;

const ABOUT_W: [&str; 3] = [
    "dynamic_manipulability",
    "dynamic_manipulability_gradient",
    "jacobian_and_gradient",
];

/// How far one method of the generated programs is from the reference at a state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judgement {
    pub(crate) method: &'static str,
    /// The relative error.
    pub(crate) error: f64,
    /// What rounding may leave of it.
    pub(crate) allowed: f64,
}

impl Judgement {
    /// Whether the error is allowed; a NaN is not.
    pub(crate) fn passes(&self) -> bool {
        self.error <= self.allowed
    }

    /// The error, in what is allowed; infinite for what is no number.
    pub(crate) fn excess(&self) -> f64 {
        if self.passes() && self.allowed == 0.0 {
            0.0
        } else if self.error.is_nan() {
            f64::INFINITY
        } else {
            self.error / self.allowed
        }
    }
}

/// Every method of the programs beside the textbook's, at one state. Where one of them takes w_D for 0 and the other does not,
/// that is all there is to say about w_D.
pub(crate) fn judge<const N: usize>(
    programs: &Interpreter<N>,
    chain: &SerialChain<N>,
    state: State<N>,
) -> Vec<Judgement> {
    let report = compare(programs, chain, [state]);
    let judgements = report.deviations.iter().map(|deviation| Judgement {
        method: deviation.method,
        error: deviation.error,
        allowed: deviation.tolerance,
    });
    let mut judgements: Vec<_> = judgements.collect();
    let w = [
        programs.dynamic_manipulability(&state.q),
        chain.dynamic_manipulability(&state.q),
    ];
    let rule = match w.map(|w| w == 0.0) {
        [true, false] => "w_D is 0, the textbook's is not",
        [false, true] => "w_D is not 0, the textbook's is",
        _ => return judgements,
    };
    judgements.retain(|judgement| !ABOUT_W.contains(&judgement.method));
    judgements.push(Judgement {
        method: rule,
        error: 1.0,
        allowed: 0.0,
    });
    judgements
}
