//! [`View`]: an isometric view of the world.

use plotters::element::Text;
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};

use super::chart::tick;
use super::sketch::{Point, arrow};
use super::style::{BLACK, Pen, anchored};
use super::{Area, Drawn};

/// From the world to pixels: an isometric view, z up.
pub(super) struct View {
    /// Quarter turns about z before it is looked at.
    turns: u32,
    /// Pixels per metre.
    pub(super) scale: f64,
    middle: (f64, f64),
    centre: Point,
    /// Bottom left.
    corner: Point,
    /// m, of the drawn scale.
    unit: f64,
}

/// Right and up of a point in an isometric view, after some quarter turns about z.
fn isometric([x, y, z]: &[f64; 3], turns: u32) -> (f64, f64) {
    let (x, y) = match turns % 4 {
        0 => (*x, *y),
        1 => (-y, *x),
        2 => (-x, -y),
        _ => (*y, -x),
    };
    let cos = 3.0_f64.sqrt() / 2.0;
    ((y - x) * cos, z - 0.5 * (x + y))
}

/// How long links are in a view, together.
fn seen(links: &[Vec<[f64; 3]>], turns: u32) -> f64 {
    let pieces = links.iter().flat_map(|points| points.windows(2));
    pieces
        .map(|piece| {
            let [a, b] = [0, 1].map(|end| isometric(&piece[end], turns));
            (a.0 - b.0).hypot(a.1 - b.1)
        })
        .sum()
}

impl View {
    /// Of the four views the one that shortens the links least.
    pub(super) fn of(
        points: &[[f64; 3]],
        links: &[Vec<[f64; 3]>],
        (width, height): (u32, u32),
        pen: Pen,
    ) -> Self {
        let by_length = |a: &u32, b: &u32| seen(links, *a).total_cmp(&seen(links, *b));
        let turns = (0..4).rev().max_by(by_length).unwrap_or(0);
        let mut least = (f64::INFINITY, f64::INFINITY);
        let mut most = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for (u, v) in points.iter().map(|point| isometric(point, turns)) {
            least = (least.0.min(u), least.1.min(v));
            most = (most.0.max(u), most.1.max(v));
        }
        let (wide, high) = ((most.0 - least.0).max(1e-6), (most.1 - least.1).max(1e-6));
        let (width, height) = (width.cast_signed(), height.cast_signed());
        // Room for frames and numbers around, and for the world's axes at the left.
        let (left, rim) = (pen.at(150), pen.at(60));
        let room = (f64::from(width - left - rim), f64::from(height - 2 * rim));
        let scale = (room.0 / wide).min(room.1 / high);
        // The largest of 1, 2, 5 times a power of ten that is at most 60 px long.
        let most_unit = f64::from(pen.at(60)) / scale;
        let power = 10_f64.powf(most_unit.log10().floor());
        let unit = [5.0, 2.0, 1.0].into_iter().find(|n| n * power <= most_unit);
        Self {
            turns,
            scale,
            middle: (0.5 * (least.0 + most.0), 0.5 * (least.1 + most.1)),
            centre: ((left + width - rim) / 2, height / 2),
            corner: (pen.at(70), height - pen.at(70)),
            unit: unit.unwrap_or(1.0) * power,
        }
    }

    /// Where a point is drawn.
    pub(super) fn at(&self, point: &[f64; 3]) -> Point {
        let (u, v) = isometric(point, self.turns);
        let right = (u - self.middle.0) * self.scale;
        let down = (self.middle.1 - v) * self.scale;
        (
            self.centre.0 + right.round() as i32,
            self.centre.1 + down.round() as i32,
        )
    }

    /// The world's axes, each as long as it says.
    pub(super) fn axes<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let style = anchored(&pen.small(), HPos::Center, VPos::Center);
        for (i, name) in ["x", "y", "z"].into_iter().enumerate() {
            let mut axis = [0.0; 3];
            axis[i] = self.unit;
            let (u, v) = isometric(&axis, self.turns);
            let end = |share: f64| {
                let (right, down) = (u * self.scale * share, -v * self.scale * share);
                (self.corner.0 + right as i32, self.corner.1 + down as i32)
            };
            arrow(area, pen, &[self.corner, end(1.0)], (BLACK, 1))?;
            area.draw(&Text::new(name, end(1.35), style.clone()))?;
        }
        let words = format!("world axes, {} m each", tick(self.unit));
        let at = (pen.at(12), self.corner.1 + pen.at(56));
        let style = anchored(&pen.small(), HPos::Left, VPos::Center);
        area.draw(&Text::new(words, at, style))
    }
}
