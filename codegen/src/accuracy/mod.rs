//! How exact a program is: run in `f64` and in [`DoubleDouble`] at the same states, side by side.
//!
//! The states are random ones and, since that is where digits are lost, others walked from there towards singular poses.
//! Only operations that every machine rounds alike go into it, so that the same table gives the same figures everywhere.

mod scalar;
mod state;
mod walk;

use ulna::arm::singular;
use ulna::internal::bounds::carried_inertia;
use ulna::internal::random::SplitMix64;
use ulna::{Real as _, TaskRow};
use ulna_table::Model;

use crate::double_double::DoubleDouble;
use crate::formulate::Choices;
use crate::formulate::chain::Chain;
use crate::formulate::task::relative_volume;
use crate::graph::Graph;
use crate::schedule::{Program, Size, schedule};

pub use scalar::Arguments;
pub use scalar::Scalar;

pub(crate) use state::State;
use walk::walk;

/// States at random.
const RANDOM: usize = 16;
/// States near singular poses, as far as the arm has any.
const NEAR_SINGULAR: usize = 8;
/// How near: the volume that J's rows span, relative to the product of their lengths.
pub(crate) const LEAST_VOLUME: f64 = 1e-4;
/// A long program is not run on all states: about so many operations are enough.
const OPERATIONS: usize = 100_000;
/// What is measured times this is claimed: other states, fused multiply-adds, and sines that are 1.4 units off.
pub(crate) const ALLOWANCE: f64 = 8.0;

/// How exact w_D and ∇w_D are: their relative error is at most `factor` times ε times the condition number of w_D.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditioned {
    /// The factor.
    pub factor: f64,
    /// The condition number at the median of the random states.
    pub median: f64,
    /// The largest condition number at which that was measured.
    pub largest: f64,
}

/// The states at which an arm's programs are judged.
#[derive(Debug)]
pub(crate) struct TestStates {
    /// Random ones first.
    states: Vec<State>,
    /// How many of them are near singular poses.
    pub near_singular: usize,
    /// Whether the task is singular in every configuration.
    pub singular_everywhere: bool,
    /// The chain's length, m.
    length: f64,
}

