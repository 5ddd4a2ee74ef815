//! An SVG as PNG.

use resvg::{tiny_skia, usvg};

/// DejaVu Sans, Latin and Greek letters, digits above and below the line and signs: what our pictures write.
const FONT: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");
const FAMILY: &str = "DejaVu Sans";

/// An SVG as a PNG on white; `scale` pixels are one of the SVG, of which 96 are an inch.
///
/// **Errors**: what the SVG reader or the PNG writer says; none for the SVGs that are drawn here.
pub(crate) fn png(svg: &str, scale: f32) -> Result<Vec<u8>, String> {
    let mut options = usvg::Options { font_family: FAMILY.into(), ..usvg::Options::default() };
    options.fontdb_mut().load_font_data(FONT.to_vec());
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| error.to_string())?;
    let [width, height] = [tree.size().width(), tree.size().height()].map(|side| (side * scale).round() as u32);
    let mut pixels = tiny_skia::Pixmap::new(width, height).ok_or("a picture without size")?;
    pixels.fill(tiny_skia::Color::WHITE);
    resvg::render(&tree, tiny_skia::Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| error.to_string())
}
