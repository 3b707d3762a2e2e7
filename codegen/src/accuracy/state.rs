//! [`State`]: where programs are judged.

use std::f64::consts::PI;

use ulna::internal::random::SplitMix64;
use ulna::{JointKind, Payload, Real as _};
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
    pub(super) wrench: Vec<f64>,
    pub(super) payload: Vec<f64>,
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
            wrench: Vec::new(),
            payload: Vec::new(),
        }
    }

    /// Gives every state a wrench and a payload, from a stream of their own.
    pub(super) fn load(states: &mut [Self], model: &Model) {
        let mut random = SplitMix64::new(2);
        for state in states {
            state.wrench = (0..6).map(|_| random.symmetric()).collect();
            state.payload = payload(model, &mut random);
        }
    }

    fn arguments(&self) -> Arguments<'_> {
        let Self {
            q,
            qd,
            qdd,
            tau,
            wrench,
            payload,
        } = self;
        Arguments {
            q,
            qd,
            qdd,
            tau,
            wrench,
            payload,
        }
    }

    pub(crate) fn exactly(&self, program: &Program) -> Vec<DoubleDouble> {
        evaluate(program, self.arguments(), DoubleDouble::sin_cos)
    }

    /// In `f64`; its sines and cosines are not those of the machine, which may differ in their last digits.
    pub(super) fn in_f64(&self, program: &Program) -> Vec<f64> {
        evaluate(program, self.arguments(), portable_sin_cos)
    }
}

/// The parameters of a body as heavy as the arm's last link on average, and within a tenth of a metre of its tool;
/// none for an arm without a payload.
fn payload(model: &Model, random: &mut SplitMix64) -> Vec<f64> {
    let Some(last) = model.joints().last().filter(|_| model.has_payload()) else {
        return Vec::new();
    };
    let mass = last.link.mass * (1.0 + random.symmetric());
    let com = std::array::from_fn(|_| 0.1 * random.symmetric());
    let moment = 0.01 * mass;
    let inertia = [[moment, 0.0, 0.0], [0.0, moment, 0.0], [0.0, 0.0, moment]];
    let payload = Payload::new(mass, com, inertia).unwrap_or_default();
    payload.parameters(model.tool()).to_vec()
}
