//! [`Plan`]: which of the shards that were found make up a campaign, and what by their manifests keeps them from it.

use std::collections::{BTreeMap, BTreeSet};

use ulna_study::experiment::Shard;

use super::found::Found;
use crate::Identity;

/// What is to be put together.
#[derive(Default)]
pub(crate) struct Plan {
    /// Those of one campaign that are complete, in order; every number once, if nothing is wrong.
    pub(crate) shards: Vec<Found>,
    /// Others that are complete, the same again or of another campaign: their rows are looked at as well.
    pub(crate) others: Vec<Found>,
    notes: Vec<String>,
}

impl Plan {
    /// Sorts what was `found`, and says all that is wrong with it.
    ///
    /// Which campaign is meant, the shards themselves tell: that of most of them, or of several such the first.
    pub(crate) fn new(found: Vec<Found>, errors: &mut Vec<String>) -> Self {
        let mut campaigns: Vec<Vec<Found>> = Vec::new();
        for found in found {
            let is_its = |campaign: &&mut Vec<Found>| {
                let mut shards = campaign.iter();
                shards
                    .next()
                    .is_some_and(|one| difference(one, &found).is_none())
            };
            match campaigns.iter_mut().find(is_its) {
                Some(campaign) => campaign.push(found),
                None => campaigns.push(vec![found]),
            }
        }
        let mut plan = Self::default();
        // Of equals `max_by_key` takes the last.
        let meant = (0..campaigns.len()).rev();
        let Some(meant) = meant.max_by_key(|campaign| campaigns[*campaign].len()) else {
            return plan;
        };
        let own = campaigns.remove(meant);
        for found in campaigns.into_iter().flatten() {
            let other = own
                .first()
                .and_then(|own| Some((own, difference(own, &found)?)));
            errors.extend(other.map(|(own, difference)| {
                format!(
                    "{} is a shard of another campaign than {}: it {difference}; leave it out",
                    found.manifest.display(),
                    own.manifest.display()
                )
            }));
            plan.others.extend(Some(found).filter(Found::is_complete));
        }
        plan.sort(own, errors);
        plan
    }

    /// Puts a campaign's own shards in order.
    fn sort(&mut self, own: Vec<Found>, errors: &mut Vec<String>) {
        errors.extend(missing(&own));
        let mut by_number: BTreeMap<Shard, Vec<Found>> = BTreeMap::new();
        for found in own {
            by_number.entry(found.shard).or_default().push(found);
        }
        for (shard, found) in by_number {
            let (complete, unfinished): (Vec<_>, Vec<_>) =
                found.into_iter().partition(Found::is_complete);
            let mut complete = complete.into_iter();
            let Some(first) = complete.next() else {
                errors.extend(unfinished.iter().map(say_unfinished));
                continue;
            };
            self.notes.extend(unfinished.iter().map(|found| {
                format!(
                    "{} is passed over: {shard} is not complete there, and is in {}",
                    found.manifest.display(),
                    first.manifest.display()
                )
            }));
            for again in complete {
                if again.record.sha256 != first.record.sha256 {
                    errors.push(format!(
                        "{shard} is there twice with different rows, {} and {}: one of them comes of another build of the \
                         program, or of another kind of processor; leave that one out",
                        first.rows.display(),
                        again.rows.display()
                    ));
                }
                self.others.push(again);
            }
            self.shards.push(first);
        }
    }

    /// What is well to know, though nothing is wrong.
    pub(crate) fn notes(&self) -> &[String] {
        &self.notes
    }
}

/// What keeps the rows of `other` from standing beside those of `own`.
fn difference(own: &Found, other: &Found) -> Option<String> {
    let identity: fn(&Found) -> &Identity = |found| &found.record.identity;
    if let Some(difference) = identity(own).difference(identity(other)) {
        return Some(difference);
    }
    let [cases, laws] = [
        [own.about.cases, other.about.cases].map(|cases| format!("{cases} cases")),
        [&own.about.laws, &other.about.laws].map(|laws| format!("the laws {}", laws.join(", "))),
    ];
    let shards = [own.shard.of(), other.shard.of()].map(|of| format!("{of} shards"));
    for [own, other] in [cases, shards, laws] {
        if own != other {
            return Some(format!("is of one with {other}, not {own}"));
        }
    }
    None
}

/// Which numbers are not there at all, if any.
fn missing(own: &[Found]) -> Option<String> {
    let of = own.first()?.shard.of();
    let there: BTreeSet<_> = own.iter().map(|found| found.shard.number()).collect();
    let mut gaps = Vec::new();
    let mut next = 1;
    for number in there.into_iter().chain([of + 1]) {
        match number - next {
            0 => {}
            1 => gaps.push(next.to_string()),
            _ => gaps.push(format!("{next}-{}", number - 1)),
        }
        next = number + 1;
    }
    (!gaps.is_empty()).then(|| {
        format!(
            "missing of {of} shards: {}; `ulna campaign SCENARIO --shard I/{of}` makes them, with the same cases and seed",
            gaps.join(", ")
        )
    })
}

fn say_unfinished(found: &Found) -> String {
    let (there, all) = (found.record.rows, found.about.rows());
    let (shard, manifest) = (found.shard, found.manifest.display());
    let what = if there < all {
        format!("{there} of {all} rows are made")
    } else {
        format!("{} is not there", found.rows.display())
    };
    format!(
        "{manifest}: {shard} is incomplete, {what}; `ulna campaign SCENARIO --shard {}/{}` goes on with it",
        shard.number(),
        shard.of()
    )
}
