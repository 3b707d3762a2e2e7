//! The motion: straight in joint space, near the table's configuration q = 0, as quick as the drives allow.

use ulna::nalgebra::SVector;
use ulna::{
    Arm, Joint, JointKind, JointLimits, Limits, PointToPoint, Profile, ProfileShape, SerialChain,
    Trajectory,
};

use my_crate::N;

/// The least that the motion takes, and the most, s.
const SHORTEST: f64 = 2.0;
const LONGEST: f64 = 200.0;
/// The share of the rated torques that the plan may take; the feedback needs some.
const SHARE: f64 = 0.8;

pub fn plan(
    arm: &dyn Arm<N>,
    chain: &SerialChain<N>,
) -> Result<PointToPoint<N>, Box<dyn std::error::Error>> {
    let [start, goal] =
        [0.1, 0.9].map(|share| SVector::from_fn(|i, _| on_the_way(&chain.joints[i], share)));
    let limits = JointLimits::of(chain);
    let mut duration = SHORTEST;
    while duration <= LONGEST {
        let profile = Profile::new(duration, duration / 4.0, ProfileShape::Quintic)?;
        match PointToPoint::along(start, goal, profile, &limits) {
            Ok(plan) if is_within_rated_torques(arm, &plan) => return Ok(plan),
            // Too quick for the joints or their drives.
            _ => duration *= 2.0,
        }
    }
    Err(format!(
        "the drives do not carry the arm along this way within {LONGEST} s: choose another one in plan.rs"
    )
    .into())
}

/// A position of a joint: 0 to 1 along a radian, or a quarter of a metre, or as much of it as its limits leave.
fn on_the_way(joint: &Joint, share: f64) -> f64 {
    let width = match joint.kind {
        JointKind::Revolute => 1.0,
        JointKind::Prismatic => 0.25,
    };
    // About 0, unless that is beyond the limits, which are infinite where the table has none.
    let Limits { lower, upper, .. } = joint.limits;
    let lower = lower.max((upper - width).min(-0.5 * width));
    let upper = upper.min(lower + width);
    lower + share * (upper - lower)
}

fn is_within_rated_torques(arm: &dyn Arm<N>, plan: &PointToPoint<N>) -> bool {
    let most = arm.rated_torque() * SHARE;
    (0..=100).all(|i| {
        let state = plan.state(plan.duration() * f64::from(i) / 100.0);
        let torque = arm.inverse_dynamics(&state.q, &state.qd, &state.qdd);
        torque
            .iter()
            .zip(&most)
            .all(|(torque, most)| torque.abs() <= *most)
    })
}
