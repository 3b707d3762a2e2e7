//! Compensation for a failure of which neither the joint nor the time is known.
//!
//! Before any lock there is one U₀(t) for all of them; once joint k has locked and is known, a recourse U_k(t) of its own.
//! With everything force-exact but for a budget ε, `U₀ = P z + Jᵀ f` and `U_k = P_k y_k + J_kᵀ f_k`, at every sample the
//! second-order cone program is (Boyd and Vandenberghe, *Convex Optimization*, 4.4.2 and 6.4)
//!
//! `min s  with  ‖step_k + U_k − U₀‖_healthy ≤ w_k s,  ‖h(U₀)‖, ‖h(U_k)‖ ≤ ε,  |planned + U₀|, |planned_k + U_k| ≤ rated`,
//!
//! and the samples are coupled by `|U₀(t + Δ) − U₀(t)| ≤ r Δ`: one banded program for the whole motion.
//!
//! Where no rated torque can bind after the lock, y_k is eliminated: the best one takes away all of the residual that lies
//! in the null space of J_k.

mod part;
mod rows;

use std::time::Instant;

use nalgebra::SVector;

use super::conic::Program;
use crate::search::{OperatingPoint, SearchError, SolveStatus};
use part::{Layout, Part};
use ulna::control::compensation::FreeTorque;

/// One time of a motion, and every lock that may happen then.
#[derive(Clone, Debug)]
pub struct Moment<const N: usize> {
    /// All joints moving.
    pub before: OperatingPoint<N>,
    /// The same time with the joints of each lock at rest.
    pub after: Vec<OperatingPoint<N>>,
}

impl<const N: usize> Moment<N> {
    /// What a lock, one of [`after`](Self::after), makes the healthy joints' torques step by without compensation, N·m (N).
    pub fn step(&self, after: &OperatingPoint<N>) -> SVector<f64, N> {
        after.locked.without(&(after.planned - self.before.planned))
    }
}

/// What is to be small.
#[derive(Clone, Debug, PartialEq)]
pub enum RobustObjective {
    /// At each time the largest ratio of after to before, over the locks. A lock whose step is below `floor`, N·m (N), above 0,
    /// counts as if it were that much: what is nothing need not become less.
    WorstRatio {
        /// N·m (N).
        floor: f64,
    },
    /// At each time the largest norm, N·m (N), over the locks.
    WorstTorque,
    /// At each time the expected norm, N·m (N): a probability for each lock.
    Expected(Vec<f64>),
}

/// How a [`robust`] compensation is sought.
#[derive(Clone, Debug, PartialEq)]
pub struct RobustOptions<const N: usize> {
    /// What is to be small.
    pub objective: RobustObjective,
    /// ε: how far the static tool force may be bent, N (with the moments' N·m, if the task has any).
    pub force_budget: f64,
    /// Largest |dU₀/dt| of each joint, N·m/s (N/s); infinite where there is no limit.
    pub rate: SVector<f64, N>,
    /// When U₀ begins at 0, s: from there to the first moment it obeys [`rate`](Self::rate) too. `None` if it may begin anywhere.
    pub start: Option<f64>,
    /// Rated torques, N·m (N); infinite where there is no limit.
    pub rated_torque: SVector<f64, N>,
    /// What the mean over the locks counts beside the worst of them: it decides where the worst leaves a choice. At least 0;
    /// without meaning for [`RobustObjective::Expected`].
    pub mean: f64,
    /// What U₀ costs: at every time `½ effort² ‖U₀‖²` (of N·m) is added to the objective, and decides among equals.
    pub effort: f64,
}

impl<const N: usize> Default for RobustOptions<N> {
    /// The worst ratio with the force exact, without limits.
    fn default() -> Self {
        Self {
            objective: RobustObjective::WorstRatio { floor: 1e-2 },
            force_budget: 0.0,
            rate: SVector::repeat(f64::INFINITY),
            start: None,
            rated_torque: SVector::repeat(f64::INFINITY),
            mean: 0.0,
            effort: 1e-4,
        }
    }
}

