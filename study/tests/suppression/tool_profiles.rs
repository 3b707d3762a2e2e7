//! A tool along every profile.

use ulna::control::trajectory::TrajectoryError;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{Arm, JointLimits, Profile, ProfileShape, Trajectory};
use ulna_generated::Ssrms;
use ulna_study::tool_path::{StraightLine, ToolPath};

use crate::arms::{paper_like_motion, ssrms};
use crate::profiles::{inside, profiles};
use crate::trajectory::is_differentiated;

fn path(
    profile: Profile,
    knot_period: f64,
    limits: &JointLimits<7>,
) -> Result<ToolPath<7>, TrajectoryError> {
    let line = StraightLine {
        displacement: Vector6::new(-1.0, 0.6, 0.4, 0.0, 0.0, 0.0),
        profile,
        knot_period,
    };
    ToolPath::straight(&Ssrms, &paper_like_motion().state(0.0).q, &line, limits)
}

/// A knot period that fits into no phase, so that a phase's last knot has to be its own.
#[test]
fn a_tool_moves_along_every_profile_as_exactly() {
    let arm = ssrms();
    let free = JointLimits::none();
    for profile in profiles() {
        let coarse = path(profile, 0.031, &free).unwrap();
        let fine = path(profile, 0.01, &free).unwrap();
        is_differentiated(&fine, &profile);
        let origin = arm
            .forward_kinematics(&fine.state(0.0).q)
            .translation
            .vector;
        for time in inside(&profile).step_by(97) {
            let (state, exact) = (coarse.state(time), fine.state(time));
            assert!((state.q - exact.q).amax() < 1e-9, "{profile:?} at {time} s");
            let error = (state.qdd - exact.qdd).amax() / profile.peak_acceleration();
            assert!(error < 1e-4, "{profile:?} at {time} s: {error:e}");
            // As far along the line as the profile says.
            let moved = arm.forward_kinematics(&exact.q).translation.vector - origin;
            let (s, speed, acceleration) = profile.at(time);
            assert!((moved.x + s).abs() < 1e-9, "{profile:?} at {time} s");
            let jacobian = arm.geometric_jacobian(&exact.q);
            assert!(((jacobian * exact.qd).x + speed).abs() < 1e-8);
            let rates = arm.jacobian_derivatives(&exact.q);
            let bias: Vector6<f64> = rates
                .iter()
                .zip(&exact.qd)
                .map(|(derivative, rate)| derivative * exact.qd * *rate)
                .sum();
            let error = (jacobian * exact.qdd + bias).x + acceleration;
            assert!(
                error.abs() < 1e-5 * profile.peak_acceleration(),
                "{profile:?} at {time} s: {error:e}"
            );
        }
        for end in profile.phase_ends() {
            let (before, after) = (fine.state_before(end), fine.state(end));
            assert!((before.q - after.q).amax() < 1e-12 && (before.qd - after.qd).amax() < 1e-9);
            let jumps = profile.shape() == ProfileShape::Trapezoid;
            let jump = (before.qdd - after.qdd).amax();
            assert_eq!(jump > 1e-6, jumps, "{profile:?} at {end} s: {jump}");
        }
    }
}

#[test]
fn a_tools_joints_are_held_to_their_jerk() {
    let smooth = |jerk: f64| JointLimits {
        jerk: SVector::repeat(jerk),
        ..JointLimits::none()
    };
    let profile = |shape| Profile::new(8.0, 2.0, shape).unwrap();
    let refusal = path(profile(ProfileShape::Trapezoid), 0.02, &smooth(1e6)).unwrap_err();
    let message = refusal.to_string();
    assert!(
        message.contains("would need inf rad/s³ (m/s³) at 0.000 s"),
        "{message}"
    );
    let s_curve = profile(ProfileShape::s_curve(2.0));
    let refusal = path(s_curve, 0.02, &smooth(0.02)).unwrap_err();
    let TrajectoryError::Jerk {
        joint, time, value, ..
    } = refusal
    else {
        panic!("{refusal}");
    };
    // Against differences of the path's own accelerations.
    let planned = path(s_curve, 0.02, &JointLimits::none()).unwrap();
    let (from, to) = (
        planned.state(time - 0.01).qdd,
        planned.state_before(time + 0.01).qdd,
    );
    let jerk = ((to - from) / 0.02)[joint].abs();
    assert!(
        (jerk / value - 1.0).abs() < 1e-6,
        "{value} at {time} s, {jerk}"
    );
    assert!(path(s_curve, 0.02, &smooth(10.0)).is_ok());
}
