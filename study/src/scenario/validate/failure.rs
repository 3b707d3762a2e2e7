//! `[failure]`.

use nalgebra::Vector6;

use super::Reader;
use crate::scenario::format::{self, DEFAULT_STEP_TIME};
use crate::scenario::read::{FailureTable, List, Number};
use ulna_table::toml_reader::{Key, Located};

/// What `[failure]` says.
pub(super) struct FailureRead {
    /// From 0, ascending.
    pub(super) joints: Vec<usize>,
    /// s.
    pub(super) times: Vec<f64>,
    /// Δt of Eq. 18 where an experiment has none of its own, s.
    pub(super) step_time: f64,
    /// `ΔF_e` and `ΔN_e` of Eq. 8, N and N·m.
    pub(super) wrench_step: Vector6<f64>,
}

impl Reader<'_> {
    pub(super) fn failure(
        &self,
        table: &FailureTable,
        duration: Option<f64>,
    ) -> Option<FailureRead> {
        let joints = table
            .joints
            .as_ref()
            .and_then(|joints| self.joint_numbers(joints));
        let joints = joints.map(|mut joints| {
            joints.sort_unstable();
            joints
        });
        let times = table.times.as_ref().and_then(|times| {
            self.not_empty(times, "times = [10.0]")?;
            let mut checked: Vec<f64> = Vec::new();
            let mut sound = true;
            for written in &times.value {
                let written = written.as_ref();
                let time = written.and_then(|written| self.time(written, duration));
                let Some((written, time)) = written.zip(time) else {
                    sound = false;
                    continue;
                };
                if checked.contains(&time) {
                    let message = format!("{} is there twice", written.name);
                    self.refuse(&written.span, message, "repeated", "write each time once");
                    sound = false;
                }
                checked.push(time);
            }
            sound.then_some(checked)
        });
        let step_time = match &table.step_time {
            None => Some(DEFAULT_STEP_TIME),
            written => {
                let last = times.as_deref().and_then(latest);
                self.step_time(written, &format::STEP_TIME, last.zip(duration))
            }
        };
        let force = self.three(&table.force_step, &format::FORCE_STEP);
        let moment = self.three(&table.moment_step, &format::MOMENT_STEP);
        let ([fx, fy, fz], [nx, ny, nz]) = (force?, moment?);
        Some(FailureRead {
            joints: joints?,
            times: times?,
            step_time: step_time?,
            wrench_step: Vector6::new(fx, fy, fz, nx, ny, nz),
        })
    }

    /// Δt of Eq. 18; with the last failure time and the motion's duration, it has to fit between them.
    pub(super) fn step_time(
        &self,
        written: &Number,
        key: &Key,
        span: Option<(f64, f64)>,
    ) -> Option<f64> {
        let step_time = self.bounded(written, key)?;
        let written = written.as_ref()?;
        if let Some((last, duration)) = span
            && last + step_time > duration
        {
            let message = format!(
                "{} leads past the motion's end: a lock at {last} s leaves {} s of it",
                written.name,
                duration - last
            );
            let help = "write a shorter time, or earlier `times` of [failure]";
            self.refuse(&written.span, message, "", help);
            return None;
        }
        Some(step_time)
    }

    /// Three numbers; zeros where there are none.
    fn three(&self, list: &List, key: &Key) -> Option<[f64; 3]> {
        if list.is_none() {
            return Some([0.0; 3]);
        }
        let numbers = self.counted(list, 3, "along x, y and z of the world")?;
        key.admit_all(numbers, self.sink)?.try_into().ok()
    }

    /// A time while the arm moves.
    fn time(&self, time: &Located<f64>, duration: Option<f64>) -> Option<f64> {
        if time.value >= 0.0 && duration.is_none_or(|duration| time.value < duration) {
            return Some(time.value);
        }
        let most = match duration {
            Some(duration) => format!("from 0 to below {duration} s"),
            None => "not negative".to_owned(),
        };
        let message = format!("{} is not while the arm moves", time.name);
        self.refuse(
            &time.span,
            message,
            most,
            "times count in seconds from the motion's start",
        );
        None
    }
}

/// The last of the failure times, s.
pub(super) fn latest(times: &[f64]) -> Option<f64> {
    times.iter().copied().reduce(f64::max)
}
