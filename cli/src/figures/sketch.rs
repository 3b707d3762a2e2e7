//! Lines, arrows and labelled boxes on an area without axes, in pixels of the backend.

use plotters::element::{PathElement, Polygon, Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor};

use super::style::{BLACK, Pen, WHITE, anchored};
use super::{Area, Drawn};

/// A point, x to the right and y down.
pub(super) type Point = (i32, i32);

/// A line through some points, piece by piece: where a whole one turned back, its corner would be drawn as a spike.
pub(super) fn line<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    points: &[Point],
    (colour, width): (RGBColor, u32),
) -> Drawn<DB> {
    for piece in points.windows(2) {
        area.draw(&PathElement::new(piece.to_vec(), pen.line(colour, width)))?;
    }
    Ok(())
}

/// A line of dashes, css pixels long and apart.
pub(super) fn dashes<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    points: &[Point],
    (colour, width): (RGBColor, u32),
    dash: i32,
) -> Drawn<DB> {
    let period = f64::from(pen.at(2 * dash));
    let mut travelled = 0.0;
    for pair in points.windows(2) {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]].map(|(x, y)| (f64::from(x), f64::from(y)));
        let length = (x1 - x0).hypot(y1 - y0);
        let pieces = (length / f64::from(pen.at(1))).ceil().max(1.0) as usize;
        let at = |share: f64| {
            let (x, y) = (x0 + (x1 - x0) * share, y0 + (y1 - y0) * share);
            (x.round() as i32, y.round() as i32)
        };
        for i in 0..pieces {
            let (from, to) = (i as f64 / pieces as f64, (i + 1) as f64 / pieces as f64);
            if (travelled + length * from) % period < 0.5 * period {
                line(area, pen, &[at(from), at(to)], (colour, width))?;
            }
        }
        travelled += length;
    }
    Ok(())
}

/// A line through some points with a head at the last.
pub(super) fn arrow<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    points: &[Point],
    (colour, width): (RGBColor, u32),
) -> Drawn<DB> {
    line(area, pen, points, (colour, width))?;
    let [.., from, to] = points else {
        return Ok(());
    };
    let (dx, dy) = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
    let length = dx.hypot(dy);
    if length < 1.0 {
        return Ok(());
    }
    let size = f64::from(pen.at(3 + 2 * width.cast_signed()));
    let (dx, dy) = (dx / length * size, dy / length * size);
    let (x, y) = (f64::from(to.0), f64::from(to.1));
    let corner = |along: f64, across: f64| {
        let (x, y) = (x + along * dx - across * dy, y + along * dy + across * dx);
        (x.round() as i32, y.round() as i32)
    };
    let head = vec![corner(0.4, 0.0), corner(-1.0, 0.5), corner(-1.0, -0.5)];
    area.draw(&Polygon::new(head, colour.filled()))
}

/// Lines of text around a point.
pub(super) fn text<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    (x, y): Point,
    lines: &[&str],
    horizontal: HPos,
) -> Drawn<DB> {
    let style = anchored(&pen.text(), horizontal, VPos::Center);
    let height = pen.at(18);
    let top = y - height * (lines.len() as i32 - 1) / 2;
    for (i, line) in lines.iter().enumerate() {
        let at = (x, top + height * i as i32);
        area.draw(&Text::new((*line).to_owned(), at, style.clone()))?;
    }
    Ok(())
}

/// What is around the text of a step.
#[derive(Clone, Copy)]
pub(super) enum Shape {
    /// Something is done.
    Step,
    /// A question.
    Question,
}

/// A step of a flow diagram: its middle, and its size.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub(super) at: Point,
    pub(super) size: (i32, i32),
}

impl Node {
    pub(super) fn top(&self) -> Point {
        (self.at.0, self.at.1 - self.size.1 / 2)
    }

    pub(super) fn bottom(&self) -> Point {
        (self.at.0, self.at.1 + self.size.1 / 2)
    }

    pub(super) fn left(&self) -> Point {
        (self.at.0 - self.size.0 / 2, self.at.1)
    }

    pub(super) fn right(&self) -> Point {
        (self.at.0 + self.size.0 / 2, self.at.1)
    }

    /// Draws it with its text in it.
    pub(super) fn draw<DB: DrawingBackend>(
        &self,
        area: &Area<DB>,
        pen: Pen,
        shape: Shape,
        colour: RGBColor,
        lines: &[&str],
    ) -> Drawn<DB> {
        let corners = [
            (self.left().0, self.top().1),
            (self.right().0, self.bottom().1),
        ];
        match shape {
            Shape::Step => {
                area.draw(&Rectangle::new(corners, colour.mix(0.15).filled()))?;
                area.draw(&Rectangle::new(corners, pen.line(colour, 2)))?;
            }
            Shape::Question => {
                let rim = vec![self.left(), self.top(), self.right(), self.bottom()];
                area.draw(&Polygon::new(rim.clone(), WHITE.filled()))?;
                area.draw(&Polygon::new(rim.clone(), colour.mix(0.15).filled()))?;
                let closed = [rim.clone(), vec![rim[0]]].concat();
                line(area, pen, &closed, (colour, 2))?;
            }
        }
        text(area, pen, self.at, lines, HPos::Center)
    }
}

/// The colour of arrows.
pub(super) const ARROW: (RGBColor, u32) = (BLACK, 1);