/// A compensation over a motion, and its certificate.
#[derive(Clone, Debug, PartialEq)]
pub struct RobustPlan<const N: usize> {
    /// One for each [`Moment`].
    pub samples: Vec<RobustSample<N>>,
    /// The sum over the samples of what was to be small; no plan within the limits leaves less by more than [`gap`](Self::gap).
    pub objective: f64,
    /// How the search ended.
    pub status: SolveStatus,
    /// Primal minus dual objective, in the objective's unit.
    pub gap: f64,
    /// Of the solver.
    pub iterations: usize,
    /// Variables of the program.
    pub variables: usize,
    /// How long it took, s.
    pub seconds: f64,
}

/// A time of a [`RobustPlan`].
#[derive(Clone, Debug, PartialEq)]
pub struct RobustSample<const N: usize> {
    /// When, s.
    pub time: f64,
    /// Until a lock.
    pub before: FreeTorque<N>,
    /// If a lock happens now, one for each of [`Moment::after`].
    pub after: Vec<FreeTorque<N>>,
    /// The norm of the healthy joints' steps for each lock, N·m (N).
    pub impact: Vec<f64>,
}

/// Cones of thousands of variables are solved so well: ratios to eight digits.
pub(super) const TOLERANCE: f64 = 1e-6;

/// The compensation that leaves least by `options`, whichever lock of each of `moments` happens.
///
/// # Errors
/// When a budget, rate or effort is no number that makes a program, when no compensation keeps the limits,
/// or when the solver stops without an answer.
pub fn robust<const N: usize>(
    moments: &[Moment<N>],
    options: &RobustOptions<N>,
) -> Result<RobustPlan<N>, SearchError> {
    let clock = Instant::now();
    check(moments, options)?;
    // Without the variables y_k first; with those of the locks after which a rated torque turns out to be in the way.
    let mut kept: Vec<_> = moments
        .iter()
        .map(|moment| vec![false; moment.after.len()])
        .collect();
    let mut iterations = 0;
    for round in 0.. {
        let mut plan = solve(moments, options, &kept)?;
        iterations += plan.iterations;
        let beyond = plan.beyond(moments, options, &kept);
        if beyond.is_empty() {
            plan.iterations = iterations;
            plan.seconds = clock.elapsed().as_secs_f64();
            return Ok(plan);
        }
        for (moment, lock) in beyond {
            kept[moment][lock] = true;
        }
        if round == MOST_ROUNDS {
            kept.iter_mut().for_each(|kept| kept.fill(true));
        }
    }
    Err(SearchError::NotSolved("rated torques kept in turns"))
}

/// After so many rounds nothing is eliminated any more.
const MOST_ROUNDS: usize = 4;
/// A rated torque counts as exceeded beyond this, relative: the solver keeps limits to its tolerance.
const EXCEEDED: f64 = 1e-6;

/// The program with the variables y_k of the locks that are `kept`.
fn solve<const N: usize>(
    moments: &[Moment<N>],
    options: &RobustOptions<N>,
    kept: &[Vec<bool>],
) -> Result<RobustPlan<N>, SearchError> {
    let parts: Vec<Part> = moments
        .iter()
        .zip(kept)
        .map(|(moment, kept)| Part::new(moment, options, kept))
        .collect();
    let layout = Layout::of(&parts, &options.objective, options.mean);
    let mut program = Program::new(layout.variables);
    program.tolerance = TOLERANCE;
    for (i, part) in parts.iter().enumerate() {
        part.add(&mut program, &layout.places[i], options);
        if let Some((next, after)) = parts.get(i + 1).zip(layout.places.get(i + 1)) {
            let time = moments[i + 1].before.time - moments[i].before.time;
            let pair = [(part, &layout.places[i]), (next, after)];
            rows::couple(&mut program, pair, time, &options.rate);
        }
    }
    if let (Some(start), [part, ..], [place, ..], [moment, ..]) =
        (options.start, &parts[..], &layout.places[..], moments)
    {
        let time = (moment.before.time - start).max(0.0);
        rows::begin(&mut program, (part, place), time, &options.rate);
    }
    let solved = program.solve()?;
    let minimum = solved.ok_or_else(|| tightest(moments, options))?;
    let places = layout.places.iter().zip(&parts).zip(moments);
    let samples = places.map(|((place, part), moment)| part.sample(&minimum, place, moment));
    Ok(RobustPlan {
        objective: layout.objective(&minimum),
        samples: samples.collect(),
        status: minimum.status,
        gap: minimum.gap,
        iterations: minimum.iterations,
        variables: layout.variables,
        seconds: 0.0,
    })
}

