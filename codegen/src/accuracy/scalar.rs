//! [`Scalar`]: what programs can be run on without a compiler.

use ulna::internal::coordinate;
use ulna::{JointKind, Real};

use crate::double_double::{DoubleDouble, LARGEST_ANGLE};
use crate::graph::Input;
use crate::schedule::Program;

/// What a program reads.
#[derive(Clone, Copy, Debug, Default)]
pub struct Arguments<'a> {
    /// Joint coordinates.
    pub q: &'a [f64],
    /// Their rates.
    pub qd: &'a [f64],
    /// Their accelerations.
    pub qdd: &'a [f64],
    /// Joint torques.
    pub tau: &'a [f64],
    /// The wrench on the tool.
    pub wrench: &'a [f64],
    /// The payload's parameters; none of an arm that has no payload.
    pub payload: &'a [f64],
}

/// A scalar that a program can be run on.
pub trait Scalar: Real {
    /// A constant of a program.
    fn number(value: DoubleDouble) -> Self;

    /// The nearest double.
    fn to_f64(self) -> f64;

    /// A joint's coordinate as programs on this scalar may read it.
    fn coordinate(kind: JointKind, q: f64) -> f64;

    /// All results of `program` in order, rounded.
    fn run(program: &Program, arguments: Arguments<'_>) -> Vec<f64>;
}

impl Scalar for f64 {
    fn number(value: DoubleDouble) -> Self {
        value.to_f64()
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn coordinate(kind: JointKind, q: f64) -> f64 {
        coordinate(kind, q)
    }

    fn run(program: &Program, arguments: Arguments<'_>) -> Vec<f64> {
        evaluate(program, arguments, f64::sin_cos)
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
    fn coordinate(kind: JointKind, q: f64) -> f64 {
        match kind {
            JointKind::Revolute if q.abs() < LARGEST_ANGLE => q,
            _ => coordinate(kind, q),
        }
    }

    fn run(program: &Program, arguments: Arguments<'_>) -> Vec<f64> {
        let exact = evaluate(program, arguments, DoubleDouble::sin_cos);
        exact.into_iter().map(DoubleDouble::to_f64).collect()
    }
}

/// All results of `program` in order, with sines and cosines by `sines`.
pub(super) fn evaluate<R: Scalar>(
    program: &Program,
    arguments: Arguments<'_>,
    sines: fn(R) -> (R, R),
) -> Vec<R> {
    let Arguments {
        q,
        qd,
        qdd,
        tau,
        wrench,
        payload,
    } = arguments;
    let angles = program.angles.iter();
    let angles: Vec<(R, R)> = angles
        .map(|angle| sines(angle.at(|i| R::of(q[i]), R::number)))
        .collect();
    program.evaluate(R::number, |input, _| match input {
        Input::Q(i) => R::of(q[i]),
        Input::Sin(index) => angles[index].0,
        Input::Cos(index) => angles[index].1,
        Input::Qd(i) => R::of(qd[i]),
        Input::Qdd(i) => R::of(qdd[i]),
        Input::Tau(i) => R::of(tau[i]),
        Input::Wrench(i) => R::of(wrench[i]),
        Input::Payload(i) => R::of(payload[i]),
    })
}
