//! The simulated lock as experiments have it: what its servo, its rotors and its projector come to, and the verdict over all of them.

use std::path::Path;
use std::sync::OnceLock;

use ulna::control::compensation::Projector;
use ulna::{Arm, LockedJoints, Trajectory};
use ulna_generated::Ssrms;
use ulna_study::experiment::{
    Campaign, ExperimentRunner, Rotors, SearchMethod, SimulatedLock, SimulatedRun, Sweep, Verdict,
};
use ulna_study::scenario::KnownArm;
use ulna_study::simulation::Ending;
use ulna_study::{LawName, Scenario};

const PAPER_LIKE: &str = include_str!("../../scenarios/paper_like.toml");
const KNOWN: &[KnownArm] = &[KnownArm {
    name: "ssrms",
    joints: &Ssrms::CHAIN.joints,
    joint_names: &Ssrms::JOINT_NAMES,
}];
const NONE: Rotors = Rotors::Common(0.0);

/// The paper-like scenario with `edits`, and with `servo` and `motors` in the place of its own.
fn scenario(edits: &[(&str, &str)], drives: &str) -> Scenario {
    let (text, _) = PAPER_LIKE.split_once("\n[servo]").unwrap();
    let text = edits.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "the scenario has no {from:?}");
        text.replacen(from, to, 1)
    });
    let text = format!("{text}\n{drives}");
    Scenario::parse(&text, "test.toml", Path::new("scenarios"), KNOWN)
        .unwrap_or_else(|errors| panic!("{errors}"))
}

fn simulated(scenario: &Scenario, time: f64) -> SimulatedLock {
    let runner = ExperimentRunner::new(&Ssrms, scenario).unwrap();
    runner
        .simulated_lock(&scenario.experiments()[0], time)
        .unwrap()
}

/// The paper-like scenario's locks.
fn simulations() -> &'static [SimulatedLock] {
    static SIMULATIONS: OnceLock<Vec<SimulatedLock>> = OnceLock::new();
    SIMULATIONS.get_or_init(|| {
        let scenario = scenario(&[], "");
        let times = scenario.failure_times().iter();
        times.map(|time| simulated(&scenario, *time)).collect()
    })
}

fn run(simulated: &SimulatedLock, method: Option<SearchMethod>) -> &SimulatedRun {
    simulated
        .runs
        .iter()
        .find(|run| run.method == method)
        .unwrap()
}

fn healthy_norm(torque: &[f64]) -> f64 {
    let healthy = torque.iter().enumerate().filter(|(joint, _)| *joint != 1);
    healthy
        .map(|(_, torque)| torque * torque)
        .sum::<f64>()
        .sqrt()
}

fn assert_close(value: f64, expected: f64, tolerance: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error <= tolerance, "{value}, not {expected}");
}

/// The lock at 10 s, over all gains and rotors.
fn sweep() -> &'static Sweep {
    static SWEEP: OnceLock<Sweep> = OnceLock::new();
    SWEEP.get_or_init(|| {
        let scenario = scenario(&[], "");
        let runner = ExperimentRunner::new(&Ssrms, &scenario).unwrap();
        runner.sweep(&scenario.experiments()[0], 10.0).unwrap()
    })
}

/// What another program found: without compensation, and with Eq. 16.
#[test]
fn the_step_that_is_felt_is_a_matter_of_the_gain() {
    let expected = [
        (0.0, 89.3, 824.1),
        (1.0, 90.8, 616.2),
        (5.0, 560.5, 605.1),
        (20.0, 939.7, 954.0),
    ];
    assert_eq!(sweep().gains, expected.map(|(gain, ..)| gain));
    for (gain, without, with) in expected {
        let felt = |method| sweep().felt(gain, &NONE, method).unwrap();
        assert_close(felt(None).step, without, 1e-3);
        assert_close(felt(Some(SearchMethod::PerJoint)).step, with, 1e-3);
        assert_close(felt(None).predicted_step, 42.87, 1e-3);
    }
}

#[test]
fn a_sweep_has_every_gain_and_rotors_and_the_scenarios_own() {
    let sweep = sweep();
    assert_eq!((sweep.own_gain, &sweep.own_rotors), (5.0, &NONE));
    let decades = [0.0, 1e2, 1e3, 1e4, 1e5].map(Rotors::Common);
    assert_eq!(sweep.rotors, decades);
    assert_eq!(sweep.points.len(), 4 * 5 * 4);
    assert!(sweep.points.iter().all(|point| point.felt.is_some()));
    // The same lock as in the truth of the scenario.
    let simulated = &simulations()[1];
    for method in [None, Some(SearchMethod::Optimal)] {
        let step = healthy_norm(&run(simulated, method).torque_step);
        assert_close(sweep.felt(5.0, &NONE, method).unwrap().step, step, 1e-6);
    }
}

