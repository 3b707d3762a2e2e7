//! What can be done with an arm without a scenario: plan a motion, look at a lock in it, control it, simulate it.

pub(crate) mod control;
pub(crate) mod impact;
pub(crate) mod operation;
pub(crate) mod plan;
pub(crate) mod simulation;
