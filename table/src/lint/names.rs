//! [`Lint`]: the table of lints, a row each.

use super::{Rule, angle_unit, far_centroid, found_elsewhere, gravity, heavy_link};
use super::{inertia_about_origin, inertia_across, inertia_size, other_convention};
use crate::toml_reader::{Choice, Word};

macro_rules! lints {
    ($($Lint:ident = $name:literal by $rule:expr, $meaning:literal;)+) => {
        /// Something that is legal in a table and rarely meant: a warning at every door, unless the table's `allow` names it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Lint {
            $(#[doc = $meaning] $Lint,)+
        }

        impl Lint {
            /// Every lint.
            pub const ALL: &[Self] = &[$(Self::$Lint),+];

            /// What a table's `allow` calls it.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$Lint => $name),+ }
            }

            /// What it warns of and why, in a sentence.
            pub const fn meaning(self) -> &'static str {
                match self { $(Self::$Lint => $meaning),+ }
            }

            pub(super) fn rule(self) -> Rule {
                match self { $(Self::$Lint => $rule),+ }
            }
        }

        impl Choice for Lint {
            const WORDS: &'static [Word<Self>] = &[$(Word::new($name, Self::$Lint, $meaning)),+];
        }
    };
}

lints! {
    MissingGravity = "missing_gravity" by gravity::missing,
        "There is no `gravity`, so that it is zero: right in space, and to be said there";
    UpwardGravity = "upward_gravity" by gravity::upward,
        "Gravity points along the world's +z and the base's z with it: it is how things fall, not what holds them";
    OddGravity = "odd_gravity" by gravity::odd,
        "Gravity is none of a planet's or a large moon's (1.3 to 26 m/s^2): it may be in g, in feet or in cm";
    OtherConvention = "other_convention" by other_convention::find,
        "Two neighbouring joints turn about one axis, or the tool is on the last one and the task singular everywhere, and neither is so in the other Denavit-Hartenberg convention";
    RoundedAngle = "rounded_angle" by found_elsewhere,
        "An angle in radians is a quarter turn rounded to a few digits: only the full number has an exact sine and cosine";
    OtherAngleUnit = "other_angle_unit" by angle_unit::find,
        "Angles or limits look like the other unit: no angle beyond 6.3 degrees and fractions of pi among them, or limits of 20 radians and more";
    FarCentroid = "far_centroid" by far_centroid::find,
        "A centroid is farther from its link (from the foot of its axis over its origin to the next origin or the tool) than half the link, the arm's longest link and half the body's own length: \
         it may be in mm, or in another frame";
    HeavyLink = "heavy_link" by heavy_link::find,
        "A moving mass beyond a tonne and beyond 2 t for each cubic metre of the arm's length cubed, or a link of 100 kg that would be denser than osmium: \
         it may be in grams";
    LargeInertia = "large_inertia" by inertia_size::large,
        "By its inertia a link's mass lies farther from its centroid (root mean square) than 1.25 times what the link and half the arm's longest reach from there: it may be in g mm^2, kg mm^2 or g cm^2";
    SmallInertia = "small_inertia" by inertia_size::small,
        "By its inertia a link's mass lies within 1/125 of the link's length around its centroid: it may have been divided by a thousand or more";
    InertiaAboutOrigin = "inertia_about_origin" by inertia_about_origin::find,
        "Inertias seem to be about the frames' origins, not about the centroids: with m c^2 taken off every link is still a body (one link in five of sound tables is), and a rod fits its link only then, or three links become much smaller bodies";
    InertiaAcross = "inertia_across" by inertia_across::find,
        "By its inertia a link is three times as long across as along: the tensor may be in other axes than those of the link's frame";
    SingularTask = "singular_task" by found_elsewhere,
        "The task's rows of J depend on each other in every configuration, so that w_D is 0 everywhere";
}
