//! Where the arm's frames are at some q, as the description has it and as the rows have it.

use nalgebra::Vector3;
use ulna::JointKind;

use crate::frame::Frame;
use crate::rows::{Moving, Rows};

/// Coordinates that are in no simple relation: the parts after the point of multiples of the golden ratio.
pub(crate) fn generic(configuration: usize, joints: usize) -> Vec<f64> {
    const GOLDEN: f64 = 1.618_033_988_749_895;
    let first = configuration * joints + 1;
    let parts = (first..first + joints).map(|k| (k as f64 * GOLDEN).fract());
    parts.map(|part| 2.0 * part - 1.0).collect()
}

/// The joints' frames before they move, and the tool's, in the base link's.
pub(crate) fn frames(
    kinds: &[JointKind],
    joints: &[Moving],
    tool: &Frame,
    q: &[f64],
) -> (Vec<Frame>, Frame) {
    let mut at = Frame::identity();
    let mut frames = Vec::new();
    for ((kind, joint), q) in kinds.iter().zip(joints).zip(q) {
        at = at.times(&joint.placement);
        frames.push(at);
        at = at.times(&moved(*kind, &joint.axis, *q));
    }
    (frames, at.times(tool))
}

/// How far from the description's the tool is by its rows, m or rad, at several configurations.
pub(crate) fn distance(kinds: &[JointKind], joints: &[Moving], tool: &Frame, rows: &Rows) -> f64 {
    const CONFIGURATIONS: usize = 5;
    let z = Vector3::z();
    let at = |configuration: usize| {
        let q: Vec<f64> = generic(configuration, joints.len())
            .iter()
            .map(|q| 3.0 * q)
            .collect();
        let (_, described) = frames(kinds, joints, tool, &q);
        let last = kinds
            .iter()
            .zip(&rows.rows)
            .zip(&q)
            .fold(rows.base, |at, ((kind, row), q)| {
                at.times(&Frame::turned(&Vector3::x(), row.alpha))
                    .times(&Frame::moved(Vector3::x() * row.a))
                    .times(&Frame::turned(&z, row.theta))
                    .times(&Frame::moved(z * row.d))
                    .times(&moved(*kind, &z, *q))
            });
        let by_rows = last.times(&rows.tool);
        let turned = (described.rotation - by_rows.rotation).amax();
        turned.max((described.translation - by_rows.translation).amax())
    };
    (0..CONFIGURATIONS).map(at).fold(0.0, f64::max)
}

fn moved(kind: JointKind, axis: &Vector3<f64>, q: f64) -> Frame {
    match kind {
        JointKind::Revolute => Frame::turned(axis, q),
        JointKind::Prismatic => Frame::moved(axis * q),
    }
}
