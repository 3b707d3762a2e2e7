//! Masses in grams, or of tonnes where they cannot be.

use super::short;
use super::subject::Subject;
use crate::diagnostics::Diagnostic;

/// Osmium, kg/m^3: nothing that arms are made of is denser.
const DENSEST: f64 = 22_600.0;
/// Lighter links may be idealized: a thin rod, a point.
const LEAST_DENSE_LINK: f64 = 100.0;
/// An arm of a tonne...
const LEAST_ARM: f64 = 1_000.0;
/// ... with more than that for each cubic metre of its length cubed, kg/m^3: a block of two thirds concrete. Industrial arms have 20 to 200.
const SOLID: f64 = 2_000.0;

/// A warning for each link that would be denser than osmium; or one, at the heaviest, if the arm as a whole is too heavy for its length.
pub(super) fn find(arm: &Subject<'_>) -> Vec<Diagnostic> {
    const HELP: &str = "masses are in kilograms: if this is in grams, write a thousandth";
    let dense = arm
        .links
        .iter()
        .filter(|link| link.body.mass >= LEAST_DENSE_LINK && link.body.density() > DENSEST);
    let mut found: Vec<Diagnostic> = dense
        .map(|link| {
            let message = format!("the link of {} would be denser than any metal", link.joint);
            let density = short(link.body.density());
            let label =
                format!("{density} kg/m^3 in the ellipsoid of that inertia, osmium has 2.26e4");
            Diagnostic::warning(link.places.mass.clone(), message)
                .label(label)
                .help(HELP)
        })
        .collect();
    let mass: f64 = arm.links.iter().map(|link| link.body.mass).sum();
    let cube = arm.span.powi(3);
    let heaviest = arm
        .links
        .iter()
        .max_by(|a, b| a.body.mass.total_cmp(&b.body.mass));
    if let Some(link) = heaviest
        && found.is_empty()
        && mass > LEAST_ARM
        && cube > 0.0
        && mass > SOLID * cube
    {
        let message = format!(
            "{} kg move in an arm that is {} m long",
            short(mass),
            short(arm.span)
        );
        let label = format!("{} kg of them", short(link.body.mass));
        let place = link.places.mass.clone();
        found.push(Diagnostic::warning(place, message).label(label).help(HELP));
    }
    found
}
