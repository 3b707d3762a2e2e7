//! Links that are too light for what their joints carry.

use crate::diagnostics::Diagnostic;
use crate::table::JointTable;
use crate::toml_reader::Located;
use ulna::internal::bounds::Share;
use ulna::{Joint, JointKind};

/// Where a link's mass and inertia are written.
pub(super) struct Weight {
    mass: Option<Located<()>>,
    inertia: Option<Located<()>>,
}

/// The places of a row's mass and inertia.
pub(super) fn weight_of(row: &JointTable) -> Weight {
    let link = row.link.as_ref();
    Weight {
        mass: link.and_then(|link| link.mass.as_ref()).map(Located::place),
        inertia: link
            .and_then(|link| link.inertia.as_ref())
            .map(Located::place),
    }
}

/// An error for each link that has less than its [least share](Share::least) of what its joint carries at its greatest distance:
/// in M it would drown in rounding, and M would not be positive definite any more.
pub(super) fn light_links(joints: &[Joint], weights: Vec<Weight>) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    for (index, weight) in weights.into_iter().enumerate() {
        let Some(joint) = joints.get(index) else {
            continue;
        };
        let share = Share::of(joints, index);
        if share.is_enough() {
            continue;
        }
        let (Share { own, carried }, least) = (share, share.least());
        let (place, unit, what) = match joint.kind {
            JointKind::Revolute => (
                weight.inertia,
                "kg m^2 about the joint's axis",
                "a rotor's inertia counts",
            ),
            JointKind::Prismatic => (weight.mass, "kg", "the motor counts"),
        };
        if let Some(Located { span, name, .. }) = place {
            let message = format!(
                "{name} drowns in the rounding of what joint {} carries",
                index + 1
            );
            errors.push(
                Diagnostic::error(span, message)
                    .label(format!("{own:.1e} {unit}, beside up to {carried:.1e}"))
                    .help(format!(
                        "write what the link really has ({what}), at least {least:.1e} {unit}, \
                         or leave the joint out and count its link with the next"
                    )),
            );
        }
    }
    errors
}
