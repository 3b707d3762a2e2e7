//! Figures: each is drawn once and comes out as SVG and as PNG, alike.

mod arm;
mod chart;
mod heat_map;
mod impact;
mod law;
mod ratio_map;
mod search_flow;
mod simulated;
mod sketch;
mod stroke;
mod structure;
mod style;
mod sweep;
mod torque;
mod tradeoff;
mod view;

use std::sync::Once;

use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::Text;
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{FontStyle, WHITE};

pub(crate) use arm::Arm;
pub(crate) use heat_map::HeatMap;
pub(crate) use impact::Impacts;
pub(crate) use ratio_map::RatioMaps;
pub(crate) use search_flow::SearchFlow;
pub(crate) use simulated::{Convergence, SimulatedTorques};
pub(crate) use structure::Structure;
use style::{Pen, anchored};
pub(crate) use sweep::FeltSteps;
pub(crate) use torque::Torques;
pub(crate) use tradeoff::Tradeoffs;

/// Where a figure is drawn.
type Area<DB> = DrawingArea<DB, Shift>;
/// How drawing ends.
type Drawn<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// Something that can be drawn on any backend.
pub(crate) trait Figure {
    /// Width and height in CSS pixels.
    fn size(&self) -> (u32, u32);

    /// Draws it on an `area` of that size, or of a multiple of it that `pen` knows.
    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB>;
}

/// The height of the line below a figure, CSS pixels.
const FOOTER: u32 = 22;

/// Width and height of a figure with the line below it.
fn whole(figure: &impl Figure) -> (u32, u32) {
    let (width, height) = figure.size();
    (width, height + FOOTER)
}

/// A figure as SVG, with a line below it that says what it is of.
pub(crate) fn svg(figure: &impl Figure, footer: &str) -> anyhow::Result<String> {
    load_fonts();
    // The backend's coordinates are whole numbers: whole pixels would make steps of curves.
    let pen = Pen { scale: 16 };
    let (width, height) = whole(figure);
    let (fine_width, fine_height) = (width * pen.scale, height * pen.scale);
    let mut text = String::new();
    let area = SVGBackend::with_string(&mut text, (fine_width, fine_height)).into_drawing_area();
    draw(figure, footer, &area, pen)?;
    drop(area);
    let fine = format!("width=\"{fine_width}\" height=\"{fine_height}\"");
    let size = format!("width=\"{width}\" height=\"{height}\"");
    let text = text.replacen(&fine, &size, 1);
    // Else the background would shine through where two fields meet.
    Ok(text.replace("<rect ", "<rect shape-rendering=\"crispEdges\" "))
}

/// The same as PNG, at twice the resolution.
pub(crate) fn png(figure: &impl Figure, footer: &str) -> anyhow::Result<Vec<u8>> {
    load_fonts();
    let pen = Pen { scale: 2 };
    let (width, height) = whole(figure);
    let (width, height) = (width * pen.scale, height * pen.scale);
    let mut pixels = vec![0; (width * height * 3) as usize];
    let area = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
    draw(figure, footer, &area, pen)?;
    drop(area);
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(file)
}

fn draw<DB: DrawingBackend>(
    figure: &impl Figure,
    footer: &str,
    area: &Area<DB>,
    pen: Pen,
) -> anyhow::Result<()> {
    let (body, foot) = area.split_vertically(area.dim_in_pixel().1 - pen.px(FOOTER));
    let style = anchored(&pen.footer(), HPos::Left, VPos::Center);
    let line = Text::new(footer.to_owned(), (pen.at(8), pen.at(10)), style);
    let drawn = area
        .fill(&WHITE)
        .and_then(|()| figure.draw(&body, pen))
        .and_then(|()| foot.draw(&line))
        .and_then(|()| area.present());
    // The backend's own error need not outlive the drawing; its text is enough.
    drawn.map_err(|error| anyhow::anyhow!("a figure cannot be drawn: {error}"))
}

/// Fonts that come with the program, so that a figure does not depend on those of the machine.
fn load_fonts() {
    static FONTS: Once = Once::new();
    FONTS.call_once(|| {
        let faces = [
            (FontStyle::Normal, dejavu::sans::regular()),
            (FontStyle::Bold, dejavu::sans::bold()),
        ];
        for (style, face) in faces {
            // The faces are valid: they come with the crate.
            let _ = plotters::style::register_font(style::FONT, style, face);
        }
    });
}
