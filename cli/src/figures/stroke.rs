//! Curves, told apart without colour too.

use plotters::chart::ChartContext;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::DrawingBackend;
use plotters::series::{DashedLineSeries, LineSeries};
use plotters::style::{RGBColor, ShapeStyle};

use super::Drawn;
use super::style::{Pen, SEQUENCE};

/// How a curve is drawn: the dashes tell it apart without colour.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub(super) colour: RGBColor,
    pub(super) width: u32,
    /// Lengths of dash and gap; `None` for a solid line.
    pub(super) dash: Option<(u32, u32)>,
}

impl Stroke {
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
    curve(0, None),
    curve(1, Some((9, 4))),
    curve(2, Some((3, 3))),
    curve(3, None),
    curve(4, Some((9, 4))),
    curve(5, Some((3, 3))),
];

const fn curve(colour: usize, dash: Option<(u32, u32)>) -> Stroke {
    Stroke {
        colour: SEQUENCE[colour],
        width: 2,
        dash,
    }
}
