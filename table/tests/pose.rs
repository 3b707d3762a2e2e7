//! Where an arm of any number of joints is, what its joints hold, and how far it reaches.

use ulna::nalgebra::SVector;
use ulna::{Arm, SerialChain};
use ulna_table::Model;

fn arm(name: &str) -> Model {
    Model::load(format!("../arms/{name}.toml")).unwrap()
}

/// The textbook's poses and torques.
fn compare<const N: usize>(model: &Model) {
    let chain = SerialChain::<N>::try_from(model).unwrap();
    for sample in 0..20 {
        let q = SVector::<f64, N>::from_fn(|i, _| 2.0 * (1.7 * f64::from(sample) + i as f64).sin());
        let pose = model.pose(q.as_slice());
        let size = 1.0 + pose.tool().translation.vector.amax();
        let apart = pose.tool().to_homogeneous() - chain.forward_kinematics(&q).to_homogeneous();
        assert!(apart.amax() < 1e-14 * size, "{apart}");
        for (link, frame) in pose.links().iter().zip(chain.link_frames(&q)) {
            assert!((link.to_homogeneous() - frame.to_homogeneous()).amax() < 1e-14 * size);
        }
        let torque = SVector::<f64, N>::from_vec(pose.gravity_torque(model.gravity()));
        let expected = chain.gravity_torque(&q);
        assert!(
            (torque - expected).amax() <= 1e-13 * (1.0 + expected.amax()),
            "{torque}{expected}"
        );
    }
}

#[test]
fn poses_and_gravity_are_the_textbooks() {
    compare::<2>(&arm("planar_2r"));
    compare::<6>(&arm("oblique_6"));
    compare::<6>(&arm("geared_6"));
    compare::<7>(&arm("ssrms"));
}

#[test]
fn coordinates_left_out_are_zero() {
    let geared = arm("geared_6");
    assert_eq!(
        geared.pose(&[0.4]).tool(),
        geared.pose(&[0.4, 0.0, 0.0, 0.0, 0.0, 0.0]).tool()
    );
    assert_eq!(geared.pose(&[]).links().len(), 6);
}

/// Two rods of 1 m, the first as it is and the second within limits.
fn planar(limits: &str) -> Model {
    let text = include_str!("../../arms/planar_2r.toml");
    let text = text.replace(
        "rated_torque = 15.0",
        &format!("rated_torque = 15.0\n{limits}"),
    );
    Model::parse(&text, "planar.toml").unwrap()
}

#[test]
fn the_reach_keeps_to_the_limits() {
    let reach = |limits: &str| planar(limits).reach();
    let is =
        |reach: f64, expected: f64| assert!((reach - expected).abs() < 1e-9, "{reach} {expected}");
    is(reach(""), 2.0);
    // The law of cosines at the end of the elbow's limits that is nearer to straight, and a turn away.
    is(
        reach("limits = { lower = 90.0, upper = 150.0 }"),
        2.0_f64.sqrt(),
    );
    is(
        reach("limits = { lower = -150.0, upper = -60.0 }"),
        3.0_f64.sqrt(),
    );
    is(reach("limits = { lower = 300.0, upper = 400.0 }"), 2.0);
    is(
        reach("limits = { lower = -300.0, upper = -60.0 }"),
        3.0_f64.sqrt(),
    );
}

#[test]
fn a_slide_reaches_as_far_as_it_goes() {
    let slide = |limits: &str| {
        let kind =
            format!("kind = \"prismatic\"\n{limits}\ntheta = 0.0\nd = 0.5\na = 1.0\nalpha = 90.0");
        let text = include_str!("../../arms/planar_2r.toml")
            .replace("theta = 0.0\nd = 0.0\na = 1.0\nalpha = 0.0", &kind)
            .replace("xyz = [1.0, 0.0, 0.0]", "xyz = [0.0, 0.0, 0.0]");
        Model::parse(&text, "slide.toml").unwrap().reach()
    };
    // The tool is at x = 1, and d + q out.
    assert!((slide("limits = { lower = -3.0, upper = 1.5 }") - 1.0_f64.hypot(2.5)).abs() < 1e-9);
    assert!((slide("") - 1.0_f64.hypot(0.5)).abs() < 1e-9);
}

/// No configuration of a dense sample is farther.
#[test]
fn no_configuration_is_farther() {
    for name in ["oblique_6", "geared_6", "ssrms"] {
        let model = arm(name);
        let reach = model.reach();
        for sample in 0_u32..5000 {
            let spread = |index: usize| {
                let share =
                    (f64::from(sample) * (index as f64 + 1.25).sqrt() * 0.754_877_666).fract();
                let joint = &model.joints()[index];
                let (lower, upper) = match joint.kind {
                    ulna::JointKind::Revolute => {
                        (joint.limits.lower.max(-3.15), joint.limits.upper.min(3.15))
                    }
                    ulna::JointKind::Prismatic if joint.limits.lower.is_finite() => {
                        (joint.limits.lower, joint.limits.upper)
                    }
                    ulna::JointKind::Prismatic => (0.0, 0.0),
                };
                lower + share * (upper - lower)
            };
            let q: Vec<f64> = (0..model.joints().len()).map(spread).collect();
            let pose = model.pose(&q);
            let from_first = pose.tool().translation.vector - pose.links()[0].translation.vector;
            assert!(
                from_first.norm() <= reach + 1e-9,
                "{name}: {} > {reach}",
                from_first.norm()
            );
        }
    }
}

/// Maximum reach: Franka Emika Panda 0.855 m and Kinova Gen3 0.902 m, and from axis 2 of a KUKA LBR iiwa 14 R820 0.820 m
/// to the wrist's centre, 0.126 m before the flange.
#[test]
fn the_reach_is_that_of_data_sheets() {
    for (name, sheet) in [("franka_panda", 0.855), ("gen3", 0.902), ("iiwa_14", 0.946)] {
        let reach = arm(name).reach();
        assert!((reach - sheet).abs() < 0.004, "{name}: {reach}");
    }
}
