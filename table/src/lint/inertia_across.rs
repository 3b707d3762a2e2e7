//! Inertias in other axes than the link's.

use nalgebra::Vector3;

use super::short;
use super::subject::Subject;
use crate::diagnostics::Diagnostic;

/// So many times as long as thick a body must be, by its inertia, for its axis to mean something.
const SLENDER: f64 = 3.0;
/// The cosine of the angle between it and the link from which on it lies across: 60 degrees.
const ACROSS: f64 = 0.5;

/// A warning for each slender body that lies across a long, straight link.
pub(super) fn find(arm: &Subject<'_>) -> Vec<Diagnostic> {
    let certain = arm.links.iter().filter(|link| link.extent.is_certain);
    let found = certain.filter_map(|link| {
        let direction = link.extent.direction()?;
        let (axis, times) = (link.body.longest_axis, link.body.slenderness());
        if link.extent.length <= 0.5 * arm.longest
            || times <= SLENDER
            || axis.dot(&direction).abs() >= ACROSS
        {
            return None;
        }
        let message = format!("by its inertia the link of {} is long across, not along", link.joint);
        let label = format!(
            "{} times as long along {}, but the link runs along {}",
            short(times),
            written(link.as_given(axis)),
            written(link.as_given(direction)),
        );
        let help = "write the tensor in the axes of this row's frame, each moment about its own axis: \
                    that about the axis along a slender link is the smallest";
        Some(Diagnostic::warning(link.places.inertia.clone(), message).label(label).help(help))
    });
    found.collect()
}

/// A direction, its largest entry positive.
fn written(direction: Vector3<f64>) -> String {
    let largest = direction[direction.iamax()];
    let [x, y, z] = (direction * largest.signum())
        .map(|entry| (entry * 100.0).round() / 100.0 + 0.0)
        .into();
    format!("[{x}, {y}, {z}]")
}
