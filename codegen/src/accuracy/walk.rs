//! From anywhere to the neighbourhood of a singular pose.

use super::LEAST_VOLUME;

/// From `q` downhill on `relative`, joint by joint, to a pose where it is a little above [`LEAST_VOLUME`]; `None` if none is met soon.
pub(super) fn walk(q: &[f64], relative: &impl Fn(&[f64]) -> f64) -> Option<Vec<f64>> {
    /// Sweeps over all joints.
    const SWEEPS: usize = 30;
    /// A step that gains less is not worth taking.
    const GAIN: f64 = 0.9;
    let (mut high, mut value, mut step) = (q.to_vec(), relative(q), 0.5);
    for _ in 0..SWEEPS {
        let before = value;
        for joint in 0..q.len() {
            for along in [step, -step] {
                let mut next = high.clone();
                next[joint] += along;
                let at = relative(&next);
                if at < LEAST_VOLUME {
                    return Some(between(&high, &next, relative));
                }
                if at < GAIN * value {
                    (high, value) = (next, at);
                    break;
                }
            }
        }
        if value == before {
            step *= 0.5;
        }
    }
    None
}

/// A pose on the way from `high` to `low` where `relative` is still above [`LEAST_VOLUME`], and nearly that.
fn between(high: &[f64], low: &[f64], relative: &impl Fn(&[f64]) -> f64) -> Vec<f64> {
    let at = |share: f64| -> Vec<f64> {
        let pairs = high.iter().zip(low);
        pairs
            .map(|(high, low)| high + share * (low - high))
            .collect()
    };
    let (mut far, mut near) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (far + near);
        let value = relative(&at(middle));
        if value < LEAST_VOLUME {
            near = middle;
        } else {
            far = middle;
        }
    }
    at(far)
}
