//! The format of a scenario: every key with its kind, its bounds, its default and its meaning.

pub(super) mod assess;
pub(super) mod bounds;
pub(super) mod campaign;
pub(super) mod experiment;
pub(super) mod motion;
pub(super) mod motors;
pub(super) mod servo;
mod words;

use bounds::{
    BRAKE as BRAKE_BOUND, COEFFICIENT, CYCLE as CYCLE_BOUND, MAX_CYCLES, MAX_STUDIES,
    STEP as STEP_BOUND, STEP_TIME as STEP_TIME_BOUND, WRENCH_STEP,
};
use ulna_table::ANGLE_UNIT;
use ulna_table::toml_reader::{Choice, Key, Kind, Limit, Need, Section, reference as printed};

use crate::simulation::BrakeProfile;

const INTRODUCTION: &str = "
# A scenario

A TOML file with one motion of one arm, the joints that lock, and what is tried against the impact. SI units; angles in the unit
that `angle_unit` names. `ulna reproduce FILE` makes its experiments, `ulna campaign FILE` varies it at random,
`ulna assess FILE` judges every law over failures for which it was not tuned.
";

/// The reference of the format, Markdown.
pub fn reference() -> String {
    printed(INTRODUCTION, &SCENARIO)
}

/// The keys before the first header.
pub(super) static SCENARIO: Section = Section {
    header: "",
    meaning: "What the scenario is about, and what stands under the headers below",
    example: "name = \"my_scenario\"\ndescription = \"two joints of a planar arm\"\narm = \"my_arm.toml\"\nangle_unit = \"deg\"\n",
    keys: &[
        &NAME,
        &DESCRIPTION,
        &ARM,
        &ANGLE_UNIT,
        &MOTION,
        &FAILURE,
        &CONTROL,
        &SEARCH,
        &BRAKE,
        &SERVO,
        &MOTORS,
        &EXPERIMENTS,
        &CAMPAIGN,
        &ASSESS,
    ],
};

pub(super) static NAME: Key = Key::required(
    "name",
    Kind::Text,
    "What it is called where its results are written",
    "`name = \"my_scenario\"`",
);
pub(super) static DESCRIPTION: Key = Key::required(
    "description",
    Kind::Text,
    "A sentence about it",
    "`description = \"what it is about\"`",
)
.need(Need::Optional("there is none"));
pub(super) static ARM: Key = Key::required(
    "arm",
    Kind::Text,
    "An arm that the program was compiled with, or the path of a table from this file's folder, ending in .toml",
    "`arm = \"ssrms\"` or `arm = \"my_arm.toml\"`",
);
pub(super) static MOTION: Key = Key::required(
    "motion",
    Kind::Table(&motion::MOTION),
    "The planned motion",
    "`[motion]` with kind, angles, start, goal, duration and blend below it",
);
pub(super) static FAILURE: Key = Key::required(
    "failure",
    Kind::Table(&FAILURE_SECTION),
    "Which joints lock, and when",
    "`[failure]` with joints and times below it",
);
pub(super) static CONTROL: Key = Key::required(
    "control",
    Kind::Table(&CONTROL_SECTION),
    "The controller",
    "`[control]` and below it `cycle = 0.01`",
);
pub(super) static SEARCH: Key = Key::required(
    "search",
    Kind::Table(&SEARCH_SECTION),
    "The paper's search for the coefficients",
    "`[search]` with start and step below it",
);
pub(super) static BRAKE: Key = Key::required(
    "brake",
    Kind::Table(&BRAKE_SECTION),
    "The brakes",
    "`[brake]` and below it `duration = 0.1`",
)
.need(Need::Optional("its keys have their defaults"));
pub(super) static SERVO: Key = Key::required(
    "servo",
    Kind::Table(&servo::SERVO),
    "The servo",
    "`[servo]` and below it `gain = 5.0`",
)
.need(Need::Optional("its keys have their defaults"));
pub(super) static MOTORS: Key = Key::required(
    "motors",
    Kind::Table(&motors::MOTORS),
    "The rotors behind their gears",
    "`[motors]` and below it `rotor_inertia = 1e-4`",
)
.need(Need::Optional("its keys have their defaults"));
pub(super) static EXPERIMENTS: Key = Key::required(
    "experiment",
    Kind::Tables(&experiment::EXPERIMENT),
    "What is tried with the motion",
    "`[[experiment]]` once for each tool force",
);
pub(super) static CAMPAIGN: Key = Key::required(
    "campaign",
    Kind::Table(&campaign::CAMPAIGN),
    "How `ulna campaign` varies the scenario",
    "`[campaign]` and below it `cases = 10_000`",
)
.need(Need::Optional("its keys have their defaults"));

pub(super) static ASSESS: Key = Key::required(
    "assess",
    Kind::Table(&assess::ASSESS),
    "How `ulna assess` judges every law",
    "`[assess]` and below it `failure_times = 79`",
)
.need(Need::Optional("its keys have their defaults"));

