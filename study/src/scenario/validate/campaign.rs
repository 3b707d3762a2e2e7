//! `[campaign]`.

use std::ops::RangeInclusive;

use super::Reader;
use crate::scenario::CampaignSettings;
use crate::scenario::read::{CampaignTable, Number};
use ulna_table::toml_reader::{Bound, Located};

const SPREAD: Bound = Bound {
    range: 0.0..=100.0,
    unit: "rad (m)",
    help: "a spread is the largest deviation, not negative",
};
const FORCE_SPREAD: Bound = Bound {
    range: 0.0..=1e7,
    unit: "N (N m)",
    help: "a spread is the largest deviation, not negative",
};

/// How many failure times there may be: each is a column of the figure.
const FAILURE_TIMES: RangeInclusive<u64> = 1..=1000;

impl Reader<'_> {
    pub(super) fn campaign(&self, table: &CampaignTable) -> Option<CampaignSettings> {
        let count = |number: &Option<Located<u64>>, default: u64, range: RangeInclusive<u64>| {
            let Some(number) = number else {
                return Some(default);
            };
            if range.contains(&number.value) {
                return Some(number.value);
            }
            let message = format!("{} is out of bounds", number.name);
            self.refuse(
                &number.span,
                message,
                format!("must be within {} to {}", range.start(), range.end()),
                "write a count",
            );
            None
        };
        let spread = |number: &Number, default: f64, bound: &Bound| match number {
            Some(_) => self.bounded(number, bound),
            None => Some(default),
        };
        let cases = count(&table.cases, 10_000, CampaignSettings::CASES);
        let failure_times = count(&table.failure_times, 20, FAILURE_TIMES);
        let start_spread = spread(&table.start_spread, 0.5, &SPREAD);
        let goal_spread = spread(&table.goal_spread, 0.5, &SPREAD);
        let force_spread = spread(&table.force_spread, 20.0, &FORCE_SPREAD);
        Some(CampaignSettings {
            cases: cases?,
            seed: table.seed.as_ref().map_or(1, |seed| seed.value),
            failure_times: failure_times?,
            start_spread: start_spread?,
            goal_spread: goal_spread?,
            force_spread: force_spread?,
        })
    }
}
