//! A moment in the program: its variables, where they stand, and what they do.

use nalgebra::{DMatrix, DVector, SVector};

use super::rows::{below, keep_force, keep_force_of, keep_torque};
use super::{Moment, RobustObjective, RobustOptions, RobustSample};
use crate::search::OperatingPoint;
use crate::search::convex::conic::{Minimum, Program};
use crate::search::convex::free_map::FreeMap;
use crate::search::convex::pseudo_inverse::{null_space, stack};

/// What of a moment goes into the program.
pub(super) struct Part {
    /// `U₀`'s map; its last columns are the force's, if there is a budget.
    pub(super) before: FreeMap,
    planned: DVector<f64>,
    rated: DVector<f64>,
    locks: Vec<Lock>,
}

/// A lock at a moment.
pub(super) struct Lock {
    map: FreeMap,
    /// Healthy joints' rows of the step, seen in [`seen`](Self::seen).
    step: DVector<f64>,
    /// What of a healthy torque counts, as the norm of its products with these columns: what y_k cannot take away, or all of it if y_k is kept.
    seen: DMatrix<f64>,
    /// Whether y_k is a variable of the program.
    kept: bool,
    planned: DVector<f64>,
    rated: DVector<f64>,
    /// The norm of the step without compensation.
    before: f64,
}

/// Where a part's variables stand.
pub(super) struct Place {
    pub(super) before: usize,
    /// Of each lock: y_k and f_k.
    after: Vec<usize>,
    /// What bounds each lock's norm: one variable for all of them, or one each.
    bounds: Vec<usize>,
    /// What each bound costs.
    costs: Vec<f64>,
    /// What bounds those of several, at a cost of 1.
    worst: Option<usize>,
}

pub(super) struct Layout {
    pub(super) places: Vec<Place>,
    pub(super) variables: usize,
}

impl Layout {
    pub(super) fn of(parts: &[Part], objective: &RobustObjective, mean: f64) -> Self {
        let mut variables = 0;
        let mut take = |count: usize| {
            variables += count;
            variables - count
        };
        let mut places = Vec::with_capacity(parts.len());
        for part in parts {
            let before = take(part.before.torque.ncols());
            let after = part.locks.iter().map(|lock| take(lock.columns())).collect();
            let locks = part.locks.len();
            let mut each = || (0..locks).map(|_| take(1)).collect();
            let (bounds, costs, worst) = match objective {
                RobustObjective::Expected(weights) => (each(), weights.clone(), None),
                _ if mean > 0.0 => {
                    let bounds = each();
                    (bounds, vec![mean / locks as f64; locks], Some(take(1)))
                }
                _ => (vec![take(1); locks.max(1)], vec![1.0], None),
            };
            places.push(Place {
                before,
                after,
                bounds,
                costs,
                worst,
            });
        }
        Self { places, variables }
    }

    pub(super) fn objective(&self, minimum: &Minimum) -> f64 {
        let of_place = |place: &Place| {
            let costs = place.bounds.iter().zip(&place.costs);
            let each: f64 = costs.map(|(bound, cost)| cost * minimum.x[*bound]).sum();
            each + place.worst.map_or(0.0, |worst| minimum.x[worst])
        };
        self.places.iter().map(of_place).sum()
    }
}

impl Part {
    /// `kept` says of which locks y_k stays in the program.
    pub(super) fn new<const N: usize>(
        moment: &Moment<N>,
        options: &RobustOptions<N>,
        kept: &[bool],
    ) -> Self {
        let exact = options.force_budget == 0.0;
        let all = DVector::from_column_slice(options.rated_torque.as_slice());
        Self {
            before: FreeMap::new(&moment.before).kept(exact),
            planned: DVector::from_column_slice(moment.before.planned.as_slice()),
            rated: all,
            locks: moment
                .after
                .iter()
                .zip(kept)
                .map(|(after, kept)| Lock::new(after, &moment.before, options, *kept))
                .collect(),
        }
    }

    pub(super) fn add<const N: usize>(
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
        if let Some(worst) = place.worst {
            program.linear[worst] = 1.0;
            below(program, &place.bounds, worst);
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
    pub(super) fn sample<const N: usize>(
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
        kept: bool,
    ) -> Self {
        let map = FreeMap::new(after).kept(options.force_budget == 0.0);
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
        let seen = if kept {
            let mut seen = DMatrix::zeros(N, healthy.len());
            for (column, joint) in healthy.iter().enumerate() {
                seen[(*joint, column)] = 1.0;
            }
            seen
        } else {
            // Neither what y_k takes away nor what goes into the brakes; near a singular pose it takes away a part.
            let mut brakes = DMatrix::zeros(after.locked.len(), N);
            for (row, joint) in after.locked.iter().enumerate() {
                brakes[(row, joint)] = 1.0;
            }
            let left = null_space(&stack(&map.null.transpose(), &brakes));
            match 1.0 - after.pose.fade() {
                0.0 => left,
                kept => stack(&left.transpose(), &(map.null.transpose() * kept)).transpose(),
            }
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
        let y = self.map.null.tr_mul(&left);
        let mut both = DVector::zeros(null + own.len());
        both.rows_mut(0, null).copy_from(&y);
        both.rows_mut(null, own.len()).copy_from(&own);
        both
    }
}
