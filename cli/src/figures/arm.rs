//! The arm as a stick figure with its joint frames: the paper's Figures 1 and 3.

use plotters::element::{Circle, Cross, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor};
use ulna_study::experiment::{ArmPose, LockMechanics};

use super::chart::{Key, legend};
use super::sketch::{Point, arrow, dashes, line};
use super::stroke::Stroke;
use super::style::{
    BLACK, BLUE, GREEN, GREY, Marker, ORANGE, PURPLE, Pen, VERMILION, WHITE, anchored,
};
use super::view::View;
use super::{Area, Drawn, Figure};

/// The arm around a lock: where it starts, where the lock falls, where it ends.
pub(crate) struct Arm<'l> {
    pub(crate) lock: &'l LockMechanics,
    /// With the failed joints at rest from the lock on; otherwise as planned.
    pub(crate) locked: bool,
}

const START: RGBColor = GREY;
const FAILURE: RGBColor = BLACK;
const GOAL: RGBColor = GREEN;
const LOCKED: RGBColor = VERMILION;

/// Of a joint's frame.
const AXES: [(RGBColor, &str); 3] = [
    (ORANGE, "joint frame: x"),
    (PURPLE, "y"),
    (BLUE, "z, the axis"),
];

impl Figure for Arm<'_> {
    fn size(&self) -> (u32, u32) {
        (1000, 640)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let (head, body) = area.split_vertically(pen.px(58));
        let lock = self.lock;
        let (goal, path) = if self.locked {
            (&lock.locked_goal, &lock.locked_path)
        } else {
            (&lock.goal, &lock.path)
        };
        let solid = |colour| Key::Stroke(Stroke::solid(colour));
        let mut entries = vec![(solid(FAILURE), format!("at {} s", lock.failure_time))];
        if self.locked {
            let end = "end, failed joints at rest";
            entries.push((solid(GOAL), end.to_owned()));
            let planned = "end if none locks";
            entries.push((Key::Stroke(Stroke::dashed(GREY)), planned.to_owned()));
            entries.push((
                Key::Marker(Marker::Square, LOCKED),
                "joint that locks".to_owned(),
            ));
        } else {
            entries.push((solid(START), "start".to_owned()));
            entries.push((solid(GOAL), "goal".to_owned()));
        }
        let path_key = Key::Stroke(Stroke::dotted(BLACK));
        entries.push((path_key, "path of the tool".to_owned()));
        entries.extend(AXES.map(|(colour, label)| (solid(colour), label.to_owned())));
        legend(&head, pen, &entries)?;

        let mut points: Vec<[f64; 3]> = path.clone();
        let others = if self.locked { &lock.goal } else { &lock.start };
        for pose in [&lock.failure, goal, others] {
            points.extend(corners(pose));
        }
        let links = [&lock.failure, goal, others].map(corners);
        let view = View::of(&points, &links, body.dim_in_pixel(), pen);
        view.axes(&body, pen)?;
        let way: Vec<_> = path.iter().map(|point| view.at(point)).collect();
        dashes(&body, pen, &way, (BLACK, 1), 2)?;
        if self.locked {
            let sticks: Vec<_> = corners(&lock.goal).iter().map(|p| view.at(p)).collect();
            dashes(&body, pen, &sticks, (GREY, 2), 5)?;
        } else {
            view.sticks(&body, pen, &lock.start, START, 3)?;
        }
        view.sticks(&body, pen, goal, GOAL, 3)?;
        view.sticks(&body, pen, &lock.failure, FAILURE, 4)?;
        view.frames(&body, pen, &lock.failure)?;
        view.joints(&body, pen, &lock.failure, |joint| {
            self.locked && lock.failed_joints.contains(&joint)
        })?;
        if self.locked {
            for joint in &lock.failed_joints {
                let at = view.at(&goal.joints[*joint].origin);
                Marker::Square.draw(&body, pen, at, LOCKED)?;
            }
        }
        Ok(())
    }
}

