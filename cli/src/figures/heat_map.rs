//! The impact over joint and failure time, before and after: the picture of a campaign.

use std::cmp::Ordering;

use plotters::element::{Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor};
use ulna_study::Scenario;

use super::chart::{Axes, grid_panel, tick};
use super::style::{BLACK, GREY, Pen, anchored};
use super::{Area, Drawn, Figure};
use crate::campaign::Row;

/// A quantity of a case.
type Quantity = fn(&Row) -> Option<f64>;

const PANELS: [(&str, Quantity); 4] = [
    ("without suppression", |row| row.before),
    ("Eq. 16 (force bent)", |row| row.eq16),
    ("Eq. 20 (force kept)", |row| row.eq20),
    ("optimal (force kept)", |row| row.optimal),
];

/// Medians over the cases of each joint and failure time.
pub(crate) struct HeatMap<'r> {
    /// By joint, and then by failure time.
    rows: Vec<&'r Row>,
    joints: usize,
    /// Ascending.
    times: Vec<f64>,
}

impl<'r> HeatMap<'r> {
    /// Of the cases of a campaign of an arm with so many joints.
    pub(crate) fn new(rows: &'r [Row], joints: usize) -> Self {
        let mut times: Vec<_> = rows.iter().map(|row| row.failure_time).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let mut rows: Vec<_> = rows.iter().collect();
        rows.sort_by(|a, b| order(a, b.failed_joint, b.failure_time));
        Self {
            rows,
            joints,
            times,
        }
    }

    /// A line for each joint: medians over all its cases.
    pub(crate) fn summary(&self, scenario: &Scenario) -> String {
        let done = self.rows.iter().filter(|row| row.before.is_some()).count();
        let without = match self.rows.len() - done {
            0 => String::new(),
            count => format!(", {count} without (the column `status` says why)"),
        };
        let mut lines = vec![
            format!(
                "{}: arm {}, {} cases, {done} with an outcome{without}; seed {}",
                scenario.name(),
                scenario.arm().name(),
                self.rows.len(),
                scenario.campaign().seed()
            ),
            "median impact, norm over the healthy joints, N m".to_owned(),
            format!(
                "{:>6} {:>10} {:>10} {:>10} {:>10}",
                "joint", "before", "Eq.16", "Eq.20", "optimal"
            ),
        ];
        for joint in 1..=self.joints {
            let of_joint = |row: &&&Row| row.failed_joint == joint;
            let cells = PANELS.map(|(_, quantity)| {
                let values = self.rows.iter().filter(of_joint);
                let values = values.filter_map(|row| quantity(row));
                median(values.collect()).map_or_else(String::new, |median| format!("{median:.3}"))
            });
            let [before, eq16, eq20, optimal] = cells;
            lines.push(format!(
                "{joint:>6} {before:>10} {eq16:>10} {eq20:>10} {optimal:>10}"
            ));
        }
        lines.join("\n")
    }

    fn cell(&self, joint: usize, time: f64, quantity: Quantity) -> Option<f64> {
        let first = |past: Ordering| {
            self.rows
                .partition_point(|row| order(row, joint, time) < past)
        };
        let here = &self.rows[first(Ordering::Equal)..first(Ordering::Greater)];
        median(here.iter().filter_map(|row| quantity(row)).collect())
    }

    /// The ends of the colour scale, powers of ten: four decades up to the largest median without suppression.
    fn decades(&self) -> (f64, f64) {
        let (_, before) = PANELS[0];
        let joints = 1..=self.joints;
        let cells = joints.flat_map(|joint| {
            self.times
                .iter()
                .filter_map(move |time| self.cell(joint, *time, before))
        });
        let most = cells.fold(1e-6, f64::max).log10().ceil();
        (most - 4.0, most)
    }
}

/// How a row stands to those of a joint and a failure time.
fn order(row: &Row, joint: usize, time: f64) -> Ordering {
    let joints = row.failed_joint.cmp(&joint);
    joints.then(row.failure_time.total_cmp(&time))
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = values.get(values.len() / 2)?;
    let lower = values.get(values.len().saturating_sub(1) / 2)?;
    Some(0.5 * (upper + lower))
}

/// The colour of a value on the logarithmic scale; what is below it has the lowest colour.
fn colour(value: f64, (least, most): (f64, f64)) -> RGBColor {
    let share = (value.max(1e-300).log10() - least) / (most - least);
    ViridisRGB.get_color(share.clamp(0.0, 1.0))
}

impl Figure for HeatMap<'_> {
    fn size(&self) -> (u32, u32) {
        (1000, 620)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let scale = self.decades();
        let (body, side) = area.split_horizontally(area.dim_in_pixel().0 - pen.px(120));
        let half = self.times.first().copied().unwrap_or(0.5);
        let end = self.times.last().copied().unwrap_or(0.5) + half;
        for (area, (title, quantity)) in body.split_evenly((2, 2)).iter().zip(PANELS) {
            let axes = Axes {
                title,
                x: ("failure time in s", 0.0..end),
                y: ("joint that locks", 0.5..self.joints as f64 + 0.5),
            };
            let mut panel = grid_panel(area, pen, &axes)?;
            for joint in 1..=self.joints {
                for time in &self.times {
                    let colour = self
                        .cell(joint, *time, quantity)
                        .map_or(GREY, |value| colour(value, scale));
                    let y = joint as f64;
                    let cell = [(time - half, y - 0.5), (time + half, y + 0.5)];
                    panel.draw_series([Rectangle::new(cell, colour.filled())])?;
                }
            }
        }
        colour_bar(&side, pen, scale)
    }
}

/// What the colours stand for.
fn colour_bar<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    (least, most): (f64, f64),
) -> Drawn<DB> {
    let height = area.dim_in_pixel().1.cast_signed();
    let (top, bottom) = (pen.at(60), height - pen.at(60));
    let (left, right) = (pen.at(10), pen.at(30));
    let at = |exponent: f64| {
        bottom - (f64::from(bottom - top) * (exponent - least) / (most - least)) as i32
    };
    for y in (top..bottom).step_by(pen.px(1) as usize) {
        let share = f64::from(bottom - y) / f64::from(bottom - top);
        let colour = ViridisRGB.get_color(share);
        area.draw(&Rectangle::new(
            [(left, y), (right, y + pen.at(1))],
            colour.filled(),
        ))?;
    }
    area.draw(&Rectangle::new(
        [(left, top), (right, bottom)],
        BLACK.stroke_width(pen.px(1)),
    ))?;
    let style = anchored(&pen.small(), HPos::Left, VPos::Center);
    let mut exponent = least;
    while exponent <= most {
        // What is below the scale has its lowest colour.
        let bound = if exponent == least { "\u{2264} " } else { "" };
        let label = format!("{bound}{}", tick(10_f64.powf(exponent)));
        area.draw(&Text::new(label, (pen.at(36), at(exponent)), style.clone()))?;
        exponent += 1.0;
    }
    let head = anchored(&pen.small(), HPos::Left, VPos::Bottom);
    area.draw(&Text::new(
        "median impact",
        (pen.at(4), pen.at(34)),
        head.clone(),
    ))?;
    area.draw(&Text::new("in N\u{b7}m", (pen.at(4), pen.at(50)), head))
}
