//! The step that the healthy joints really transmit, over the servo's gain and over the rotors' inertia.

use plotters::element::Rectangle;
use plotters::prelude::DrawingBackend;
use plotters::style::{Color, RGBColor};
use ulna_study::experiment::{Rotors, SearchMethod, Sweep};

use super::chart::{Key, category_panel, legend};
use super::law::{LAWS, WITHOUT, WITHOUT_LABEL};
use super::stroke::Stroke;
use super::style::{BLACK, Pen};
use super::{Area, Drawn, Figure};
use crate::setting::{short, titled_rotors};

/// For some failure times: bars over the gains with the scenario's rotors, and beside them over the rotors with its gain.
pub(crate) struct FeltSteps<'s> {
    sweeps: Vec<&'s Sweep>,
}

impl<'s> FeltSteps<'s> {
    /// The first, the middle and the last failure time, if there are more than three.
    pub(crate) fn new(sweeps: &'s [Sweep]) -> Self {
        let shown = match sweeps {
            [first, others @ .., last] if others.len() > 1 => {
                vec![first, &sweeps[sweeps.len() / 2], last]
            }
            sweeps => sweeps.iter().collect(),
        };
        Self { sweeps: shown }
    }
}

/// The step that is predicted without compensation.
const PREDICTED: Stroke = Stroke::dashed(BLACK);

/// None, and the laws, in the order of the legend.
fn columns() -> Vec<(Option<SearchMethod>, RGBColor, &'static str)> {
    let laws = LAWS.iter().map(|law| {
        let label = match law.method {
            SearchMethod::Projected => "Eq. 20",
            SearchMethod::Optimal => "optimal",
            _ => "Eq. 16",
        };
        (Some(law.method), law.stroke.colour, label)
    });
    std::iter::once((None, WITHOUT.colour, WITHOUT_LABEL))
        .chain(laws)
        .collect()
}

impl Figure for FeltSteps<'_> {
    fn size(&self) -> (u32, u32) {
        (1000, 40 + 260 * self.sweeps.len().max(1) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (head, body) = area.split_vertically(pen.px(34));
        let mut entries: Vec<_> = columns()
            .into_iter()
            .map(|(_, colour, label)| (Key::Patch(colour), label.to_owned()))
            .collect();
        entries.push((
            Key::Stroke(PREDICTED),
            "predicted, without suppression".to_owned(),
        ));
        legend(&head, pen, &entries)?;
        let areas = body.split_evenly((self.sweeps.len().max(1), 2));
        let (least, most) = self.ends();
        for (pair, sweep) in areas.chunks(2).zip(&self.sweeps) {
            let (own_gain, own_rotors) = (sweep.own_gain, &sweep.own_rotors);
            let lock = format!("lock at {} s", sweep.failure_time);
            let gains: Vec<_> = sweep
                .gains
                .iter()
                .map(|gain| (gain.to_string(), *gain, own_rotors))
                .collect();
            let rotors: Vec<_> = sweep
                .rotors
                .iter()
                .map(|rotors| (short(rotors), own_gain, rotors))
                .collect();
            let brake = format!("brake {} s", sweep.brake_time);
            let settings = [
                (
                    format!("{lock}, {brake}, {}", titled_rotors(own_rotors)),
                    "servo's gain in rad/s",
                    gains,
                ),
                (
                    format!("{lock}, {brake}, servo of {own_gain} rad/s"),
                    "rotors at each joint in kg\u{b7}m\u{b2}, as it feels them",
                    rotors,
                ),
            ];
            for (area, (title, what, groups)) in pair.iter().zip(settings) {
                bars(area, pen, sweep, (&title, what), &groups, least..most)?;
            }
        }
        Ok(())
    }
}

impl FeltSteps<'_> {
    /// Of the vertical axes: from a power of ten to above the largest bar.
    fn ends(&self) -> (f64, f64) {
        let points = self.sweeps.iter().flat_map(|sweep| &sweep.points);
        let felt = points.filter_map(|point| point.felt);
        let steps = felt.flat_map(|felt| [felt.step, felt.predicted_step]);
        // What is suppressed to nothing would leave no room for what is not.
        let notable = steps.filter(|step| *step > 1e-3);
        let (least, most) = notable.fold((f64::INFINITY, 1e-2), |(least, most), step| {
            (step.min(least), step.max(most))
        });
        let least = if least < most { least } else { most / 10.0 };
        let floor = 10_f64.powf(least.log10().floor());
        (floor, 1.5 * most)
    }
}

/// A group of bars for each gain or rotors.
fn bars<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    sweep: &Sweep,
    (title, what): (&str, &str),
    groups: &[(String, f64, &Rotors)],
    y: core::ops::Range<f64>,
) -> Drawn<DB> {
    let names: Vec<_> = groups.iter().map(|(name, ..)| name.clone()).collect();
    let label = "step of the healthy joints in N\u{b7}m";
    let mut panel = category_panel(area, pen, title, (what, &names), (label, y.clone()))?;
    for (i, (_, gain, rotors)) in groups.iter().enumerate() {
        for (column, (method, colour, _)) in columns().into_iter().enumerate() {
            let Some(felt) = sweep.felt(*gain, rotors, method) else {
                continue;
            };
            let left = i as f64 + 0.62 + 0.19 * column as f64;
            let top = felt.step.clamp(y.start * 1.02, y.end);
            let bar = [(left, y.start), (left + 0.17, top)];
            panel.draw_series([Rectangle::new(bar, colour.filled())])?;
        }
    }
    let mut felt = groups
        .iter()
        .filter_map(|(_, gain, rotors)| sweep.felt(*gain, rotors, None));
    if let Some(felt) = felt.next() {
        let ends = [0.5, groups.len() as f64 + 0.5];
        let line = ends.map(|x| (x, felt.predicted_step));
        PREDICTED.curve(&mut panel, pen, &line)?;
    }
    Ok(())
}
