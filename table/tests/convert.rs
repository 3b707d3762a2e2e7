//! Every arm in the other convention, and back: the same M, J and torques.

use ulna::nalgebra::{SMatrix, SVector};
use ulna::{Arm, SerialChain};
use ulna_table::{AngleUnit, Convention, Model};

/// The largest difference of pose, J, M and τ between two arms of `N` joints, each relative to its largest entry.
fn difference<const N: usize>(one: &Model, other: &Model) -> f64 {
    let [one, other] = [one, other].map(|model| SerialChain::<N>::try_from(model).unwrap());
    // Numbers of no arm in particular.
    let state = |sample: usize, what: usize| {
        SVector::<f64, N>::from_fn(|i, _| {
            let number = (sample * 31 + what * 7 + i * 3 + 1) as f64;
            4.0 * (number * 0.618_033_988_75).fract() - 2.0
        })
    };
    (0..20)
        .map(|sample| {
            let [q, qd, qdd] = [0, 1, 2].map(|what| state(sample, what));
            let pose = |arm: &SerialChain<N>| arm.forward_kinematics(&q).to_homogeneous();
            let tau = |arm: &SerialChain<N>| arm.inverse_dynamics(&q, &qd, &qdd);
            [
                relative(pose(&one), pose(&other)),
                relative(one.geometric_jacobian(&q), other.geometric_jacobian(&q)),
                relative(one.mass_matrix(&q), other.mass_matrix(&q)),
                relative(tau(&one), tau(&other)),
            ]
            .into_iter()
            .fold(0.0, f64::max)
        })
        .fold(0.0, f64::max)
}

fn relative<const R: usize, const C: usize>(
    one: SMatrix<f64, R, C>,
    other: SMatrix<f64, R, C>,
) -> f64 {
    (one - other).amax() / one.amax()
}

fn difference_of_any(one: &Model, other: &Model) -> f64 {
    macro_rules! dispatch {
        ($($joints:literal)+) => {
            match one.joints().len() {
                $($joints => difference::<$joints>(one, other),)+
                joints => panic!("write {joints} below"),
            }
        };
    }
    dispatch!(1 2 3 4 5 6 7 8)
}

#[test]
fn there_and_back_every_arm_stays_what_it_is() {
    for entry in std::fs::read_dir("../arms").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|end| end != "toml") {
            continue;
        }
        let arm = Model::load(&path).unwrap();
        let through = |model: &Model, to| {
            let text = model.description().in_convention(to);
            let text = text.to_table(AngleUnit::Degrees).to_string();
            let model = Model::parse(&text, "converted.toml").unwrap();
            assert_eq!(model.convention(), to);
            model
        };
        let standard = through(&arm, Convention::Standard);
        let back = through(&standard, Convention::Modified);
        for (what, other) in [("there", &standard), ("and back", &back)] {
            let difference = difference_of_any(&arm, other);
            println!("{} {what}: {difference:.1e}", arm.name());
            assert!(difference < 1e-12, "{} {what}: {difference:e}", arm.name());
            assert_eq!(other.joint_names(), arm.joint_names());
        }
    }
}

/// A row of standard form has the a and α of the row before it in modified form; the first row's are the base's.
#[test]
fn rows_take_the_lengths_and_twists_of_their_neighbours() {
    let arm = Model::load("../arms/geared_6.toml").unwrap().description();
    let standard = arm.in_convention(Convention::Standard);
    let shift = |joint: &ulna::Joint| (joint.a, joint.alpha);
    for pair in 0..5 {
        assert_eq!(shift(&standard.joints[pair]), shift(&arm.joints[pair + 1]));
    }
    assert_eq!(standard.joints[5].a, 0.0);
    let back = standard.in_convention(Convention::Modified);
    assert_eq!(back.joints[1].a, arm.joints[1].a);
    assert_eq!(back.joints[0].a, 0.0);
    assert_eq!(arm.in_convention(Convention::Modified), arm);
}
