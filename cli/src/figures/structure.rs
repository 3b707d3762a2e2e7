//! What the lock loads the structure with, along the axes and off them.

use plotters::element::{Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor};
use ulna::JointKind;
use ulna_study::experiment::{LockMechanics, StructureLoad};

use super::chart::{Axes, Key, count_panel, legend};
use super::law::WITHOUT;
use super::style::{Pen, VERMILION, anchored};
use super::{Area, Drawn, Figure};

/// A row for each failure time: moments and forces of each joint.
pub(crate) struct Structure<'l> {
    pub(crate) locks: &'l [LockMechanics],
}

const ALONG: RGBColor = WITHOUT.colour;
const OFF: RGBColor = VERMILION;

/// What is along the axis, if that is of the panel's unit, and what is off it.
type Loads = fn(&StructureLoad) -> (Option<f64>, f64);

fn moments(load: &StructureLoad) -> (Option<f64>, f64) {
    let along = (load.kind == JointKind::Revolute).then(|| load.along_axis().abs());
    (along, load.off_axis_moment())
}

fn forces(load: &StructureLoad) -> (Option<f64>, f64) {
    let along = (load.kind == JointKind::Prismatic).then(|| load.along_axis().abs());
    (along, load.off_axis_force())
}

impl Figure for Structure<'_> {
    fn size(&self) -> (u32, u32) {
        (1000, 40 + 260 * self.locks.len().max(1) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (head, body) = area.split_vertically(pen.px(34));
        let entries = [
            (Key::Patch(ALONG), "along the joint's axis: the motor"),
            (Key::Patch(OFF), "off the axis: bearings and links"),
        ];
        legend(
            &head,
            pen,
            &entries.map(|(key, label)| (key, label.to_owned())),
        )?;
        let rows = body.split_evenly((self.locks.len().max(1), 1));
        for (row, lock) in rows.iter().zip(self.locks) {
            let (left, right) = row.split_horizontally(row.dim_in_pixel().0 / 2);
            let columns: [(_, Loads, _); 2] = [
                (left, moments, "step of the moment in N\u{b7}m"),
                (right, forces, "step of the force in N"),
            ];
            for (area, loads, label) in columns {
                bars(&area, pen, lock, loads, label)?;
            }
        }
        Ok(())
    }
}

fn bars<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    lock: &LockMechanics,
    loads: Loads,
    label: &str,
) -> Drawn<DB> {
    let values: Vec<_> = lock.loads.iter().map(loads).collect();
    let largest = values
        .iter()
        .flat_map(|(along, off)| [along.unwrap_or(0.0), *off]);
    let largest = largest.fold(0.0, f64::max);
    let top = if largest > 0.0 { 1.18 * largest } else { 1.0 };
    let title = format!("lock at {} s", lock.failure_time);
    let axes = Axes {
        title: &title,
        x: ("joint", 0.5..values.len() as f64 + 0.5),
        y: (label, 0.0..top),
    };
    let mut panel = count_panel(area, pen, &axes)?;
    let style = anchored(&pen.tiny(), HPos::Center, VPos::Bottom);
    for (joint, (along, off)) in values.iter().enumerate() {
        for (i, (value, colour)) in [(*along, ALONG), (Some(*off), OFF)].into_iter().enumerate() {
            let Some(value) = value else {
                continue;
            };
            let left = joint as f64 + 0.63 + 0.38 * i as f64;
            let bar = [(left, 0.0), (left + 0.36, value)];
            panel.draw_series([Rectangle::new(bar, colour.filled())])?;
            let text = Text::new(rounded(value, largest), (left + 0.18, value), style.clone());
            panel.draw_series([text])?;
        }
        if lock.failed_joints.contains(&joint) {
            let at = (joint as f64 + 1.0, top);
            let style = anchored(&pen.small(), HPos::Center, VPos::Top);
            panel.draw_series([Text::new("locks", at, style)])?;
        }
    }
    Ok(())
}

/// As exact as the largest is with three digits; rounding is 0.
fn rounded(value: f64, largest: f64) -> String {
    if value <= 1e-9 * largest {
        return "0".to_owned();
    }
    let decimals = (2.0 - largest.log10().floor()).clamp(0.0, 9.0) as usize;
    let least = 10_f64.powi(-(decimals as i32));
    if value < 0.5 * least {
        return format!("<{least}");
    }
    format!("{value:.decimals$}")
}
