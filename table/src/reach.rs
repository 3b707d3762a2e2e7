//! How far an arm reaches.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;

use crate::Model;
use crate::pose::Pose;
use ulna::internal::random::SplitMix64;
use ulna::{Joint, JointKind};

/// Configurations at random from which the arm is stretched, beside q = 0.
const STARTS: usize = 8;
/// Each joint in turn, so often at most.
const SWEEPS: usize = 100;
/// A sweep that gains less than this share has arrived.
const GAIN: f64 = 1e-10;

impl Model {
    /// The largest distance of the tool point from the origin of frame 1, m, that is found within the joints' limits.
    ///
    /// Each joint in turn goes where the tool is farthest, which is known in closed form, until none gains anything; from q = 0
    /// and from some configurations at random. A sliding joint without limits stays at q = 0.
    pub fn reach(&self) -> f64 {
        let mut random = SplitMix64::new(1);
        let mut start = |joint: &Joint| {
            let limits = joint.limits;
            let (lower, upper) = match joint.kind {
                JointKind::Revolute => (limits.lower.max(-PI), limits.upper.min(PI)),
                JointKind::Prismatic if limits.lower.is_finite() && limits.upper.is_finite() => {
                    (limits.lower, limits.upper)
                }
                JointKind::Prismatic => (0.0, 0.0),
            };
            0.5 * (lower + upper) + 0.5 * (upper - lower) * random.symmetric()
        };
        let zero = self
            .joints()
            .iter()
            .map(|joint| 0.0_f64.clamp(joint.limits.lower, joint.limits.upper));
        let mut starts: Vec<Vec<f64>> = vec![zero.collect()];
        starts.extend((0..STARTS).map(|_| self.joints().iter().map(&mut start).collect()));
        let reached = starts.into_iter().map(|q| self.stretched(q));
        reached.fold(0.0, f64::max)
    }

    /// The distance to which the arm is stretched from `q`.
    fn stretched(&self, mut q: Vec<f64>) -> f64 {
        let mut reached = distance(&self.pose(&q));
        for _ in 0..SWEEPS {
            for index in 1..q.len() {
                q[index] = self.farthest(&q, index);
            }
            let now = distance(&self.pose(&q));
            if now <= reached * (1.0 + GAIN) {
                return now.max(reached);
            }
            reached = now;
        }
        reached
    }

    /// The coordinate of joint `index` at which the tool is farthest from the origin of frame 1, the others being at `q`.
    fn farthest(&self, q: &[f64], index: usize) -> f64 {
        let joint = &self.joints()[index];
        let (lower, upper) = (joint.limits.lower, joint.limits.upper);
        let ends = [lower, upper].into_iter().filter(|end| end.is_finite());
        let mut candidates: Vec<f64> = std::iter::once(q[index]).chain(ends).collect();
        if joint.kind == JointKind::Revolute {
            let best = q[index] + turn_away(&self.pose(q), index);
            // The same angle within the limits, if there is one.
            let turns = if lower.is_finite() {
                ((lower - best) / TAU).ceil()
            } else {
                0.0
            };
            let best = best + turns * TAU;
            if (lower..=upper).contains(&best) {
                candidates.push(best);
            }
        }
        let measured = candidates.into_iter().map(|candidate| {
            let mut q = q.to_vec();
            q[index] = candidate;
            (distance(&self.pose(&q)), candidate)
        });
        // The coordinate as it is comes first, and gives way to a farther one alone.
        let farthest = measured.reduce(|best, other| if other.0 > best.0 { other } else { best });
        farthest.map_or(q[index], |(_, coordinate)| coordinate)
    }
}

/// The turn of joint `index` that brings the tool to the other side of the joint's axis than the origin of frame 1.
fn turn_away(pose: &Pose<'_>, index: usize) -> f64 {
    let frame = &pose.links()[index];
    let (axis, origin) = (frame.rotation * Vector3::z(), frame.translation.vector);
    let across = |point: Vector3<f64>| {
        let arm = point - origin;
        arm - axis * axis.dot(&arm)
    };
    let tool = across(pose.tool().translation.vector);
    let away = -across(pose.links()[0].translation.vector);
    axis.dot(&tool.cross(&away)).atan2(tool.dot(&away))
}

fn distance(pose: &Pose<'_>) -> f64 {
    (pose.tool().translation.vector - pose.links()[0].translation.vector).norm()
}
