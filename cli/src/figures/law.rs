//! How the laws look in every figure.

use ulna_study::experiment::SearchMethod;

use super::stroke::Stroke;
use super::style::{BLUE, GREEN, GREY, ORANGE};

/// A law by its exact search: what it is called, and how it is drawn.
pub(super) struct Law {
    pub(super) method: SearchMethod,
    pub(super) label: &'static str,
    pub(super) stroke: Stroke,
}

/// In the order of legends.
pub(super) const LAWS: [Law; 3] = [
    Law {
        method: SearchMethod::PerJoint,
        label: "Eq. 16",
        stroke: Stroke::solid(BLUE),
    },
    Law {
        method: SearchMethod::Projected,
        label: "Eq. 20",
        stroke: Stroke::dashed(ORANGE),
    },
    Law {
        method: SearchMethod::Optimal,
        label: "optimal",
        stroke: Stroke::dotted(GREEN),
    },
];

/// The torque without any.
pub(super) const WITHOUT: Stroke = Stroke::solid(GREY);
/// What it is called.
pub(super) const WITHOUT_LABEL: &str = "without suppression";
