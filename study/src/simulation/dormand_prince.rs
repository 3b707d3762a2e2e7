//! Adaptive integration by the pair of order 5(4) of Dormand and Prince (1980)
//! (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, II.4 and II.5, Table 5.2).
//!
//! Our own, because it has to run without std and without allocation, on a state that is no plain vector.

use std::ops::{Add, Mul};

use nalgebra::ComplexField;

/// A state that can be integrated: a vector space with a measure of error.
pub(super) trait State: Copy + Add<Output = Self> + Mul<f64, Output = Self> {
    /// The largest entry of `error` relative to `1 + |self|`; NaN if an entry is.
    fn relative(&self, error: &Self) -> f64;
}

/// Why an integration stopped early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// A slope is infinite or no number, however short the step.
    NotFinite,
    /// The steps ran out, or became too short to move the time on.
    StepTooShort,
}

/// The rows of the tableau below the first: where a stage lies, and the weights of the stages before it.
const STAGES: [(f64, [f64; 6]); 6] = [
    (1.0 / 5.0, [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (3.0 / 10.0, [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0]),
    (
        4.0 / 5.0,
        [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    ),
    (
        8.0 / 9.0,
        [
            19372.0 / 6561.0,
            -25360.0 / 2187.0,
            64448.0 / 6561.0,
            -212.0 / 729.0,
            0.0,
            0.0,
        ],
    ),
    (
        1.0,
        [
            9017.0 / 3168.0,
            -355.0 / 33.0,
            46732.0 / 5247.0,
            49.0 / 176.0,
            -5103.0 / 18656.0,
            0.0,
        ],
    ),
    // The solution of order 5: its slope is the first stage of the next step.
    (
        1.0,
        [
            35.0 / 384.0,
            0.0,
            500.0 / 1113.0,
            125.0 / 192.0,
            -2187.0 / 6784.0,
            11.0 / 84.0,
        ],
    ),
];

/// The solution of order 5 minus that of order 4.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// What [`Step::at`] adds to the solution of order 5 between a step's ends (Hairer, Nørsett, Wanner, II.6, after Shampine).
const BETWEEN: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// A step that was taken, to be looked into.
pub(super) struct Step<S> {
    from: f64,
    to: f64,
    length: f64,
    start: S,
    slopes: [S; 7],
}

impl<S: State> Step<S> {
    /// The time and the state after the share `s`, 0 to 1, of the step: continuous output of order 4.
    pub(super) fn at(&self, s: f64) -> (f64, S) {
        let rest = 1.0 - s;
        let solution = &STAGES[5].1;
        let weights: [f64; 7] = std::array::from_fn(|i| {
            let whole = solution.get(i).copied().unwrap_or(0.0);
            let (first, last) = (f64::from(u8::from(i == 0)), f64::from(u8::from(i == 6)));
            let bent = 2.0 * whole - first - last + rest * BETWEEN[i];
            s * (whole + rest * (first - whole + s * bent))
        });
        let time = if s == 1.0 {
            self.to
        } else {
            self.from + self.length * s
        };
        (
            time,
            self.start + combine(&self.slopes, &weights) * self.length,
        )
    }
}

/// Takes steps, and remembers between calls how long they may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stepper {
    /// Bound of the local error of a step, as [`State::relative`] measures it.
    tolerance: f64,
    /// The next step, s.
    step: f64,
    /// Steps that may still be tried.
    left: u32,
    /// Steps taken.
    pub(super) taken: u32,
}

impl Stepper {
    pub(super) fn new(tolerance: f64, at_most: u32) -> Self {
        Self {
            tolerance,
            step: f64::INFINITY,
            left: at_most,
            taken: 0,
        }
    }

    /// Begins anew with a step of at most `first_step`, after the slope has jumped.
    pub(super) fn restart(&mut self, first_step: f64) {
        self.step = first_step.min(self.step);
    }

    /// Takes `state` from the time `from` to `to`, hit exactly, and shows every step that it takes to `watch`.
    pub(super) fn advance<S: State>(
        &mut self,
        state: &mut S,
        from: f64,
        to: f64,
        slope: impl Fn(f64, &S) -> S,
        mut watch: impl FnMut(&Step<S>),
    ) -> Result<(), Stop> {
        let mut time = from;
        let mut first = slope(time, state);
        let mut stop = Stop::StepTooShort;
        while time < to {
            let left = to - time;
            let last = self.step >= left;
            let step = if last { left } else { self.step };
            if self.left == 0 || time + step == time {
                return Err(stop);
            }
            self.left -= 1;

            let mut slopes = [first; 7];
            let mut next = *state;
            for (i, (at, weights)) in STAGES.iter().enumerate() {
                next = *state + combine(&slopes[..=i], weights) * step;
                slopes[i + 1] = slope(time + at * step, &next);
            }
            let error = next.relative(&(combine(&slopes, &ERROR) * step)) / self.tolerance;
            if !error.is_finite() {
                stop = Stop::NotFinite;
                self.step = step * 0.2;
                continue;
            }
            stop = Stop::StepTooShort;
            let factor = (0.9 * ComplexField::powf(error.max(1e-10), -0.2)).clamp(0.2, 5.0);
            if error <= 1.0 {
                let start = std::mem::replace(state, next);
                let from = time;
                time = if last { to } else { time + step };
                watch(&Step {
                    from,
                    to: time,
                    length: step,
                    start,
                    slopes,
                });
                first = slopes[6];
                self.taken += 1;
                // A step cut short by `to` says nothing against the longer one.
                self.step = if last {
                    self.step.max(step * factor)
                } else {
                    step * factor
                };
            } else {
                self.step = step * factor;
            }
        }
        Ok(())
    }
}

/// The sum of `states` times `weights`.
fn combine<S: State>(states: &[S], weights: &[f64]) -> S {
    let mut terms = states.iter().zip(weights).filter(|(_, w)| **w != 0.0);
    let (first, weight) = terms.next().unwrap_or((&states[0], &0.0));
    terms.fold(*first * *weight, |sum, (state, weight)| {
        sum + *state * *weight
    })
}
