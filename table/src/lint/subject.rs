//! [`Subject`]: an arm as the rules look at it.

use nalgebra::Vector3;

use super::Places;
use super::body::Body;
use super::extent::{Extent, crosses_clearly};
use super::places::JointPlaces;
use crate::Model;
use ulna::JointKind;

/// A model with what every rule asks of it.
pub(super) struct Subject<'m> {
    pub(super) model: &'m Model,
    pub(super) places: &'m Places,
    /// Its links, base first.
    pub(super) links: Vec<LinkSubject<'m>>,
    /// The length of its longest link, m, or of its longest slide; 0 if no link says where it is.
    pub(super) longest: f64,
    /// The lengths of all rows but the first and of the tool, one after the other, m: no tool is farther from joint 1.
    pub(super) span: f64,
}

/// One link.
pub(super) struct LinkSubject<'m> {
    /// Its joint, such as `joint 2 (elbow)`.
    pub(super) joint: String,
    /// Where its numbers stand.
    pub(super) places: &'m JointPlaces,
    /// What it reaches over.
    pub(super) extent: Extent,
    /// Its mass, and how that lies.
    pub(super) body: Body,
    /// From the origin of the frame that the table gives the centroid in to the centroid, m, in the model's axes.
    pub(super) from_given_origin: Vector3<f64>,
    /// The turn about x from the frame that the table gives the link in to the model's, rad.
    given_turn: f64,
}

impl<'m> Subject<'m> {
    pub(super) fn new(model: &'m Model, places: &'m Places) -> Self {
        let joints = model.joints();
        let standard = places.is_standard();
        let links = joints.iter().zip(&places.joints).enumerate();
        let links = links.map(|(index, (joint, places))| {
            let body = Body::of(&joint.link);
            // In standard form link i is given in a frame that stands at `Tx(a) Rx(alpha)` of the model's.
            let (origin, turn) = match standard {
                true => (places.a, places.alpha),
                false => (0.0, 0.0),
            };
            LinkSubject {
                joint: called(model, index),
                places,
                extent: Extent::of(joints, model.tool(), index),
                from_given_origin: body.com - Vector3::new(origin, 0.0, 0.0),
                body,
                given_turn: turn,
            }
        });
        let links: Vec<_> = links.collect();
        let certain = links.iter().filter(|link| link.extent.is_certain);
        let longest = certain.map(|link| link.extent.length);
        let slides = joints
            .iter()
            .filter(|joint| joint.kind == JointKind::Prismatic)
            .map(|joint| joint.limits.upper - joint.limits.lower)
            .filter(|travel| travel.is_finite());
        let rows = joints.iter().enumerate().skip(1);
        let rows = rows.map(|(index, row)| {
            match crosses_clearly(joints, index) && crosses_clearly(joints, index + 1) {
                true => row.a.hypot(row.d),
                false => row.a.abs(),
            }
        });
        Self {
            model,
            places,
            longest: longest.chain(slides.clone()).fold(0.0, f64::max),
            span: rows.chain(slides).sum::<f64>() + norm(model.tool().translation),
            links,
        }
    }
}

impl LinkSubject<'_> {
    /// A direction of the model's frame in that of the table's row.
    pub(super) fn as_given(&self, direction: Vector3<f64>) -> Vector3<f64> {
        let (sin, cos) = self.given_turn.sin_cos();
        let [x, y, z] = direction.into();
        Vector3::new(x, cos * y + sin * z, cos * z - sin * y)
    }
}

/// A joint of the model as messages call it.
pub(super) fn called(model: &Model, index: usize) -> String {
    let name = model.joint_names().get(index).map(String::as_str);
    crate::model::called(index, name)
}

fn norm(vector: [f64; 3]) -> f64 {
    Vector3::from(vector).norm()
}
