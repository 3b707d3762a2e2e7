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

use std::time::Instant;

use nalgebra::{DMatrix, DVector, SVector};

use super::conic::{Minimum, Program};
use super::free_map::FreeMap;
use super::pseudo_inverse::{null_space, pseudo_inverse, stack};
use crate::search::{OperatingPoint, SearchError, SolveStatus};
use ulna::control::compensation::FreeTorque;

/// One time of a motion, and every lock that may happen then.
#[derive(Clone, Debug)]
pub struct Moment<const N: usize> {
    /// All joints moving.
    pub before: OperatingPoint<N>,
    /// The same time with the joints of each lock at rest.
    pub after: Vec<OperatingPoint<N>>,
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
    /// Rated torques, N·m (N); infinite where there is no limit.
    pub rated_torque: SVector<f64, N>,
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
            rated_torque: SVector::repeat(f64::INFINITY),
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
pub(super) const TOLERANCE: f64 = 1e-8;

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
    let exact = options.force_budget == 0.0;
    let parts: Vec<Part> = moments
        .iter()
        .map(|moment| Part::new(moment, options, exact))
        .collect();
    let layout = Layout::of(&parts, &options.objective);
    let mut program = Program::new(layout.variables);
    program.tolerance = TOLERANCE;
    for (i, part) in parts.iter().enumerate() {
        part.add(&mut program, &layout.places[i], options);
        if let Some((next, after)) = parts.get(i + 1).zip(layout.places.get(i + 1)) {
            let time = moments[i + 1].before.time - moments[i].before.time;
            couple(
                &mut program,
                [(part, &layout.places[i]), (next, after)],
                time,
                &options.rate,
            );
        }
    }
    let minimum = program.solve()?.ok_or_else(|| tightest(moments, options))?;
    let places = layout.places.iter().zip(&parts).zip(moments);
    let samples: Vec<_> = places
        .map(|((place, part), moment)| part.sample(&minimum, place, moment))
        .collect();
    Ok(RobustPlan {
        objective: layout.objective(&minimum),
        samples,
        status: minimum.status,
        gap: minimum.gap,
        iterations: minimum.iterations,
        variables: layout.variables,
        seconds: clock.elapsed().as_secs_f64(),
    })
}

