//! Panels with axes, and the legend above them.

use core::ops::Range;

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::combinators::{IntoLogRange, LogCoord};
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::element::{PathElement, Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor};

use super::stroke::Stroke;
use super::style::{self, BLACK, GREY, Pen, anchored};
use super::{Area, Drawn};

/// A panel with two linear axes.
pub(super) type Panel<'a, DB> = ChartContext<'a, DB, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// What the axes of a panel say.
pub(super) struct Axes<'t> {
    pub(super) title: &'t str,
    pub(super) x: (&'t str, Range<f64>),
    pub(super) y: (&'t str, Range<f64>),
}

/// A panel that drew, or why it could not be drawn.
type Built<'a, DB, X, Y> = Result<
    ChartContext<'a, DB, Cartesian2d<X, Y>>,
    DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>,
>;

/// An empty panel.
pub(super) fn panel<'a, DB: DrawingBackend>(
    area: &'a Area<DB>,
    pen: Pen,
    axes: &Axes<'_>,
) -> Built<'a, DB, RangedCoordf64, RangedCoordf64> {
    let (x, y) = (axes.x.1.clone(), axes.y.1.clone());
    with_coordinates(area, pen, axes, (x, 7), (y, 6), Snap::Linear)
}

/// An empty panel with a tick at each whole number of its horizontal axis.
pub(super) fn count_panel<'a, DB: DrawingBackend>(
    area: &'a Area<DB>,
    pen: Pen,
    axes: &Axes<'_>,
) -> Built<'a, DB, RangedCoordf64, RangedCoordf64> {
    let (x, y) = (axes.x.1.clone(), axes.y.1.clone());
    let ticks = (axes.x.1.end - axes.x.1.start) as usize;
    with_coordinates(area, pen, axes, (x, ticks), (y, 6), Snap::Linear)
}

/// An empty panel with a tick at each whole number of its horizontal axis and a logarithmic vertical one.
pub(super) fn bar_panel<'a, DB: DrawingBackend>(
    area: &'a Area<DB>,
    pen: Pen,
    axes: &Axes<'_>,
) -> Built<'a, DB, RangedCoordf64, LogCoord<f64>> {
    let (x, y) = (axes.x.1.clone(), axes.y.1.clone().log_scale());
    let ticks = (axes.x.1.end - axes.x.1.start) as usize;
    with_coordinates(area, pen, axes, (x, ticks), (y, 6), Snap::Log)
}

/// An empty panel with a tick at each whole number of its vertical axis.
pub(super) fn grid_panel<'a, DB: DrawingBackend>(
    area: &'a Area<DB>,
    pen: Pen,
    axes: &Axes<'_>,
) -> Built<'a, DB, RangedCoordf64, RangedCoordf64> {
    let (x, y) = (axes.x.1.clone(), axes.y.1.clone());
    let ticks = (axes.y.1.end - axes.y.1.start) as usize + 1;
    with_coordinates(area, pen, axes, (x, 7), (y, ticks), Snap::Linear)
}

/// An empty panel with a name at each whole number of its horizontal axis, from 1 on, and a logarithmic vertical one.
pub(super) fn category_panel<'a, DB: DrawingBackend>(
    area: &'a Area<DB>,
    pen: Pen,
    title: &str,
    (what, names): (&str, &[String]),
    (label, y): (&str, Range<f64>),
) -> Built<'a, DB, RangedCoordf64, LogCoord<f64>> {
    let x = 0.5..names.len() as f64 + 0.5;
    let axes = Axes {
        title,
        x: (what, x.clone()),
        y: (label, y.clone()),
    };
    let name = |x: f64| {
        let index = (x.round() as usize).checked_sub(1);
        let name = index.and_then(|index| names.get(index));
        // Between two names there is none.
        name.filter(|_| (x - x.round()).abs() < 1e-6)
            .cloned()
            .unwrap_or_default()
    };
    let coordinates = ((x, names.len()), (y.log_scale(), 6));
    with_names(area, pen, &axes, coordinates, Snap::Log, &name)
}

/// An empty panel with two logarithmic axes.
pub(super) fn double_log_panel<'a, DB: DrawingBackend>(
    area: &'a Area<DB>,
    pen: Pen,
    axes: &Axes<'_>,
) -> Built<'a, DB, LogCoord<f64>, LogCoord<f64>> {
    let (x, y) = (axes.x.1.clone().log_scale(), axes.y.1.clone().log_scale());
    with_coordinates(area, pen, axes, (x, 8), (y, 8), Snap::Log)
}

/// What ticks that are almost 0 are.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Snap {
    /// 0, but for the rounding of a sum of steps.
    Linear,
    /// Small numbers.
    Log,
}

impl Snap {
    /// `value`, a tick of an axis of this `range`.
    fn tick(self, value: f64, range: &Range<f64>) -> String {
        let rounding = 1e-9 * (range.end - range.start);
        if self == Self::Linear && value.abs() < rounding {
            return tick(0.0);
        }
        tick(value)
    }
}

/// An empty panel with these coordinates, and about so many ticks on each axis.
fn with_coordinates<'a, DB: DrawingBackend, X, Y>(
    area: &'a Area<DB>,
    pen: Pen,
    axes: &Axes<'_>,
    x: (X, usize),
    y: (Y, usize),
    snap: Snap,
) -> Built<'a, DB, X::CoordDescType, Y::CoordDescType>
where
    X: AsRangedCoord<Value = f64>,
    X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: AsRangedCoord<Value = f64>,
    Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let range = axes.x.1.clone();
    with_names(area, pen, axes, (x, y), snap, &|x| snap.tick(x, &range))
}

