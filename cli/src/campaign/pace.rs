//! How long a case takes.

use std::time::{Duration, Instant};

use ulna_campaign::Campaign;

/// What a case costs one thread of this machine, s: as many are made as take a second, all over the campaign.
pub(super) fn seconds_a_case(campaign: &Campaign<'_>) -> f64 {
    const PATIENCE: Duration = Duration::from_secs(1);
    const MOST: u64 = 1000;
    let cases = campaign.cases();
    let step = (cases / MOST).max(1);
    // The first has what is paid once.
    campaign.row(0);
    let clock = Instant::now();
    let mut made = 0;
    for index in (0..cases).step_by(usize::try_from(step).unwrap_or(1)) {
        campaign.row(index);
        made += 1;
        if clock.elapsed() > PATIENCE {
            break;
        }
    }
    clock.elapsed().as_secs_f64() / f64::from(made.max(1))
}
