//! A centroid that no body on its link can have, or that is in millimetres.

use super::short;
use super::subject::{LinkSubject, Subject};
use crate::diagnostics::Diagnostic;

/// A warning for each centroid that is farther from its link than half the link's length, the arm's longest link and
/// half the body's own length together.
pub(super) fn find(arm: &Subject<'_>) -> Vec<Diagnostic> {
    let certain = arm.links.iter().filter(|link| link.extent.is_certain);
    let far = certain.filter_map(|link| {
        let allowed = allowed(arm, link);
        let distance = link.extent.distance(link.body.com);
        if distance <= allowed {
            return None;
        }
        let message = format!("the centroid of {} is far outside its link", link.joint);
        let length = short(link.extent.length);
        let label = format!("{} m from a link {length} m long", short(distance));
        let millimetres = link.extent.distance(link.body.com * 1e-3) <= allowed;
        let help = if millimetres && distance > 1.0_f64.max(3.0 * arm.longest) {
            let metres = (link.places.com_given * 1e-3).map(round);
            let [x, y, z] = metres.into();
            format!("lengths are in metres: if these are millimetres, write `com = [{x:?}, {y:?}, {z:?}]`")
        } else {
            "write the centroid in metres, in the frame of this row".to_owned()
        };
        Some(Diagnostic::warning(link.places.com.clone(), message).label(label).help(help))
    });
    far.collect()
}

/// How far a link's centroid may be from it, m.
fn allowed(arm: &Subject<'_>, link: &LinkSubject<'_>) -> f64 {
    // A body that reaches back to its link: a uniform rod of that spread ends 1.7 of it from its centroid.
    let body = 3.0_f64.sqrt() * link.body.half_spread();
    let lengths = 0.5 * link.extent.length + arm.longest;
    if lengths == 0.0 {
        // An arm without lengths says nothing of its size; its bodies do.
        return 20.0 * body;
    }
    // An inertia in a wrong unit makes no body of that size.
    lengths + body.min(3.0 * arm.span)
}

/// Without the digits that only the division has put there.
fn round(number: f64) -> f64 {
    (number * 1e9).round() / 1e9
}
