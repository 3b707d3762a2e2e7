//! `[failure]`.

use super::Reader;
use crate::scenario::read::FailureTable;
use ulna_table::toml_reader::Located;

impl Reader<'_> {
    /// The joints, ascending, and the times.
    pub(super) fn failure(
        &self,
        table: &FailureTable,
        duration: Option<f64>,
    ) -> Option<(Vec<usize>, Vec<f64>)> {
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
        Some((joints?, times?))
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