impl TestStates {
    /// Chooses the states for the arm of `model`.
    pub(crate) fn new(model: &Model) -> Self {
        let graph = Graph::without_labels();
        let program = schedule(&graph, &relative_volume(&Chain::new(&graph, model)));
        let relative = |q: &[f64]| {
            let state = State {
                q: q.to_vec(),
                ..State::default()
            };
            let found = state.in_f64(&program);
            found[0].max(0.0).sqrt() / found[1].sqrt()
        };
        let mut random = SplitMix64::new(1);
        let mut states: Vec<State> = (0..RANDOM)
            .map(|_| State::random(model, &mut random))
            .collect();
        State::load(&mut states, model);
        let singular_everywhere = states.iter().all(|state| {
            let volume_squared = state.exactly(&program)[0].to_f64();
            counts_as_zero(model, &state.q, volume_squared)
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
            length: length(model, &vec![0.0; model.joints().len()]),
        }
    }

    /// How many states at random there are.
    pub(crate) fn random(&self) -> usize {
        self.states.len() - self.near_singular
    }

    /// The largest relative error of `program` in `f64` that is to be expected: the largest that is measured, with an allowance.
    ///
    /// An output's error is that of its worst entry, relative to its largest one; ∇w_D's also to w_D, beside which it stands.
    pub(crate) fn error(&self, program: &Program) -> f64 {
        let errors = self
            .some_states(program)
            .map(|state| self.error_at(program, state));
        ALLOWANCE * errors.fold(0.0, f64::max)
    }

    /// What is to be expected of `program`, which computes ∇w_D, in terms of the condition number that `sensitivity` computes.
    pub(crate) fn conditioned(
        &self,
        model: &Model,
        program: &Program,
        sensitivity: &Program,
    ) -> Option<Conditioned> {
        if self.singular_everywhere {
            return None;
        }
        let mut conditions = Vec::new();
        let mut factor = 0.0_f64;
        for state in self.some_states(program) {
            let condition = condition(model, &state.q, &state.in_f64(sensitivity));
            if condition.is_finite() {
                factor = factor.max(self.error_at(program, state) / (f64::EPSILON * condition));
                conditions.push(condition);
            }
        }
        conditions.sort_by(f64::total_cmp);
        Some(Conditioned {
            // Not less than the rounding of the result itself.
            factor: ALLOWANCE * factor.max(1.0),
            median: *conditions.get(conditions.len() / 2)?,
            largest: *conditions.last()?,
        })
    }

    /// The places of the task's rows, those first that are longest in H at the median of the random states.
    pub(crate) fn longest_first(&self, squared_lengths: &Program) -> [usize; 6] {
        let random = self.states[..self.random()].iter();
        let lengths: Vec<Vec<f64>> = random.map(|state| state.in_f64(squared_lengths)).collect();
        let median = |place: usize| {
            let mut of_row: Vec<f64> = lengths
                .iter()
                .filter_map(|all| all.get(place).copied())
                .collect();
            of_row.sort_by(f64::total_cmp);
            of_row.get(of_row.len() / 2).copied().unwrap_or(-1.0)
        };
        let mut order = Choices::default().order;
        let medians = order.map(median);
        order.sort_by(|a, b| medians[*b].total_cmp(&medians[*a]));
        order
    }

    /// As many states as a program of its length is run on, near-singular ones among them.
    fn some_states(&self, program: &Program) -> impl Iterator<Item = &State> {
        let operations = program.steps.len() * self.states.len();
        let stride = operations.div_ceil(OPERATIONS).max(1);
        self.states.iter().rev().step_by(stride)
    }

    /// The largest relative error of a program's outputs at a state.
    fn error_at(&self, program: &Program, state: &State) -> f64 {
        let (exact, found) = (state.exactly(program), state.in_f64(program));
        let (mut start, mut worst, mut largest_beside) = (0, 0.0_f64, 0.0_f64);
        for output in &program.outputs {
            let range = start..start + output.elements.len();
            start = range.end;
            if output.size == Size::Any {
                continue;
            }
            let (mut difference, mut largest) = (0.0_f64, 0.0_f64);
            for (exact, found) in exact[range.clone()].iter().zip(&found[range]) {
                let apart = (*exact - DoubleDouble::of(*found)).abs().to_f64();
                difference = difference.max(if apart.is_nan() { f64::INFINITY } else { apart });
                largest = largest.max(exact.to_f64().abs());
            }
            let size = match output.size {
                Size::LargestOrBefore => largest.max(largest_beside),
                Size::LargestOrLength => largest.max(self.length),
                // What cancels to 0 is measured by 1, in SI units.
                _ if largest == 0.0 => 1.0,
                _ => largest,
            };
            largest_beside = largest;
            if difference > 0.0 {
                worst = worst.max(difference / size);
            }
        }
        worst
    }
}

/// The condition number of w_D at `q`, as `ulna::proof::condition` has it, from ∂ln w_D/∂J (by rows) and ∂ln w_D/∂M.
fn condition(model: &Model, q: &[f64], sensitivity: &[f64]) -> f64 {
    let joints = model.joints().len();
    let (by_jacobian, by_mass) = sensitivity.split_at(model.task().len() * joints);
    let length = length(model, q);
    let rows = model.task().iter().zip(by_jacobian.chunks(joints));
    let of_rows = rows.map(|(row, weights)| {
        let size = if row < TaskRow::Rx { length } else { 1.0 };
        weights.iter().map(|weight| weight.abs()).sum::<f64>() * size
    });
    let sizes: Vec<f64> = (0..joints)
        .map(|i| carried_inertia(model.joints(), i, |joint| q[joint]).sqrt())
        .collect();
    let of_masses = by_mass.chunks(joints).zip(&sizes).map(|(row, size)| {
        let row = row.iter().zip(&sizes);
        row.map(|(weight, other)| weight.abs() * size * other)
            .sum::<f64>()
    });
    of_rows.sum::<f64>() + of_masses.sum::<f64>()
}

/// `SerialChain::length` of a chain whose number of joints is known at run time.
fn length(model: &Model, q: &[f64]) -> f64 {
    singular::length(model.joints(), model.tool(), q)
}

/// The same of `SerialChain::is_singular`.
fn counts_as_zero(model: &Model, q: &[f64], volume_squared: f64) -> bool {
    let least = singular::least_volume_squared(model.joints(), model.tool(), model.task(), q);
    singular::counts_as_zero(volume_squared, least, q)
}

/// An error to one digit, not less than it is.
pub(crate) fn rounded_up(error: f64) -> String {
    if error == 0.0 || !error.is_finite() {
        return error.to_string();
    }
    let place = 10_f64.powf(error.log10().floor());
    format!("{:.0e}", (error / place).ceil() * place)
}
