//! The impact over joint and failure time, before and after, and the force error of Eq. 16: the picture of a campaign.

use std::cmp::Ordering;

use plotters::element::{Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor};

use super::chart::{Axes, grid_panel, tick};
use super::style::{BLACK, Pen, WHITE, anchored};
use super::{Area, Drawn, Figure};
use crate::campaign::{LAWS, Quantity, Row, median};

/// Medians over the cases of each joint and failure time.
pub(crate) struct HeatMap<'r> {
    /// By joint, and then by failure time.
    rows: Vec<&'r Row>,
    joints: usize,
    /// Ascending.
    times: Vec<f64>,
}

/// Panels with one colour scale.
struct Group {
    panels: Vec<(String, Quantity)>,
    /// The words beside the scale.
    scale: [&'static str; 2],
}

/// Impacts, and force errors.
fn groups() -> [Group; 2] {
    let mut impacts: Vec<(String, Quantity)> =
        vec![("without suppression".to_owned(), |row| row.before)];
    impacts.extend(LAWS.iter().map(|law| (law.title.to_owned(), law.impact)));
    // Of Eq. 16, the first: the others keep the tool force as far as the rated torques let them.
    let forces = LAWS.iter().take(1).flat_map(|law| {
        let (at_lock, most) = law.force;
        [
            (format!("{}: force error at the lock", law.title), at_lock),
            (format!("{}: force error at worst", law.title), most),
        ]
    });
    [
        Group {
            panels: impacts,
            scale: ["median impact", "in N\u{b7}m"],
        },
        Group {
            panels: forces.collect(),
            scale: ["median error", "in N"],
        },
    ]
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

    fn cell(&self, joint: usize, time: f64, quantity: Quantity) -> Option<f64> {
        let first = |past: Ordering| {
            self.rows
                .partition_point(|row| order(row, joint, time) < past)
        };
        let here = &self.rows[first(Ordering::Equal)..first(Ordering::Greater)];
        median(here.iter().filter_map(|row| quantity(row)).collect())
    }

    /// The ends of the colour scale of a group, powers of ten: four decades up to the largest median in its panels.
    fn decades(&self, group: &Group) -> (f64, f64) {
        let quantities = group.panels.iter().map(|(_, quantity)| *quantity);
        let cells = quantities.flat_map(|quantity| {
            let joints = 1..=self.joints;
            joints.flat_map(move |joint| {
                let times = self.times.iter();
                times.filter_map(move |time| self.cell(joint, *time, quantity))
            })
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

/// The colour of a value on the logarithmic scale; what is below it has the lowest colour.
fn colour(value: f64, (least, most): (f64, f64)) -> RGBColor {
    let share = (value.max(1e-300).log10() - least) / (most - least);
    ViridisRGB.get_color(share.clamp(0.0, 1.0))
}

/// The panels stand in two columns.
const COLUMNS: usize = 2;

impl Figure for HeatMap<'_> {
    fn size(&self) -> (u32, u32) {
        let rows = groups().map(|group| group.panels.len().div_ceil(COLUMNS));
        (1000, 280 * rows.iter().sum::<usize>() as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let mut rest = area.clone();
        for group in groups() {
            let rows = group.panels.len().div_ceil(COLUMNS);
            let (upper, lower) = rest.split_vertically(pen.px(280 * rows as u32));
            rest = lower;
            self.group(&upper, pen, &group)?;
        }
        Ok(())
    }
}

impl HeatMap<'_> {
    fn group<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen, group: &Group) -> Drawn<DB> {
        let scale = self.decades(group);
        let (body, side) = area.split_horizontally(area.dim_in_pixel().0 - pen.px(120));
        let half = self.times.first().copied().unwrap_or(0.5);
        let end = self.times.last().copied().unwrap_or(0.5) + half;
        let rows = group.panels.len().div_ceil(COLUMNS);
        let areas = body.split_evenly((rows, COLUMNS));
        for (area, (title, quantity)) in areas.iter().zip(&group.panels) {
            let axes = Axes {
                title,
                x: ("failure time in s", 0.0..end),
                y: ("joint that locks", 0.5..self.joints as f64 + 0.5),
            };
            let mut panel = grid_panel(area, pen, &axes)?;
            for joint in 1..=self.joints {
                for time in &self.times {
                    let colour = self
                        .cell(joint, *time, *quantity)
                        .map_or(WHITE, |value| colour(value, scale));
                    let y = joint as f64;
                    let cell = [(time - half, y - 0.5), (time + half, y + 0.5)];
                    panel.draw_series([Rectangle::new(cell, colour.filled())])?;
                }
            }
        }
        colour_bar(&side, pen, scale, group.scale)
    }
}

/// What the colours stand for.
fn colour_bar<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    (least, most): (f64, f64),
    words: [&'static str; 2],
) -> Drawn<DB> {
    let height = area.dim_in_pixel().1.cast_signed();
    let (top, bottom) = (pen.at(74), height - pen.at(60));
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
    let lines = [words[0], words[1], "(no case: white)"].into_iter();
    for (line, y) in lines.zip([30, 46, 62]) {
        area.draw(&Text::new(line, (pen.at(4), pen.at(y)), head.clone()))?;
    }
    Ok(())
}
