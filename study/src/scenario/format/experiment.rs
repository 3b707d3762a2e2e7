//! `[[experiment]]`, its references and its figures.

use super::bounds::{
    FAILURE_TIME, FIGURE as FIGURE_BOUND, FORCE as FORCE_BOUND, MAX_COEFFICIENTS, MAX_FIGURES,
    RATED, STEP_TIME as STEP_TIME_BOUND,
};
use crate::scenario::read::{FigureWord, RatedWord};
use ulna_table::toml_reader::{Choice, Key, Kind, Limit, Need, Section};

pub(in crate::scenario) static EXPERIMENT: Section = Section {
    header: "[[experiment]]",
    meaning: "At least once: a tool force, and torque limits",
    example: "[[experiment]]\nsection = \"1\"\ntitle = \"growing force\"\nforce = [10.0, [5.0, 2.0], 0.0]\n\
              moment = [0.0, 0.0, 0.0]\nrated_torque = 300.0\nstep_time = 0.01\n",
    keys: &[
        &SECTION,
        &TITLE,
        &FORCE,
        &MOMENT,
        &RATED_TORQUE,
        &STEP_TIME,
        &REFERENCES,
        &FIGURES,
    ],
};

pub(in crate::scenario) static SECTION: Key = Key::required(
    "section",
    Kind::Text,
    "A number or word that names the experiment, such as the paper's \"5.2\"; no two are alike",
    "`section = \"5.2\"`",
)
.limits(&[Limit::Said(|| {
    "up to 32 letters, digits, dots, hyphens and underscores".to_owned()
})]);
pub(in crate::scenario) static TITLE: Key = Key::required(
    "title",
    Kind::Text,
    "A few words",
    "`title = \"constant force\"`",
)
.need(Need::Optional("there is none"));

const POLYNOMIALS: Kind = Kind::List(
    &Kind::OneOf(&[Kind::Number, Kind::List(&Kind::Number, "")]),
    "of three",
);
const FORCES: &[Limit] = &[
    Limit::Within(&FORCE_BOUND),
    Limit::Said(|| format!("at most {MAX_COEFFICIENTS} coefficients")),
];
pub(in crate::scenario) static FORCE: Key = Key::required(
    "force",
    POLYNOMIALS,
    "What the tool exerts along the world's axes; [c0, c1, c2] stands for c0 + c1 t + c2 t^2",
    "`force = [20.0, 20.0, 20.0]`",
)
.limits(FORCES);
pub(in crate::scenario) static MOMENT: Key = Key::required(
    "moment",
    POLYNOMIALS,
    "What it exerts about them, likewise",
    "`moment = [0.0, 0.0, 0.0]`",
)
.limits(FORCES)
.need(Need::Default(|| "[0.0, 0.0, 0.0]".to_owned()));
/// How torque limits are written.
pub(super) const RATED_TORQUES: Kind = Kind::OneOf(&[
    Kind::Words(RatedWord::listed),
    Kind::Number,
    Kind::List(&Kind::Number, "one for each joint"),
]);
pub(in crate::scenario) static RATED_TORQUE: Key = Key::required(
    "rated_torque",
    RATED_TORQUES,
    "The torque limits to keep; one number counts for all joints",
    "`rated_torque = \"table\"` or `rated_torque = 300.0`",
)
.limits(&[Limit::Within(&RATED)]);
pub(in crate::scenario) static STEP_TIME: Key = Key::required(
    "step_time",
    Kind::Number,
    "Delta t of Eq. 18 in this experiment",
    "`step_time = 0.01`",
)
.limits(&[Limit::Within(&STEP_TIME_BOUND)])
.need(Need::Optional("that of [failure] counts"));
pub(in crate::scenario) static REFERENCES: Key = Key::required(
    "reference",
    Kind::Tables(&REFERENCE),
    "Somebody else's figures, to stand beside ours",
    "`[[experiment.reference]]` with source, time, before and after below it",
)
.need(Need::Optional("there is none"));
pub(in crate::scenario) static FIGURES: Key = Key::required(
    "figure",
    Kind::Tables(&FIGURE),
    "What to draw",
    "`[[experiment.figure]]` with name and kind below it",
)
.limits(&[Limit::Said(|| {
    format!("at most {MAX_FIGURES} in a scenario")
})])
.need(Need::Optional("there is none"));

