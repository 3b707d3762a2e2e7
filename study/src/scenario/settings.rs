//! The numbers of a scenario that stand together: the search, the brakes, the campaign.

use std::ops::RangeInclusive;

use super::format::bounds::MAX_CASES;
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
}

impl CampaignSettings {
    /// How many cases there may be: their rows are in memory together, 0.2 KB each.
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