#[test]
fn the_verdict_says_what_lowers_the_step() {
    let verdicts = Verdict::of(std::slice::from_ref(sweep()));
    assert_eq!(verdicts.len(), 4 * 5);
    let verdict = |gain: f64, rotors: &Rotors| {
        let mut verdicts = verdicts.iter();
        let found = verdicts.find(|verdict| verdict.gain == gain && verdict.rotors == *rotors);
        found.unwrap()
    };
    // Direct drives without feedback: two laws help, and Eq. 16 makes it nine times worse.
    let free = &verdict(0.0, &NONE).locks[0];
    assert_eq!(free.helps().unwrap().0, SearchMethod::Optimal);
    assert_close(free.ratio(SearchMethod::PerJoint).unwrap(), 9.23, 1e-2);
    assert!(free.lowers(SearchMethod::Projected) && !free.lowers(SearchMethod::PerJoint));
    // As the scenario has it none does.
    let own = verdict(5.0, &NONE);
    assert!(own.own && own.locks[0].helps().is_none() && own.locks[0].best().is_some());
    assert_eq!(verdicts.iter().filter(|verdict| verdict.own).count(), 1);
    // Geared joints: what is left of the step is what the rotors leave of U.
    let (_, left) = verdict(0.0, &Rotors::Common(1e5)).locks[0].helps().unwrap();
    assert!((0.95..0.99).contains(&left), "{left}");
}

#[test]
fn rotors_of_the_scenario_are_among_those_of_the_sweep() {
    let drives = "[motors]\nrotor_inertia = 2e-3\nratio = [100, 100, 100, 100, 50, 50, 50]\n[servo]\ngain = 2.5";
    let scenario = scenario(&[("cycle = 0.01", "cycle = 0.1")], drives);
    let runner = ExperimentRunner::new(&Ssrms, &scenario).unwrap();
    let sweep = runner.sweep(&scenario.experiments()[0], 3.0).unwrap();
    let own = Rotors::Own(vec![20.0, 20.0, 20.0, 20.0, 5.0, 5.0, 5.0]);
    assert_eq!(sweep.own_rotors, own);
    assert_eq!((&sweep.rotors[0], &sweep.rotors[1]), (&NONE, &own));
    // 20 rad/s are too many for 0.1 s.
    assert_eq!(sweep.gains, [0.0, 1.0, 2.5, 5.0]);
    assert_eq!(sweep.unstable_gains, [20.0]);
    let simulated = simulated(&scenario, 3.0);
    assert_eq!(simulated.gain, 2.5);
    let step = healthy_norm(&run(&simulated, None).torque_step);
    assert_close(sweep.felt(2.5, &own, None).unwrap().step, step, 1e-6);
    let light = sweep.felt(2.5, &NONE, None).unwrap().step;
    assert!((step / light - 1.0).abs() > 1e-3, "{step} {light}");
}

/// Eq. 1–12 have −q̈_k alone; here the rate's share, by M's column of the joint that stops.
#[test]
fn the_rates_share_of_a_brake_stands_beside_the_predicted_step() {
    for (simulated, expected) in simulations().iter().zip([340.3, 833.8, 288.6]) {
        assert_close(healthy_norm(&simulated.braking_step), expected, 1e-3);
        let scenario = scenario(&[], "");
        let runner = ExperimentRunner::new(&Ssrms, &scenario).unwrap();
        let state = runner.motion().state(simulated.failure_time);
        let column = Ssrms.mass_matrix(&state.q).column(1) * (-state.qd[1] / 0.1);
        for (step, expected) in simulated.braking_step.iter().zip(column.iter()) {
            assert!((step - expected).abs() < 1e-9);
        }
    }
}

#[test]
fn what_eq_16_does_to_the_tool_is_what_another_program_found() {
    for (simulated, expected) in simulations().iter().zip([2.816, 4.965, 0.1112]) {
        assert_eq!(run(simulated, None).tool_acceleration, 0.0);
        let found = run(simulated, Some(SearchMethod::PerJoint)).tool_acceleration;
        assert_close(found, expected, 1e-3);
    }
}

