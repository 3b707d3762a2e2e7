//! States one after another, compared side by side: what of a comparison does not depend on the number of joints.

use rayon::prelude::*;

use crate::Verified;

/// So many states are held at a time.
const BATCH: usize = 64;

/// An arm at random states, drawn some at a time.
pub(crate) trait States: Sync + Send {
    /// Draws the next states, in the place of those before.
    fn draw(&mut self, count: usize);

    /// What is found at one of the states drawn.
    fn at(&self, index: usize) -> Verified;

    /// What is found before the first state.
    fn nowhere(&self) -> Verified;
}

/// What is found at the next `samples` states. The same on any number of threads: reports are put together in the states' order.
pub(crate) fn all(states: &mut dyn States, samples: usize, each: &(dyn Fn() + Sync)) -> Verified {
    let mut found = states.nowhere();
    let mut left = samples;
    while left > 0 {
        let count = left.min(BATCH);
        states.draw(count);
        let drawn = &*states;
        let at = |index| {
            let verified = drawn.at(index);
            each();
            verified
        };
        let batch: Vec<Verified> = (0..count).into_par_iter().map(at).collect();
        found = batch.iter().fold(found, Verified::and);
        left -= count;
    }
    found
}
