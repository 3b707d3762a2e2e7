//! `[campaign]`.

use super::Reader;
use crate::scenario::CampaignSettings;
use crate::scenario::format::bounds::{MAX_CASES, MAX_FAILURE_TIMES};
use crate::scenario::format::campaign::{self as format, DEFAULTS};
use crate::scenario::read::{CampaignTable, Number};
use ulna_table::toml_reader::{Key, Located};

impl Reader<'_> {
    pub(super) fn campaign(&self, table: &CampaignTable) -> Option<CampaignSettings> {
        let count = |number: &Option<Located<u64>>, default: u64, most: u64| {
            let Some(number) = number else {
                return Some(default);
            };
            if (1..=most).contains(&number.value) {
                return Some(number.value);
            }
            let message = format!("{} is out of bounds", number.name);
            self.refuse(
                &number.span,
                message,
                format!("must be within 1 to {most}"),
                "write a count",
            );
            None
        };
        let spread = |number: &Number, default: f64, key: &Key| match number {
            Some(_) => self.bounded(number, key),
            None => Some(default),
        };
        let cases = count(&table.cases, DEFAULTS.cases, MAX_CASES);
        let failure_times = count(
            &table.failure_times,
            DEFAULTS.failure_times,
            MAX_FAILURE_TIMES,
        );
        let start_spread = spread(
            &table.start_spread,
            DEFAULTS.start_spread,
            &format::START_SPREAD,
        );
        let goal_spread = spread(
            &table.goal_spread,
            DEFAULTS.goal_spread,
            &format::GOAL_SPREAD,
        );
        let force_spread = spread(
            &table.force_spread,
            DEFAULTS.force_spread,
            &format::FORCE_SPREAD,
        );
        Some(CampaignSettings {
            cases: cases?,
            seed: table.seed.as_ref().map_or(DEFAULTS.seed, |seed| seed.value),
            failure_times: failure_times?,
            start_spread: start_spread?,
            goal_spread: goal_spread?,
            force_spread: force_spread?,
        })
    }
}
