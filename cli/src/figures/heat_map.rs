//! The impact over joint and failure time, before and after, and the force errors of laws that bend the force: the picture of a campaign.

use std::cmp::Ordering;

use plotters::element::{Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor};
use ulna_campaign::{LawCells, Row};
use ulna_study::LawSet;

use super::chart::{Axes, grid_panel, tick};
use super::style::{BLACK, Pen, WHITE, anchored};
use super::{Area, Drawn, Figure};
use crate::campaign::median;

/// Medians over the cases of each joint and failure time.
pub(crate) struct HeatMap<'r> {
    /// By joint, and then by failure time.
    rows: Vec<&'r Row>,
    laws: LawSet,
    joints: usize,
    /// Ascending.
    times: Vec<f64>,
}

/// A quantity of a case.
type Quantity = Box<dyn Fn(&Row) -> Option<f64>>;

/// Of the law whose cells are the `index`-th.
fn of_law(index: usize, quantity: fn(&LawCells) -> Option<f64>) -> Quantity {
    Box::new(move |row| row.laws.get(index).and_then(quantity))
}

/// Panels with one colour scale.
struct Group {
    panels: Vec<(String, Quantity)>,
    /// The words beside the scale.
    scale: [&'static str; 2],
}

/// Impacts, and the force errors of laws that bend the force: the others keep it as far as the rated torques let them.
fn groups(laws: LawSet) -> Vec<Group> {
    let mut impacts: Vec<(String, Quantity)> = vec![(
        "without suppression".to_owned(),
        Box::new(|row| row.case.before),
    )];
    let mut forces: Vec<(String, Quantity)> = Vec::new();
    for (index, law) in laws.iter().enumerate() {
        let title = law.title();
        impacts.push((title.to_owned(), of_law(index, |cells| cells.impact)));
        if law.bends_force() {
            let at_lock = of_law(index, |cells| cells.force_error);
            let at_worst = of_law(index, |cells| cells.max_force_error);
            forces.push((format!("{title}: force error at the lock"), at_lock));
            forces.push((format!("{title}: force error at worst"), at_worst));
        }
    }
    let groups = [
        Group {
            panels: impacts,
            scale: ["median impact", "in N\u{b7}m"],
        },
        Group {
            panels: forces,
            scale: ["median error", "in N"],
        },
    ];
    let groups = groups.into_iter();
    groups.filter(|group| !group.panels.is_empty()).collect()
}

impl<'r> HeatMap<'r> {
    /// Of the cases of a campaign of `laws`, of an arm with so many joints.
    pub(crate) fn new(rows: &'r [Row], laws: LawSet, joints: usize) -> Self {
        let mut times: Vec<_> = rows.iter().map(|row| row.case.failure_time).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let mut rows: Vec<_> = rows.iter().collect();
        rows.sort_by(|a, b| order(a, b.case.failed_joint, b.case.failure_time));
        Self {
            rows,
            laws,
            joints,
            times,
        }
    }

    fn cell(&self, joint: usize, time: f64, quantity: &Quantity) -> Option<f64> {
        let first = |past: Ordering| {
            self.rows
                .partition_point(|row| order(row, joint, time) < past)
        };
        let here = &self.rows[first(Ordering::Equal)..first(Ordering::Greater)];
        median(here.iter().filter_map(|row| quantity(row)).collect())
    }

    /// The ends of the colour scale of a group, powers of ten: four decades up to the largest median in its panels.
    fn decades(&self, group: &Group) -> (f64, f64) {
        let quantities = group.panels.iter().map(|(_, quantity)| quantity);
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
    let joints = row.case.failed_joint.cmp(&joint);
    joints.then(row.case.failure_time.total_cmp(&time))
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
        let groups = groups(self.laws);
        let rows = groups
            .iter()
            .map(|group| group.panels.len().div_ceil(COLUMNS));
        (1000, 280 * rows.sum::<usize>() as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let mut rest = area.clone();
        for group in groups(self.laws) {
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
                        .cell(joint, *time, quantity)
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
