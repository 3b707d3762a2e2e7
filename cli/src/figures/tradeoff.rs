//! What tool force buys: force error against impact.

use plotters::prelude::DrawingBackend;
use ulna_study::experiment::{SearchMethod, Study};

use super::chart::{Axes, Key, Panel, legend, panel};
use super::stroke::CURVES;
use super::style::{GREY, Marker, Pen};
use super::{Area, Drawn, Figure};

/// The frontier of an experiment at each failure time, with the laws as marks.
pub(crate) struct Tradeoffs<'s> {
    /// One for each failure time.
    pub(crate) studies: &'s [&'s Study],
}

/// The marks: what the shapes stand for.
const MARKS: [(SearchMethod, &str, Marker); 3] = [
    (SearchMethod::Optimal, "optimal", Marker::Circle),
    (SearchMethod::Projected, "Eq. 20", Marker::Triangle),
    (SearchMethod::PerJoint, "Eq. 16", Marker::Square),
];

impl Figure for Tradeoffs<'_> {
    fn size(&self) -> (u32, u32) {
        (1000, 460)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (head, body) = area.split_vertically(pen.px(34));
        let curves = self.studies.iter().zip(CURVES.into_iter().cycle());
        let mut entries: Vec<_> = curves
            .map(|(study, stroke)| {
                (
                    Key::Stroke(stroke),
                    format!("least possible, lock at {} s", study.failure_time),
                )
            })
            .collect();
        entries
            .extend(MARKS.map(|(_, label, marker)| (Key::Marker(marker, GREY), label.to_owned())));
        legend(&head, pen, &entries)?;

        let cases = self.studies.iter().flat_map(|study| {
            MARKS.map(|(method, ..)| {
                let case = study.case(method);
                (case.force_error, case.healthy_impact().1)
            })
        });
        let frontier = self
            .studies
            .iter()
            .filter_map(|study| study.tradeoff.as_ref());
        let frontier: Vec<_> = frontier
            .flat_map(|tradeoff| tradeoff.frontier.iter().copied())
            .collect();
        let most = |points: &mut dyn Iterator<Item = f64>| 1.08 * points.fold(1e-3, f64::max);
        let all: Vec<_> = cases.chain(frontier.iter().copied()).collect();
        let top = most(&mut all.iter().map(|point| point.1));
        let near = most(&mut frontier.iter().map(|point| point.0));
        let far = most(&mut all.iter().map(|point| point.0));
        let (left, right) = body.split_horizontally(body.dim_in_pixel().0 / 2);
        for (area, title, right) in [
            (&left, "close to the exact tool force", near),
            (&right, "up to Eq. 16", far),
        ] {
            let mut panel = panel(
                area,
                pen,
                &Axes {
                    title,
                    x: (
                        "error of the tool force at the lock in N",
                        -0.02 * right..right,
                    ),
                    y: (
                        "impact, norm over the healthy joints, in N\u{b7}m",
                        -0.02 * top..top,
                    ),
                },
            )?;
            self.draw_into(&mut panel, pen, right)?;
        }
        Ok(())
    }
}

impl Tradeoffs<'_> {
    fn draw_into<DB: DrawingBackend>(
        &self,
        panel: &mut Panel<'_, DB>,
        pen: Pen,
        right: f64,
    ) -> Drawn<DB> {
        for (study, stroke) in self.studies.iter().zip(CURVES.into_iter().cycle()) {
            if let Some(tradeoff) = &study.tradeoff {
                let mut points = tradeoff.frontier.clone();
                // More force error never hurts: from its end the frontier goes on as it is.
                points.extend(points.last().map(|last| (right, last.1)));
                stroke.curve(panel, pen, &points)?;
            }
        }
        for (study, stroke) in self.studies.iter().zip(CURVES.into_iter().cycle()) {
            for (method, _, marker) in MARKS {
                let case = study.case(method);
                let point = (case.force_error, case.healthy_impact().1);
                if point.0 <= right {
                    marker.draw(panel.plotting_area(), pen, point, stroke.colour)?;
                }
            }
        }
        Ok(())
    }
}
