//! [`LawName`]: what the laws are called, wherever a scenario chooses them and wherever results are theirs.

use std::fmt;

/// A law that answers a lock: the paper's, its rivals, and what they are measured against.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LawName {
    /// No compensation.
    None,
    /// Eq. 16, its coefficients tuned for one lock.
    PerJoint,
    /// Eq. 20, likewise.
    Projected,
    /// Eq. 16 with the gradient of the kinematic manipulability in the place of ∇w_D (the paper's reference 11), likewise.
    Kinematic,
    /// Eq. 16 with the constant coefficients that are best at the worst of all failures.
    ConstantPerJoint,
    /// Eq. 20, likewise.
    ConstantProjected,
    /// Nothing before the lock; after it the torques of the healthy joints are brought nearest to what they were
    /// (a static reading of the paper's reference 12).
    AfterOnly,
    /// [`OnLine`](ulna::control::compensation::OnLine) before the lock, the nearest torques after it: no plan, no tuning.
    OnLine,
    /// [`robust`](crate::search::robust): planned for all locks at all times.
    Robust,
    /// The least that any law leaves that keeps the static tool force and knows the joint and the time: no law, a bound.
    Limit,
}

/// What stands for a law where it is written and read.
struct Words {
    name: &'static str,
    title: &'static str,
    meaning: &'static str,
}

impl LawName {
    /// Every law, in the order of tables.
    pub const ALL: [Self; 10] = [
        Self::None,
        Self::PerJoint,
        Self::Projected,
        Self::Kinematic,
        Self::ConstantPerJoint,
        Self::ConstantProjected,
        Self::AfterOnly,
        Self::OnLine,
        Self::Robust,
        Self::Limit,
    ];

    const fn words(self) -> Words {
        let (name, title, meaning) = match self {
            Self::None => ("none", "none", "no compensation"),
            Self::PerJoint => ("eq16", "Eq. 16", "Eq. 16, tuned for one lock"),
            Self::Projected => ("eq20", "Eq. 20", "Eq. 20, tuned for one lock"),
            Self::Kinematic => (
                "kinematic",
                "Eq. 16, kinematic",
                "Eq. 16 along the gradient of the kinematic manipulability, tuned for one lock",
            ),
            Self::ConstantPerJoint => (
                "eq16_constant",
                "Eq. 16, best constants",
                "Eq. 16 with the constants that are best at the worst of all failures",
            ),
            Self::ConstantProjected => (
                "eq20_constant",
                "Eq. 20, best constants",
                "Eq. 20 with the constants that are best at the worst of all failures",
            ),
            Self::AfterOnly => (
                "after_only",
                "after the lock only",
                "nothing before the lock, and after it the healthy torques that are nearest to those before",
            ),
            Self::OnLine => (
                "on_line",
                "on line",
                "before the lock what prepares for the next one, from the state alone, and after it the nearest torques",
            ),
            Self::Robust => (
                "robust",
                "robust",
                "planned for all locks at all times of a motion",
            ),
            Self::Limit => (
                "limit",
                "limit, force kept",
                "the least that can be left with the tool force kept, joint and time known: a bound, no law",
            ),
        };
        Words {
            name,
            title,
            meaning,
        }
    }

    /// What it is called in files.
    pub const fn name(self) -> &'static str {
        self.words().name
    }

    /// What it is called where people read.
    pub const fn title(self) -> &'static str {
        self.words().title
    }

    /// What it does, in a line.
    pub const fn meaning(self) -> &'static str {
        self.words().meaning
    }

    /// Whether it bends the static tool force by itself: Eq. 16 does, unless all coefficients are equal. The others keep it, as far as
    /// rated torques, a dynamic projector and a force budget let them.
    pub const fn bends_force(self) -> bool {
        matches!(
            self,
            Self::PerJoint | Self::Kinematic | Self::ConstantPerJoint
        )
    }
}

impl fmt::Display for LawName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Some of the laws, each once.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct LawSet {
    /// In the order of [`LawName::ALL`], which is that of the variants.
    chosen: [bool; LawName::ALL.len()],
}

impl LawSet {
    /// Every law.
    pub const ALL: Self = Self {
        chosen: [true; LawName::ALL.len()],
    };

    /// These laws.
    pub const fn of(laws: &[LawName]) -> Self {
        let mut chosen = [false; LawName::ALL.len()];
        let mut i = 0;
        while i < laws.len() {
            chosen[laws[i] as usize] = true;
            i += 1;
        }
        Self { chosen }
    }

    /// These laws, and one more.
    #[must_use]
    pub const fn with(mut self, law: LawName) -> Self {
        self.chosen[law as usize] = true;
        self
    }

    /// Whether `law` is one of them.
    pub const fn contains(&self, law: LawName) -> bool {
        self.chosen[law as usize]
    }

    /// In the order of [`LawName::ALL`], however they were written.
    pub fn iter(&self) -> impl Iterator<Item = LawName> {
        let this = *self;
        LawName::ALL
            .into_iter()
            .filter(move |law| this.contains(*law))
    }
}

impl fmt::Debug for LawSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    /// Sets are indexed by the variants, and files by the names.
    #[test]
    fn laws_stand_in_the_order_of_the_variants_and_have_names_of_their_own() {
        for (index, law) in LawName::ALL.into_iter().enumerate() {
            assert_eq!(law as usize, index);
        }
        let names: HashSet<_> = LawName::ALL.map(LawName::name).into();
        let titles: HashSet<_> = LawName::ALL.map(LawName::title).into();
        assert_eq!((names.len(), titles.len()), (10, 10));
    }

    #[test]
    fn a_set_has_each_law_once_and_in_order() {
        let set = LawSet::of(&[LawName::Limit, LawName::PerJoint, LawName::Limit]);
        assert!(set.iter().eq([LawName::PerJoint, LawName::Limit]));
        assert!(set.contains(LawName::Limit) && !set.contains(LawName::None));
        assert!(set.with(LawName::None).iter().eq([
            LawName::None,
            LawName::PerJoint,
            LawName::Limit
        ]));
        assert!(LawSet::ALL.iter().eq(LawName::ALL));
    }
}