/// The same with names of its own at the ticks of the horizontal axis.
fn with_names<'a, DB: DrawingBackend, X, Y>(
    area: &'a Area<DB>,
    pen: Pen,
    axes: &Axes<'_>,
    ((x, x_ticks), (y, y_ticks)): ((X, usize), (Y, usize)),
    snap: Snap,
    name: &dyn Fn(f64) -> String,
) -> Built<'a, DB, X::CoordDescType, Y::CoordDescType>
where
    X: AsRangedCoord<Value = f64>,
    X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: AsRangedCoord<Value = f64>,
    Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let (left, label, right) = (6, 66, 18);
    let mut chart = ChartBuilder::on(area)
        .margin_top(pen.px(28))
        .margin_bottom(pen.px(4))
        .margin_left(pen.px(left))
        .margin_right(pen.px(right))
        .x_label_area_size(pen.px(38))
        .y_label_area_size(pen.px(label))
        .build_cartesian_2d(x, y)?;
    // The library's own caption keeps a distance of whole pixels, whatever the scale.
    let width = area.dim_in_pixel().0;
    let centre = (width + pen.px(left + label) - pen.px(right)) / 2;
    let title = anchored(&pen.title(), HPos::Center, VPos::Bottom);
    area.draw(&Text::new(
        axes.title,
        (centre.cast_signed(), pen.at(22)),
        title,
    ))?;
    chart
        .configure_mesh()
        .bold_line_style(GREY.mix(0.25).stroke_width(pen.px(1)))
        .light_line_style(GREY.mix(0.0))
        .axis_style(BLACK.stroke_width(pen.px(1)))
        .x_labels(x_ticks)
        .y_labels(y_ticks)
        .x_label_formatter(&|x| name(*x))
        .y_label_formatter(&|y| snap.tick(*y, &axes.y.1))
        .x_desc(axes.x.0)
        .y_desc(axes.y.0)
        .label_style(pen.small())
        .axis_desc_style(pen.text())
        .set_all_tick_mark_size(pen.px(4))
        .draw()?;
    Ok(chart)
}

/// The shortest text of a tick that is exact to a thousandth; very small and very large ones by their power of ten.
pub(super) fn tick(value: f64) -> String {
    let size = value.abs();
    let text = if (1e-3..1e5).contains(&size) || size == 0.0 {
        let text = format!("{value:.3}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        let text = format!("{value:.2e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let power = format!("10{}", superscript(exponent));
        match mantissa.trim_end_matches('0').trim_end_matches('.') {
            "1" => power,
            "-1" => format!("-{power}"),
            mantissa => format!("{mantissa}\u{b7}{power}"),
        }
    };
    match text.as_str() {
        "-0" => "0".to_owned(),
        text => text.replace('-', "\u{2212}"),
    }
}

fn superscript(exponent: &str) -> String {
    const DIGITS: [char; 10] = [
        '\u{2070}', '\u{b9}', '\u{b2}', '\u{b3}', '\u{2074}', '\u{2075}', '\u{2076}', '\u{2077}',
        '\u{2078}', '\u{2079}',
    ];
    let digit = |c: char| {
        c.to_digit(10)
            .map_or('\u{207b}', |digit| DIGITS[digit as usize])
    };
    exponent.chars().map(digit).collect()
}

/// A range around `values`, with some air; never empty, never infinite.
pub(super) fn range(values: impl IntoIterator<Item = f64>) -> Range<f64> {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let (least, most) = finite.fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(least, most), value| (least.min(value), most.max(value)),
    );
    if least > most {
        return -1.0..1.0;
    }
    let air = (0.06 * (most - least)).max(1e-9 * most.abs()).max(1e-6);
    least - air..most + air
}

/// One entry of a legend.
pub(super) enum Key {
    /// A curve.
    Stroke(Stroke),
    /// A filled patch.
    Patch(RGBColor),
    /// A marker.
    Marker(style::Marker, RGBColor),
}

/// Draws the entries side by side, from the left, on the upper edge of `area`; as many rows as it takes.
pub(super) fn legend<DB: DrawingBackend>(
    area: &Area<DB>,
    pen: Pen,
    entries: &[(Key, String)],
) -> Drawn<DB> {
    let width = area.dim_in_pixel().0.cast_signed();
    let text = anchored(&pen.text(), HPos::Left, VPos::Center);
    let (mut x, mut y) = (pen.at(72), pen.at(14));
    for (key, label) in entries {
        let length = area.estimate_text_size(label, &pen.text())?.0.cast_signed();
        let entry = pen.at(38) + length + pen.at(22);
        if x + entry > width && x > pen.at(72) {
            (x, y) = (pen.at(72), y + pen.at(20));
        }
        let end = x + pen.at(30);
        match key {
            Key::Stroke(stroke) => {
                let style = stroke.style(pen);
                let (dash, gap) = stroke.dash.map_or((30, 1), |(dash, gap)| {
                    (dash.cast_signed(), gap.cast_signed())
                });
                let mut from = x;
                while from < end {
                    let to = (from + pen.at(dash)).min(end);
                    area.draw(&PathElement::new(vec![(from, y), (to, y)], style))?;
                    from = to + pen.at(gap);
                }
            }
            Key::Patch(colour) => {
                let patch = [
                    (x + pen.at(8), y - pen.at(6)),
                    (x + pen.at(24), y + pen.at(6)),
                ];
                area.draw(&Rectangle::new(patch, colour.filled()))?;
            }
            Key::Marker(marker, colour) => {
                marker.draw(area, pen, (x + pen.at(16), y), *colour)?;
            }
        }
        area.draw(&Text::new(label.clone(), (x + pen.at(36), y), text.clone()))?;
        x += entry;
    }
    Ok(())
}
