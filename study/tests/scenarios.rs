//! Scenario files: what a good one says, and every error of a bad one at once, each at its line.

use std::path::Path;

use proptest::prelude::*;
use ulna::control::compensation::Projector;
use ulna::nalgebra::Vector6;
use ulna::{ProfileShape, SerialChain, Trajectory};
use ulna_study::Scenario;
use ulna_study::scenario::{KnownArm, MotionPath, ScenarioArm, ScenarioErrors, ToolForce};
use ulna_table::Model;

const PAPER_LIKE: &str = include_str!("../../scenarios/paper_like.toml");

/// The arms of `arms/`, as a program knows them that was compiled with them.
fn known() -> Vec<KnownArm> {
    ["ssrms", "oblique_6"]
        .into_iter()
        .map(|name| {
            let model = Model::load(format!("../arms/{name}.toml")).unwrap();
            KnownArm {
                name,
                joints: model.description().joints.leak(),
                joint_names: &[],
            }
        })
        .collect()
}

fn parse(text: &str) -> Result<Scenario, ScenarioErrors> {
    Scenario::parse(
        text,
        "scenarios/bad.toml",
        Path::new("../scenarios"),
        &known(),
    )
}

/// The scenario with the first of each `from` replaced by `to`.
fn edited(edits: &[(&str, &str)]) -> String {
    edits
        .iter()
        .fold(PAPER_LIKE.to_owned(), |text, (from, to)| {
            assert!(text.contains(from), "the scenario has no {from:?}");
            text.replacen(from, to, 1)
        })
}

