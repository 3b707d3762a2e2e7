//! [`Assessment`]: what became of all laws over all failures.

use super::case::AssessedCase;
use super::law::{AssessedLaw, Law, Tuning};

/// All laws over all failures.
#[derive(Clone, Debug, PartialEq)]
pub struct Assessment {
    /// Each with its cases.
    pub laws: Vec<LawAssessment>,
    /// The largest norm of a step without compensation, N·m (N).
    pub largest: f64,
}

/// A law over all failures.
#[derive(Clone, Debug, PartialEq)]
pub struct LawAssessment {
    /// Which.
    pub law: Law,
    /// What it was tuned for, if it was tuned for one lock.
    pub tuned: Option<Tuning>,
    /// How far it may bend the static tool force, N, if it has a budget.
    pub force_budget: Option<f64>,
    /// What its search says of itself.
    pub note: String,
    /// One for each failure that the limits leave it something for: single joints, then pairs, times ascending.
    pub cases: Vec<AssessedCase>,
    /// Of the failures of single joints.
    pub singles: Statistics,
    /// Of those of pairs; `None` if there are none.
    pub pairs: Option<Statistics>,
}

/// Ratios of after to before over many failures, and what they cost. Failures without a step to speak of have no ratio.
#[derive(Clone, Debug, PartialEq)]
pub struct Statistics {
    /// How many failures have a ratio.
    pub count: usize,
    /// The largest ratio.
    pub worst_ratio: f64,
    /// The joints and the time of it; `None` if nothing has a ratio.
    pub worst: Option<Tuning>,
    /// The median ratio.
    pub median_ratio: f64,
    /// The mean of the worst twentieth: the conditional value at risk (Rockafellar and Uryasev 2000).
    pub cvar: f64,
    /// The share of failures with a larger step than without the law.
    pub share_worse: f64,
    /// The largest norm without the law, N·m (N).
    pub worst_before: f64,
    /// The largest norm with it, N·m (N).
    pub worst_after: f64,
    /// The largest force error over all motions, N.
    pub worst_force_error: f64,
    /// The largest at a lock, N.
    pub worst_force_error_at_lock: f64,
    /// What is left of the rated torques at worst, N·m (N).
    pub least_margin: f64,
    /// The largest |dU_i/dt|, N·m/s (N/s).
    pub fastest_change: f64,
}

impl Assessment {
    /// Of all `cases`: for each failure what each law made of it, as [`FailureGrid::cases`](super::FailureGrid::cases) has it.
    pub fn new<const N: usize>(
        laws: &[AssessedLaw<N>],
        cases: Vec<Vec<Option<AssessedCase>>>,
    ) -> Self {
        let mut of_law: Vec<Vec<AssessedCase>> = laws.iter().map(|_| Vec::new()).collect();
        for failure in cases {
            for (case, list) in failure.into_iter().zip(&mut of_law) {
                list.extend(case);
            }
        }
        let all = of_law.iter().flatten();
        let largest = all.map(|case| case.before).fold(0.0, f64::max);
        let laws = laws.iter().zip(of_law).map(|(law, cases)| {
            let of = |joints: usize| {
                let cases = cases.iter().filter(|case| case.joints.len() == joints);
                cases.collect::<Vec<_>>()
            };
            let pairs = of(2);
            LawAssessment {
                law: law.law,
                tuned: law.tuned.clone(),
                force_budget: law.force_budget,
                note: law.note.clone(),
                singles: Statistics::of(&of(1), largest),
                pairs: (!pairs.is_empty()).then(|| Statistics::of(&pairs, largest)),
                cases,
            }
        });
        Self {
            laws: laws.collect(),
            largest,
        }
    }

    /// The first entry of a law.
    pub fn law(&self, law: Law) -> Option<&LawAssessment> {
        self.laws.iter().find(|entry| entry.law == law)
    }
}

impl Statistics {
    /// The worst part of the failures that [`cvar`](Self::cvar) is the mean of.
    pub const TAIL: f64 = 0.05;
    /// A step counts as larger beyond this, relative.
    const ROUNDING: f64 = 1e-9;

    fn of(cases: &[&AssessedCase], largest: f64) -> Self {
        let mut ratios: Vec<(f64, &AssessedCase)> = cases
            .iter()
            .filter_map(|case| Some((case.ratio(largest)?, *case)))
            .collect();
        ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
        let count = ratios.len();
        let sorted: Vec<f64> = ratios.iter().map(|(ratio, _)| *ratio).collect();
        let tail = ((Self::TAIL * count as f64).ceil() as usize).max(1);
        let worst = &ratios[count - tail.min(count)..];
        let larger = ratios
            .iter()
            .filter(|(ratio, _)| *ratio > 1.0 + Self::ROUNDING);
        let most = |quantity: fn(&AssessedCase) -> f64| {
            cases.iter().map(|case| quantity(case)).fold(0.0, f64::max)
        };
        Self {
            count,
            worst_ratio: ratios.last().map_or(1.0, |(ratio, _)| *ratio),
            worst: ratios.last().map(|(_, case)| Tuning {
                joints: case.joints.clone(),
                time: case.time,
            }),
            median_ratio: median(&sorted),
            cvar: match worst {
                [] => 1.0,
                worst => worst.iter().map(|(ratio, _)| ratio).sum::<f64>() / worst.len() as f64,
            },
            share_worse: larger.count() as f64 / count.max(1) as f64,
            worst_before: most(|case| case.before),
            worst_after: most(|case| case.after),
            worst_force_error: most(|case| case.force_error),
            worst_force_error_at_lock: most(|case| case.force_error_at_lock),
            least_margin: cases
                .iter()
                .map(|case| case.least_margin)
                .fold(f64::INFINITY, f64::min),
            fastest_change: most(|case| case.fastest_change),
        }
    }
}

/// The median of ratios in ascending order; 1 if there is none.
pub(super) fn median(sorted: &[f64]) -> f64 {
    let at = |index: usize| sorted.get(index).copied().unwrap_or(1.0);
    0.5 * (at(sorted.len().saturating_sub(1) / 2) + at(sorted.len() / 2))
}
