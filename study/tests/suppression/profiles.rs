//! Profiles: their derivatives, their peaks, what is continuous, and what is refused; joints along each.

use ulna::control::trajectory::TrajectoryError;
use ulna::nalgebra::SVector;
use ulna::{JointLimits, PointToPoint, Profile, ProfileShape, Trajectory};

use crate::arms::paper_like_motion;
use crate::trajectory::is_differentiated;

const DURATION: f64 = 20.0;

/// Every shape with long and short blends, with a cruise and without one.
pub(crate) fn profiles() -> impl Iterator<Item = Profile> {
    [0.3, 4.455, 10.0].into_iter().flat_map(|blend| {
        [
            ProfileShape::Trapezoid,
            ProfileShape::Quintic,
            ProfileShape::s_curve(blend),
            ProfileShape::SCurve {
                jerk_time: 0.2 * blend,
            },
        ]
        .map(|shape| Profile::new(DURATION, blend, shape).unwrap())
    })
}

/// The middles of a thousand parts of each phase.
pub(crate) fn inside(profile: &Profile) -> impl Iterator<Item = f64> {
    let ends: Vec<_> = profile.phase_ends().collect();
    let phases: Vec<_> = ends.windows(2).map(|pair| (pair[0], pair[1])).collect();
    phases.into_iter().flat_map(|(start, end)| {
        (0..1000).map(move |i| start + (end - start) * (f64::from(i) + 0.5) / 1000.0)
    })
}

#[test]
fn every_profile_goes_from_rest_to_rest_in_the_same_time() {
    for profile in profiles() {
        assert_eq!(profile.duration(), DURATION);
        assert_eq!(profile.at(-1.0), (0.0, 0.0, 0.0));
        assert_eq!(profile.just_before(0.0), (0.0, 0.0, 0.0));
        for time in [DURATION, DURATION + 1.0] {
            assert_eq!(profile.at(time), (1.0, 0.0, 0.0));
        }
        let (start, speed, _) = profile.at(0.0);
        assert_eq!((start, speed), (0.0, 0.0));
        let (end, speed, _) = profile.just_before(DURATION);
        assert_eq!((end, speed), (1.0, 0.0));
        // Half of the way at half of the time, mirrored about it; the same speed in between for all shapes.
        let (half, cruise, _) = profile.at(0.5 * DURATION);
        assert!((half - 0.5).abs() < 1e-15, "{profile:?}");
        let fastest = inside(&profile).map(|time| profile.at(time).1);
        let fastest = fastest.fold(cruise, f64::max);
        assert!((fastest * (DURATION - profile.blend()) - 1.0).abs() < 1e-12);
        for time in inside(&profile) {
            let (s, speed, acceleration) = profile.at(time);
            let (left, mirrored, slowing) = profile.at(DURATION - time);
            assert!((s + left - 1.0).abs() < 1e-12);
            assert!((speed - mirrored).abs() < 1e-12 && (acceleration + slowing).abs() < 1e-11);
        }
    }
}

#[test]
fn every_profile_is_differentiated_and_its_peaks_are_met() {
    for profile in profiles() {
        let step = 1e-5;
        let (mut peak, mut jerk) = (0.0_f64, 0.0_f64);
        for time in inside(&profile) {
            let clear = |end: f64| (time - end).abs() > 1.5 * step;
            if !profile.phase_ends().all(clear) {
                continue;
            }
            let [before, now, after] = [time - step, time, time + step].map(|t| profile.at(t));
            let speed = (after.0 - before.0) / (2.0 * step);
            let acceleration = (after.1 - before.1) / (2.0 * step);
            assert!((speed - now.1).abs() < 1e-9, "{profile:?} at {time} s");
            assert!(
                (acceleration - now.2).abs() < 1e-7,
                "{profile:?} at {time} s"
            );
            peak = peak.max(now.2.abs());
            jerk = jerk.max(((after.2 - before.2) / (2.0 * step)).abs());
        }
        let expected = profile.peak_acceleration();
        assert!((peak / expected - 1.0).abs() < 1e-3, "{profile:?}: {peak}");
        let (_, _, there) = profile.at(profile.peak_acceleration_time());
        assert!((there / expected - 1.0).abs() < 1e-12, "{profile:?}");
        match profile.shape() {
            ProfileShape::Trapezoid => assert_eq!(profile.peak_jerk(), f64::INFINITY),
            _ => {
                let expected = profile.peak_jerk();
                assert!((jerk / expected - 1.0).abs() < 1e-3, "{profile:?}: {jerk}");
                let (step, at) = (1e-6, profile.peak_jerk_time());
                let there = (profile.at(at + step).2 - profile.at(at).2) / step;
                assert!((there / expected - 1.0).abs() < 1e-3, "{profile:?}");
            }
        }
    }
}