/// The base, the joints and the tool.
fn corners(pose: &ArmPose) -> Vec<[f64; 3]> {
    let joints = pose.joints.iter().map(|joint| joint.origin);
    [pose.base]
        .into_iter()
        .chain(joints)
        .chain([pose.tool])
        .collect()
}

impl View {
    fn sticks<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        pen: Pen,
        pose: &ArmPose,
        colour: RGBColor,
        width: u32,
    ) -> Drawn<DB> {
        let points: Vec<_> = corners(pose).iter().map(|point| self.at(point)).collect();
        line(area, pen, &points, (colour, width))?;
        for point in &points {
            area.draw(&Circle::new(*point, pen.px(3), colour.filled()))?;
        }
        if let Some(tool) = points.last() {
            area.draw(&Cross::new(*tool, pen.px(6), pen.line(colour, 2)))?;
        }
        Ok(())
    }

    /// Each joint's frame.
    fn frames<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen, pose: &ArmPose) -> Drawn<DB> {
        let length = f64::from(pen.at(30)) / self.scale;
        for joint in &pose.joints {
            let from = self.at(&joint.origin);
            for (axis, (colour, _)) in joint.axes.iter().zip(AXES) {
                let mut end = joint.origin;
                for (end, along) in end.iter_mut().zip(axis) {
                    *end += length * along;
                }
                arrow(area, pen, &[from, self.at(&end)], (colour, 1))?;
            }
        }
        Ok(())
    }

    /// The joints' numbers; joints in one place share one.
    fn joints<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        pen: Pen,
        pose: &ArmPose,
        locks: impl Fn(usize) -> bool,
    ) -> Drawn<DB> {
        let mut places: Vec<(Point, Vec<usize>)> = Vec::new();
        for (joint, frame) in pose.joints.iter().enumerate() {
            let at = self.at(&frame.origin);
            let near = |place: &&mut (Point, Vec<usize>)| {
                let ((x, y), _) = **place;
                (x - at.0).abs().max((y - at.1).abs()) < pen.at(8)
            };
            match places.iter_mut().find(near) {
                Some((_, joints)) => joints.push(joint),
                None => places.push((at, vec![joint])),
            }
            if locks(joint) {
                Marker::Square.draw(area, pen, at, LOCKED)?;
            }
        }
        let style = anchored(&pen.title(), HPos::Center, VPos::Center);
        let mut taken: Vec<(Point, (i32, i32))> = Vec::new();
        for ((x, y), joints) in places {
            let names: Vec<_> = joints.iter().map(|joint| (joint + 1).to_string()).collect();
            let text = names.join(", ");
            let (width, height) = area.estimate_text_size(&text, &pen.title())?;
            let size = (width.cast_signed() + pen.at(4), height.cast_signed());
            // Beside the joint, where no other number stands.
            let beside = [(-1, -1), (1, -1), (-1, 1), (1, 1), (0, -2), (0, 2)];
            let beside = beside.map(|(dx, dy)| {
                let right = dx * (size.0 / 2 + pen.at(5));
                (x + right, y + dy * (size.1 / 2 + pen.at(5)))
            });
            let free = |at: &&Point| {
                taken.iter().all(|(other, extent)| {
                    2 * (at.0 - other.0).abs() > size.0 + extent.0
                        || 2 * (at.1 - other.1).abs() > size.1 + extent.1
                })
            };
            let at = *beside.iter().find(free).unwrap_or(&beside[0]);
            taken.push((at, size));
            // A white rim keeps it legible on lines.
            for (dx, dy) in [(-1, 0), (1, 0), (0, -1), (0, 1)] {
                let rim = style.color(&WHITE);
                let at = (at.0 + pen.at(dx), at.1 + pen.at(dy));
                area.draw(&Text::new(text.clone(), at, rim))?;
            }
            area.draw(&Text::new(text, at, style.clone()))?;
        }
        Ok(())
    }
}
