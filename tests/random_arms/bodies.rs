//! Strategies for links: rigid bodies of every mass and size, the light ones of a last joint among them.

use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

use super::geometry::{decades, point, rounded, turn};
use super::table::Link;

/// How large the largest principal moment is.
#[derive(Clone, Debug)]
enum Size {
    /// Radius of gyration, m.
    Radius(f64),
    /// The moment itself, kg m^2.
    Moment(f64),
}

fn mass() -> BoxedStrategy<f64> {
    prop_oneof![8 => decades(-30..=30), 1 => decades(-60..=60)].boxed()
}

/// Bodies of ordinary size mostly, and any that a table may hold.
fn size() -> BoxedStrategy<Size> {
    prop_oneof![
        8 => (1..=100).prop_map(|centimetres| Size::Radius(f64::from(centimetres) / 100.0)),
        1 => decades(-100..=40).prop_map(Size::Moment),
    ]
    .boxed()
}

/// A last link whose own inertia is next to nothing: a tool changer, a camera, a needle.
fn light() -> BoxedStrategy<Size> {
    decades(-100..=-60).prop_map(Size::Moment).boxed()
}

/// The principal moments, the largest being 1: those of a ball, a box, a rod, a plate.
/// They are sums of two of a body's second moments, so that the triangle inequality holds.
fn shape() -> BoxedStrategy<[f64; 3]> {
    let second_moments = prop_oneof![
        3 => Just([1.0; 3]),
        4 => [1..=20, 1..=20, 1..=20].prop_map(|sides: [i32; 3]| sides.map(f64::from)),
        1 => Just([1.0, 1e-3, 1e-3]),
        1 => Just([1.0, 1.0, 1e-3]),
    ];
    second_moments
        .prop_map(|[x, y, z]| {
            let moments = [y + z, z + x, x + y];
            let largest = moments.into_iter().fold(0.0, f64::max);
            moments.map(|moment| moment / largest)
        })
        .boxed()
}

fn body(size: BoxedStrategy<Size>) -> BoxedStrategy<Link> {
    let turned = proptest::option::of([turn(), turn(), turn()]);
    (mass(), point(), size, shape(), turned)
        .prop_map(|(mass, com, size, shape, turned)| {
            let largest = match size {
                Size::Radius(radius) => mass * radius * radius,
                Size::Moment(moment) => moment,
            };
            let moments = Vector3::from(shape) * largest;
            let inertia = match turned {
                None => [moments.x, moments.y, moments.z, 0.0, 0.0, 0.0],
                Some(angles) => tensor(moments, angles),
            };
            let inertia = inertia.map(|entry| rounded(entry, 6));
            Link { mass, com, inertia }
        })
        .boxed()
}

fn tensor(moments: Vector3<f64>, angles: [f64; 3]) -> [f64; 6] {
    let [roll, pitch, yaw] = angles.map(f64::to_radians);
    let rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
    let tensor =
        rotation.matrix() * Matrix3::from_diagonal(&moments) * rotation.matrix().transpose();
    [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|entry| tensor[entry])
}

/// Any link.
pub(crate) fn link() -> BoxedStrategy<Link> {
    body(size())
}

/// A link to put in the last one's place, sometimes.
pub(crate) fn distal() -> BoxedStrategy<Option<Link>> {
    proptest::option::weighted(0.35, body(light())).boxed()
}