/// The messages for each edit, one after the other.
fn messages(edits: &[(&str, &str)]) -> String {
    let blocks = edits.iter().map(|edit| {
        let (from, to) = edit;
        let title = format!("{from:.60} -> {to:.60}").replace('\n', "\\n");
        let errors = parse(&edited(&[*edit])).expect_err("the scenario should be refused");
        format!("==== {title}\n\n{errors}\n")
    });
    blocks.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_paper_like_scenario_is_that_of_the_notes() {
    let scenario = Scenario::load("../scenarios/paper_like.toml", &known()).unwrap();
    assert_eq!(scenario.name(), "paper_like");
    assert_eq!(scenario.arm().name(), "ssrms");
    assert_eq!(scenario.failed_joints(), [1]);
    assert_eq!(scenario.failure_times(), [3.0, 10.0, 18.0]);
    // q = the DH angles minus theta of the table's rows.
    let quarter = std::f64::consts::FRAC_PI_2;
    let theta = [0.0, quarter, 0.0, 0.0, 0.0, -quarter, 0.0];
    let start = [0.0, 0.601, -0.895, -2.108, -1.398, 1.437, 0.0];
    let travel = [1.474, 0.689, -4.400, 0.273, -3.284, 0.820, 0.0];
    let MotionPath::Joint(goal) = &scenario.motion().path() else {
        panic!("a joint motion");
    };
    for i in 0..7 {
        assert!((scenario.motion().start()[i] - (start[i] - theta[i])).abs() < 1e-15);
        assert!((goal[i] - scenario.motion().start()[i] - travel[i]).abs() < 1e-12);
    }
    let constant = &scenario.experiments()[0];
    assert_eq!(constant.section(), "5.2");
    assert_eq!(constant.rated_torque(), None);
    let wrench = Vector6::new(20.0, 20.0, 20.0, 0.0, 0.0, 0.0);
    assert_eq!(
        *constant.force(),
        ToolForce::constant(&wrench).without_moment()
    );
    assert_eq!(constant.references().len(), 3);
    assert_eq!(constant.references()[0].before()[1], Some(66.72));
    assert_eq!(constant.references()[0].failed_joints(), Some(&[1][..]));
}

trait WithoutMoment {
    fn without_moment(self) -> Self;
}

impl WithoutMoment for ToolForce {
    fn without_moment(mut self) -> Self {
        self.coefficients[3..].fill(Vec::new());
        self
    }
}

#[test]
fn every_shipped_scenario_is_sound() {
    let mut count = 0;
    for entry in std::fs::read_dir("../scenarios").unwrap() {
        let path = entry.unwrap().path();
        if let Err(errors) = Scenario::load(&path, &known()) {
            panic!("{errors}");
        }
        count += 1;
    }
    assert!(count >= 2);
}

#[test]
fn positions_are_read_in_either_unit_from_either_zero() {
    let plan = |edits: &[(&str, &str)]| parse(&edited(edits)).unwrap().motion().clone();
    let radians = plan(&[]);
    let from_q = plan(&[("angles = \"dh\"", "angles = \"q\"")]);
    assert!((from_q.start()[1] - 0.601).abs() < 1e-15 && (radians.start()[1] - 0.601).abs() > 1.0);
    let degrees = plan(&[
        ("angle_unit = \"rad\"", "angle_unit = \"deg\""),
        ("angles = \"dh\"", "angles = \"q\""),
        ("start = [0.0, 0.601", "start = [90.0, 0.601"),
        (
            "[failure]",
            "max_velocity = [90, 90, 90, 90, 90, 90, 90]\n[failure]",
        ),
    ]);
    let quarter = std::f64::consts::FRAC_PI_2;
    assert!((degrees.start()[0] - quarter).abs() < 1e-15);
    assert_eq!(degrees.max_velocity(), [quarter; 7]);
    assert_eq!(degrees.max_acceleration(), [f64::INFINITY; 7]);
}

#[test]
fn a_table_stands_in_for_a_known_arm() {
    let text = edited(&[("arm = \"ssrms\"", "arm = \"../arms/ssrms.toml\"")]);
    let by_table = parse(&text).unwrap();
    let by_name = parse(PAPER_LIKE).unwrap();
    let ScenarioArm::Table { path, model } = by_table.arm() else {
        panic!("a table");
    };
    assert_eq!(path, Path::new("../scenarios/../arms/ssrms.toml"));
    assert_eq!(model.name(), "ssrms");
    assert_eq!(by_table.motion(), by_name.motion());
    let chain = SerialChain::<7>::try_from(model.as_ref()).unwrap();
    let motion = by_table.motion().plan(&chain, 0.05).unwrap();
    assert_eq!(motion.duration(), 20.0);
    let other =
        SerialChain::<6>::try_from(&Model::load("../arms/oblique_6.toml").unwrap()).unwrap();
    let refusal = by_table.motion().plan(&other, 0.05).unwrap_err();
    assert_eq!(
        refusal.to_string(),
        "the motion is for 7 joints, the arm has 6"
    );
}

#[test]
fn a_campaign_is_changed_within_its_bounds() {
    let scenario = parse(PAPER_LIKE).unwrap();
    let changed = scenario.clone().with_seed(7).with_cases(1).unwrap();
    let campaign = changed.campaign();
    assert_eq!((campaign.seed(), campaign.cases()), (7, 1));
    for cases in [0, 1_000_000_000_001] {
        let refusal = scenario.clone().with_cases(cases).unwrap_err();
        let expected = format!("a campaign of {cases} cases: it must have 1 to 1000000000000");
        assert_eq!(refusal.to_string(), expected);
    }
}

#[test]
fn forces_are_polynomials_of_time() {
    let text = edited(&[(
        "force = [20.0, 20.0, 20.0]",
        "force = [[0, 4, 0.2], 5, []]\nmoment = [0, 0, [1, -1]]",
    )]);
    let scenario = parse(&text).unwrap();
    let force = scenario.experiments()[0].force();
    assert_eq!(force.at(10.0), Vector6::new(60.0, 5.0, 0.0, 0.0, 0.0, -9.0));
    assert!(!force.is_constant());
}

#[test]
fn a_reference_may_say_which_joints_lock_there() {
    let of = |written: &str| {
        let text = edited(&[("time = 10.0\nfailed_joints = [2]", written)]);
        let scenario = parse(&text)?;
        let reference = &scenario.experiments()[0].references()[0];
        Ok::<_, ScenarioErrors>(reference.failed_joints().map(<[usize]>::to_vec))
    };
    assert_eq!(
        of("time = 10.0\nfailed_joints = [4, 2]").unwrap(),
        Some(vec![1, 3])
    );
    assert_eq!(of("time = 10.0\n#").unwrap(), None);
    let refusal = of("time = 10.0\nfailed_joints = [8]").unwrap_err();
    assert!(
        refusal.to_string().contains(
            "item 1 of `failed_joints` of reference 1 of experiment 1 is no joint of the arm"
        ),
        "{refusal}"
    );
}

#[test]
fn keys_and_types() {
    let messages = messages(&[
        ("cycle = 0.01", "cylce = 0.01"),
        ("\n[motion]", "\n[motions]"),
        ("kind = \"joint\"", "kind = \"joints\""),
        ("kind = \"joint\"", "kind = \"tool\""),
        ("goal = [1.474", "goal = \"home\" # [1.474"),
        ("rated_torque = \"none\"", "rated_torque = \"nine\""),
        ("[[experiment.reference]]", "[experiment.reference]"),
        ("times = [3.0, 10.0, 18.0]", "times = 3.0"),
        ("section = \"5.2\"", "section = 5.2"),
        ("title = \"constant force\"", "title = \"\\u001b[31mred\""),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn a_table_is_told_from_a_scenario() {
    let table = include_str!("../../arms/ssrms.toml");
    insta::assert_snapshot!(parse(table).unwrap_err());
}

#[test]
fn one_bracket_too_few() {
    let single = PAPER_LIKE.replace("[[experiment]]", "[experiment]");
    let orphan = PAPER_LIKE.replacen("[[experiment]]", "", 1);
    let messages = [single, orphan].map(|text| parse(&text).unwrap_err().to_string());
    insta::assert_snapshot!(messages.join("\n\n"));
}

#[test]
fn joints_and_lengths() {
    let messages = messages(&[
        ("start = [0.0, ", "start = ["),
        ("start = [0.0, ", "start = [400.0, "),
        ("joints = [2]", "joints = [0, 2, 2, 8, 1.5]"),
        ("joints = [2]", "joints = []"),
        ("before = [30.18, ", "before = ["),
        ("force = [20.0, ", "force = ["),
        ("rated_torque = \"none\"", "rated_torque = [300.0, -300.0]"),
        ("rated_torque = \"none\"", "rated_torque = -300.0"),
        (
            "[failure]",
            "max_velocity = [0, 1, 1, 1, 1, 1, 1]\n[failure]",
        ),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn times_and_steps() {
    let messages = messages(&[
        (
            "times = [3.0, 10.0, 18.0]",
            "times = [3.0, -1.0, 20.0, 3.0]",
        ),
        ("times = [3.0, 10.0, 18.0]", "times = [3.0, 3.0]"),
        ("blend = 4.455", "blend = 10.1"),
        ("duration = 20.0", "duration = 0.0"),
        ("cycle = 0.01", "cycle = 1e-5"),
        ("step = 1e6", "step = 0"),
        (
            "step = 1e6",
            "step = 1e6\n[campaign]\ncases = 0\nseed = -1\nstart_spread = -1.0",
        ),
        (
            "[[experiment]]",
            "[[experiment]]\nsection = \"5.2\"\nforce = [0, 0, 0]\nrated_torque = \"table\"\n[[experiment]]",
        ),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn profiles_and_lock_steps() {
    let s_curve = |jerk_time: &str| {
        let written = format!("profile = \"s_curve\"\n{jerk_time}");
        let scenario = parse(&edited(&[("profile = \"trapezoid\"", &written)])).unwrap();
        scenario.motion().profile().shape()
    };
    assert_eq!(s_curve(""), ProfileShape::s_curve(4.455));
    assert_eq!(
        s_curve("jerk_time = 1.0"),
        ProfileShape::SCurve { jerk_time: 1.0 }
    );
    // A scenario that does not say has a trapezoid.
    let unsaid = parse(&edited(&[("profile = \"trapezoid\"", "")])).unwrap();
    assert_eq!(unsaid, parse(PAPER_LIKE).unwrap());
    let messages = messages(&[
        ("profile = \"trapezoid\"", "profile = \"trapezoidal\""),
        (
            "profile = \"trapezoid\"",
            "profile = \"quintic\"\njerk_time = 1.0",
        ),
        (
            "profile = \"trapezoid\"",
            "profile = \"s_curve\"\njerk_time = 2.3",
        ),
        ("[failure]", "max_jerk = [0, 1, 1, 1, 1, 1, 1]\n[failure]"),
        ("step_time = 0.0 ", "step_time = 2.5 "),
        ("step_time = 0.01 ", "step_time = -0.01 "),
        ("step_time = 0.01 ", "step_time = 3 "),
        ("force_step = [0.0, 0.0, 0.0]", "force_step = [0.0, 1.0]"),
        (
            "force_step = [0.0, 0.0, 0.0]",
            "moment_step = [0.0, 1.0, 1e8]",
        ),
        ("decrease = [21.58, 67.57, 56.84]", "decrease = [21.58]"),
        ("mean_room = 254.18", "mean_room = true"),
    ]);
    insta::assert_snapshot!(messages);
}

/// What a scenario may ask for is bounded, so that no text fills the memory.
#[test]
fn sizes() {
    let experiments = |count: usize| {
        let more = (1..count).map(|i| {
            format!(
                "[[experiment]]\nsection = \"{i}\"\nforce = [0, 0, 0]\nrated_torque = \"none\"\n"
            )
        });
        format!("{}\n[[experiment]]", more.collect::<String>())
    };
    let figures = |count: usize| {
        let more = (4..count)
            .map(|i| format!("[[experiment.figure]]\nname = \"f_{i}\"\nkind = \"impact\"\n"));
        format!("{}\n[campaign]", more.collect::<String>())
    };
    // The scenario has three experiments, three times and four figures.
    let most = [
        ("[[experiment]]", &*experiments(31)),
        ("[campaign]", &figures(100)),
        ("cycle = 0.01", "cycle = 0.002"),
        ("cases = 10_000", "cases = 1_000_000_000_000"),
        ("failure_times = 20", "failure_times = 1_000"),
    ];
    let scenario = parse(&edited(&most)).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(scenario.experiments().len(), 33);
    let slow = [
        ("duration = 20.0", "duration = 1e5"),
        ("cycle = 0.01", "cycle = 10"),
    ];
    parse(&edited(&slow)).unwrap_or_else(|errors| panic!("{errors}"));
    let messages = messages(&[
        ("[[experiment]]", &experiments(32)),
        ("[[experiment]]", &experiments(2_001)),
        ("[campaign]", &figures(101)),
        ("cycle = 0.01", "cycle = 0.0019"),
        ("duration = 20.0", "duration = 100_001"),
        ("cases = 10_000", "cases = 1_000_000_000_001"),
        ("failure_times = 20", "failure_times = 1_001"),
    ]);
    insta::assert_snapshot!(messages);
    let tool = include_str!("../../scenarios/tool_path.toml").replace("cycle = 0.1", "cycle = 10");
    let lasting = |duration| parse(&tool.replace("duration = 10.0", duration));
    assert!(lasting("duration = 1_000").is_ok());
    let text = lasting("duration = 1_001").unwrap_err().to_string();
    assert!(
        text.contains("must be within 0.001 to 1000.0 s for a motion of the tool"),
        "{text}"
    );
}

#[test]
fn sections_brakes_and_figures() {
    let messages = messages(&[
        ("section = \"5.2\"", "section = \"../5.2\""),
        ("name = \"figure_4\"", "name = \"Figure 4\""),
        ("name = \"figure_5\"", "name = \"figure_4\""),
        ("kind = \"torque\"", "kind = \"torques\""),
        (
            "joints = [1, 3]\ntime = 10.0",
            "joints = [1, 9]\ntime = 11.0",
        ),
        (
            "name = \"figure_7\"\nkind = \"impact\"",
            "name = \"figure_7\"\nkind = \"impact\"\njoints = [1]",
        ),
        ("duration = 0.1 ", "duration = 0.0 "),
        ("profile = \"constant\"", "profile = \"constnat\""),
        ("cases = 10_000", "cases = 1.5"),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn servos_and_motors() {
    let without = PAPER_LIKE.split_once("\n[servo]").unwrap().0;
    let scenario = parse(without).unwrap();
    // What a file means that does not say.
    let servo = scenario.servo();
    assert_eq!(
        (servo.gain(), servo.detection(), servo.lead()),
        (5.0, 0.0, 0.25)
    );
    assert_eq!(servo.projector(), Projector::Static);
    assert_eq!(scenario.motors().reflected_inertia(), [0.0; 7]);
    assert_eq!(servo, parse(PAPER_LIKE).unwrap().servo());
    let motors = |text: &str| {
        let text = format!("{without}\n[motors]\n{text}");
        parse(&text).unwrap().motors().clone()
    };
    assert_eq!(motors("ratio = 100").reflected_inertia(), [0.0; 7]);
    assert_eq!(motors("rotor_inertia = 2").reflected_inertia(), [2.0; 7]);
    let each = motors("rotor_inertia = 2e-4\nratio = [100, 200, 0.5, 1, 1, 1, 1000]");
    assert_eq!(each.rotor_inertia(), [2e-4; 7]);
    assert_eq!(each.ratio()[1], 200.0);
    for (found, expected) in each.reflected_inertia().iter().zip([2.0, 8.0, 5e-5]) {
        assert!((found / expected - 1.0).abs() < 1e-12);
    }
    let consistent = [(
        "projector = \"static\"",
        "projector = \"dynamically_consistent\"",
    )];
    let servo = parse(&edited(&consistent)).unwrap().servo();
    assert_eq!(servo.projector(), Projector::DynamicallyConsistent);
    let still = parse(&edited(&[("gain = 5.0", "gain = 0")]))
        .unwrap()
        .servo();
    assert_eq!(still.gain(), 0.0);
    let messages = messages(&[
        ("gain = 5.0", "gain = -5.0"),
        ("gain = 5.0", "gian = 5.0"),
        ("detection = 0.0", "detection = 20"),
        ("lead = 0.25", "lead = -0.25"),
        ("projector = \"static\"", "projector = \"dynamic\""),
        (
            "[servo]",
            "[motors]\nrotor_inertia = [1e-4, 1e-4]\nratio = 0\n[servo]",
        ),
        (
            "[servo]",
            "[motors]\nrotor_inertia = -1\nratio = \"100\"\n[servo]",
        ),
        ("[servo]", "[motors]\ngain = 1\n[servo]"),
    ]);
    insta::assert_snapshot!(messages);
}

#[test]
fn arms() {
    let messages = messages(&[
        ("arm = \"ssrms\"", "arm = \"ssmrs\""),
        ("arm = \"ssrms\"", "arm = \"canadarm\""),
        ("arm = \"ssrms\"", "arm = \"../arms/ssrm.toml\""),
        ("arm = \"ssrms\"", "arm = \"../tests/bad_arm.toml\""),
        ("arm = \"ssrms\"", "arm = \"oblique_6\""),
    ]);
    // As from the repository's root.
    let messages = messages.replace("../scenarios/", "scenarios/");
    insta::assert_snapshot!(messages);
}

#[test]
fn every_error_at_once() {
    let text = edited(&[
        ("arm = \"ssrms\"", "arm = \"ssrm\""),
        ("angles = \"dh\"", "angles = \"hd\""),
        ("blend = 4.455", "blend = 11"),
        ("joints = [2]", "joints = [9]"),
        ("cycle = 0.01", "cycle = 0"),
        ("step = 1e6", "step = -1e6"),
        ("force = [20.0", "force = [nan"),
        ("before = [46.56, ", "before = ["),
        ("time = 18.0\n", ""),
    ]);
    let errors = parse(&text).unwrap_err();
    insta::assert_snapshot!(errors);
}

#[test]
fn absent_files() {
    let errors = Scenario::load("../scenarios/paper_lik.toml", &known()).unwrap_err();
    let text = errors.to_string();
    assert!(
        text.contains("did you mean ../scenarios/paper_like.toml?"),
        "{text}"
    );
}

proptest! {
    /// Whatever the text, an answer comes and none of them is a panic.
    #[test]
    fn no_text_panics(at in 0..PAPER_LIKE.len(), cut in 0_usize..40, put in "[-0-9a-z\\[\\]=.\"#\n ]{0,6}") {
        let floor = |byte: usize| (0..=byte.min(PAPER_LIKE.len())).rev().find(|b| PAPER_LIKE.is_char_boundary(*b)).unwrap();
        let (from, to) = (floor(at), floor(at + cut));
        let text = format!("{}{put}{}", &PAPER_LIKE[..from], &PAPER_LIKE[to..]);
        if let Err(errors) = Scenario::parse(&text, "a.toml", Path::new(""), &[]) {
            prop_assert!(!errors.to_string().is_empty());
        }
    }
}