static REFERENCE: Section = Section {
    header: "[[experiment.reference]]",
    meaning: "Any number of times below an `[[experiment]]`",
    example: "[[experiment.reference]]\nsource = \"paper, Table 2\"\ntime = 5.0\nfailed_joints = [2]\njoints = [1, 2]\nbefore = [30.0, 60.0]\n\
              after = [0.1, 0.1]\ncoefficients = [-1e7, -1e7]\nfree_after = [0.01, 0.02]\ndecrease = [20.0, 60.0]\nmean_room = 250.0\n",
    keys: &[
        &SOURCE,
        &REFERENCE_TIME,
        &REFERENCE_FAILED_JOINTS,
        &REFERENCE_JOINTS,
        &BEFORE,
        &AFTER,
        &COEFFICIENTS,
        &FREE_AFTER,
        &DECREASE,
        &MEAN_ROOM,
    ],
};
pub(in crate::scenario) static SOURCE: Key = Key::required(
    "source",
    Kind::Text,
    "Where the figures stand",
    "`source = \"paper, Table 2\"`",
);
pub(in crate::scenario) static REFERENCE_TIME: Key = Key::required(
    "time",
    Kind::Number,
    "The failure time that they are for",
    "`time = 10.0`",
)
.limits(&[Limit::Within(&FAILURE_TIME)]);
pub(in crate::scenario) static REFERENCE_FAILED_JOINTS: Key = Key::required(
    "failed_joints",
    Kind::List(&Kind::Number, "at least one"),
    "The joints that lock there, counted from 1: the figures stand beside no other lock",
    "`failed_joints = [2]`",
)
.need(Need::Optional(
    "it is not said, and the figures stand beside any lock",
));
pub(in crate::scenario) static REFERENCE_JOINTS: Key = Key::required(
    "joints",
    Kind::List(&Kind::Number, "at least one"),
    "The joints that the lists below are for, counted from 1",
    "`joints = [4, 5, 6]`",
)
.need(Need::Optional("all of them"));
pub(in crate::scenario) static BEFORE: Key = figures(
    "before",
    "Impact torque without compensation, N m (N)",
    "`before = [30.18, 66.72]`",
);
pub(in crate::scenario) static AFTER: Key = figures(
    "after",
    "Impact torque with compensation, N m (N)",
    "`after = [0.15, 0.14]`",
);
pub(in crate::scenario) static COEFFICIENTS: Key = figures(
    "coefficients",
    "The coefficients k_d",
    "`coefficients = [1e7, -1e7]`",
);

pub(in crate::scenario) static FREE_AFTER: Key = figures(
    "free_after",
    "Impact torque with the compensation that no rated torque limits, N m (N)",
    "`free_after = [0.01, 0.02]`",
);
pub(in crate::scenario) static DECREASE: Key = figures(
    "decrease",
    "By how much the rated torques lower the compensation, %",
    "`decrease = [20.0, 60.0]`",
);
pub(in crate::scenario) static MEAN_ROOM: Key = Key::required(
    "mean_room",
    Kind::Number,
    "What the motion leaves of the rated torques, on the mean over it and over these joints, N m (N)",
    "`mean_room = 250.0`",
)
.limits(PRINTED)
.need(Need::Optional("there is no figure"));

const PRINTED: &[Limit] = &[Limit::Within(&FIGURE_BOUND)];

const fn figures(name: &'static str, meaning: &'static str, write: &'static str) -> Key {
    let one_each = Kind::List(&Kind::Number, "one for each joint of the reference");
    Key::required(name, one_each, meaning, write)
        .limits(PRINTED)
        .need(Need::Optional("there is no figure"))
}

static FIGURE: Section = Section {
    header: "[[experiment.figure]]",
    meaning: "Any number of times below an `[[experiment]]`",
    example: "[[experiment.figure]]\nname = \"torques\"\nkind = \"torque\"\njoints = [1, 2]\ntime = 5.0\n",
    keys: &[&FIGURE_NAME, &FIGURE_KIND, &FIGURE_JOINTS, &FIGURE_TIME],
};
pub(in crate::scenario) static FIGURE_NAME: Key = Key::required(
    "name",
    Kind::Text,
    "What its files are called; no two are alike",
    "`name = \"my_figure\"`",
)
.limits(&[Limit::Said(|| {
    "up to 64 of a to z, 0 to 9 and _".to_owned()
})]);
pub(in crate::scenario) static FIGURE_KIND: Key = Key::required(
    "kind",
    Kind::Words(FigureWord::listed),
    "What it shows",
    "`kind = \"torque\"` or `kind = \"impact\"`",
);
pub(in crate::scenario) static FIGURE_JOINTS: Key = Key::required(
    "joints",
    Kind::List(&Kind::Number, "at least one"),
    "The joints that it shows, counted from 1",
    "`joints = [1, 3]`",
)
.need(Need::With("kind = \"torque\""));
pub(in crate::scenario) static FIGURE_TIME: Key = Key::required(
    "time",
    Kind::Number,
    "The failure time that it shows",
    "`time = 10.0`",
)
.limits(&[Limit::Said(|| "s, one of `times` of [failure]".to_owned())])
.need(Need::With("kind = \"torque\""));
