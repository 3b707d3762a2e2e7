//! The impact joint by joint at each failure time, and the tool force over time: the paper's Figure 7.

use plotters::element::Rectangle;
use plotters::element::Text;
use plotters::prelude::DrawingBackend;
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, VPos};
use ulna_study::experiment::{Case, SearchMethod, Study};

use super::chart::{Axes, Key, bar_panel, legend, panel, range};
use super::law::{LAWS, WITHOUT, WITHOUT_LABEL};
use super::stroke::Stroke;
use super::style::{BLACK, Pen, anchored};
use super::{Area, Drawn, Figure};

/// Bars for each failure time, and the tool force if it varies.
pub(crate) struct Impacts<'s> {
    /// One for each failure time.
    pub(crate) studies: &'s [&'s Study],
    /// Whether to draw the tool force over time.
    pub(crate) with_force: bool,
    /// Of the impacts.
    pub(crate) unit: &'s str,
}

/// Below this share of the largest value a value is rounding, and said to be 0.
const ROUNDING: f64 = 1e-9;

impl Figure for Impacts<'_> {
    fn size(&self) -> (u32, u32) {
        let panels = self.studies.len() as u32 + u32::from(self.with_force);
        (1000, 40 + 300 * panels.div_ceil(2).max(1))
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (head, body) = area.split_vertically(pen.px(34));
        let mut entries = vec![(Key::Patch(WITHOUT.colour), WITHOUT_LABEL.to_owned())];
        entries.extend(LAWS.map(|law| (Key::Patch(law.stroke.colour), law.label.to_owned())));
        if self.with_force {
            entries.push((Key::Stroke(FORCE), "tool force asked for".to_owned()));
        }
        legend(&head, pen, &entries)?;
        let panels = self.studies.len() + usize::from(self.with_force);
        let areas = body.split_evenly((panels.div_ceil(2).max(1), 2));
        let mut areas = areas.iter();
        if self.with_force
            && let (Some(area), Some(study)) = (areas.next(), self.force_study())
        {
            force(area, pen, study)?;
        }
        let values = self.studies.iter().flat_map(|study| {
            let before = study
                .case(SearchMethod::PerJoint)
                .impact_before
                .iter()
                .copied();
            before.chain(
                LAWS.into_iter()
                    .flat_map(|law| study.case(law.method).impact_after.iter().copied()),
            )
        });
        let scale = Scale::of(&values.collect::<Vec<_>>());
        for (study, area) in self.studies.iter().zip(areas) {
            bars(area, pen, study, scale, self.unit)?;
        }
        Ok(())
    }
}

const FORCE: Stroke = Stroke::dashed(BLACK);

impl Impacts<'_> {
    /// The failure time whose tool force is drawn: the middle one.
    fn force_study(&self) -> Option<&Study> {
        self.studies.get(self.studies.len() / 2).copied()
    }
}

/// The size of the static tool force: asked for, and as the laws give it.
fn force<DB: DrawingBackend>(area: &Area<DB>, pen: Pen, study: &Study) -> Drawn<DB> {
    let size = |force: &[f64; 6], error: &[f64; 6]| {
        let components = force.iter().zip(error).take(3);
        components
            .map(|(force, error)| (force + error).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    let given = |case: &Case| {
        let series = &case.rollout.series;
        let forces = series.force.iter().zip(&series.force_error);
        let points = series.time.iter().zip(forces);
        points
            .map(|(time, (force, error))| (*time, size(force, error)))
            .collect::<Vec<_>>()
    };
    let series = &study.case(SearchMethod::PerJoint).rollout.series;
    let asked: Vec<_> = series
        .time
        .iter()
        .zip(&series.force)
        .map(|(time, force)| (*time, size(force, &[0.0; 6])))
        .collect();
    let curves = LAWS.map(|law| (given(study.case(law.method)), law.stroke.colour));
    let all = || curves.iter().flat_map(|(points, _)| points).chain(&asked);
    let y = range(all().map(|point| point.1).chain([0.0]));
    let x = 0.0..all().map(|point| point.0).fold(1e-3, f64::max);
    let title = format!("static tool force, lock at {} s", study.failure_time);
    let mut panel = panel(
        area,
        pen,
        &Axes {
            title: &title,
            x: ("time in s", x),
            y: ("norm of the tool force in N", y),
        },
    )?;
    for (points, colour) in &curves {
        Stroke::solid(*colour).curve(&mut panel, pen, points)?;
    }
    FORCE.curve(&mut panel, pen, &asked)
}

/// A logarithmic axis that shows every value but rounding.
#[derive(Clone, Copy)]
struct Scale {
    /// A power of ten below the smallest value.
    floor: f64,
    top: f64,
    /// Up to here a value is 0.
    zero: f64,
}

impl Scale {
    fn of(values: &[f64]) -> Self {
        let largest = values.iter().copied().fold(0.0, f64::max);
        if largest <= 0.0 {
            return Self {
                floor: 0.1,
                top: 10.0,
                zero: 0.0,
            };
        }
        let zero = ROUNDING * largest;
        let seen = values.iter().copied().filter(|value| *value > zero);
        let least = seen.fold(largest, f64::min);
        // The shortest bar has some height too, and the axis two decades.
        let floor = (0.7 * least).min(0.03 * largest);
        Self {
            floor: 10_f64.powf(floor.log10().floor()),
            top: 3.0 * largest,
            zero,
        }
    }
}

/// A group of bars for each joint, on a logarithmic axis; where there is no impact a 0.
fn bars<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    study: &Study,
    scale: Scale,
    unit: &str,
) -> Drawn<DB> {
    let eq16 = study.case(SearchMethod::PerJoint);
    let before = &eq16.impact_before;
    let joints = before.len();
    let title = format!(
        "lock at {} s; force error of Eq. 16: {} N, at worst {} N",
        study.failure_time,
        rounded(eq16.force_error),
        rounded(eq16.rollout.max_force_error),
    );
    let label = format!("impact in {}", unit.replace("N m", "N\u{b7}m"));
    let axes = Axes {
        title: &title,
        x: ("joint", 0.5..joints as f64 + 0.5),
        y: (&label, scale.floor..scale.top),
    };
    let mut panel = bar_panel(area, pen, &axes)?;
    let zero = anchored(&pen.small(), HPos::Center, VPos::Bottom);
    for (joint, before) in before.iter().enumerate() {
        let after = LAWS.map(|law| {
            let case = study.case(law.method);
            (case.impact_after[joint], law.stroke.colour)
        });
        let group = [(*before, WITHOUT.colour)].into_iter().chain(after);
        for (i, (value, colour)) in group.enumerate() {
            let left = joint as f64 + 0.62 + 0.19 * i as f64;
            if value <= scale.zero {
                let text = zero.color(&colour);
                let at = (left + 0.085, scale.floor);
                panel.draw_series([Text::new("0", at, text)])?;
                continue;
            }
            let bar = [(left, scale.floor), (left + 0.17, value)];
            panel.draw_series([Rectangle::new(bar, colour.filled())])?;
        }
        if eq16.failed_joints.contains(&joint) {
            let style = anchored(&pen.small(), HPos::Center, VPos::Top);
            let at = (joint as f64 + 1.0, scale.top);
            panel.draw_series([Text::new("locks", at, style)])?;
        }
    }
    Ok(())
}

/// Three digits.
fn rounded(value: f64) -> String {
    if value < 1e-9 {
        return "0".to_owned();
    }
    let decimals = (2.0 - value.log10().floor()).clamp(0.0, 9.0) as usize;
    format!("{value:.decimals$}")
}