impl<const N: usize> RobustPlan<N> {
    /// The locks whose y_k was eliminated, and after which it exceeds a rated torque.
    fn beyond(
        &self,
        moments: &[Moment<N>],
        options: &RobustOptions<N>,
        kept: &[Vec<bool>],
    ) -> Vec<(usize, usize)> {
        let mut beyond = Vec::new();
        for (i, (sample, moment)) in self.samples.iter().zip(moments).enumerate() {
            for (lock, (point, free)) in moment.after.iter().zip(&sample.after).enumerate() {
                let torque = point.planned + point.compensation(free);
                let exceeds = |joint: usize| {
                    let rated = options.rated_torque[joint];
                    torque[joint].abs() > rated * (1.0 + EXCEEDED)
                };
                if !kept[i][lock] && point.locked.healthy().any(exceeds) {
                    beyond.push((i, lock));
                }
            }
        }
        beyond
    }
}

fn check<const N: usize>(
    moments: &[Moment<N>],
    options: &RobustOptions<N>,
) -> Result<(), SearchError> {
    let argument = |name, range, value| Err(SearchError::Argument { name, range, value });
    if !(options.force_budget >= 0.0 && options.force_budget.is_finite()) {
        return argument("force budget", "at least 0 N", options.force_budget);
    }
    if !(options.mean >= 0.0 && options.mean.is_finite()) {
        return argument("weight of the mean", "at least 0", options.mean);
    }
    if !(options.effort > 0.0 && options.effort.is_finite()) {
        return argument("effort", "above 0", options.effort);
    }
    if let Some(rate) = options
        .rate
        .iter()
        .find(|rate| rate.is_nan() || **rate <= 0.0)
    {
        return argument("rate of the compensation", "above 0", *rate);
    }
    if let RobustObjective::WorstRatio { floor } = options.objective
        && !(floor > 0.0 && floor.is_finite())
    {
        return argument("floor of the ratio", "above 0 N m", floor);
    }
    if let RobustObjective::Expected(weights) = &options.objective {
        let locks = moments.iter().map(|moment| moment.after.len());
        if locks.into_iter().any(|locks| locks != weights.len()) {
            return argument(
                "number of probabilities",
                "that of the locks",
                weights.len() as f64,
            );
        }
        if let Some(value) = weights.iter().find(|p| !(**p >= 0.0 && p.is_finite())) {
            return argument("probability", "at least 0", *value);
        }
    }
    Ok(())
}

/// The joint and the time with the least room for any compensation.
fn tightest<const N: usize>(moments: &[Moment<N>], options: &RobustOptions<N>) -> SearchError {
    let mut least = (f64::INFINITY, 0, 0.0);
    for point in moments
        .iter()
        .flat_map(|moment| moment.after.iter().chain([&moment.before]))
    {
        for joint in point.locked.healthy() {
            let room = options.rated_torque[joint] - point.planned[joint].abs();
            if room < least.0 {
                least = (room, joint, point.time);
            }
        }
    }
    let (_, joint, time) = least;
    SearchError::Empty { joint, time }
}