fn check<const N: usize>(
    moments: &[Moment<N>],
    options: &RobustOptions<N>,
) -> Result<(), SearchError> {
    let argument = |name, range, value| Err(SearchError::Argument { name, range, value });
    if !(options.force_budget >= 0.0 && options.force_budget.is_finite()) {
        return argument("force budget", "at least 0 N", options.force_budget);
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

/// What of a moment goes into the program.
struct Part {
    /// `U₀`'s map; its last columns are the force's, if there is a budget.
    before: FreeMap,
    planned: DVector<f64>,
    rated: DVector<f64>,
    locks: Vec<Lock>,
}

/// A lock at a moment.
struct Lock {
    map: FreeMap,
    /// Healthy joints' rows of the step, seen in [`seen`](Self::seen).
    step: DVector<f64>,
    /// What of a healthy torque counts: an orthonormal basis of what y_k cannot take away, or all of it if y_k is kept.
    seen: DMatrix<f64>,
    /// Whether y_k is a variable of the program.
    kept: bool,
    planned: DVector<f64>,
    rated: DVector<f64>,
    /// The norm of the step without compensation.
    before: f64,
}

/// Where a part's variables stand.
struct Place {
    before: usize,
    /// Of each lock: y_k and f_k.
    after: Vec<usize>,
    /// s, or one for each lock.
    bounds: Vec<usize>,
    /// What each lock's bound costs.
    costs: Vec<f64>,
}

struct Layout {
    places: Vec<Place>,
    variables: usize,
}

impl Layout {
    fn of(parts: &[Part], objective: &RobustObjective) -> Self {
        let mut variables = 0;
        let mut take = |count: usize| {
            variables += count;
            variables - count
        };
        let mut places = Vec::with_capacity(parts.len());
        for part in parts {
            let before = take(part.before.torque.ncols());
            let after = part.locks.iter().map(|lock| take(lock.columns())).collect();
            let (bounds, costs) = match objective {
                RobustObjective::Expected(weights) => {
                    let bounds = weights.iter().map(|_| take(1)).collect();
                    (bounds, weights.clone())
                }
                _ => (vec![take(1); part.locks.len().max(1)], vec![1.0]),
            };
            places.push(Place {
                before,
                after,
                bounds,
                costs,
            });
        }
        Self { places, variables }
    }

    fn objective(&self, minimum: &Minimum) -> f64 {
        let places = self.places.iter();
        let costs = places.flat_map(|place| place.bounds.iter().zip(&place.costs));
        costs.map(|(bound, cost)| cost * minimum.x[*bound]).sum()
    }
}

impl Part {
    fn new<const N: usize>(moment: &Moment<N>, options: &RobustOptions<N>, exact: bool) -> Self {
        let all = DVector::from_column_slice(options.rated_torque.as_slice());
        Self {
            before: FreeMap::new(&moment.before).kept(exact),
            planned: DVector::from_column_slice(moment.before.planned.as_slice()),
            rated: all,
            locks: moment
                .after
                .iter()
                .map(|after| Lock::new(after, &moment.before, options, exact))
                .collect(),
        }
    }

    fn add<const N: usize>(
        &self,
        program: &mut Program,
        place: &Place,
        options: &RobustOptions<N>,
    ) {
        for variable in &mut program.quadratic[place.before..][..self.before.null.ncols()] {
            *variable = options.effort * options.effort;
        }
        for (bound, cost) in place.bounds.iter().zip(&place.costs) {
            program.linear[*bound] = *cost;
        }
        keep_force(program, &self.before, place.before, options.force_budget);
        keep_torque(
            program,
            (place.before, &self.before.torque),
            &self.planned,
            &self.rated,
        );
        for ((lock, first), bound) in self.locks.iter().zip(&place.after).zip(&place.bounds) {
            let weight = match options.objective {
                RobustObjective::WorstRatio { floor } => lock.before.max(floor),
                _ => 1.0,
            };
            let own = lock.seen.tr_mul(&lock.torque()) / weight;
            let others = lock.seen.tr_mul(&self.before.torque) / -weight;
            let step = &lock.step / weight;
            program.cone(
                &[(*first, &own), (place.before, &others)],
                step.as_slice(),
                0.0,
                Some((*bound, 1.0)),
            );
            let null = lock.map.null.ncols();
            let forces = if lock.kept { *first + null } else { *first };
            keep_force_of(program, &lock.map, forces, options.force_budget);
            if lock.kept {
                keep_torque(
                    program,
                    (*first, &lock.map.torque),
                    &lock.planned,
                    &lock.rated,
                );
            }
        }
    }

    /// What the solver's answer means at this moment.
    fn sample<const N: usize>(
        &self,
        minimum: &Minimum,
        place: &Place,
        moment: &Moment<N>,
    ) -> RobustSample<N> {
        let x = minimum
            .x
            .rows(place.before, self.before.torque.ncols())
            .into_owned();
        let u = &self.before.torque * &x;
        let locks = self.locks.iter().zip(&place.after);
        let (mut after, mut impact) = (Vec::new(), Vec::new());
        for ((lock, first), point) in locks.zip(&moment.after) {
            let y = lock.recourse(minimum, *first, &u, moment, point);
            let change = &lock.map.torque * &y - &u;
            let change = SVector::from_fn(|i, _| change[i]);
            let residual = point.planned - moment.before.planned + change;
            impact.push(point.locked.without(&residual).norm());
            after.push(lock.map.parameters(y.as_slice()));
        }
        RobustSample {
            time: moment.before.time,
            before: self.before.parameters(x.as_slice()),
            after,
            impact,
        }
    }
}

impl Lock {
    fn new<const N: usize>(
        after: &OperatingPoint<N>,
        before: &OperatingPoint<N>,
        options: &RobustOptions<N>,
        exact: bool,
    ) -> Self {
        let map = FreeMap::new(after).kept(exact);
        let healthy: Vec<usize> = after.locked.healthy().collect();
        let step = after.locked.without(&(after.planned - before.planned));
        let rated = |joint: usize| {
            if after.locked.contains(joint) {
                f64::INFINITY
            } else {
                options.rated_torque[joint]
            }
        };
        let rated = DVector::from_fn(N, |joint, _| rated(joint));
        let kept = rated.iter().any(|rated| rated.is_finite());
        let seen = if kept {
            let mut seen = DMatrix::zeros(N, healthy.len());
            for (column, joint) in healthy.iter().enumerate() {
                seen[(*joint, column)] = 1.0;
            }
            seen
        } else {
            // Neither what y_k takes away nor what goes into the brakes.
            let taken = map.torque.columns(0, map.null.ncols()).transpose();
            let mut brakes = DMatrix::zeros(after.locked.len(), N);
            for (row, joint) in after.locked.iter().enumerate() {
                brakes[(row, joint)] = 1.0;
            }
            null_space(&stack(&taken, &brakes))
        };
        Self {
            step: seen.tr_mul(&DVector::from_column_slice(step.as_slice())),
            seen,
            kept,
            planned: DVector::from_column_slice(after.planned.as_slice()),
            rated,
            before: step.norm(),
            map,
        }
    }

    /// How many variables of the program are its own.
    fn columns(&self) -> usize {
        let all = self.map.torque.ncols();
        if self.kept {
            all
        } else {
            all - self.map.null.ncols()
        }
    }

    /// What those do.
    fn torque(&self) -> DMatrix<f64> {
        let (all, own) = (self.map.torque.ncols(), self.columns());
        self.map.torque.columns(all - own, own).into_owned()
    }

    /// y_k and f_k, the former made up for if it was eliminated.
    fn recourse<const N: usize>(
        &self,
        minimum: &Minimum,
        first: usize,
        u: &DVector<f64>,
        moment: &Moment<N>,
        after: &OperatingPoint<N>,
    ) -> DVector<f64> {
        let own = minimum.x.rows(first, self.columns()).into_owned();
        if self.kept {
            return own;
        }
        let step = after
            .locked
            .without(&(after.planned - moment.before.planned));
        let left = u - DVector::from_column_slice(step.as_slice()) - self.torque() * &own;
        let null = self.map.null.ncols();
        let taking = self.map.torque.columns(0, null).into_owned();
        let y = pseudo_inverse(&taking, 1.0) * left;
        let mut both = DVector::zeros(null + own.len());
        both.rows_mut(0, null).copy_from(&y);
        both.rows_mut(null, own.len()).copy_from(&own);
        both
    }
}

/// `‖h‖ ≤ ε` of a whole map, whose variables begin at `first`.
fn keep_force(program: &mut Program, map: &FreeMap, first: usize, budget: f64) {
    keep_force_of(program, map, first + map.null.ncols(), budget);
}

/// The same with the force's own variables beginning at `first`: P z bends nothing.
fn keep_force_of(program: &mut Program, map: &FreeMap, first: usize, budget: f64) {
    let null = map.null.ncols();
    let forces = map.force.ncols() - null;
    if forces > 0 {
        let force = map.force.columns(null, forces).into_owned();
        program.cone(&[(first, &force)], &vec![0.0; force.nrows()], budget, None);
    }
}

/// `|planned + T x| ≤ rated` where a rated torque is finite.
fn keep_torque(
    program: &mut Program,
    (first, torque): (usize, &DMatrix<f64>),
    planned: &DVector<f64>,
    rated: &DVector<f64>,
) {
    let bound: Vec<usize> = (0..rated.len()).filter(|i| rated[*i].is_finite()).collect();
    if bound.is_empty() {
        return;
    }
    let rows = torque.select_rows(&bound);
    let room = |sign: f64| -> Vec<f64> {
        let room = bound.iter().map(|i| rated[*i] - sign * planned[*i]);
        room.collect()
    };
    program.at_most_from(first, &rows, &room(1.0));
    program.at_most_from(first, &-rows, &room(-1.0));
}

/// `|U₀(next) − U₀| ≤ rate · time`.
fn couple<const N: usize>(
    program: &mut Program,
    [(part, place), (next, after)]: [(&Part, &Place); 2],
    time: f64,
    rate: &SVector<f64, N>,
) {
    let bound: Vec<usize> = (0..N).filter(|i| rate[*i].is_finite()).collect();
    if bound.is_empty() {
        return;
    }
    let from = -part.before.torque.select_rows(&bound);
    let to = next.before.torque.select_rows(&bound);
    let room: Vec<f64> = bound.iter().map(|i| rate[*i] * time).collect();
    program.within(&[(place.before, &from), (after.before, &to)], &room);
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
