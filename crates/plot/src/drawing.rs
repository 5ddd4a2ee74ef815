//! A scene as one SVG.

use dalembert::Error;
use dalembert::chain::{Chain, Joint};
use dalembert::quantity::Units;
use dalembert::solve::TypedHistory;

use crate::draw::{Canvas, Size};
use crate::picture::Picture;
use crate::scene_data::{Request, SceneData};

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
        Ok(DrawnSvg { svg: self.svg(&request, &[scene], title), color_limit })
    }

    /// Draws the bodies of a chain, from the bottom up, each with its name and the units of its numbers: their fields
    /// at their heights, and the forces at the joints; on a page also their centres and energies.
    ///
    /// **Accuracy**: that of the histories, and a hundredth of a millimetre.
    ///
    /// **Errors**: as [`Drawing::draw`].
    pub fn draw_chain(&self, chain: &Chain, bodies: &[(String, Units, TypedHistory<f64>)]) -> Result<DrawnSvg, Error> {
        let pictures = match self.canvas {
            Canvas::Page => &Picture::CHAIN[..],
            Canvas::Screen { .. } => &Picture::CHAIN[..2],
        };
        let request = Request { heights: heights(chain), ..self.request(pictures) };
        let spans = bodies.iter().map(|(.., history)| request.span(history)).collect::<Result<Vec<_>, _>>()?;
        let request = request.over(&spans);
        let gather = |(name, units, history): &(String, Units, TypedHistory<f64>)| {
            request.gather(name.clone(), units.clone(), history)
        };
        let scenes = bodies.iter().map(gather).collect::<Result<Vec<_>, _>>()?;
        let limits = scenes.iter().filter_map(|scene| scene.field.as_ref()).map(|field| field.color_limit);
        let color_limit = limits.fold(0.0, f64::max);
        let title = self.title.iter().cloned().collect();
        Ok(DrawnSvg { svg: self.svg(&request, &scenes, title), color_limit })
    }

    fn svg(&self, request: &Request, scenes: &[SceneData], title: Vec<String>) -> String {
        // The scenes have one set of units.
        request.sheet(scenes, title).map_or_else(
            |_| String::new(),
            |sheet| match self.canvas {
                Canvas::Page => sheet.svg(Size::Page),
                Canvas::Screen { width, height, letters } => sheet.stacked_svg(width, height, letters),
            },
        )
    }

    /// Returns the first and the last time that are drawn.
    ///
    /// **Errors**: as [`Drawing::draw`].
    pub fn drawn_span(&self, history: &TypedHistory<f64>) -> Result<[f64; 2], Error> {
        self.request(&[]).span(history)
    }
}

/// Share of the height of a chain by which a contact joint is drawn open.
const DRAWN_GAP: f64 = 0.05;

/// Returns the height of each body of a chain in a picture: joints in contact are drawn open.
pub fn heights(chain: &Chain) -> Vec<f64> {
    let lengths = || chain.bodies().iter().map(|body| body.length().to_f64());
    let gap = DRAWN_GAP * lengths().sum::<f64>();
    let gaps = chain.joints().iter().map(|joint| if *joint == Joint::Bonded { 0.0 } else { gap });
    let rises = [0.0].into_iter().chain(lengths().zip(gaps).map(|(length, gap)| length + gap));
    rises
        .scan(0.0, |height, rise| {
            *height += rise;
            Some(*height)
        })
        .collect()
}
