use ulna::control::trajectory::TrajectoryError;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{Arm, JointLimits, PointToPoint, Profile, ProfileShape, Trajectory};
use ulna_study::tool_path::{StraightLine, ToolPath};

use crate::arms::{chain, paper_like_motion, ssrms};

/// Rates and accelerations against central differences, away from the times where acceleration or jerk jumps.
pub(crate) fn is_differentiated<const N: usize>(motion: &impl Trajectory<N>, profile: &Profile) {
    let step = 1e-5;
    for i in 1..40 {
        let time = motion.duration() * f64::from(i) / 40.0;
        if profile
            .phase_ends()
            .any(|jump| (time - jump).abs() < 2.0 * step)
        {
            continue;
        }
        let [before, now, after] = [time - step, time, time + step].map(|t| motion.state(t));
        let qd = (after.q - before.q) / (2.0 * step);
        let qdd = (after.qd - before.qd) / (2.0 * step);
        assert!((qd - now.qd).amax() < 1e-8, "q̇ at {time} s");
        assert!((qdd - now.qdd).amax() < 1e-7, "q̈ at {time} s");
    }
}

#[test]
fn trapezoid_goes_from_rest_to_rest() {
    let motion = paper_like_motion();
    is_differentiated(&motion, motion.profile());
    let (start, goal) = (motion.state(0.0).q, motion.state(20.0).q);
    assert_eq!(motion.state(-1.0).q, start);
    assert_eq!(motion.state(25.0).q, goal);
    assert_eq!(motion.state(25.0).qd, SVector::<f64, 7>::zeros());
    assert_eq!(motion.state(0.0).qd, SVector::<f64, 7>::zeros());
    let travel = SVector::from([1.474, 0.689, -4.400, 0.273, -3.284, 0.820, 0.0]);
    assert!((goal - start - travel).amax() < 1e-15);
    assert!((motion.state(10.0).q - start - travel / 2.0).amax() < 1e-15);
}

#[test]
fn trapezoid_refuses_what_cannot_be_executed() {
    let start = SVector::from([0.0, 0.0]);
    let goal = SVector::from([1.0, -4.0]);
    let free = JointLimits::none();
    let planned = |duration, blend, limits| PointToPoint::new(start, goal, duration, blend, limits);
    assert_eq!(
        planned(0.0, 0.1, &free),
        Err(TrajectoryError::Duration(0.0))
    );
    assert!(matches!(
        planned(f64::NAN, 0.1, &free),
        Err(TrajectoryError::Duration(_))
    ));
    for blend in [0.0, -1.0, 1.1, f64::NAN] {
        assert!(matches!(
            planned(2.0, blend, &free),
            Err(TrajectoryError::Blend { .. })
        ));
    }
    assert!(planned(2.0, 1.0, &free).is_ok());
    let bad = SVector::from([0.0, f64::INFINITY]);
    assert_eq!(
        PointToPoint::new(start, bad, 2.0, 0.5, &free),
        Err(TrajectoryError::NotFinite("goal"))
    );
    let (far, away) = (SVector::repeat(1e308), SVector::repeat(-1e308));
    assert!(PointToPoint::<2>::new(far, away, 2.0, 0.5, &free).is_err());
    let slow = JointLimits {
        velocity: SVector::from([1.0, 2.0]),
        ..free
    };
    let refusal = planned(2.0, 0.5, &slow).unwrap_err();
    assert_eq!(
        refusal.to_string(),
        "joint 2 would need 2.666667 rad/s (m/s) at 0.500 s; its limit is 2.000000"
    );
    let soft = JointLimits {
        acceleration: SVector::from([1.0, f64::INFINITY]),
        ..free
    };
    assert!(matches!(
        planned(2.0, 0.5, &soft),
        Err(TrajectoryError::Acceleration { joint: 0, value, .. }) if (value - 4.0 / 3.0).abs() < 1e-12
    ));
}

