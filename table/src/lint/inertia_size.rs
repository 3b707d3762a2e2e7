//! Inertias of the wrong order: in other units than kg m^2.

use super::short;
use super::subject::{LinkSubject, Subject};
use crate::diagnostics::Diagnostic;

/// So far a link's mass may lie from its centroid, in what the link and half the arm's longest reach from there.
const FARTHEST: f64 = 1.25;
/// So near it must lie at least, in the length of its link.
const NEAREST: f64 = 1.0 / 125.0;
/// Units that inertias are found in, and what one of them is, kg m^2.
const UNITS: [(&str, f64); 4] = [
    ("kg cm^2", 1e-4),
    ("kg mm^2", 1e-6),
    ("g cm^2", 1e-7),
    ("g mm^2", 1e-9),
];
/// In a unit that is meant the mass lies within this part of the link's size from the centroid.
const USUAL: std::ops::RangeInclusive<f64> = 0.06..=0.6;

/// A warning for each link whose mass would lie farther out than the link.
pub(super) fn large(arm: &Subject<'_>) -> Vec<Diagnostic> {
    let certain = arm.links.iter().filter(|link| link.extent.is_certain);
    let found = certain.filter_map(|link| {
        let body = &link.body;
        let size = link.extent.farthest(body.com) + 0.5 * arm.longest;
        // An arm without lengths says nothing of its size.
        if arm.longest == 0.0 || body.half_spread() <= FARTHEST * size {
            return None;
        }
        let message = format!(
            "the inertia of {} is that of a larger body than the link",
            link.joint
        );
        let about = size_of(arm, link);
        let unit = UNITS
            .iter()
            .filter(|(_, unit)| USUAL.contains(&(body.half_spread() * unit.sqrt() / about)));
        let units: Vec<_> = unit
            .map(|(name, unit)| format!("{name} (1 is {unit:e} kg m^2)"))
            .collect();
        let help = if units.is_empty() {
            "write the tensor in kg m^2, about the centroid".to_owned()
        } else {
            format!(
                "write kg m^2; as a body of its size it would be in {}",
                units.join(" or ")
            )
        };
        let beside = "where the link and half the arm's longest reach";
        Some(at(link, message, beside, size).help(help))
    });
    found.collect()
}

/// A warning for each link whose mass would lie in a point of it.
pub(super) fn small(arm: &Subject<'_>) -> Vec<Diagnostic> {
    let certain = arm.links.iter().filter(|link| link.extent.is_certain);
    let found = certain.filter_map(|link| {
        let size = size_of(arm, link);
        if link.body.half_spread() >= NEAREST * size {
            return None;
        }
        let message = format!(
            "the inertia of {} is that of a point beside the link",
            link.joint
        );
        Some(
            at(link, message, "in a link of", size)
                .help("write the tensor in kg m^2, about the centroid"),
        )
    });
    found.collect()
}

/// A link's size, m: its length, or a tenth of the arm's where the link is short.
fn size_of(arm: &Subject<'_>, link: &LinkSubject<'_>) -> f64 {
    link.extent.length.max(0.1 * arm.span)
}

fn at(link: &LinkSubject<'_>, message: String, beside: &str, size: f64) -> Diagnostic {
    let gyration = short(link.body.gyration());
    let label = format!(
        "radius of gyration sqrt(I / m) is {gyration} m, {beside} {} m",
        short(size)
    );
    Diagnostic::warning(link.places.inertia.clone(), message).label(label)
}
