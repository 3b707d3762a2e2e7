//! [`Peaks`]: the largest torques of the continuous motion, not of its samples.

use nalgebra::SVector;

/// The largest torques so far, without sign, N·m (N).
#[derive(Clone, Copy, Debug)]
pub(super) struct Peaks<const N: usize> {
    /// What the joints transmit.
    pub(super) torque: SVector<f64, N>,
    /// What the brakes give while they slow their joints down.
    pub(super) brake: SVector<f64, N>,
}

impl<const N: usize> Default for Peaks<N> {
    fn default() -> Self {
        Self {
            torque: SVector::zeros(),
            brake: SVector::zeros(),
        }
    }
}

impl<const N: usize> Peaks<N> {
    /// Looks into one step of the integration, in which nothing jumps: `loads` gives what the joints transmit and what the brakes give
    /// after a share of it.
    ///
    /// A step is short enough for its error that a torque in it bends little more than a parabola does: where the one through both
    /// ends and the middle rises above the peak so far in between, the torque's own maximum is looked for.
    pub(super) fn look(
        &mut self,
        loads: impl Fn(f64) -> (SVector<f64, N>, SVector<f64, N>),
        braking: bool,
    ) {
        let points = [0.0, 0.5, 1.0].map(&loads);
        for joint in 0..N {
            let values = points.map(|(torque, _)| torque[joint].abs());
            let peak = &mut self.torque[joint];
            *peak = larger(*peak, values, |share| loads(share).0[joint].abs());
            if braking {
                let values = points.map(|(_, brake)| brake[joint].abs());
                let peak = &mut self.brake[joint];
                *peak = larger(*peak, values, |share| loads(share).1[joint].abs());
            }
        }
    }
}

/// The largest of `known` and of a smooth function on 0 to 1, whose `values` at 0, ½ and 1 are known.
fn larger(known: f64, values: [f64; 3], function: impl Fn(f64) -> f64) -> f64 {
    /// Less is not worth looking for, relative.
    const LEAST_GAIN: f64 = 1e-9;
    let [first, middle, last] = values;
    let known = values.into_iter().fold(known, f64::max);
    let (slope, bend) = (last - first, first - 2.0 * middle + last);
    let within = bend < 0.0 && slope.abs() < -2.0 * bend;
    if !within || middle - slope * slope / (8.0 * bend) <= known * (1.0 + LEAST_GAIN) {
        return known;
    }
    known.max(golden_section(function))
}

/// The maximum on 0 to 1 of a function that rises and then falls (Kiefer 1953).
/// Near a maximum a function is flat: what 2e-5 of the interval are off counts by their square.
fn golden_section(function: impl Fn(f64) -> f64) -> f64 {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut from, mut to) = (0.0, 1.0);
    let inner = |from: f64, to: f64| (to - RATIO * (to - from), from + RATIO * (to - from));
    let (mut left, mut right) = inner(from, to);
    let (mut at_left, mut at_right) = (function(left), function(right));
    for _ in 0..22 {
        if at_left > at_right {
            (to, right, at_right) = (right, left, at_left);
            left = inner(from, to).0;
            at_left = function(left);
        } else {
            (from, left, at_left) = (left, right, at_right);
            right = inner(from, to).1;
            at_right = function(right);
        }
    }
    at_left.max(at_right)
}
