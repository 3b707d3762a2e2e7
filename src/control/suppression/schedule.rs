//! [`Schedule`]: a compensation computed beforehand.

use nalgebra::{SVector, Vector6};

use crate::control::compensation::FreeTorque;

/// Samples of `U = P z(t) + Jᵀ f(t)` at a fixed period, with straight lines between them; the first and last one hold before and after.
///
/// It is z and f that are interpolated, and P and J are those of the cycle: whatever the arm's way, the static tool force is off by f and by nothing else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schedule<'a, const N: usize> {
    start: f64,
    period: f64,
    torques: &'a [SVector<f64, N>],
    /// As many as torques, or none.
    wrenches: &'a [Vector6<f64>],
}

/// Why samples make no schedule.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScheduleError {
    /// No samples.
    #[error("a schedule needs at least one sample")]
    Empty,
    /// A period that is not above 0, or a time that is not finite.
    #[error(
        "a schedule's start must be finite and its period finite and above 0 s, not {start} s and {period} s"
    )]
    Time {
        /// The start, s.
        start: f64,
        /// The period, s.
        period: f64,
    },
    /// More or fewer wrenches than torques.
    #[error("a schedule needs a wrench for each of its {torques} torques, not {wrenches}")]
    Wrenches {
        /// How many torques there are.
        torques: usize,
        /// How many wrenches.
        wrenches: usize,
    },
    /// A sample that is infinite or no number.
    #[error("sample {0} of the schedule is not finite")]
    NotFinite(usize),
}

impl<'a, const N: usize> Schedule<'a, N> {
    /// `torques`: z, N·m (N), from `start` on, every `period` s.
    ///
    /// # Errors
    /// No samples, times that are none, samples that are not finite.
    pub fn new(
        start: f64,
        period: f64,
        torques: &'a [SVector<f64, N>],
    ) -> Result<Self, ScheduleError> {
        if torques.is_empty() {
            return Err(ScheduleError::Empty);
        }
        if !(start.is_finite() && period.is_finite() && period > 0.0) {
            return Err(ScheduleError::Time { start, period });
        }
        let broken = |torque: &SVector<f64, N>| torque.iter().any(|x| !x.is_finite());
        if let Some(sample) = torques.iter().position(broken) {
            return Err(ScheduleError::NotFinite(sample));
        }
        Ok(Self {
            start,
            period,
            torques,
            wrenches: &[],
        })
    }

    /// The same with f, `[force; moment]`, world axes, N and N·m, at the same times; 0 outside the task.
    ///
    /// # Errors
    /// Not as many as there are torques, or samples that are not finite.
    pub fn with_wrenches(self, wrenches: &'a [Vector6<f64>]) -> Result<Self, ScheduleError> {
        if wrenches.len() != self.torques.len() {
            return Err(ScheduleError::Wrenches {
                torques: self.torques.len(),
                wrenches: wrenches.len(),
            });
        }
        let broken = |wrench: &Vector6<f64>| wrench.iter().any(|x| !x.is_finite());
        if let Some(sample) = wrenches.iter().position(broken) {
            return Err(ScheduleError::NotFinite(sample));
        }
        Ok(Self { wrenches, ..self })
    }

    /// z and f at `time`, s.
    #[inline]
    pub fn at(&self, time: f64) -> FreeTorque<N> {
        let last = self.torques.len() - 1;
        let position = ((time - self.start) / self.period).max(0.0);
        // What is beyond the end, and beyond every integer, is the end.
        let before = (position as usize).min(last);
        let after = (before + 1).min(last);
        let share = (position - before as f64).min(1.0);
        FreeTorque {
            torque: between(&self.torques[before], &self.torques[after], share),
            wrench: match (self.wrenches.get(before), self.wrenches.get(after)) {
                (Some(before), Some(after)) => between(before, after, share),
                _ => Vector6::zeros(),
            },
        }
    }
}

fn between<const N: usize>(
    from: &SVector<f64, N>,
    to: &SVector<f64, N>,
    share: f64,
) -> SVector<f64, N> {
    from * (1.0 - share) + to * share
}
