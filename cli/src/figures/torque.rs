//! Torques over time, without and with suppression: the paper's Figures 4 to 6.

use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::DrawingBackend;
use ulna::experiment::{Case, Method, Series, Study};

use super::chart::{Axes, Key, legend, panel, range};
use super::law::{LAWS, WITHOUT, WITHOUT_LABEL};
use super::stroke::{BOUND, EVENT};
use super::style::Pen;
use super::{Area, Drawn, Figure};

/// For each of some joints: the torque over the whole motion, and beside it around the lock.
pub(crate) struct Torques<'s> {
    pub(crate) study: &'s Study,
    /// Counted from 0.
    pub(crate) joints: &'s [usize],
    /// "N\u{b7}m", or "N" for a prismatic joint.
    pub(crate) units: &'s [&'static str],
}

impl Figure for Torques<'_> {
    fn size(&self) -> (u32, u32) {
        (1000, 40 + 230 * self.joints.len().max(1) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (head, body) = area.split_vertically(pen.px(34));
        let rated = self.study.case(Method::PerJoint).rated_torque.as_ref();
        let mut entries = vec![(Key::Stroke(WITHOUT), WITHOUT_LABEL.to_owned())];
        entries.extend(LAWS.map(|law| (Key::Stroke(law.stroke), law.label.to_owned())));
        if rated.is_some() {
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
            let series = &case.flight.series;
            let points = series.time.iter().zip(rows(series));
            let points = points.map(|(time, row)| (*time, row[joint]));
            points.filter(|(time, _)| seen(*time)).collect::<Vec<_>>()
        };
        let planned = curve(self.study.case(Method::PerJoint), |series| &series.planned);
        let curves = LAWS.map(|law| {
            let case = self.study.case(law.method);
            (curve(case, |series| &series.torque), law.stroke)
        });
        let rated = self.study.case(Method::PerJoint).rated_torque.as_ref();
        let rated = rated
            .map(|rated| rated[joint])
            .filter(|rated| rated.is_finite() && within.is_none());

        let all = || curves.iter().flat_map(|(points, _)| points).chain(&planned);
        let title = match (within, rated) {
            (Some(_), _) => format!("around the lock at {lock} s"),
            (None, None) => format!("joint {}", joint + 1),
            (None, Some(rated)) => {
                format!("joint {} (rated {rated} {})", joint + 1, self.units[joint])
            }
        };
        // A limit that is far away is not drawn: it would press the curves flat.
        let largest = all().fold(0.0_f64, |largest, point| largest.max(point.1.abs()));
        let rated = rated.filter(|rated| *rated <= 1.5 * largest);
        let limits = rated.into_iter().flat_map(|rated| [rated, -rated]);
        let y = range(all().map(|point| point.1).chain(limits));
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
                y: (&format!("torque in {}", self.units[joint]), y.clone()),
            },
        )?;
        EVENT.curve(&mut panel, pen, &[(lock, y.start), (lock, y.end)])?;
        for limit in rated.into_iter().flat_map(|rated| [rated, -rated]) {
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
