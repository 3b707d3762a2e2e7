//! Beginnings, ends, refusals.

use ulna::nalgebra::{SVector, Vector6};
use ulna::{Controller, Status};
use ulna_generated::Ssrms;
use ulna_study::simulation::{
    Brake, Control, Ending, Feedback, Resolution, Simulation, SimulationError,
};

use crate::{Compensation, cancelling, lock, oblique, oblique_motion, ssrms, ssrms_motion};

#[test]
fn arguments_that_make_no_run_are_refused_by_name() {
    let motion = ssrms_motion();
    let good = ssrms(&motion, Compensation::none(), 0.1);
    let fine = Resolution::default();
    let run = |simulation: &Simulation<_, _, _, _, 7>, span, resolution| {
        simulation
            .run(span, &resolution, |_| ())
            .unwrap_err()
            .to_string()
    };
    let message = run(&good, 3.0..2.0, fine);
    assert_eq!(
        message,
        "the run must begin before it ends, at finite times, not go from 3 s to 2 s"
    );
    let message = run(&good, 0.0..f64::NAN, fine);
    assert!(message.starts_with("the run must begin"), "{message}");
    let message = run(&good, 11.0..12.0, fine);
    assert_eq!(
        message,
        "the failure's time must be finite and not before the run's begin, not 10 s"
    );
    let message = run(
        &good,
        0.0..2.0,
        Resolution {
            tolerance: 0.0,
            ..fine
        },
    );
    assert_eq!(message, "the tolerance must be finite and above 0, not 0");
    let message = run(
        &good,
        0.0..2.0,
        Resolution {
            sample_period: f64::INFINITY,
            ..fine
        },
    );
    assert_eq!(
        message,
        "the sample period must be finite and above 0, not inf"
    );

    let mut bad = good;
    bad.brake.duration = -0.1;
    assert_eq!(
        run(&bad, 0.0..2.0, fine),
        "the brake's duration must be finite and not below 0, not -0.1"
    );
    let mut bad = good;
    bad.brake.detection = f64::NAN;
    assert_eq!(
        run(&bad, 0.0..2.0, fine),
        "the detection must be finite and not below 0, not NaN"
    );
    let mut bad = good;
    bad.feedback.rate = -1.0;
    assert_eq!(
        run(&bad, 0.0..2.0, fine),
        "the feedback's rate gain must be finite and not below 0, not -1"
    );
    let mut bad = good;
    bad.control = Control::Every(0.0);
    assert_eq!(
        run(&bad, 0.0..2.0, fine),
        "the control period must be finite and above 0, not 0"
    );
    let mut bad = good;
    bad.brake.failure.time = f64::NAN;
    assert!(matches!(
        bad.run(0.0..2.0, &fine, |_| ()),
        Err(SimulationError::FailureTime(_))
    ));
}

#[test]
fn a_run_that_ends_before_the_brake_has_done_its_work_reports_no_impact() {
    let motion = ssrms_motion();
    let simulation = ssrms(&motion, Compensation::none(), 0.5);
    for end in [9.0, 10.0, 10.2] {
        let outcome = simulation
            .run(8.0..end, &Resolution::default(), |_| ())
            .unwrap();
        assert_eq!(outcome.ending, Ending::Complete);
        assert!(outcome.impact.is_none(), "{end}");
    }
    assert!(
        simulation
            .run(8.0..10.6, &Resolution::default(), |_| ())
            .unwrap()
            .impact
            .is_some()
    );
}

#[test]
fn numbers_that_are_none_end_the_run_where_they_appear() {
    let motion = ssrms_motion();
    let simulation = Simulation {
        plant: &Ssrms,
        controller: Controller::new(&Ssrms, Compensation::none()),
        trajectory: &motion,
        wrench: |time: f64| Vector6::repeat(if time < 2.0 { 1.0 } else { f64::NAN }),
        feedback: Feedback::NONE,
        control: Control::Continuous,
        brake: Brake::none(),
        reflected_inertia: SVector::zeros(),
    };
    let (series, outcome) = simulation.record(0.0..5.0, &Resolution::default()).unwrap();
    assert_eq!(outcome.ending, Ending::NotFinite);
    assert!(outcome.balance.energy_error < 1e-8);
    let last = series.last().unwrap();
    assert!((1.98..=2.0).contains(&last.time), "{}", last.time);
}

#[test]
fn feedback_too_stiff_to_follow_ends_the_run() {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, Compensation::none(), 1e-3);
    simulation.brake.failure = lock(&[1], 10.0);
    simulation.feedback = Feedback::critical(1e9);
    let resolution = Resolution {
        tolerance: 1e-3,
        sample_period: 1.0,
        steps: 1000,
        ..Resolution::default()
    };
    let outcome = simulation.run(9.9..11.0, &resolution, |_| ()).unwrap();
    assert_eq!(outcome.ending, Ending::StepTooShort);
}

/// Where the motion alone comes to ask for more than the rated torque, cycle by cycle the compensation goes and comes back.
/// A sampled control lives with that; a continuous one has no motion there.
#[test]
fn the_controllers_worst_status_is_reported() {
    let motion = ssrms_motion();
    let resolution = Resolution {
        steps: 1000,
        ..Resolution::default()
    };
    let mut simulation = ssrms(&motion, cancelling(), 0.02);
    simulation.control = Control::Every(2e-3);
    let outcome = simulation.run(9.95..10.05, &resolution, |_| ()).unwrap();
    assert_eq!(outcome.status, Status::Nominal);

    simulation.controller = simulation
        .controller
        .with_rated_torque(SVector::repeat(410.0));
    let outcome = simulation.run(9.95..10.05, &resolution, |_| ()).unwrap();
    assert!(outcome.status >= Status::Saturated, "{:?}", outcome.status);
    assert_eq!(outcome.ending, Ending::Complete);
    assert!(outcome.balance.energy_error < 1e-8);
}

#[test]
fn a_sampled_control_tends_to_the_continuous_one() {
    let motion = oblique_motion();
    let end = |control| {
        let mut simulation = oblique(&motion, 1, 0.02);
        simulation.control = control;
        let mut q = SVector::zeros();
        simulation
            .run(1.15..1.3, &Resolution::default(), |sample| {
                q = sample.state.q;
            })
            .unwrap();
        q
    };
    let limit = end(Control::Continuous);
    let [coarse, fine] = [4e-3, 1e-3].map(|period| (end(Control::Every(period)) - limit).amax());
    assert!(fine < 0.3 * coarse && coarse < 1e-2, "{coarse} {fine}");
}

#[test]
fn between_two_cycles_motors_hold_their_torques() {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, cancelling(), 0.0);
    simulation.control = Control::Every(0.02);
    let resolution = Resolution {
        sample_period: 1e-3,
        ..Resolution::default()
    };
    let (series, _) = simulation.record(9.95..10.1, &resolution).unwrap();
    let mut torques: Vec<_> = series.iter().map(|sample| sample.motor).collect();
    torques.dedup();
    // At 9.95 s, 9.96 s, 9.98 s, 10 s, ... 10.08 s; the run ends with the cycle that would follow.
    assert_eq!(torques.len(), 8);
}
