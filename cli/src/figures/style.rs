//! Colours, fonts, lines: what all figures have in common.

use plotters::coord::CoordTranslate;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, EmptyElement, Polygon};
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, RGBColor, ShapeStyle, TextStyle};
use ulna::JointKind;

use super::Drawn;

/// The family in an SVG; in a PNG it is the font that comes with the program.
pub(super) const FONT: &str = "sans-serif";

// Okabe and Ito (2008): told apart by all common kinds of colour vision.
pub(super) const BLACK: RGBColor = RGBColor(0, 0, 0);
pub(super) const WHITE: RGBColor = RGBColor(255, 255, 255);
pub(super) const GREY: RGBColor = RGBColor(120, 120, 120);
pub(super) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(super) const ORANGE: RGBColor = RGBColor(230, 159, 0);
pub(super) const GREEN: RGBColor = RGBColor(0, 158, 115);
pub(super) const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub(super) const PURPLE: RGBColor = RGBColor(204, 121, 167);
pub(super) const SKY: RGBColor = RGBColor(86, 180, 233);

/// Colours of a sequence, such as failure times.
pub(super) const SEQUENCE: [RGBColor; 6] = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY];

/// How many pixels of the backend a CSS pixel has, and all sizes in those.
#[derive(Clone, Copy)]
pub(crate) struct Pen {
    pub(super) scale: u32,
}

impl Pen {
    /// A length.
    pub(super) fn px(self, css: u32) -> u32 {
        css * self.scale
    }

    /// A length in the type of coordinates.
    pub(super) fn at(self, css: i32) -> i32 {
        css * self.scale.cast_signed()
    }

    /// Text of axes and legends.
    pub(super) fn text(self) -> TextStyle<'static> {
        self.font(FontStyle::Normal, 13, BLACK)
    }

    /// Text of ticks.
    pub(super) fn small(self) -> TextStyle<'static> {
        self.font(FontStyle::Normal, 12, BLACK)
    }

    /// Text on bars.
    pub(super) fn tiny(self) -> TextStyle<'static> {
        self.font(FontStyle::Normal, 9, BLACK)
    }

    /// Text below a figure.
    pub(super) fn footer(self) -> TextStyle<'static> {
        self.font(FontStyle::Normal, 11, GREY)
    }

    /// Text above a panel.
    pub(super) fn title(self) -> TextStyle<'static> {
        self.font(FontStyle::Bold, 13, BLACK)
    }

    fn font(self, style: FontStyle, css: u32, colour: RGBColor) -> TextStyle<'static> {
        FontDesc::new(FontFamily::SansSerif, f64::from(self.px(css)), style).color(&colour)
    }

    /// A line.
    pub(super) fn line(self, colour: impl Color, width: u32) -> ShapeStyle {
        colour.stroke_width(self.px(width))
    }
}

/// Where text stands relative to its point.
pub(super) fn anchored<'s>(
    style: &TextStyle<'s>,
    horizontal: HPos,
    vertical: VPos,
) -> TextStyle<'s> {
    style.pos(Pos::new(horizontal, vertical))
}

/// A mark at a point; the shapes tell it apart without colour.
#[derive(Clone, Copy)]
pub(super) enum Marker {
    Circle,
    Square,
    Triangle,
}

impl Marker {
    /// Draws it around `at`, in the coordinates of `area`.
    pub(super) fn draw<DB: DrawingBackend, CT: CoordTranslate>(
        self,
        area: &DrawingArea<DB, CT>,
        pen: Pen,
        at: CT::From,
        colour: RGBColor,
    ) -> Drawn<DB>
    where
        CT::From: Clone,
    {
        let r = pen.at(5);
        let corners = match self {
            Self::Circle => {
                let circle = Circle::new((0, 0), pen.px(5), colour.filled());
                return area.draw(&(EmptyElement::at(at) + circle));
            }
            Self::Square => vec![(-r, -r), (r, -r), (r, r), (-r, r)],
            Self::Triangle => vec![(-r, r), (r, r), (0, -r)],
        };
        area.draw(&(EmptyElement::at(at) + Polygon::new(corners, colour.filled())))
    }
}

/// The unit of what a joint bears.
pub(super) fn unit(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "N\u{b7}m",
        JointKind::Prismatic => "N",
    }
}

/// What a joint bears, on an axis.
pub(super) fn torque_label(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "torque in N\u{b7}m",
        JointKind::Prismatic => "force in N",
    }
}
