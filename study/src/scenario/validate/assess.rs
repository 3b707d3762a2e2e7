//! `[assess]`.

use super::Reader;
use crate::laws::LawSet;
use crate::scenario::AssessSettings;
use crate::scenario::format::assess as format;
use crate::scenario::format::bounds::{MAX_ASSESSED_TIMES, MAX_BUDGETS};
use crate::scenario::read::AssessTable;

impl Reader<'_> {
    pub(super) fn assess(&self, table: &AssessTable) -> Option<AssessSettings> {
        let failure_times = self.count(
            &table.failure_times,
            format::FAILURE_TIMES_DEFAULT,
            MAX_ASSESSED_TIMES,
        );
        let locks_at_once = self.count(
            &table.locks_at_once,
            format::LOCKS_AT_ONCE_DEFAULT,
            AssessSettings::MOST_LOCKS_AT_ONCE,
        );
        let force_budgets = self.force_budgets(table);
        let rate_limit = self.number_or(
            &table.rate_limit,
            format::RATE_LIMIT_DEFAULT,
            &format::RATE_LIMIT,
        );
        let ramp = self.number_or(&table.ramp, format::RAMP_DEFAULT, &format::RAMP_TIME);
        let rated_torque = match &table.rated_torque {
            Some(rated) => self.rated_torque(rated).map(Some),
            None => Some(None),
        };
        let laws = self.laws(&table.laws, format::LAWS_DEFAULT, |_| None);
        let always = format::ALWAYS_ASSESSED.into_iter();
        let laws = laws.map(|laws| always.fold(laws, LawSet::with));
        Some(AssessSettings {
            failure_times: failure_times?,
            locks_at_once: locks_at_once?,
            force_budgets: force_budgets?,
            rate_limit: rate_limit?,
            ramp: ramp?,
            rated_torque: rated_torque?,
            laws: laws?,
        })
    }

    /// Ascending, each once.
    fn force_budgets(&self, table: &AssessTable) -> Option<Vec<f64>> {
        let Some(list) = &table.force_budgets else {
            return Some(format::FORCE_BUDGETS_DEFAULT.to_vec());
        };
        self.not_empty(list, "force_budgets = [0.0, 5.0]")?;
        let mut budgets = format::FORCE_BUDGETS.admit_all(&list.value, self.sink)?;
        budgets.sort_by(f64::total_cmp);
        if budgets.len() > MAX_BUDGETS || budgets.windows(2).any(|pair| pair[0] == pair[1]) {
            let message = format!("{} has too many numbers, or one of them twice", list.name);
            let label = format!("at most {MAX_BUDGETS}, each once");
            self.refuse(&list.span, message, label, "write fewer");
            return None;
        }
        Some(budgets)
    }
}
