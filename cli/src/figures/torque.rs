//! Torques over time, without and with suppression: the paper's Figures 4 to 6.

use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::DrawingBackend;
use ulna::JointKind;
use ulna_study::experiment::{Case, SearchMethod, Series, Study};

use super::chart::{Axes, Key, legend, panel, range};
use super::law::{LAWS, WITHOUT, WITHOUT_LABEL};
use super::stroke::{BOUND, EVENT};
use super::style::{Pen, torque_label, unit};
use super::{Area, Drawn, Figure};

/// For each of some joints: the torque over the whole motion, and beside it around the lock.
pub(crate) struct Torques<'s> {
    pub(crate) study: &'s Study,
    /// Counted from 0.
    pub(crate) joints: &'s [usize],
    /// Of every joint.
    pub(crate) kinds: &'s [JointKind],
}

impl Figure for Torques<'_> {
    fn size(&self) -> (u32, u32) {
        (1000, 40 + 230 * self.joints.len().max(1) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (head, body) = area.split_vertically(pen.px(34));
        let mut entries = vec![(Key::Stroke(WITHOUT), WITHOUT_LABEL.to_owned())];
        entries.extend(LAWS.map(|law| (Key::Stroke(law.stroke), law.label.to_owned())));
        if self
            .joints
            .iter()
            .any(|joint| self.near_limit(*joint).is_some())
        {
            entries.push((Key::Stroke(BOUND), "rated torque".to_owned()));
        }
        legend(&head, pen, &entries)?;
        let rows = body.split_evenly((self.joints.len(), 1));
        for (row, joint) in rows.iter().zip(self.joints) {
            let (whole, lock) =
                row.split_horizontally((f64::from(row.dim_in_pixel().0) * 0.62) as u32);
            self.joint(&whole, pen, *joint, None)?;
            self.joint(&lock, pen, *joint, Some(0.5))?;
        }
        Ok(())
    }
}

impl Torques<'_> {
    /// A joint's rated torque, if it has one.
    fn rated(&self, joint: usize) -> Option<f64> {
        let rated = self
            .study
            .case(SearchMethod::PerJoint)
            .rated_torque
            .as_ref();
        rated
            .map(|rated| rated[joint])
            .filter(|rated| rated.is_finite())
    }

    /// A rated torque that is worth drawing: one that is far away would press the curves flat.
    fn near_limit(&self, joint: usize) -> Option<f64> {
        let largest = LAWS.map(|law| self.study.case(law.method).rollout.max_torque[joint]);
        let largest = largest.into_iter().fold(0.0, f64::max);
        self.rated(joint).filter(|rated| *rated <= 1.5 * largest)
    }

    /// One joint over the whole motion, or `within` so many seconds of the lock.
    fn joint<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        pen: Pen,
        joint: usize,
        within: Option<f64>,
    ) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
        let lock = self.study.failure_time;
        let seen = |time: f64| within.is_none_or(|within| (time - lock).abs() <= within);
        let curve = |case: &Case, rows: fn(&Series) -> &Vec<Vec<f64>>| {
            let series = &case.rollout.series;
            let points = series.time.iter().zip(rows(series));
            let points = points.map(|(time, row)| (*time, row[joint]));
            points.filter(|(time, _)| seen(*time)).collect::<Vec<_>>()
        };
        let planned = curve(self.study.case(SearchMethod::PerJoint), |series| {
            &series.planned
        });
        let curves = LAWS.map(|law| {
            let case = self.study.case(law.method);
            (curve(case, |series| &series.torque), law.stroke)
        });
        let limit = self.near_limit(joint).filter(|_| within.is_none());
        let limits = || limit.into_iter().flat_map(|limit| [limit, -limit]);

        let all = || curves.iter().flat_map(|(points, _)| points).chain(&planned);
        let title = match (within, self.rated(joint)) {
            (Some(_), _) => format!("around the lock at {lock} s"),
            (None, None) => format!("joint {}", joint + 1),
            (None, Some(rated)) => {
                format!(
                    "joint {} (rated {rated} {})",
                    joint + 1,
                    unit(self.kinds[joint])
                )
            }
        };
        let y = range(all().map(|point| point.1).chain(limits()));
        let x = match within {
            Some(within) => lock - within..lock + within,
            None => 0.0..all().map(|point| point.0).fold(lock, f64::max),
        };
        let mut panel = panel(
            area,
            pen,
            &Axes {
                title: &title,
                x: ("time in s", x.clone()),
                y: (torque_label(self.kinds[joint]), y.clone()),
            },
        )?;
        EVENT.curve(&mut panel, pen, &[(lock, y.start), (lock, y.end)])?;
        for limit in limits() {
            BOUND.curve(&mut panel, pen, &[(x.start, limit), (x.end, limit)])?;
        }
        WITHOUT.curve(&mut panel, pen, &planned)?;
        // The first law of the legend lies on top.
        for (points, stroke) in curves.iter().rev() {
            stroke.curve(&mut panel, pen, points)?;
        }
        Ok(())
    }
}
