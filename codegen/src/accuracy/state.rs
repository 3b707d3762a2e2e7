//! [`State`]: where programs are judged.

use std::f64::consts::PI;

use ulna::internal::random::SplitMix64;
use ulna::{JointKind, Real as _};
use ulna_table::Model;

use super::scalar::{Arguments, evaluate};
use crate::double_double::{DoubleDouble, portable_sin_cos};
use crate::schedule::Program;

/// Arguments of a method.
#[derive(Clone, Debug, Default)]
pub(crate) struct State {
    pub(super) q: Vec<f64>,
    pub(super) qd: Vec<f64>,
    pub(super) qdd: Vec<f64>,
    pub(super) tau: Vec<f64>,
}

impl State {
    pub(crate) fn random(model: &Model, random: &mut SplitMix64) -> Self {
        let mut vector = || -> Vec<f64> {
            let joints = model.joints().iter();
            joints.map(|_| random.symmetric()).collect()
        };
        let range = |(joint, x): (&ulna::Joint, f64)| match joint.kind {
            JointKind::Revolute => PI * x,
            JointKind::Prismatic => x,
        };
        Self {
            q: model.joints().iter().zip(vector()).map(range).collect(),
            qd: vector(),
            qdd: vector(),
            tau: vector(),
        }
    }

    fn arguments(&self) -> Arguments<'_> {
        [&self.q, &self.qd, &self.qdd, &self.tau]
    }

    pub(crate) fn exactly(&self, program: &Program) -> Vec<DoubleDouble> {
        evaluate(program, self.arguments(), DoubleDouble::sin_cos)
    }

    /// In `f64`; its sines and cosines are not those of the machine, which may differ in their last digits.
    pub(super) fn in_f64(&self, program: &Program) -> Vec<f64> {
        evaluate(program, self.arguments(), portable_sin_cos)
    }
}
