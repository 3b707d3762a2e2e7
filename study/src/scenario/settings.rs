//! The numbers of a scenario that stand together: the search, the brakes, the campaign.

use std::ops::RangeInclusive;

use super::format::bounds::MAX_CASES;
use crate::laws::LawSet;
use crate::simulation::BrakeProfile;

/// Figure 2: where the search for k_di starts, and its step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchGrid {
    pub(super) start: f64,
    pub(super) step: f64,
}

impl SearchGrid {
    /// The first value.
    pub fn start(&self) -> f64 {
        self.start
    }

    /// The step, above 0; both signs are tried.
    pub fn step(&self) -> f64 {
        self.step
    }
}

/// Brakes that take time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrakeSettings {
    pub(super) duration: f64,
    pub(super) profile: BrakeProfile,
}

impl BrakeSettings {
    /// From moving to locked, s; above 0.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// How the rate falls in that time.
    pub fn profile(&self) -> BrakeProfile {
        self.profile
    }
}

/// How a campaign varies a scenario. All ranges are symmetric and uniform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CampaignSettings {
    pub(super) cases: u64,
    pub(super) seed: u64,
    pub(super) failure_times: u64,
    pub(super) start_spread: f64,
    pub(super) goal_spread: f64,
    pub(super) force_spread: f64,
    pub(super) laws: LawSet,
}

impl CampaignSettings {
    /// How many cases there may be. Whoever keeps their rows in memory may have to take fewer.
    pub const CASES: RangeInclusive<u64> = 1..=MAX_CASES;

    /// How many cases.
    pub fn cases(&self) -> u64 {
        self.cases
    }

    /// The seed of all random numbers.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// How many failure times, evenly spread over the motion; at least 1.
    pub fn failure_times(&self) -> u64 {
        self.failure_times
    }

    /// Each joint's start is moved by at most so much, rad (m).
    pub fn start_spread(&self) -> f64 {
        self.start_spread
    }

    /// Each joint's goal is moved by at most so much, rad (m).
    pub fn goal_spread(&self) -> f64 {
        self.goal_spread
    }

    /// Each task component of the tool force is within so much, N (N·m), constant in time.
    pub fn force_spread(&self) -> f64 {
        self.force_spread
    }

    /// The laws that meet every case; at least one.
    pub fn laws(&self) -> LawSet {
        self.laws
    }
}

/// How laws are judged over failures for which they were not tuned.
#[derive(Clone, Debug, PartialEq)]
pub struct AssessSettings {
    pub(super) failure_times: u64,
    pub(super) locks_at_once: u64,
    pub(super) force_budgets: Vec<f64>,
    pub(super) rate_limit: f64,
    pub(super) ramp: f64,
    pub(super) rated_torque: Option<Option<Vec<f64>>>,
    pub(super) laws: LawSet,
}

impl AssessSettings {
    /// The most joints that lock together.
    pub const MOST_LOCKS_AT_ONCE: u64 = 2;

    /// How many failure times, evenly spread over the motion without its ends; at least 1.
    pub fn failure_times(&self) -> u64 {
        self.failure_times
    }

    /// The most joints that lock together: 1 or 2.
    pub fn locks_at_once(&self) -> u64 {
        self.locks_at_once
    }

    /// How far the robust law may bend the static tool force, and the recourse of the others, N (with the moments' N·m, if the task has any); ascending, at least one.
    pub fn force_budgets(&self) -> &[f64] {
        &self.force_budgets
    }

    /// The fastest that the robust law's compensation may change, N·m/s (N/s).
    pub fn rate_limit(&self) -> f64 {
        self.rate_limit
    }

    /// How long a recourse takes to fade out, s; above 0.
    pub fn ramp(&self) -> f64 {
        self.ramp
    }

    /// The rated torques to keep, N·m (N), `Some(None)` for no limit; `None` where those of the first experiment count.
    pub fn rated_torque(&self) -> Option<Option<&[f64]>> {
        self.rated_torque.as_ref().map(Option::as_deref)
    }

    /// The laws that are judged; that without a compensation and the limit among them.
    pub fn laws(&self) -> LawSet {
        self.laws
    }
}

/// A campaign cannot have so many cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "a campaign of {cases} cases: it must have {} to {}",
    CampaignSettings::CASES.start(),
    CampaignSettings::CASES.end()
)]
pub struct CaseCountError {
    /// So many were asked for.
    pub cases: u64,
}
