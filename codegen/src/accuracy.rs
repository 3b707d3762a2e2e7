//! How exact a program is: run in `f64` and in [`DoubleDouble`] at the same states, side by side.
//!
//! The states are random ones and, since that is where digits are lost, others walked from there towards singular poses.
//! Only operations that every machine rounds alike go into it, so that the same table gives the same figures everywhere.

use std::f64::consts::PI;

use nalgebra::SVector;
use ulna::random::SplitMix64;
use ulna::unrolled::coordinates;
use ulna::{JointKind, Model, Real, SerialChain};

use crate::double_double::{DoubleDouble, LARGEST_ANGLE, portable_sin_cos};
use crate::formulate::chain::Chain;
use crate::formulate::relative_volume;
use crate::graph::{AngleSum, Graph, Input};
use crate::schedule::{Program, schedule};

/// States at random.
const RANDOM: usize = 16;
/// States near singular poses, as far as the arm has any.
const NEAR_SINGULAR: usize = 8;
/// How near: the volume that J's rows span, relative to the product of their lengths.
pub const LEAST_VOLUME: f64 = 1e-4;
/// A long program is not run on all states: about so many operations are enough.
const OPERATIONS: usize = 100_000;
/// What is measured times this is claimed: other states, fused multiply-adds, and sines that are 1.4 units off.
pub const ALLOWANCE: f64 = 8.0;

