//! [`Shard`]: one of the parts that a campaign is made in, on as many machines as there are.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// One of so many parts of a campaign, counted from 1. Written as `3/16`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Shard {
    number: u64,
    of: u64,
}

impl Shard {
    /// `None` where there is no such part.
    pub fn new(number: u64, of: u64) -> Option<Self> {
        (1..=of).contains(&number).then_some(Self { number, of })
    }

    /// From 1.
    pub fn number(self) -> u64 {
        self.number
    }

    /// How many shards there are.
    pub fn of(self) -> u64 {
        self.of
    }

    /// Its cases, of `cases`: a range, so that merging is putting one after the other. A thousand cases in a row have every
    /// joint and every time of a thousand in them, and random motions: no range is more work than another.
    /// Sizes differ by one at most.
    pub fn range(self, cases: u64) -> Range<u64> {
        let bound = |shards: u64| {
            let bound = u128::from(cases) * u128::from(shards) / u128::from(self.of);
            // At most `cases`.
            u64::try_from(bound).unwrap_or(cases)
        };
        bound(self.number - 1)..bound(self.number)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.parse::<u64>().ok();
        let parts = text.split_once('/');
        let shard = parts.and_then(|(i, n)| Self::new(number(i)?, number(n)?));
        shard.ok_or_else(|| {
            "write I/N: the I-th of N shards, counted from 1, such as 3/16".to_owned()
        })
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "shard {} of {}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every case is in one shard, for any number of shards, and no shard has two more than another.
    #[test]
    fn shards_share_the_cases_evenly() {
        for cases in [1, 2, 7, 60, 61, 1_000_000_007] {
            for of in (1..=cases.min(61)).chain([cases]).filter(|of| *of < 100) {
                let ranges = (1..=of).map(|number| Shard { number, of }.range(cases));
                let mut next = 0;
                for range in ranges {
                    assert_eq!(range.start, next);
                    let size = range.end - range.start;
                    assert!(
                        size == cases / of || size == cases.div_ceil(of),
                        "{range:?}"
                    );
                    next = range.end;
                }
                assert_eq!(next, cases);
            }
        }
        let last = Shard {
            number: u64::MAX,
            of: u64::MAX,
        };
        assert_eq!(last.range(u64::MAX), u64::MAX - 1..u64::MAX);
    }

    #[test]
    fn shards_are_read_and_written() {
        let shard: Shard = "3/16".parse().unwrap();
        assert_eq!(shard.to_string(), "shard 3 of 16");
        for wrong in ["0/4", "5/4", "1/0", "1", "1/4/4", "a/b", "-1/4", ""] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
