//! [`Target`]: whose code it is, and on what scalars.

use ulna::{Joint, JointKind};
use ulna_table::Model;

use super::options::{COptions, Precision};

/// What all functions of a file have in common.
pub(super) struct Target<'m> {
    pub(super) model: &'m Model,
    pub(super) options: COptions,
}

impl Target<'_> {
    /// An identifier of the file's own.
    pub(super) fn own(&self, name: &str) -> String {
        format!("{}_{name}", self.model.name())
    }

    /// The scalar's type.
    pub(super) fn real(&self) -> String {
        self.own("real")
    }

    pub(super) fn joints(&self) -> &[Joint] {
        self.model.joints()
    }

    pub(super) fn is_prismatic(&self, joint: usize) -> bool {
        self.joints()[joint].kind == JointKind::Prismatic
    }

    /// A function of `<math.h>`, for the scalar.
    pub(super) fn math(&self, name: &str) -> String {
        match self.options.precision {
            Precision::Double => name.to_owned(),
            Precision::Float => format!("{name}f"),
        }
    }

    /// Twice the largest rounding error of the scalar, relative.
    pub(super) fn epsilon(&self) -> f64 {
        match self.options.precision {
            Precision::Double => f64::EPSILON,
            Precision::Float => f64::from(f32::EPSILON),
        }
    }

    /// The largest number, as `<float.h>` calls it.
    pub(super) fn largest(&self) -> &'static str {
        match self.options.precision {
            Precision::Double => "DBL_MAX",
            Precision::Float => "FLT_MAX",
        }
    }

    /// A number as a constant of the scalar's type, which reads back to the same bits.
    pub(super) fn number(&self, value: f64) -> String {
        match self.options.precision {
            Precision::Double => format!("{value:?}"),
            #[expect(
                clippy::cast_possible_truncation,
                reason = "rounded, as it is meant to be"
            )]
            Precision::Float => format!("{:?}F", value as f32),
        }
    }
}