/// Arguments of a method.
#[derive(Clone, Debug)]
struct State {
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    tau: Vec<f64>,
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
    fn random(model: &Model, random: &mut SplitMix64) -> Self {
        let mut vector = || -> Vec<f64> {
            let joints = model.joints.iter();
            joints.map(|_| random.symmetric()).collect()
        };
        let range = |(joint, x): (&ulna::Joint, f64)| match joint.kind {
            JointKind::Revolute => PI * x,
            JointKind::Prismatic => x,
        };
        Self {
            q: model.joints.iter().zip(vector()).map(range).collect(),
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

    fn exactly(&self, program: &Program) -> Vec<DoubleDouble> {
        self.run(program, DoubleDouble::sin_cos)
    }

    /// In `f64`; its sines and cosines are not those of the machine, which may differ in their last digits.
    fn in_f64(&self, program: &Program) -> Vec<f64> {
        self.run(program, portable_sin_cos)
    }
}

/// The states at which an arm's programs are judged.
#[derive(Debug)]
pub struct Yardstick {
    /// Random ones first.
    states: Vec<State>,
    /// How many of them are near singular poses.
    pub near_singular: usize,
    /// Whether the task is singular in every configuration.
    pub singular_everywhere: bool,
    /// The chain's length, m.
    length: f64,
}

impl Yardstick {
    /// Chooses the states for the arm of `model`.
    pub fn new(model: &Model) -> Self {
        let graph = Graph::new();
        let program = schedule(&graph, &relative_volume(&Chain::new(&graph, model)));
        let relative = |q: &[f64]| {
            let state = State {
                q: q.to_vec(),
                qd: Vec::new(),
                qdd: Vec::new(),
                tau: Vec::new(),
            };
            let found = state.in_f64(&program);
            found[0].max(0.0).sqrt() / found[1].sqrt()
        };
        let mut random = SplitMix64::new(1);
        let mut states: Vec<State> = (0..RANDOM)
            .map(|_| State::random(model, &mut random))
            .collect();
        let singular_everywhere = states.iter().all(|state| {
            let volume_squared = state.exactly(&program)[0].to_f64();
            volume_squared.is_nan() || volume_squared <= least_volume_squared(model, &state.q)
        });
        if !singular_everywhere {
            let near: Vec<State> = states[..NEAR_SINGULAR]
                .iter()
                .filter_map(|state| {
                    let q = walk(&state.q, &relative)?;
                    Some(State { q, ..state.clone() })
                })
                .collect();
            states.extend(near);
        }
        Self {
            near_singular: states.len() - RANDOM,
            states,
            singular_everywhere,
            length: ulna::singular::length(
                &model.joints,
                &model.tool,
                &vec![0.0; model.joints.len()],
            ),
        }
    }

    /// How many states at random there are.
    pub fn random(&self) -> usize {
        self.states.len() - self.near_singular
    }

    /// The largest relative error of `program` in `f64` that is to be expected: the largest that is measured, with an allowance.
    ///
    /// An output's error is that of its worst entry, relative to its largest one; ∇w_D's also to w_D, beside which it stands.
    pub fn error(&self, program: &Program) -> f64 {
        let stride = (program.steps.len() * self.states.len())
            .div_ceil(OPERATIONS)
            .max(1);
        let states = self.states.iter().rev().step_by(stride);
        let errors = states
            .map(|state| self.difference(program, &state.exactly(program), &state.in_f64(program)));
        ALLOWANCE * errors.fold(0.0, f64::max)
    }

    /// The largest relative error of a program's outputs.
    fn difference(&self, program: &Program, exact: &[DoubleDouble], found: &[f64]) -> f64 {
        let (mut start, mut worst, mut scale_beside) = (0, 0.0_f64, 0.0_f64);
        for output in &program.outputs {
            let range = start..start + output.elements.len();
            start = range.end;
            if output.name == "volume" {
                // Only its size counts.
                continue;
            }
            let pairs = exact[range.clone()].iter().zip(&found[range]);
            let (difference, largest) =
                pairs.fold((0.0_f64, 0.0_f64), |(difference, largest), (e, f)| {
                    let apart = (*e - DoubleDouble::of(*f)).abs().to_f64();
                    let apart = if apart.is_nan() { f64::INFINITY } else { apart };
                    (difference.max(apart), largest.max(e.to_f64().abs()))
                });
            let scale = match output.name {
                "gradient" => largest.max(scale_beside),
                // A position near the base's origin is still as far off as the chain is long.
                "translation" => largest.max(self.length),
                _ => largest,
            };
            scale_beside = largest;
            if difference > 0.0 {
                worst = worst.max(difference / scale);
            }
        }
        worst
    }
}

/// An error to one digit, not less than it is.
pub fn rounded_up(error: f64) -> String {
    if error == 0.0 || !error.is_finite() {
        return error.to_string();
    }
    let place = 10_f64.powf(error.log10().floor());
    format!("{:.0e}", (error / place).ceil() * place)
}

/// `SerialChain::least_volume_squared` of a chain whose number of joints is known at run time.
fn least_volume_squared(model: &Model, q: &[f64]) -> f64 {
    ulna::singular::least_volume_squared(&model.joints, &model.tool, model.task, q)
}

/// From `q` downhill on `relative`, joint by joint, to a pose where it is a little above [`LEAST_VOLUME`]; `None` if none is met soon.
fn walk(q: &[f64], relative: &impl Fn(&[f64]) -> f64) -> Option<Vec<f64>> {
    /// Sweeps over all joints.
    const SWEEPS: usize = 30;
    /// A step that gains less is not worth taking.
    const GAIN: f64 = 0.9;
    let (mut high, mut value, mut step) = (q.to_vec(), relative(q), 0.5);
    for _ in 0..SWEEPS {
        let before = value;
        for joint in 0..q.len() {
            for along in [step, -step] {
                let mut next = high.clone();
                next[joint] += along;
                let at = relative(&next);
                if at < LEAST_VOLUME {
                    return Some(between(&high, &next, relative));
                }
                if at < GAIN * value {
                    (high, value) = (next, at);
                    break;
                }
            }
        }
        if value == before {
            step *= 0.5;
        }
    }
    None
}

/// A pose on the way from `high` to `low` where `relative` is still above [`LEAST_VOLUME`], and nearly that.
fn between(high: &[f64], low: &[f64], relative: &impl Fn(&[f64]) -> f64) -> Vec<f64> {
    let at = |share: f64| -> Vec<f64> {
        let pairs = high.iter().zip(low);
        pairs
            .map(|(high, low)| high + share * (low - high))
            .collect()
    };
    let (mut far, mut near) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (far + near);
        let value = relative(&at(middle));
        if value < LEAST_VOLUME {
            near = middle;
        } else {
            far = middle;
        }
    }
    at(far)
}
