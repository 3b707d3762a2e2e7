//! Inertias about the frame's origin where those about the centroid belong.
//!
//! Such a tensor is I_C + m (c² 1 − c cᵀ) (Steiner), its second moments S_C + m c cᵀ. So cᵀ S⁻¹ c, the distance of the origin
//! from the centroid in the body's own spreads squared, is below 1 for every link, whatever the body; and as given the body is
//! longer than it is. Links of true tables are on either side of 1: four fifths of those in public descriptions beyond it.

use nalgebra::Matrix3;

use super::short;
use super::subject::{LinkSubject, Subject};
use crate::diagnostics::Diagnostic;

/// Nearer centroids, as a part of the arm's length, say nothing.
const LEAST_OFFSET: f64 = 0.02;
/// What rounding makes of 1.
const ROUNDING: f64 = 1e-3;
/// From here on taking m c² off makes another body.
const MARKED: f64 = 0.5;
/// So many links that would be marked make an arm without a link beyond 1 suspicious.
const MANY: usize = 3;

/// A warning for each such link.
pub(super) fn find(arm: &Subject<'_>) -> Vec<Diagnostic> {
    let away = arm
        .links
        .iter()
        .filter(|link| link.from_given_origin.norm() > LEAST_OFFSET * arm.span.max(arm.longest));
    let nearness: Vec<_> = away.map(|link| (link, nearness(link))).collect();
    // One link whose tensor cannot be about the origin, and the table means the centroid.
    if !nearness
        .iter()
        .all(|(_, nearness)| *nearness <= 1.0 + ROUNDING)
    {
        return Vec::new();
    }
    let marked: Vec<_> = nearness
        .iter()
        .filter(|(_, nearness)| *nearness >= MARKED)
        .collect();
    let many = marked.len() >= MANY;
    let found = marked
        .iter()
        .filter(|(link, _)| many || fits_only_then(arm, link));
    found.map(|(link, _)| warning(link)).collect()
}

/// cᵀ S⁻¹ c; infinite for a body without any spread.
fn nearness(link: &LinkSubject<'_>) -> f64 {
    let c = link.from_given_origin;
    let inverse = link.body.spread.try_inverse();
    let nearness = inverse.map_or(f64::INFINITY, |inverse| c.dot(&(inverse * c)));
    // A plate or a rod may be rounded to a spread below 0.
    if nearness < 0.0 {
        f64::INFINITY
    } else {
        nearness
    }
}

/// Whether the body, taken for a uniform rod along a straight link, stands out at both ends as it is given, and lies within the link without m c².
fn fits_only_then(arm: &Subject<'_>, link: &LinkSubject<'_>) -> bool {
    let Some(direction) = link.extent.direction() else {
        return false;
    };
    let [low, high] = link.extent.along(direction);
    let length = high - low;
    let middle = link.body.com.dot(&direction);
    let given = link.body.half_rod(direction);
    let offset = link.from_given_origin.dot(&direction);
    let without = (given.powi(2) - 3.0 * offset.powi(2)).max(0.0).sqrt();
    let out = |half: f64| [low - (middle - half), middle + half - high];
    link.extent.is_certain
        && length > 0.5 * arm.longest
        && out(given).iter().all(|out| *out > 0.25 * length)
        && out(without).iter().all(|out| *out < 0.15 * length)
}

fn warning(link: &LinkSubject<'_>) -> Diagnostic {
    let message = format!(
        "the inertia of {} seems to be about the frame's origin, not the centroid",
        link.joint
    );
    let label = format!(
        "radius of gyration {} m, the centroid at {} m",
        short(link.body.gyration()),
        short(link.from_given_origin.norm())
    );
    let (c, given) = (link.places.com_given, link.places.inertia_given);
    let steiner = Matrix3::identity() * c.norm_squared() - c * c.transpose();
    let tensor = given - steiner * link.body.mass;
    let entry = |i, j| format!("{:.4e}", tensor[(i, j)] + 0.0);
    let help = format!(
        "about the centroid, I - m (c^2 1 - c c^T), it would be {{ xx = {}, yy = {}, zz = {}, xy = {}, xz = {}, yz = {} }}",
        entry(0, 0),
        entry(1, 1),
        entry(2, 2),
        entry(0, 1),
        entry(0, 2),
        entry(1, 2),
    );
    Diagnostic::warning(link.places.inertia.clone(), message)
        .label(label)
        .help(help)
}