fn line(displacement: [f64; 3]) -> StraightLine {
    let [x, y, z] = displacement;
    StraightLine {
        displacement: Vector6::new(x, y, z, 0.0, 0.0, 0.0),
        profile: Profile::new(8.0, 2.0, ProfileShape::Trapezoid).unwrap(),
        knot_period: 0.02,
    }
}

#[test]
fn tool_path_is_straight_and_differentiated() {
    let arm = ssrms();
    let start = paper_like_motion().state(0.0).q;
    let path =
        ToolPath::straight(&arm, &start, &line([-1.0, 0.6, 0.4]), &JointLimits::none()).unwrap();
    is_differentiated(&path, path.profile());
    let origin = arm.forward_kinematics(&start).translation.vector;
    for i in 0..=50 {
        let time = 8.0 * f64::from(i) / 50.0;
        let state = path.state(time);
        let moved = arm.forward_kinematics(&state.q).translation.vector - origin;
        let along = moved.x / -1.0;
        let expected = ulna::nalgebra::Vector3::new(-1.0, 0.6, 0.4) * along;
        assert!((moved - expected).amax() < 1e-9, "off the line at {time} s");
        let twist = arm.geometric_jacobian(&state.q) * state.qd;
        assert!((twist.y / -0.6 - twist.x).abs() < 1e-8);
    }
    let end = arm
        .forward_kinematics(&path.state(8.0).q)
        .translation
        .vector
        - origin;
    assert!((end - ulna::nalgebra::Vector3::new(-1.0, 0.6, 0.4)).amax() < 1e-9);
}

#[test]
fn tool_path_turns_the_tool_about_its_axis_of_rotation() {
    let arm = chain::<6>("oblique_6");
    let start = SVector::from([0.3, -0.4, 0.2, 0.5, 0.7, -0.3]);
    let turn = StraightLine {
        displacement: Vector6::new(0.02, -0.03, 0.05, 0.1, -0.05, 0.0),
        ..line([0.0; 3])
    };
    let path = ToolPath::straight(&arm, &start, &turn, &JointLimits::none()).unwrap();
    is_differentiated(&path, path.profile());
    let state = path.state(4.0);
    let twist = arm.geometric_jacobian(&state.q) * state.qd;
    let speed = twist.x / 0.02;
    // The sixth row, the turn about world z, is no task of this arm.
    let error = (twist - turn.displacement * speed)
        .fixed_rows::<5>(0)
        .amax();
    assert!(error < 1e-9, "{error:e}");
}

#[test]
fn tool_path_refuses_singular_poses_and_fast_joints() {
    let arm = chain::<2>("planar_2r");
    let start = SVector::from([0.0, 1.0]);
    let reach = arm.forward_kinematics(&start).translation.vector;
    // Straight out, past the stretched arm.
    let out = reach.normalize() * 3.0;
    let refusal = ToolPath::straight(
        &arm,
        &start,
        &line([out.x, out.y, 0.0]),
        &JointLimits::none(),
    )
    .unwrap_err();
    assert!(
        matches!(refusal, TrajectoryError::NearSingular { time, conditioning } if time > 0.0 && conditioning < 1e-2),
        "{refusal}"
    );
    let slow = JointLimits {
        velocity: SVector::repeat(1e-3),
        ..JointLimits::none()
    };
    let inwards = -reach.normalize() * 0.1;
    let refusal =
        ToolPath::straight(&arm, &start, &line([inwards.x, inwards.y, 0.0]), &slow).unwrap_err();
    assert!(
        matches!(refusal, TrajectoryError::Velocity { .. }),
        "{refusal}"
    );
    for knot_period in [0.0, -1.0, 1e-300, f64::NAN, f64::INFINITY] {
        let line = StraightLine {
            knot_period,
            ..line([0.1, 0.0, 0.0])
        };
        let refusal = ToolPath::straight(&arm, &start, &line, &JointLimits::none());
        assert!(matches!(refusal, Err(TrajectoryError::KnotPeriod(_))));
    }
}