/// With the dynamically consistent projector Eq. 20 leaves the tool alone in motion, and no longer at rest; searches, rollouts, campaigns
/// and the simulated controllers all have it.
#[test]
fn the_projector_reaches_searches_rollouts_and_simulations() {
    let quick = [("cycle = 0.01", "cycle = 0.1")];
    let consistent = "[servo]\nprojector = \"dynamically_consistent\"";
    let scenarios = ["", consistent].map(|servo| scenario(&quick, servo));
    let [resting, moving] = scenarios.each_ref().map(|scenario| {
        let runner = ExperimentRunner::new(&Ssrms, scenario).unwrap();
        runner.study(&scenario.experiments()[0], 10.0).unwrap()
    });
    let method = SearchMethod::Projected;
    assert!(resting.case(method).force_error < 1e-6);
    assert!(moving.case(method).force_error > 0.1);
    // The rollout's step at the lock is the search's.
    let case = moving.case(method);
    let series = &case.rollout.series;
    let lock = series.time.iter().position(|time| *time == 10.0).unwrap();
    for joint in 0..7 {
        let step = series.torque[lock + 1][joint] - series.torque[lock][joint];
        assert!((step.abs() - case.impact_after[joint]).abs() < 1e-7);
    }
    let at_rest = &simulations()[1];
    let in_motion = simulated(&scenario(&[], consistent), 10.0);
    assert_eq!(at_rest.projector, Projector::Static);
    assert_eq!(in_motion.projector, Projector::DynamicallyConsistent);
    for simulated in [at_rest, &in_motion] {
        assert!(simulated.unfinished.is_empty() && simulated.runs.len() == 4);
    }
    assert!(run(at_rest, Some(method)).tool_acceleration > 0.1);
    assert!(run(&in_motion, Some(method)).tool_acceleration < 1e-9);
    let [a, b] = scenarios.each_ref().map(|scenario| {
        let case = Campaign::new(&Ssrms, scenario).unwrap().case(29);
        let outcome = case.outcome.unwrap();
        outcome.law(LawName::Projected).unwrap().unwrap().impact
    });
    assert!((a / b - 1.0).abs() > 1e-6, "{a} {b}");
}

/// With the dynamically consistent projector Eq. 16 takes kilonewton metres, and 16 times as many of a motion 4 times as fast.
#[test]
fn a_compensation_that_flings_the_arm_off_is_named_and_the_others_are_simulated() {
    let mut faster = vec![
        ("duration = 20.0", "duration = 5.0"),
        ("blend = 4.455", "blend = 1.11375"),
        ("times = [3.0, 10.0, 18.0]", "times = [2.5]"),
    ];
    let told = PAPER_LIKE.matches("\ntime = 10.0").count();
    faster.extend(vec![("\ntime = 10.0", "\ntime = 2.5"); told]);
    let servo = "[servo]\nprojector = \"dynamically_consistent\"";
    let simulated = simulated(&scenario(&faster, servo), 2.5);
    let flung = [(SearchMethod::PerJoint, Ending::StepTooShort)];
    assert_eq!(simulated.unfinished, flung);
    let methods: Vec<_> = simulated.runs.iter().map(|run| run.method).collect();
    let simulated = [
        None,
        Some(SearchMethod::Projected),
        Some(SearchMethod::Optimal),
    ];
    assert_eq!(methods, simulated);
}

/// Until the controller knows, the motor of the joint that fails goes on.
#[test]
fn detection_and_lead_reach_the_simulation() {
    let at_once = &simulations()[1];
    let late = simulated(
        &scenario(&[], "[servo]\ndetection = 0.2\nlead = 0.05"),
        10.0,
    );
    assert_eq!((at_once.detection, at_once.lead), (0.0, 0.25));
    assert_eq!((late.detection, late.lead), (0.2, 0.05));
    assert!((run(&late, None).time[0] - 9.95).abs() < 1e-9);
    assert!((run(at_once, None).time[0] - 9.75).abs() < 1e-9);
    // The step counts to when the controller knows: later, and another.
    let steps = [at_once, &late].map(|simulated| healthy_norm(&run(simulated, None).torque_step));
    assert!((steps[0] / steps[1] - 1.0).abs() > 0.05, "{steps:?}");
    // What stops the joint in no time is the same impulse, known or not.
    let impulse = |simulated: &SimulatedLock| simulated.convergence.last().unwrap().impulse[0];
    assert_close(impulse(&late), impulse(at_once), 1e-3);
    // At the motion's begin there is nothing before.
    let early = simulated(&scenario(&[], ""), 0.1);
    assert_eq!(early.lead, 0.1);
    let joints = LockedJoints::<7>::new(&early.failed_joints).unwrap();
    assert!(joints.contains(1) && run(&early, None).time[0] == 0.0);
}
