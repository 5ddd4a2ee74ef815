//! PNG and PDF of an SVG, in the embedded font.

use krilla::Document;
use krilla::geom::Size;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use resvg::{tiny_skia, usvg};

/// DejaVu Sans, reduced to the characters that our pictures use: Latin and Greek letters, digits above and below the
/// line, and signs.
const FONT: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");
const FAMILY: &str = "DejaVu Sans";

/// Points of a PDF, 72 an inch, for a pixel of an SVG, 96 an inch.
const POINTS: f32 = 0.75;

/// SVG that is read, ready to be written as PNG or PDF.
pub struct ParsedSvg(usvg::Tree);

/// Failure to write an SVG as PNG or PDF.
#[derive(Debug, thiserror::Error)]
pub enum RasterError {
    /// The SVG reader refuses the text. The SVGs of this crate are valid.
    #[error(transparent)]
    Svg(#[from] usvg::Error),
    /// A side of the picture is zero.
    #[error("a picture without size")]
    NoSize,
    /// The PNG encoder fails.
    #[error(transparent)]
    Png(#[from] png::EncodingError),
    /// The PDF writer refuses the page.
    #[error("a picture that is no page")]
    NoPage,
    /// The PDF writer fails.
    #[error("{0:?}")]
    Pdf(krilla::error::KrillaError),
}

impl ParsedSvg {
    /// Reads an SVG.
    ///
    /// **Errors**: [`RasterError::Svg`].
    pub fn new(svg: &str) -> Result<Self, RasterError> {
        let mut options = usvg::Options { font_family: FAMILY.into(), ..usvg::Options::default() };
        options.fontdb_mut().load_font_data(FONT.to_vec());
        Ok(ParsedSvg(usvg::Tree::from_str(svg, &options)?))
    }

    /// Returns the letters that the embedded font does not have, each once, in order. They stay empty.
    pub fn missing_letters(&self) -> String {
        let mut missing = String::new();
        collect_missing(self.0.root(), &mut missing);
        missing
    }

    /// Returns a PNG on white, in which `scale` pixels are one pixel of the SVG.
    ///
    /// **Errors**: [`RasterError::NoSize`], [`RasterError::Png`].
    pub fn png(&self, scale: f32) -> Result<Vec<u8>, RasterError> {
        let [width, height] = [self.0.size().width(), self.0.size().height()].map(|side| (side * scale).round() as u32);
        let mut pixels = tiny_skia::Pixmap::new(width, height).ok_or(RasterError::NoSize)?;
        pixels.fill(tiny_skia::Color::WHITE);
        resvg::render(&self.0, tiny_skia::Transform::from_scale(scale, scale), &mut pixels.as_mut());
        // Every pixel is opaque, so that the alpha channel is left out.
        let colors: Vec<u8> = pixels.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgb);
        // Fast compression takes a tenth of the default's time and makes files half as large again.
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Adaptive);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&colors)?;
        writer.finish()?;
        Ok(bytes)
    }

    /// Returns a PDF of one page of the size of the SVG, whose texts are text in the embedded font.
    ///
    /// **Errors**: [`RasterError::NoSize`], [`RasterError::NoPage`], [`RasterError::Pdf`].
    pub fn pdf(&self) -> Result<Vec<u8>, RasterError> {
        let [width, height] = [self.0.size().width(), self.0.size().height()].map(|side| side * POINTS);
        let size = Size::from_wh(width, height).ok_or(RasterError::NoSize)?;
        let mut document = Document::new();
        let mut page = document.start_page_with(PageSettings::new(size));
        let mut surface = page.surface();
        surface.draw_svg(&self.0, size, SvgSettings::default()).ok_or(RasterError::NoPage)?;
        surface.finish();
        page.finish();
        document.finish().map_err(RasterError::Pdf)
    }
}

fn collect_missing(group: &usvg::Group, missing: &mut String) {
    for node in group.children() {
        match node {
            usvg::Node::Group(group) => collect_missing(group, missing),
            usvg::Node::Text(text) => {
                let glyphs = text.layouted().iter().flat_map(|span| &span.positioned_glyphs);
                for letter in glyphs.filter(|glyph| glyph.id.0 == 0).flat_map(|glyph| glyph.text.chars()) {
                    if !missing.contains(letter) {
                        missing.push(letter);
                    }
                }
            }
            usvg::Node::Path(_) | usvg::Node::Image(_) => (),
        }
    }
}