static FAILURE_SECTION: Section = Section {
    header: "[failure]",
    meaning: "Once",
    example: "[failure]\njoints = [2]\ntimes = [2.0, 5.0]\nstep_time = 0.0\nforce_step = [0.0, 0.0, 0.0]\n\
              moment_step = [0.0, 0.0, 0.0]\n",
    keys: &[
        &FAILED_JOINTS,
        &TIMES,
        &STEP_TIME,
        &FORCE_STEP,
        &MOMENT_STEP,
    ],
};
pub(super) static FAILED_JOINTS: Key = Key::required(
    "joints",
    Kind::List(&Kind::Number, "at least one"),
    "The joints that lock together, counted from 1 at the base",
    "`joints = [2]`",
);
pub(super) static TIMES: Key = Key::required(
    "times",
    Kind::List(&Kind::Number, "at least one"),
    "The failure times t_f, counted from the motion's start",
    "`times = [10.0]`",
)
.limits(&[Limit::Said(|| {
    format!("s, from 0 to below the motion's duration, each once; times and experiments multiply to at most {MAX_STUDIES}")
})]);

/// Δt of Eq. 18, s, in a scenario that does not say.
pub(super) const DEFAULT_STEP_TIME: f64 = 0.0;
pub(super) static STEP_TIME: Key = Key::required(
    "step_time",
    Kind::Number,
    "Delta t of Eq. 18: from the last torque before the lock, at t_f, to the first after it. Not the control cycle, and not in simulated locks, which take the time of the brake",
    "`step_time = 0.0`",
)
.limits(&[
    Limit::Within(&STEP_TIME_BOUND),
    Limit::Said(|| "within the motion after each of `times`".to_owned()),
])
.need(Need::Default(|| format!("{DEFAULT_STEP_TIME:?}")));
pub(super) static FORCE_STEP: Key = wrench_step(
    "force_step",
    "Delta F_e of Eq. 8: what the lock takes from the tool's force along the world's axes, before minus after; not in simulated locks",
    "`force_step = [0.0, 0.0, 0.0]`",
);
pub(super) static MOMENT_STEP: Key = wrench_step(
    "moment_step",
    "Delta N_e of Eq. 8: what it takes from the moment about them, likewise",
    "`moment_step = [0.0, 0.0, 0.0]`",
);

const fn wrench_step(name: &'static str, meaning: &'static str, write: &'static str) -> Key {
    Key::required(name, Kind::List(&Kind::Number, "of three"), meaning, write)
        .limits(NEWTONS)
        .need(Need::Default(|| "[0.0, 0.0, 0.0]".to_owned()))
}
const NEWTONS: &[Limit] = &[Limit::Within(&WRENCH_STEP)];

static CONTROL_SECTION: Section = Section {
    header: "[control]",
    meaning: "Once",
    example: "[control]\ncycle = 0.1\n",
    keys: &[&CYCLE],
};
pub(super) static CYCLE: Key = Key::required(
    "cycle",
    Kind::Number,
    "The control cycle: torque limits are kept at its multiples. Not the Delta t of Eq. 18, which is `step_time` of [failure]",
    "`cycle = 0.01`",
)
.limits(&[
    Limit::Within(&CYCLE_BOUND),
    Limit::Said(|| format!("at most {MAX_CYCLES} cycles in the motion")),
]);

static SEARCH_SECTION: Section = Section {
    header: "[search]",
    meaning: "Once: Figure 2 of the paper",
    example: "[search]\nstart = 0.0\nstep = 1e6\n",
    keys: &[&START, &STEP],
};
pub(super) static START: Key = Key::required(
    "start",
    Kind::Number,
    "The first value of each coefficient",
    "`start = 0.0`",
)
.limits(&[Limit::Within(&COEFFICIENT)]);
pub(super) static STEP: Key = Key::required(
    "step",
    Kind::Number,
    "The step; both signs are tried",
    "`step = 1e6`",
)
.limits(&[Limit::Within(&STEP_BOUND)]);

/// How long a brake takes, s, in a scenario that does not say.
pub(super) const DEFAULT_BRAKE: f64 = 0.1;
static BRAKE_SECTION: Section = Section {
    header: "[brake]",
    meaning: "At most once: how a failed joint comes to rest where the lock is simulated as it really is",
    example: "[brake]\nduration = 0.1\nprofile = \"constant\"\n",
    keys: &[&BRAKE_DURATION, &PROFILE],
};
pub(super) static BRAKE_DURATION: Key = Key::required(
    "duration",
    Kind::Number,
    "From moving to locked",
    "`duration = 0.1`",
)
.limits(&[Limit::Within(&BRAKE_BOUND)])
.need(Need::Default(|| format!("{DEFAULT_BRAKE:?}")));
pub(super) static PROFILE: Key = Key::required(
    "profile",
    Kind::Words(BrakeProfile::listed),
    "How the rate falls in that time",
    "`profile = \"constant\"` or `profile = \"smooth\"`",
)
.need(Need::Default(|| BrakeProfile::default().quoted()));
