//! Programs run at a state, on scalars of one's choice.

use std::f64::consts::PI;

use nalgebra::SVector;
use ulna::internal::coordinates;
use ulna::internal::random::SplitMix64;
use ulna::{JointKind, Real, SerialChain};
use ulna_table::Model;

use crate::double_double::{DoubleDouble, LARGEST_ANGLE, portable_sin_cos};
use crate::graph::{AngleSum, Input};
use crate::schedule::Program;

/// Arguments of a method.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    pub(super) q: Vec<f64>,
    pub(super) qd: Vec<f64>,
    pub(super) qdd: Vec<f64>,
    pub(super) tau: Vec<f64>,
}

/// A scalar that a program can be run on.
pub trait Scalar: Real {
    /// A constant of a program.
    fn number(value: DoubleDouble) -> Self;

    /// The nearest double.
    fn to_f64(self) -> f64;

    /// Joint coordinates as programs on this scalar may read them.
    fn coordinates<const N: usize>(chain: &SerialChain<N>, q: &SVector<f64, N>) -> SVector<f64, N>;
}

impl Scalar for f64 {
    fn number(value: DoubleDouble) -> Self {
        value.to_f64()
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn coordinates<const N: usize>(chain: &SerialChain<N>, q: &SVector<f64, N>) -> SVector<f64, N> {
        coordinates(chain, &q.data.0[0]).into()
    }
}

impl Scalar for DoubleDouble {
    fn number(value: DoubleDouble) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        DoubleDouble::to_f64(self)
    }

    /// Angles as they are, as far as their sines are right.
    fn coordinates<const N: usize>(chain: &SerialChain<N>, q: &SVector<f64, N>) -> SVector<f64, N> {
        let read = coordinates(chain, &q.data.0[0]);
        SVector::from_fn(|i, _| match chain.joints[i].kind {
            JointKind::Revolute if q[i].abs() < LARGEST_ANGLE => q[i],
            _ => read[i],
        })
    }
}

/// The argument `input` where the joints' coordinates are `q`, from its number and the others.
pub fn read<R: Scalar>(input: Input, angles: &[AngleSum], q: &[f64], others: [&[f64]; 3]) -> R {
    let angle = |index: usize| angles[index].at(|i| R::of(q[i]), R::number);
    let [qd, qdd, tau] = others;
    match input {
        Input::Q(i) => R::of(q[i]),
        Input::Sin(index) => angle(index).sin_cos().0,
        Input::Cos(index) => angle(index).sin_cos().1,
        Input::Qd(i) => R::of(qd[i]),
        Input::Qdd(i) => R::of(qdd[i]),
        Input::Tau(i) => R::of(tau[i]),
    }
}

impl State {
    pub(super) fn random(model: &Model, random: &mut SplitMix64) -> Self {
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

    fn run<R: Scalar>(&self, program: &Program, sines: fn(R) -> (R, R)) -> Vec<R> {
        let others = [&self.qd[..], &self.qdd, &self.tau];
        let angles: Vec<(R, R)> = program
            .angles
            .iter()
            .map(|angle| sines(angle.at(|i| R::of(self.q[i]), R::number)))
            .collect();
        program.evaluate(R::number, |input, sums| match input {
            Input::Sin(index) => angles[index].0,
            Input::Cos(index) => angles[index].1,
            input => read(input, sums, &self.q, others),
        })
    }

    pub(super) fn exactly(&self, program: &Program) -> Vec<DoubleDouble> {
        self.run(program, DoubleDouble::sin_cos)
    }

    /// In `f64`; its sines and cosines are not those of the machine, which may differ in their last digits.
    pub(super) fn in_f64(&self, program: &Program) -> Vec<f64> {
        self.run(program, portable_sin_cos)
    }
}
