//! Ratios of after to before over lock and failure time, a panel for each law, all on one scale: the picture of an assessment.

use plotters::element::{Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor};
use ulna_study::Scenario;
use ulna_study::assess::{Assessment, LawAssessment};

use super::chart::{Axes, grid_panel};
use super::style::{BLACK, BLUE, GREY, Pen, VERMILION, anchored};
use super::{Area, Drawn, Figure};
use crate::assess::title;

/// The ends of the scale: beyond them the colour is the end's.
const LEAST: f64 = 0.1;
const MOST: f64 = 10.0;
/// Panels side by side.
const COLUMNS: usize = 3;

/// A panel for each law.
pub(crate) struct RatioMaps<'a> {
    laws: Vec<&'a LawAssessment>,
    /// What locks, from below.
    locks: Vec<Vec<usize>>,
    times: &'a [f64],
    largest: f64,
    caption: String,
}

impl<'a> RatioMaps<'a> {
    /// Of the failures of single joints.
    pub(crate) fn of_singles(
        assessment: &'a Assessment,
        times: &'a [f64],
        scenario: &Scenario,
    ) -> Self {
        Self::new(assessment, times, scenario, 1)
    }

    /// Of those of two joints.
    pub(crate) fn of_pairs(
        assessment: &'a Assessment,
        times: &'a [f64],
        scenario: &Scenario,
    ) -> Self {
        Self::new(assessment, times, scenario, 2)
    }

    fn new(
        assessment: &'a Assessment,
        times: &'a [f64],
        scenario: &Scenario,
        at_once: usize,
    ) -> Self {
        // Without a law every ratio is 1.
        let laws = assessment.laws.iter().skip(1).collect();
        let first = assessment.laws.first();
        let cases = first.map_or(&[][..], |law| &law.cases);
        let mut locks: Vec<_> = cases
            .iter()
            .map(|case| case.joints.clone())
            .filter(|joints| joints.len() == at_once)
            .collect();
        locks.dedup();
        Self {
            laws,
            locks,
            times,
            largest: assessment.largest,
            caption: format!(
                "arm {}, scenario {}",
                scenario.arm().name(),
                scenario.name()
            ),
        }
    }

    /// What stands below the figure.
    pub(crate) fn footer(&self) -> String {
        let mut footer = format!("{}; grey: the lock makes no step", self.caption);
        if self.pairs() {
            let names: Vec<_> = self.locks.iter().map(|lock| name(lock)).collect();
            footer.push_str(&format!("; pairs from below: {}", names.join(" ")));
        }
        footer
    }

    fn rows(&self) -> usize {
        self.laws.len().div_ceil(COLUMNS)
    }

    fn pairs(&self) -> bool {
        self.locks.first().is_some_and(|lock| lock.len() > 1)
    }
}

/// Blue where the law helps, white where it changes nothing, vermilion where it makes worse.
fn colour(ratio: f64) -> RGBColor {
    let ratio = ratio.clamp(LEAST, MOST);
    let (end, share) = if ratio < 1.0 {
        (BLUE, ratio.ln() / LEAST.ln())
    } else {
        (VERMILION, ratio.ln() / MOST.ln())
    };
    let mix = |channel: u8| {
        let faded = 255.0 + (f64::from(channel) - 255.0) * share.sqrt();
        faded.round() as u8
    };
    RGBColor(mix(end.0), mix(end.1), mix(end.2))
}

impl Figure for RatioMaps<'_> {
    fn size(&self) -> (u32, u32) {
        let panel = if self.pairs() { 300 } else { 210 };
        (1200, panel * self.rows() as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (width, _) = area.dim_in_pixel();
        let (body, side) = area.split_horizontally(width - pen.px(110));
        let spacing = match self.times {
            [first, second, ..] => second - first,
            [only] => *only,
            [] => 1.0,
        };
        let end = self.times.last().copied().unwrap_or(0.0) + spacing;
        let panels = body.split_evenly((self.rows(), COLUMNS));
        for (area, law) in panels.iter().zip(&self.laws) {
            let title = title(law);
            let axes = Axes {
                title: &title,
                x: ("failure time in s", 0.0..end),
                y: (
                    if self.pairs() {
                        "pair that locks"
                    } else {
                        "joint that locks"
                    },
                    0.5..self.locks.len() as f64 + 0.5,
                ),
            };
            let mut panel = grid_panel(area, pen, &axes)?;
            let cells = law.cases.iter().filter_map(|case| {
                let row = self.locks.iter().position(|lock| *lock == case.joints)?;
                let y = row as f64 + 1.0;
                let colour = case.ratio(self.largest).map_or(GREY.mix(0.3), |ratio| {
                    let colour = colour(ratio);
                    colour.mix(1.0)
                });
                let (left, right) = (case.time - 0.5 * spacing, case.time + 0.5 * spacing);
                let cell = [(left, y - 0.5), (right, y + 0.5)];
                Some(Rectangle::new(cell, colour.filled()))
            });
            panel.draw_series(cells)?;
        }
        scale(&side, pen)
    }
}

fn name(lock: &[usize]) -> String {
    let joints: Vec<_> = lock.iter().map(|joint| (joint + 1).to_string()).collect();
    joints.join("+")
}

/// What the colours stand for.
fn scale<DB: DrawingBackend>(area: &Area<DB>, pen: Pen) -> Drawn<DB> {
    let (top, bottom) = (pen.at(70), pen.at(370));
    let (left, right) = (pen.at(10), pen.at(30));
    let height = f64::from(bottom - top);
    let at = |ratio: f64| {
        let share = (ratio / LEAST).ln() / (MOST / LEAST).ln();
        bottom - (height * share) as i32
    };
    for y in (top..bottom).step_by(pen.px(1) as usize) {
        let share = f64::from(bottom - y) / height;
        let ratio = LEAST * (MOST / LEAST).powf(share);
        let strip = [(left, y), (right, y + pen.at(1))];
        area.draw(&Rectangle::new(strip, colour(ratio).filled()))?;
    }
    let frame = [(left, top), (right, bottom)];
    area.draw(&Rectangle::new(frame, BLACK.stroke_width(pen.px(1))))?;
    let style = anchored(&pen.small(), HPos::Left, VPos::Center);
    for (ratio, label) in [
        (LEAST, "\u{2264} 0.1"),
        (0.3, "0.3"),
        (1.0, "1"),
        (3.0, "3"),
        (MOST, "\u{2265} 10"),
    ] {
        area.draw(&Text::new(label, (pen.at(36), at(ratio)), style.clone()))?;
    }
    let head = anchored(&pen.small(), HPos::Left, VPos::Bottom);
    for (line, y) in [
        ("step, after", 32),
        ("to before;", 46),
        ("above 1: worse", 60),
    ] {
        area.draw(&Text::new(line, (pen.at(4), pen.at(y)), head.clone()))?;
    }
    Ok(())
}
