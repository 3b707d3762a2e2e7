//! The simulated lock beside the predicted one, and the limit of ever shorter brakes.

use plotters::element::Text;
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};
use ulna::JointKind;
use ulna_study::experiment::{SearchMethod, SimulatedLock, SimulatedRun};

use super::chart::{Axes, Key, double_log_panel, legend, panel, range};
use super::stroke::{CURVES, EVENT, Stroke};
use super::style::{BLACK, BLUE, GREY, Marker, Pen, VERMILION, anchored, torque_label};
use super::{Area, Drawn, Figure};
use crate::setting::Setting;

const PREDICTED: Stroke = Stroke::solid(GREY);
const SIMULATED: Stroke = Stroke::solid(BLACK);
const PREDICTED_EQ16: Stroke = Stroke::dotted(VERMILION);
const SIMULATED_EQ16: Stroke = Stroke::dashed(BLUE);

/// The torques of some joints around a lock, predicted and simulated.
pub(crate) struct SimulatedTorques<'s> {
    pub(crate) simulated: &'s SimulatedLock,
    /// Counted from 0.
    pub(crate) joints: &'s [usize],
    /// Of every joint.
    pub(crate) kinds: &'s [JointKind],
}

impl Figure for SimulatedTorques<'_> {
    fn size(&self) -> (u32, u32) {
        (1000, 62 + 230 * self.joints.len().div_ceil(2).max(1) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (head, body) = area.split_vertically(pen.px(56));
        let curves = self.curves();
        let entries = curves
            .iter()
            .map(|(_, _, stroke, label)| (Key::Stroke(*stroke), (*label).to_owned()));
        legend(&head, pen, &entries.collect::<Vec<_>>())?;
        let setting = Setting::of(self.simulated).with_brake();
        let text = format!("lock at {} s; {setting}", self.simulated.failure_time);
        let style = anchored(&pen.text(), HPos::Left, VPos::Center);
        head.draw(&Text::new(text, (pen.at(72), pen.at(40)), style))?;
        let areas = body.split_evenly((self.joints.len().div_ceil(2).max(1), 2));
        for (area, joint) in areas.iter().zip(self.joints) {
            let points: Vec<_> = curves
                .iter()
                .map(|(run, rows, stroke, _)| {
                    let points = run
                        .time
                        .iter()
                        .zip(rows(run))
                        .map(|(time, row)| (*time, row[*joint]));
                    (points.collect::<Vec<_>>(), *stroke)
                })
                .collect();
            let all = || points.iter().flat_map(|(points, _)| points);
            let time = range(all().map(|point| point.0));
            let torque = range(all().map(|point| point.1));
            let what = if self.simulated.failed_joints.contains(joint) {
                " (locks; brake and motor)"
            } else {
                ""
            };
            let title = format!("joint {}{what}", joint + 1);
            let mut panel = panel(
                area,
                pen,
                &Axes {
                    title: &title,
                    x: ("time in s", time),
                    y: (torque_label(self.kinds[*joint]), torque.clone()),
                },
            )?;
            let lock = self.simulated.failure_time;
            for event in [lock, lock + self.simulated.brake_time] {
                EVENT.curve(
                    &mut panel,
                    pen,
                    &[(event, torque.start), (event, torque.end)],
                )?;
            }
            for (points, stroke) in &points {
                stroke.curve(&mut panel, pen, points)?;
            }
        }
        Ok(())
    }
}

/// A run, which of its rows, how they are drawn and what they are called.
type Curve<'s> = (
    &'s SimulatedRun,
    fn(&SimulatedRun) -> &Vec<Vec<f64>>,
    Stroke,
    &'static str,
);

impl SimulatedTorques<'_> {
    fn curves(&self) -> Vec<Curve<'_>> {
        let run = |method| self.simulated.runs.iter().find(|run| run.method == method);
        let simulated: fn(&SimulatedRun) -> &Vec<Vec<f64>> = |run| &run.torque;
        let predicted: fn(&SimulatedRun) -> &Vec<Vec<f64>> = |run| &run.predicted_torque;
        let pairs = [
            (
                None,
                [
                    (simulated, SIMULATED, "simulated, without suppression"),
                    (predicted, PREDICTED, "predicted, without suppression"),
                ],
            ),
            (
                Some(SearchMethod::PerJoint),
                [
                    (simulated, SIMULATED_EQ16, "simulated, Eq. 16"),
                    (predicted, PREDICTED_EQ16, "predicted, Eq. 16"),
                ],
            ),
        ];
        let curves = pairs
            .into_iter()
            .filter_map(|(method, curves)| Some((run(method)?, curves)));
        curves
            .flat_map(|(run, curves)| {
                curves.map(|(rows, stroke, label)| (run, rows, stroke, label))
            })
            .collect()
    }
}

/// How the impulse of the brakes tends to that of the ideal lock.
pub(crate) struct Convergence<'s> {
    /// One for each failure time.
    pub(crate) simulations: &'s [SimulatedLock],
}

impl Figure for Convergence<'_> {
    fn size(&self) -> (u32, u32) {
        (700, 460)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (head, body) = area.split_vertically(pen.px(34));
        let curves = || self.simulations.iter().zip(CURVES.into_iter().cycle());
        let entries = curves().map(|(simulated, stroke)| {
            (
                Key::Stroke(stroke),
                format!("lock at {} s", simulated.failure_time),
            )
        });
        legend(&head, pen, &entries.collect::<Vec<_>>())?;
        let points = |simulated: &SimulatedLock| {
            let points = simulated
                .convergence
                .iter()
                .map(|point| (point.brake_time, point.relative_difference));
            points
                .filter(|(_, difference)| *difference > 0.0)
                .collect::<Vec<_>>()
        };
        let all: Vec<_> = self.simulations.iter().flat_map(points).collect();
        let span = |values: &mut dyn Iterator<Item = f64>| {
            let (least, most) = values.fold((1.0_f64, 1e-12_f64), |(least, most), value| {
                (least.min(value), most.max(value))
            });
            least / 2.0..most.max(least) * 2.0
        };
        let setting = self.simulations.first().map(Setting::of);
        let setting = setting.map_or_else(String::new, |setting| setting.drives_shortly());
        let mut panel = double_log_panel(
            &body,
            pen,
            &Axes {
                title: &format!("ever shorter brakes; {setting}"),
                x: (
                    "brake time in s",
                    span(&mut all.iter().map(|point| point.0)),
                ),
                y: (
                    "relative difference from the ideal lock",
                    span(&mut all.iter().map(|point| point.1)),
                ),
            },
        )?;
        for (simulated, stroke) in curves() {
            stroke.curve(&mut panel, pen, &points(simulated))?;
            for point in points(simulated) {
                Marker::Circle.draw(panel.plotting_area(), pen, point, stroke.colour)?;
            }
        }
        Ok(())
    }
}
