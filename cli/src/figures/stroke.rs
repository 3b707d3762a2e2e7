//! Curves, told apart without colour too.

use plotters::chart::ChartContext;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::DrawingBackend;
use plotters::series::{DashedLineSeries, LineSeries};
use plotters::style::{RGBColor, ShapeStyle};

use super::Drawn;
use super::style::{GREY, Pen, SEQUENCE, VERMILION};

/// How a curve is drawn: the dashes tell it apart without colour.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub(super) colour: RGBColor,
    width: u32,
    /// Lengths of dash and gap; `None` for a solid line.
    pub(super) dash: Option<(u32, u32)>,
}

impl Stroke {
    pub(super) const fn solid(colour: RGBColor) -> Self {
        Self {
            colour,
            width: 2,
            dash: None,
        }
    }

    pub(super) const fn dashed(colour: RGBColor) -> Self {
        Self {
            dash: Some((9, 4)),
            ..Self::solid(colour)
        }
    }

    pub(super) const fn dotted(colour: RGBColor) -> Self {
        Self {
            dash: Some((3, 3)),
            ..Self::solid(colour)
        }
    }

    const fn thin(self) -> Self {
        Self { width: 1, ..self }
    }

    pub(super) fn style(&self, pen: Pen) -> ShapeStyle {
        pen.line(self.colour, self.width)
    }

    /// Draws a curve into a panel; where it leaves the panel it is cut off.
    pub(super) fn curve<
        DB: DrawingBackend,
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    >(
        &self,
        panel: &mut ChartContext<'_, DB, Cartesian2d<X, Y>>,
        pen: Pen,
        points: &[(f64, f64)],
    ) -> Drawn<DB> {
        let finite = points
            .iter()
            .copied()
            .filter(|(x, y)| x.is_finite() && y.is_finite());
        let style = self.style(pen);
        match self.dash {
            None => panel.draw_series(LineSeries::new(finite, style))?,
            Some((dash, gap)) => panel.draw_series(DashedLineSeries::new(
                finite,
                pen.px(dash),
                pen.px(gap),
                style,
            ))?,
        };
        Ok(())
    }
}

/// The curves, one for each failure time, over and over.
pub(super) const CURVES: [Stroke; 6] = [
    Stroke::solid(SEQUENCE[0]),
    Stroke::dashed(SEQUENCE[1]),
    Stroke::dotted(SEQUENCE[2]),
    Stroke::solid(SEQUENCE[3]),
    Stroke::dashed(SEQUENCE[4]),
    Stroke::dotted(SEQUENCE[5]),
];

/// A time at which something happens.
pub(super) const EVENT: Stroke = Stroke::dotted(GREY).thin();
/// A bound.
pub(super) const BOUND: Stroke = Stroke::dashed(VERMILION).thin();
