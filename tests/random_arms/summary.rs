//! What a long series came to: how many arms, and the worst of them.

use std::fmt;

use super::arms::Arm;
use super::examination::Examination;

/// How many of the worst arms are printed.
const SHOWN: usize = 100;

#[derive(Default)]
pub(crate) struct Summary {
    pub(crate) refused: usize,
    pub(crate) failed: usize,
    arms: Vec<Row>,
}

struct Row {
    /// The worst error, in what is allowed.
    excess: f64,
    text: String,
}

impl Summary {
    pub(crate) fn examined(&self) -> usize {
        self.arms.len()
    }

    pub(crate) fn add(&mut self, index: u64, arm: &Arm, examination: &Examination) {
        let joints = arm.table.joints.len();
        self.failed += usize::from(!examination.failures.is_empty());
        let mut text = format!("{index:6} {joints:6}");
        let mut excess = 0.0;
        if let Some((worst, conditions)) = &examination.worst {
            excess = worst.excess();
            text += &format!(
                "  {:8.1e}  {:7.0e}  {:8.0e}  {:8.0e}  {}",
                worst.error,
                worst.allowed,
                conditions.mass_matrix,
                conditions.jacobian,
                worst.method
            );
        }
        for failure in &examination.failures {
            let judged = examination.worst.as_ref();
            if judged.is_none_or(|(worst, _)| worst.method != failure.kind) {
                excess = f64::INFINITY;
                text += &format!("; {}", failure.kind);
            }
        }
        let row = Row { excess, text };
        self.arms.push(row);
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            refused, failed, ..
        } = self;
        let examined = self.examined();
        writeln!(
            f,
            "{examined} arms, {failed} of them fail; {refused} more tables were refused"
        )?;
        writeln!(
            f,
            "\n   arm joints     error  allowed    cond M    cond J  worst method"
        )?;
        let mut worst: Vec<_> = self.arms.iter().collect();
        worst.sort_by(|a, b| b.excess.total_cmp(&a.excess));
        for row in worst.into_iter().take(SHOWN) {
            writeln!(f, "{}", row.text)?;
        }
        Ok(())
    }
}
