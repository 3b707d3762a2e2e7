//! Figures: each is drawn once and comes out as SVG and as PNG, alike.

mod chart;
mod heat_map;
mod impact;
mod law;
mod ratio_map;
mod stroke;
mod style;
mod sweep;
mod torque;
mod tradeoff;
mod truth;

use std::sync::Once;

use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::style::{FontStyle, WHITE};

pub(crate) use heat_map::HeatMap;
pub(crate) use impact::Impacts;
pub(crate) use ratio_map::RatioMaps;
use style::Pen;
pub(crate) use sweep::FeltSteps;
pub(crate) use torque::Torques;
pub(crate) use tradeoff::Tradeoffs;
pub(crate) use truth::{Convergence, SimulatedTorques};

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

/// A figure as SVG.
pub(crate) fn svg(figure: &impl Figure) -> anyhow::Result<String> {
    load_fonts();
    // The backend's coordinates are whole numbers: whole pixels would make steps of curves.
    let pen = Pen { scale: 16 };
    let (width, height) = figure.size();
    let (fine_width, fine_height) = (width * pen.scale, height * pen.scale);
    let mut text = String::new();
    let area = SVGBackend::with_string(&mut text, (fine_width, fine_height)).into_drawing_area();
    draw(figure, &area, pen)?;
    drop(area);
    let fine = format!("width=\"{fine_width}\" height=\"{fine_height}\"");
    let size = format!("width=\"{width}\" height=\"{height}\"");
    let text = text.replacen(&fine, &size, 1);
    // Else the background would shine through where two fields meet.
    Ok(text.replace("<rect ", "<rect shape-rendering=\"crispEdges\" "))
}

/// A figure as PNG, at twice the resolution.
pub(crate) fn png(figure: &impl Figure) -> anyhow::Result<Vec<u8>> {
    load_fonts();
    let pen = Pen { scale: 2 };
    let (width, height) = figure.size();
    let (width, height) = (width * pen.scale, height * pen.scale);
    let mut pixels = vec![0; (width * height * 3) as usize];
    let area = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
    draw(figure, &area, pen)?;
    drop(area);
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(file)
}

fn draw<DB: DrawingBackend>(figure: &impl Figure, area: &Area<DB>, pen: Pen) -> anyhow::Result<()> {
    let drawn = area
        .fill(&WHITE)
        .and_then(|()| figure.draw(area, pen))
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
