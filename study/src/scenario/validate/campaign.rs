//! `[campaign]`.

use super::Reader;
use crate::scenario::CampaignSettings;
use crate::scenario::format::bounds::{MAX_CASES, MAX_FAILURE_TIMES};
use crate::scenario::format::campaign::{self as format, DEFAULTS};
use crate::scenario::read::CampaignTable;

impl Reader<'_> {
    pub(super) fn campaign(&self, table: &CampaignTable) -> Option<CampaignSettings> {
        let cases = self.count(&table.cases, DEFAULTS.cases, MAX_CASES);
        let failure_times = self.count(
            &table.failure_times,
            DEFAULTS.failure_times,
            MAX_FAILURE_TIMES,
        );
        let start_spread = self.number_or(
            &table.start_spread,
            DEFAULTS.start_spread,
            &format::START_SPREAD,
        );
        let goal_spread = self.number_or(
            &table.goal_spread,
            DEFAULTS.goal_spread,
            &format::GOAL_SPREAD,
        );
        let force_spread = self.number_or(
            &table.force_spread,
            DEFAULTS.force_spread,
            &format::FORCE_SPREAD,
        );
        let laws = self.laws(&table.laws, DEFAULTS.laws, format::refusal);
        Some(CampaignSettings {
            cases: cases?,
            seed: table.seed.as_ref().map_or(DEFAULTS.seed, |seed| seed.value),
            failure_times: failure_times?,
            start_spread: start_spread?,
            goal_spread: goal_spread?,
            force_spread: force_spread?,
            laws: laws?,
        })
    }
}