#[test]
fn only_the_trapezoids_acceleration_jumps_and_the_quintics_jerk_is_continuous_too() {
    for profile in profiles() {
        for end in profile.phase_ends() {
            let (before, after) = (profile.just_before(end), profile.at(end));
            assert!((after.0 - before.0).abs() < 1e-12 && (after.1 - before.1).abs() < 1e-12);
            let jump = (after.2 - before.2).abs() / profile.peak_acceleration();
            match profile.shape() {
                // Without a cruise there is one jump from speeding up to slowing down.
                ProfileShape::Trapezoid => {
                    let middle = end == 0.5 * DURATION;
                    let expected = if middle { 2.0 } else { 1.0 };
                    assert!((jump - expected).abs() < 1e-12, "{profile:?} at {end} s");
                }
                _ => assert!(jump < 1e-12, "{profile:?} at {end} s: {jump}"),
            }
            // The sides are what they are called.
            let step = 1e-9;
            let (earlier, later) = (profile.at(end - step), profile.at(end + step));
            let tolerance = 1e-6 * profile.peak_acceleration();
            assert!((earlier.2 - before.2).abs() < tolerance);
            assert!((later.2 - after.2).abs() < tolerance);
            if profile.shape() == ProfileShape::Quintic {
                let step = 1e-6;
                let jerk = |from: f64| (profile.at(from + step).2 - profile.at(from).2) / step;
                let jump = (jerk(end) - jerk(end - step)).abs();
                assert!(jump < 1e-3 * profile.peak_jerk(), "{jump} at {end} s");
            }
        }
    }
}

#[test]
fn a_jerk_time_that_does_not_fit_is_refused() {
    for jerk_time in [0.0, -1.0, 1.001, 1e-7, f64::NAN, f64::INFINITY] {
        let shape = ProfileShape::SCurve { jerk_time };
        let refusal = Profile::new(8.0, 2.0, shape).unwrap_err();
        assert!(matches!(refusal, TrajectoryError::JerkTime { .. }));
        let expected = format!(
            "the jerk time must be at least a millionth of the 2 s of a blend and at most half of it, not {jerk_time} s"
        );
        assert_eq!(refusal.to_string(), expected);
    }
    assert!(Profile::new(8.0, 2.0, ProfileShape::SCurve { jerk_time: 1.0 }).is_ok());
}

/// 4 rad in 2 s with blends of 0.5 s: 8/3 rad/s between them, and 16/3 rad/s² would be enough for a trapezoid.
#[test]
fn joints_are_held_to_the_peaks_of_the_profile() {
    let (start, goal) = (SVector::from([0.0, 0.0]), SVector::from([0.0, -4.0]));
    let free = JointLimits::none();
    let planned = |shape, limits: &JointLimits<2>| {
        let profile = Profile::new(2.0, 0.5, shape).unwrap();
        PointToPoint::along(start, goal, profile, limits)
    };
    let soft = JointLimits {
        acceleration: SVector::repeat(5.5),
        ..free
    };
    assert!(planned(ProfileShape::Trapezoid, &soft).is_ok());
    let refusals = [
        (ProfileShape::Quintic, "joint 2 would need 10.000000"),
        (ProfileShape::s_curve(0.5), "joint 2 would need 10.666667"),
        (
            ProfileShape::SCurve { jerk_time: 0.1 },
            "joint 2 would need 6.666667",
        ),
    ];
    for (shape, expected) in refusals {
        let refusal = planned(shape, &soft).unwrap_err().to_string();
        let expected = format!("{expected} rad/s² (m/s²) at 0.250 s; its limit is 5.500000");
        assert_eq!(refusal, expected);
    }
    let smooth = JointLimits {
        jerk: SVector::repeat(50.0),
        ..free
    };
    let jerk = |shape| planned(shape, &smooth).map_err(|refusal| refusal.to_string());
    assert!(jerk(ProfileShape::s_curve(0.5)).is_ok());
    assert_eq!(
        jerk(ProfileShape::Quintic).unwrap_err(),
        "joint 2 would need 61.584029 rad/s³ (m/s³) at 0.106 s; its limit is 50.000000"
    );
    assert_eq!(
        jerk(ProfileShape::Trapezoid).unwrap_err(),
        "joint 2 would need inf rad/s³ (m/s³) at 0.000 s; its limit is 50.000000"
    );
    // Nothing moves, nothing jumps.
    let profile = Profile::new(2.0, 0.5, ProfileShape::Trapezoid).unwrap();
    assert!(PointToPoint::along(start, start, profile, &smooth).is_ok());
}

#[test]
fn joints_move_along_every_profile() {
    let paper_like = paper_like_motion();
    let (start, goal) = (paper_like.state(0.0).q, paper_like.state(DURATION).q);
    for profile in profiles() {
        let motion = PointToPoint::along(start, goal, profile, &JointLimits::none()).unwrap();
        is_differentiated(&motion, &profile);
        assert_eq!(motion.state(0.0).q, start);
        assert!((motion.state(DURATION).q - goal).amax() < 1e-15);
        for end in profile.phase_ends() {
            let jump = motion.state(end).qdd - motion.state_before(end).qdd;
            let jumps = profile.shape() == ProfileShape::Trapezoid;
            assert_eq!(jump.amax() > 1e-6, jumps, "{profile:?} at {end} s");
        }
    }
    // The default is the trapezoid, to the last bit.
    let profile = Profile::new(DURATION, 4.455, ProfileShape::default()).unwrap();
    let motion = PointToPoint::along(start, goal, profile, &JointLimits::none()).unwrap();
    assert_eq!(
        motion.state(3.3),
        PointToPoint::new(start, goal, DURATION, 4.455, &JointLimits::none())
            .unwrap()
            .state(3.3)
    );
}
