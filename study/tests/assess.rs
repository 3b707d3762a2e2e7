//! Every law over failures for which it was not tuned.

use ulna_generated::Ssrms;
use ulna_study::Scenario;
use ulna_study::assess::{AssessedCase, Assessment, FailureGrid, Law, LawAssessment};
use ulna_study::scenario::KnownArm;

/// The paper-like scenario on a coarse grid.
fn assessment(failure_times: u32, locks_at_once: u32) -> Assessment {
    let text = std::fs::read_to_string("../scenarios/paper_like.toml").unwrap();
    let (paper, _) = text.split_once("[assess]").unwrap();
    let text = format!(
        "{paper}[assess]\nfailure_times = {failure_times}\nlocks_at_once = {locks_at_once}\n\
         force_budgets = [0.0, 5.0]\nrated_torque = 600.0\n"
    );
    let known = [KnownArm {
        name: "ssrms",
        joints: &Ssrms::CHAIN.joints,
        joint_names: &Ssrms::JOINT_NAMES,
    }];
    let scenario = Scenario::parse(&text, "text", "".as_ref(), &known).unwrap();
    let grid = FailureGrid::new(&Ssrms, &scenario).unwrap();
    let laws = grid.laws().unwrap();
    let cases = (0..grid.len()).map(|failure| grid.cases(&laws, failure).unwrap());
    Assessment::new(&laws, cases.collect())
}

fn of(assessment: &Assessment, law: Law, budget: Option<f64>) -> &LawAssessment {
    let mut laws = assessment.laws.iter();
    laws.find(|entry| entry.law == law && entry.force_budget == budget)
        .unwrap()
}

fn at(law: &LawAssessment, joint: usize, time: f64) -> &AssessedCase {
    let mut cases = law.cases.iter();
    cases
        .find(|case| case.joints == [joint] && case.time == time)
        .unwrap()
}

#[test]
fn coefficients_cancel_what_they_were_tuned_for_and_make_others_worse() {
    // 10 s is the middle one of three times. Joint 7 has no coefficient, and 0.0004 N m of its own.
    let found = assessment(3, 1);
    let eq16 = of(&found, Law::PerJoint, None);
    let own = at(eq16, 1, 10.0);
    assert!(own.before > 42.0 && own.after < 1e-3, "{own:?}");
    assert!((own.force_error_at_lock - 14.0).abs() < 1.0);
    assert!((own.force_error - 262.0).abs() < 5.0, "{}", own.force_error);
    // Joint 6 at 10 s: 0.73 to 48.55 N m.
    let other = at(eq16, 5, 10.0);
    assert!((other.before - 0.73).abs() < 0.01 && (other.after - 48.55).abs() < 0.01);
    assert!(eq16.singles.share_worse > 0.4 && eq16.singles.worst_ratio > 50.0);
    let grown = eq16.cases.iter().filter(|case| case.after > case.before);
    assert!(grown.clone().all(|case| case.grown.is_some()));
}

#[test]
fn nothing_that_keeps_the_force_is_below_the_limit() {
    let found = assessment(2, 2);
    let limit = of(&found, Law::Limit, None);
    for (law, budget) in [
        (Law::Projected, None),
        (Law::AfterOnly, Some(0.0)),
        (Law::OnLine, Some(0.0)),
        (Law::Robust, Some(0.0)),
    ] {
        let law = of(&found, law, budget);
        assert_eq!(law.cases.len(), limit.cases.len());
        for (case, least) in law.cases.iter().zip(&limit.cases) {
            assert_eq!((&case.joints, case.time), (&least.joints, least.time));
            assert!(case.force_error < 1e-6, "{:?}: {case:?}", law.law);
            assert!(case.after >= least.after - 1e-5 * (1.0 + least.after));
        }
    }
    let none = of(&found, Law::None, None);
    assert_eq!(
        (none.singles.worst_ratio, none.singles.share_worse),
        (1.0, 0.0)
    );
}

#[test]
fn the_robust_law_keeps_its_budget_and_makes_no_single_lock_worse() {
    let found = assessment(4, 1);
    for budget in [0.0, 5.0] {
        let law = of(&found, Law::Robust, Some(budget));
        assert!(law.singles.worst_force_error <= budget + 1e-6);
        assert!(
            law.singles.worst_ratio <= 1.0 + 1e-4,
            "{}",
            law.singles.worst_ratio
        );
        assert!(law.singles.least_margin >= -1e-6);
    }
    let (bent, exact) = (
        of(&found, Law::Robust, Some(5.0)),
        of(&found, Law::Robust, Some(0.0)),
    );
    assert!(bent.singles.median_ratio < 0.9 * exact.singles.median_ratio);
}

#[test]
fn figures_of_merit_are_those_of_the_cases() {
    let found = assessment(2, 1);
    let eq20 = of(&found, Law::Projected, None);
    let mut ratios: Vec<_> = eq20
        .cases
        .iter()
        .filter_map(|case| case.ratio(found.largest))
        .collect();
    ratios.sort_by(f64::total_cmp);
    // Joint 7 makes no step.
    assert_eq!((ratios.len(), eq20.singles.count), (12, 12));
    assert_eq!(eq20.singles.worst_ratio, ratios[11]);
    assert_eq!(eq20.singles.median_ratio, 0.5 * (ratios[5] + ratios[6]));
    // A twentieth of 12, rounded up.
    assert_eq!(eq20.singles.cvar, ratios[11]);
    let worse = ratios.iter().filter(|ratio| **ratio > 1.0 + 1e-9).count();
    assert_eq!(eq20.singles.share_worse, worse as f64 / 12.0);
}
