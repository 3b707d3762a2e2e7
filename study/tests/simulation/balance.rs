//! Energy and momentum account for the motion.

use ulna::nalgebra::SVector;
use ulna::{Compensation, Controller, SerialChain, Trajectory};
use ulna_generated::{Oblique6, Ssrms};
use ulna_study::simulation::{
    Balance, Brake, BrakeProfile, Control, Ending, Feedback, Outcome, Resolution, Simulation,
};

use crate::{
    cancelling, lock, oblique, oblique_motion, potential_energy, pushing, ssrms, ssrms_motion,
};

fn assert_balanced<const N: usize>(outcome: &Outcome<N>, what: &str) {
    assert_eq!(outcome.ending, Ending::Complete, "{what}");
    let Balance {
        energy_error,
        momentum_error,
        work,
        ..
    } = outcome.balance;
    assert!(work.motors != 0.0 && work.brakes != 0.0, "{what}: {work:?}");
    assert!(energy_error < 1e-8, "{what}: energy {energy_error:.1e}");
    assert!(
        momentum_error < 1e-8,
        "{what}: momentum {momentum_error:.1e}"
    );
}

#[test]
fn balances_hold_on_the_ssrms_for_every_brake() {
    let motion = ssrms_motion();
    for compensation in [Compensation::none(), cancelling()] {
        for profile in [BrakeProfile::Constant, BrakeProfile::Smooth] {
            for (duration, detection) in [(0.0, 0.0), (0.3, 0.1), (0.1, 0.2)] {
                let mut simulation = ssrms(&motion, compensation, duration);
                simulation.brake.profile = profile;
                simulation.brake.detection = detection;
                let outcome = simulation
                    .run(9.95..10.35, &Resolution::default(), |_| ())
                    .unwrap();
                assert_balanced(
                    &outcome,
                    &format!("{profile:?} {duration} s, known after {detection} s"),
                );
            }
        }
    }
}

#[test]
fn balances_hold_on_the_oblique_arm_for_every_joint() {
    let motion = oblique_motion();
    for joint in 0..6 {
        for duration in [0.0, 0.05] {
            let simulation = oblique(&motion, joint, duration);
            let outcome = simulation
                .run(1.1..1.35, &Resolution::default(), |_| ())
                .unwrap();
            assert_balanced(&outcome, &format!("joint {joint}, {duration} s"));
        }
    }
}

#[test]
fn balances_hold_with_two_joints_braked_and_a_growing_force() {
    let motion = ssrms_motion();
    let simulation = Simulation {
        plant: &Ssrms,
        controller: Controller::new(&Ssrms, Compensation::none()),
        trajectory: &motion,
        wrench: |time: f64| pushing(time) * (0.2 * time * time + 4.0 * time) / 20.0,
        feedback: Feedback::critical(3.0),
        control: Control::Every(1e-3),
        brake: Brake::new(lock(&[1, 3], 6.0), 0.2),
        reflected_inertia: SVector::zeros(),
    };
    let outcome = simulation
        .run(5.7..6.7, &Resolution::default(), |_| ())
        .unwrap();
    assert_balanced(&outcome, "joints 2 and 4");
}

#[test]
fn work_of_gravity_is_what_the_links_lose_in_height() {
    let motion = oblique_motion();
    let mut last = None;
    let simulation = oblique(&motion, 1, 0.05);
    let outcome = simulation
        .run(0.9..1.7, &Resolution::default(), |sample| {
            last = Some(*sample);
        })
        .unwrap();
    let chain: SerialChain<6> = Oblique6::CHAIN;
    let start = potential_energy(&chain, &motion.state(0.9).q);
    let end = potential_energy(&chain, &last.unwrap().state.q);
    assert!((start - end).abs() > 1.0);
    let error = outcome.balance.work.gravity - (start - end);
    assert!(
        error.abs() < 1e-8 * start.abs().max(end.abs()),
        "{error:.1e}"
    );
}

/// Without gravity nothing but joint 1 and the tool turns the SSRMS about its first axis.
#[test]
fn angular_momentum_about_the_first_axis_needs_no_other_joint() {
    let motion = ssrms_motion();
    let simulation = ssrms(&motion, Compensation::none(), 0.05);
    let resolution = Resolution {
        sample_period: 1e-3,
        ..Resolution::default()
    };
    let (series, _) = simulation.record(9.9..10.2, &resolution).unwrap();
    let mut expected = 0.0;
    for pair in series.windows(2) {
        // Simpson would need a midpoint; the trapezoid's error over 1 ms is far below the tolerance.
        let rate = |i: usize| {
            let jacobian = ulna::Arm::geometric_jacobian(&Ssrms, &pair[i].state.q);
            pair[i].joint_torque()[0] - jacobian.column(0).dot(&pushing(0.0))
        };
        expected += 0.5 * (rate(0) + rate(1)) * (pair[1].elapsed - pair[0].elapsed);
    }
    let momentum = |i: usize| {
        let state = &series[i].state;
        (ulna::Arm::mass_matrix(&Ssrms, &state.q) * state.qd)[0]
    };
    let change = momentum(series.len() - 1) - momentum(0);
    assert!(
        (change - expected).abs() < 1e-6 * momentum(0).abs(),
        "{change} {expected}"
    );
    assert!(change.abs() > 1e-3 * momentum(0).abs());
}

#[test]
fn a_finer_tolerance_gives_a_finer_motion() {
    let motion = oblique_motion();
    let mut simulation = oblique(&motion, 1, 0.05);
    simulation.brake = Brake::none();
    let end = |tolerance: f64| {
        let resolution = Resolution {
            tolerance,
            sample_period: 10.0,
            ..Resolution::default()
        };
        let mut q = SVector::zeros();
        simulation
            .run(0.0..1.0, &resolution, |sample| q = sample.state.q)
            .unwrap();
        q
    };
    let exact = end(1e-13);
    let errors = [1e-5, 1e-7, 1e-9].map(|tolerance| (end(tolerance) - exact).amax());
    assert!(
        errors[0] < 1e-4 && errors[1] < errors[0] / 10.0 && errors[2] < errors[1] / 10.0,
        "{errors:?}"
    );
    assert!(errors[2] < 1e-8, "{errors:?}");
}
