//! A scene as one SVG.

use dalembert::Error;
use dalembert::problem::Parameters;
use dalembert::quantity::Units;
use dalembert::solve::TypedHistory;

use crate::draw::{Canvas, Size};
use crate::picture::Picture;
use crate::scene_data::Request;

/// Drawing of a history: the field along the rod with its rays and contacts, the stress at the ground, the motion and
/// the energy.
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    /// Title of a page, above the values of the rod.
    pub title: Option<String>,
    /// First and last time; by default a span that shows the first contacts.
    pub span: Option<[f64; 2]>,
    /// Medium of the picture.
    pub canvas: Canvas,
}

/// Picture that is drawn.
#[derive(Clone, Debug)]
pub struct DrawnSvg {
    /// The SVG; its lengths are in mm.
    pub svg: String,
    /// Strain, or stress if there is a modulus, at which the colours of the field end.
    pub color_limit: f64,
}

impl Drawing {
    fn request(&self, pictures: &[Picture]) -> Request {
        let [from, to] = self.span.map_or([None; 2], |span| span.map(Some));
        Request { pictures: pictures.to_vec(), from, to, ..Request::default() }
    }

    /// Draws a history.
    ///
    /// **Accuracy**: that of the history, and a hundredth of a millimetre.
    ///
    /// **Errors**: those of the history; [`Error::TimeOutside`] for a span that it does not reach.
    pub fn draw(&self, history: &TypedHistory<f64>, units: Units) -> Result<DrawnSvg, Error> {
        let request = self.request(match self.canvas {
            Canvas::Page => &Picture::SHEET,
            Canvas::Screen { .. } => &[Picture::SpaceTime, Picture::Stress, Picture::Energy],
        });
        let scene = request.gather(String::new(), units, history)?;
        let title = scene.heading(self.title.as_deref(), history.problem(), &request);
        let color_limit = scene.field.as_ref().map_or(0.0, |field| field.color_limit);
        // One scene has one set of units.
        let svg = request.sheet(&[scene], title).map_or_else(
            |_| String::new(),
            |sheet| match self.canvas {
                Canvas::Page => sheet.svg(Size::Page),
                Canvas::Screen { width, height, letters } => sheet.stacked_svg(width, height, letters),
            },
        );
        Ok(DrawnSvg { svg, color_limit })
    }

    /// Returns the first and the last time that are drawn.
    ///
    /// **Errors**: as [`Drawing::draw`].
    pub fn drawn_span(&self, history: &TypedHistory<f64>) -> Result<[f64; 2], Error> {
        self.request(&[]).span(history, Parameters::<f64>::of(history.problem(), &())?.round_trip())
    }
}
