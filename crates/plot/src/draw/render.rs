//! An SVG as PNG and as PDF, in the embedded font.

use krilla::Document;
use krilla::geom::Size;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use resvg::{tiny_skia, usvg};

/// DejaVu Sans, Latin and Greek letters, digits above and below the line and signs: what our pictures write.
const FONT: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");
const FAMILY: &str = "DejaVu Sans";

/// Points of a PDF, 72 an inch, for a pixel of an SVG, 96 an inch.
const POINTS: f32 = 0.75;

/// An SVG that is read, ready to be written in other ways.
pub struct Rendered(usvg::Tree);

impl Rendered {
    /// **Errors**: what the SVG reader says; none for the SVGs that are drawn here.
    pub fn of(svg: &str) -> Result<Self, String> {
        let mut options = usvg::Options { font_family: FAMILY.into(), ..usvg::Options::default() };
        options.fontdb_mut().load_font_data(FONT.to_vec());
        usvg::Tree::from_str(svg, &options).map(Rendered).map_err(|error| error.to_string())
    }

    /// The letters that the embedded font does not have, each once, in order: they stay empty.
    pub fn missing(&self) -> String {
        let mut missing = String::new();
        collect_missing(self.0.root(), &mut missing);
        missing
    }

    /// A PNG on white; `scale` pixels are one of the SVG.
    pub fn png(&self, scale: f32) -> Result<Vec<u8>, String> {
        let [width, height] = [self.0.size().width(), self.0.size().height()].map(|side| (side * scale).round() as u32);
        let mut pixels = tiny_skia::Pixmap::new(width, height).ok_or("a picture without size")?;
        pixels.fill(tiny_skia::Color::WHITE);
        resvg::render(&self.0, tiny_skia::Transform::from_scale(scale, scale), &mut pixels.as_mut());
        // Nothing is transparent on white.
        let colors: Vec<u8> = pixels.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgb);
        // A tenth of the time of the default, for files half as large again.
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Adaptive);
        let written = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(&colors)?;
            writer.finish()
        });
        written.map(|()| bytes).map_err(|error| error.to_string())
    }

    /// A PDF of one page of the size of the SVG, its texts as text in the embedded font.
    pub fn pdf(&self) -> Result<Vec<u8>, String> {
        let [width, height] = [self.0.size().width(), self.0.size().height()].map(|side| side * POINTS);
        let size = Size::from_wh(width, height).ok_or("a picture without size")?;
        let mut document = Document::new();
        let mut page = document.start_page_with(PageSettings::new(size));
        let mut surface = page.surface();
        surface.draw_svg(&self.0, size, SvgSettings::default()).ok_or("a picture that is no page")?;
        surface.finish();
        page.finish();
        document.finish().map_err(|error| format!("{error:?}"))
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
