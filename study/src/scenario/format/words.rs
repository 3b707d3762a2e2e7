//! The words of a scenario.

use crate::laws::LawName;
use crate::scenario::read::{
    Angles, FigureWord, MotionKind, ProfileWord, ProjectorWord, RatedWord,
};
use crate::simulation::BrakeProfile;
use ulna_table::toml_reader::{Choice, Word};

impl Choice for MotionKind {
    const WORDS: &'static [Word<Self>] = &[
        Word::new(
            "joint",
            Self::Joint,
            "a straight line of the joints, to `goal`",
        ),
        Word::new(
            "tool",
            Self::Tool,
            "a straight line of the tool, by `displacement`",
        ),
    ];
}

impl Choice for Angles {
    const WORDS: &'static [Word<Self>] = &[
        Word::new(
            "dh",
            Self::Dh,
            "theta + q (or d + q), what stands in the joint's row",
        ),
        Word::new("q", Self::Q, "measured from the table's configuration"),
    ];
}

impl Choice for ProfileWord {
    const WORDS: &'static [Word<Self>] = &[
        Word::new(
            "trapezoid",
            Self::Trapezoid,
            "evenly: the acceleration is constant, and jumps at both ends of a blend",
        ),
        Word::new(
            "quintic",
            Self::Quintic,
            "as 10x^3 - 15x^4 + 6x^5 of the blend's time: acceleration and jerk are continuous",
        ),
        Word::new(
            "s_curve",
            Self::SCurve,
            "in three segments of constant jerk, seven in the whole motion: the acceleration is continuous",
        ),
    ];
}

impl Choice for BrakeProfile {
    const WORDS: &'static [Word<Self>] = &[
        Word::new("constant", Self::Constant, "constant deceleration"),
        Word::new(
            "smooth",
            Self::Smooth,
            "a deceleration that grows from 0 and falls back to it",
        ),
    ];
}

impl Choice for ProjectorWord {
    const WORDS: &'static [Word<Self>] = &[
        Word::new(
            "static",
            Self::Static,
            "the paper's: no static force at the tool",
        ),
        Word::new(
            "dynamically_consistent",
            Self::DynamicallyConsistent,
            "no acceleration of the tool; its static force is not 0",
        ),
    ];
}

impl Choice for RatedWord {
    const WORDS: &'static [Word<Self>] = &[
        Word::new("none", Self::None, "no limit"),
        Word::new("table", Self::OfArm, "the arm's own"),
    ];
}

impl Choice for FigureWord {
    const WORDS: &'static [Word<Self>] = &[
        Word::new(
            "torque",
            Self::Torque,
            "torques of some joints over time, without and with suppression",
        ),
        Word::new(
            "impact",
            Self::Impact,
            "the impact joint by joint, before and after, at every failure time",
        ),
    ];
}

impl Choice for LawName {
    const WORDS: &'static [Word<Self>] = &law_words();
}

/// One for each law.
const fn law_words() -> [Word<LawName>; LawName::ALL.len()] {
    let mut words = [const { law_word(LawName::None) }; LawName::ALL.len()];
    let mut i = 0;
    while i < words.len() {
        words[i] = law_word(LawName::ALL[i]);
        i += 1;
    }
    words
}

const fn law_word(law: LawName) -> Word<LawName> {
    Word::new(law.name(), law, law.meaning())
}
