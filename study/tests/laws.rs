//! Laws by name: what a scenario chooses, and what a campaign and an assessment make of the choice.

use std::path::Path;

use ulna::control::compensation::{Compensation, FreeTorque, OnLine};
use ulna::control::failure::{Failure, LockedJoints};
use ulna::nalgebra::{SVector, Vector6};
use ulna_generated::Ssrms;
use ulna_study::assess::{Assessment, FailureGrid};
use ulna_study::experiment::{
    Campaign, CampaignOutcome, CampaignResult, ExperimentRunner, after_only,
};
use ulna_study::scenario::{KnownArm, ScenarioErrors};
use ulna_study::search::{
    Field, ForcePriority, Objective, Operation, OperationOptions, SearchError, cancel_per_joint,
    least_impact, optimal,
};
use ulna_study::{LawName, LawSet, Scenario};

const PAPER_LIKE: &str = include_str!("../../scenarios/paper_like.toml");

fn parse(text: &str) -> Result<Scenario, ScenarioErrors> {
    let known = [KnownArm {
        name: "ssrms",
        joints: &Ssrms::CHAIN.joints,
        joint_names: &Ssrms::JOINT_NAMES,
    }];
    Scenario::parse(text, "laws.toml", Path::new(""), &known)
}

/// The paper-like scenario with `campaign` and `assess` as its last keys of these tables, and other `edits`.
fn written(campaign: &str, assess: &str, edits: &[(&str, &str)]) -> String {
    let mut text = PAPER_LIKE.to_owned();
    let campaign = format!("[campaign]\n{campaign}\n");
    let assess = format!("[assess]\n{assess}\n");
    let tables = [("[campaign]\n", &*campaign), ("[assess]\n", &*assess)];
    for (from, to) in tables.iter().chain(edits) {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    text
}

fn scenario(campaign: &str, assess: &str, edits: &[(&str, &str)]) -> Scenario {
    parse(&written(campaign, assess, edits)).unwrap()
}

const OF_CAMPAIGNS: [LawName; 6] = [
    LawName::PerJoint,
    LawName::Projected,
    LawName::Kinematic,
    LawName::AfterOnly,
    LawName::OnLine,
    LawName::Limit,
];

#[test]
fn a_scenario_that_does_not_say_has_all_laws() {
    let plain = parse(PAPER_LIKE).unwrap();
    assert!(plain.campaign().laws().iter().eq(OF_CAMPAIGNS));
    assert_eq!(plain.assess().laws(), LawSet::ALL);
}

#[test]
fn laws_are_a_set_whatever_their_order() {
    let chosen = scenario(
        "laws = [\"limit\", \"eq16\"]",
        "laws = [\"on_line\", \"none\", \"eq20\"]",
        &[],
    );
    let laws: Vec<_> = chosen.campaign().laws().iter().collect();
    assert_eq!(laws, [LawName::PerJoint, LawName::Limit]);
    // What the others are measured against is there unsaid.
    let laws: Vec<_> = chosen.assess().laws().iter().map(LawName::name).collect();
    assert_eq!(laws, ["none", "eq20", "on_line", "limit"]);
}

/// All at once, each at its place and with what to write.
#[test]
fn wrong_laws_are_refused_with_the_words_that_there_are() {
    let text = written(
        "laws = [\"eq16\", \"robust\", \"eq20_constant\", \"none\", \"eq16\", \"optimal\"]",
        "laws = [\"on_lin\", \"robust\", \"robust\", 3]",
        &[],
    );
    let errors = parse(&text).unwrap_err().to_string();
    for part in [
        "item 2 of `laws` of [campaign] cannot be \"robust\"",
        "item 3 of `laws` of [campaign] cannot be \"eq20_constant\"",
        "it is made for all failures of one motion, and each case has a motion of its own",
        "item 4 of `laws` of [campaign] cannot be \"none\"",
        "what no law leaves is always there, as `before`",
        "item 5 of `laws` of [campaign] is \"eq16\" once more",
        "leave it out; there are \"eq16\", \"eq20\", \"kinematic\", \"after_only\", \"on_line\", \"limit\"",
        "item 6 of `laws` of [campaign] cannot be \"optimal\"",
        "item 1 of `laws` of [assess] cannot be \"on_lin\"",
        "did you mean \"on_line\"?",
        "item 3 of `laws` of [assess] is \"robust\" once more",
        "\"eq16_constant\", \"eq20_constant\", \"after_only\", \"on_line\", \"robust\", \"limit\"",
        "item 4 of `laws` of [assess] must be a string, not an integer",
    ] {
        assert!(errors.contains(part), "{part} is missing in:\n{errors}");
    }
    let text = written("laws = []", "laws = \"eq16\"", &[]);
    let errors = parse(&text).unwrap_err().to_string();
    for part in [
        "`laws` of [campaign] is empty",
        "write `laws = [\"eq16\", \"on_line\"]`",
        "`laws` of [assess] must be an array of strings, not a string",
    ] {
        assert!(errors.contains(part), "{part} is missing in:\n{errors}");
    }
}

fn result(scenario: &Scenario, index: u64) -> CampaignResult {
    let campaign = Campaign::new(&Ssrms, scenario).unwrap();
    campaign.case(index).outcome.unwrap()
}

const LIMITED: (&str, &str) = (
    "rated_torque = \"none\" ",
    "rated_torque = [730.0, 1000.0, 1035.0, 795.0, 170.0, 80.0, 80.0] ",
);
const CONSISTENT: (&str, &str) = (
    "projector = \"static\" ",
    "projector = \"dynamically_consistent\" ",
);

#[test]
fn a_laws_outcome_does_not_depend_on_the_others() {
    for edits in [&[][..], &[LIMITED], &[CONSISTENT]] {
        let all = scenario("", "", edits);
        for index in [1, 24, 60] {
            let all = result(&all, index);
            for law in OF_CAMPAIGNS {
                let alone = scenario(&format!("laws = [{:?}]", law.name()), "", edits);
                let alone = result(&alone, index);
                assert_eq!(alone.law(law), all.law(law), "{law}, case {index}");
                assert_eq!((alone.before, alone.laws.len()), (all.before, 1));
                assert_eq!(alone.law(LawName::None), None);
            }
        }
    }
}

/// The motion itself, under no force: what a campaign says of it, against searches over the whole of it that are written out here.
#[test]
fn a_campaign_says_what_the_searches_say() {
    let still = [
        ("start_spread = 0.5 ", "start_spread = 0.0 "),
        ("goal_spread = 0.5 ", "goal_spread = 0.0 "),
        ("force_spread = 20.0 ", "force_spread = 0.0 "),
        ("failure_times = 20 ", "failure_times = 1 "),
    ];
    for edit in [None, Some(LIMITED), Some(CONSISTENT)] {
        let edits: Vec<_> = still.iter().copied().chain(edit).collect();
        let scenario = scenario("", "", &edits);
        let runner = ExperimentRunner::new(&Ssrms, &scenario).unwrap();
        let rated = scenario.experiments()[0].rated_torque();
        for joint in [0, 1, 5] {
            let found = result(&scenario, joint as u64);
            let failure = Failure {
                joints: LockedJoints::<7>::new(&[joint]).unwrap(),
                time: 10.0,
            };
            let options = OperationOptions {
                sample_period: 0.2,
                rated_torque: rated
                    .map_or(SVector::repeat(f64::INFINITY), SVector::from_column_slice),
                projector: scenario.servo().projector(),
                ..OperationOptions::default()
            };
            let operation = |options: &OperationOptions<7>| {
                let none = |_| Vector6::zeros();
                Operation::new(&Ssrms, runner.motion(), none, &failure, options).unwrap()
            };
            let kinematic = operation(&OperationOptions {
                field: Field::KinematicManipulability,
                ..options
            });
            let operation = operation(&options);
            let on_line = on_line(&operation, &runner);
            let expected = |law: LawName| -> Result<_, SearchError> {
                Ok(match law {
                    LawName::PerJoint => cancel_per_joint(&operation)?.assessment,
                    LawName::Projected => {
                        least_impact(&operation, Objective::LeastSquares)?.assessment
                    }
                    LawName::Kinematic => cancel_per_joint(&kinematic)?.assessment,
                    LawName::AfterOnly => operation.assess(&after_only(&operation)),
                    LawName::OnLine => operation.assess(&on_line),
                    _ => optimal(&operation, ForcePriority::Exact)?.assessment,
                })
            };
            for law in OF_CAMPAIGNS {
                let expected = expected(law);
                let found = found.law(law).unwrap();
                // With limits what acts before the lock is cut as it changes, and with the other projector it is another.
                if law == LawName::OnLine && edit.is_some() {
                    continue;
                }
                match (found, &expected) {
                    (Ok(found), Ok(expected)) => {
                        let expected = [
                            expected.healthy_impact,
                            expected.force_error(),
                            expected.max_force_error,
                        ];
                        assert_close(found, expected, &format!("{law}, joint {joint}, {edit:?}"));
                    }
                    (Err(found), Err(expected)) => assert_eq!(found, expected),
                    _ => panic!("{law}, joint {joint}: {found:?}, {expected:?}"),
                }
            }
        }
    }
}

/// At the lock it is a free torque on each side.
fn on_line(operation: &Operation<7>, runner: &ExperimentRunner<'_, 7>) -> Compensation<7> {
    let law = OnLine::equal();
    let before = operation.before();
    let state = ulna::Trajectory::state(runner.motion(), before.time);
    let u = law.compensation(&Ssrms, &state, &before.pose, LockedJoints::NONE);
    assert!(u.norm() > 0.1);
    Compensation::Optimal {
        before: FreeTorque {
            torque: u,
            wrench: Vector6::zeros(),
        },
        after: operation.recourse(&u, law.force_budget),
    }
}

fn assert_close(found: &CampaignOutcome, expected: [f64; 3], what: &str) {
    let values = [found.impact, found.force_error, found.max_force_error];
    for (found, expected) in values.into_iter().zip(expected) {
        let error = (found - expected).abs();
        assert!(
            error <= 1e-9 * (1.0 + expected),
            "{what}: {found} {expected}"
        );
    }
}

/// Over random motions: nothing that keeps the force is below the limit, and only Eq. 16 bends it.
#[test]
fn laws_stand_to_each_other_as_they_must() {
    let scenario = scenario("", "", &[]);
    let (mut cases, mut cancelled, mut kinematic_differs) = (0, [0, 0], 0);
    for index in 0..35 {
        let result = result(&scenario, index);
        let of = |law| *result.law(law).unwrap().as_ref().unwrap();
        let limit = of(LawName::Limit).impact;
        for law in OF_CAMPAIGNS.into_iter().filter(|law| !law.bends_force()) {
            let found = of(law);
            assert!(found.max_force_error < 1e-8, "{law}, case {index}");
            // An impact is what is left of torques of some hundred N·m, and joint 7's is nothing beside their rounding.
            let least = limit * (1.0 - 1e-9) - 1e-12;
            assert!(found.impact >= least, "{law}, case {index}");
        }
        assert!(of(LawName::AfterOnly).impact <= result.before * (1.0 + 1e-9));
        let (eq16, kinematic) = (of(LawName::PerJoint), of(LawName::Kinematic));
        for law in [eq16, kinematic] {
            assert!(law.impact <= result.before * (1.0 + 1e-9));
            assert!(law.force_error <= law.max_force_error * (1.0 + 1e-12));
        }
        // Joint 7 has no coefficient and no step.
        if result.before > 0.01 {
            cases += 1;
            for (count, law) in cancelled.iter_mut().zip([eq16, kinematic]) {
                *count += u32::from(law.impact < 1e-3 * result.before);
            }
            let ratio = kinematic.max_force_error / eq16.max_force_error;
            kinematic_differs += u32::from((ratio - 1.0).abs() > 0.1);
        }
    }
    // Where a coefficient is not worth its effort the joint is left alone.
    let most = cases * 2 / 3;
    assert!(
        cases >= 25 && cancelled.iter().all(|count| *count >= most),
        "{cancelled:?}"
    );
    assert!(kinematic_differs >= most, "{kinematic_differs}");
}

/// Where the limits leave a law nothing, the others have their outcomes still.
#[test]
fn a_law_without_room_says_so_by_itself() {
    let scenario = scenario(
        "",
        "",
        &[("rated_torque = \"none\" ", "rated_torque = 300.0 ")],
    );
    let found = result(&scenario, 1);
    assert!(found.before > 0.0);
    assert!(matches!(
        found.law(LawName::PerJoint),
        Some(Err(SearchError::Empty { .. }))
    ));
    assert!(matches!(found.law(LawName::AfterOnly), Some(Ok(_))));
    assert!(matches!(found.law(LawName::OnLine), Some(Ok(_))));
}

#[test]
fn an_assessment_of_chosen_laws_says_of_them_what_that_of_all_says() {
    let coarse = [
        ("failure_times = 79 ", "failure_times = 2 "),
        ("locks_at_once = 2 ", "locks_at_once = 1 "),
        (
            "force_budgets = [0.0, 2.0, 5.0, 10.0] ",
            "force_budgets = [0.0] ",
        ),
    ];
    let assessment = |laws: &str| {
        let scenario = scenario("", laws, &coarse);
        let grid = FailureGrid::new(&Ssrms, &scenario).unwrap();
        let laws = grid.laws().unwrap();
        let cases = (0..grid.len()).map(|failure| grid.cases(&laws, failure).unwrap());
        Assessment::new(&laws, cases.collect())
    };
    let all = assessment("");
    let names: Vec<_> = all.laws.iter().map(|law| law.law).collect();
    assert_eq!(names, LawName::ALL);
    let some = assessment("laws = [\"on_line\", \"kinematic\"]");
    let names: Vec<_> = some.laws.iter().map(|law| law.law.name()).collect();
    assert_eq!(names, ["none", "kinematic", "on_line", "limit"]);
    for law in &some.laws {
        assert_eq!(law.cases, all.law(law.law).unwrap().cases);
    }
}
