//! The smallest table that fails in the same way.

use std::time::{Duration, Instant};

use proptest::strategy::ValueTree;

use super::arms::Arm;
use super::examination::{Failure, Outcome, examine};

/// What a failure may cost; what has been reached by then is small enough to read.
const TIME: Duration = Duration::from_secs(20);

/// A table and all that fails of it.
pub(crate) struct Minimal {
    pub(crate) arm: Arm,
    pub(crate) failures: Vec<Failure>,
}

impl Minimal {
    pub(crate) fn failure(&self, kind: &str) -> Option<&Failure> {
        self.failures.iter().find(|failure| failure.kind == kind)
    }
}

/// Shrinks the arm of `tree`, which has a failure of this `kind`, as long as it keeps one.
pub(crate) fn minimal(mut tree: Box<dyn ValueTree<Value = Arm>>, kind: &str) -> Option<Minimal> {
    let start = Instant::now();
    let mut smallest = None;
    loop {
        let candidate = failing(tree.current());
        let moved = if candidate.failure(kind).is_some() {
            smallest = Some(candidate);
            tree.simplify()
        } else {
            tree.complicate()
        };
        if !moved || start.elapsed() > TIME {
            return smallest;
        }
    }
}

fn failing(arm: Arm) -> Minimal {
    let failures = match examine(&arm, 0) {
        Outcome::Refused => Vec::new(),
        Outcome::Examined(examination) => examination.failures,
    };
    Minimal { arm, failures }
}
