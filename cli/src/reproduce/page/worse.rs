//! Who pays: a norm says nothing about a joint.

use std::fmt::{self, Write};

use ulna_study::experiment::{SearchMethod, Study};

use crate::reproduce::worse::lines;

const METHODS: [(SearchMethod, &str); 3] = [
    (SearchMethod::PerJoint, "Eq. 16"),
    (SearchMethod::Projected, "Eq. 20"),
    (SearchMethod::Optimal, "optimal"),
];

/// The joints that end worse off, lock by lock, and what is proven of them.
pub(super) fn write(page: &mut String, studies: &[&Study]) -> fmt::Result {
    writeln!(
        page,
        "**Who pays.** A norm can shrink while a joint's own step grows; the joints that lock leave theirs to their brakes.\n"
    )?;
    for study in studies {
        let lines = lines(study, &METHODS).join("; ");
        writeln!(page, "- Lock at {} s: {lines}.", study.failure_time)?;
    }
    writeln!(page)
}
