//! A scene as one SVG.

use super::gather::{Asked, Gathered};
use super::picture::{Along, Picture};
use super::pictures::{sheet, time_axis};
use crate::draw::{Canvas, Size, plain};
use dalembert::Error;
use dalembert::problem::{Parameters, Problem};
use dalembert::quantity::Units;
use dalembert::solve::{Target, TypedHistory};

/// The pictures that tell a history, as SVG: the field along the rod with its rays and contacts, the stress at the
/// ground, the motion, the energy.
///
/// ```
/// # use dalembert::{Problem, Units};
/// # use dalembert_plot::Drawing;
/// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
/// let drawn = Drawing::default().draw(&rod.doubles()?, &rod, Units::default())?;
/// assert_eq!(drawn.svg.matches("class=\"panel\"").count(), 4);
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    /// What stands above the pictures of a page, before the values of the rod; none by default.
    pub title: Option<String>,
    /// The first and the last time; by default what shows the first contacts.
    pub span: Option<[f64; 2]>,
    /// What it is drawn on.
    pub canvas: Canvas,
}

/// A picture that is drawn.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The SVG; lengths in it are in mm.
    pub svg: String,
    /// The strain, or stress, at which the colours of the field end.
    pub greatest: f64,
}

impl Drawing {
    fn asked(&self, pictures: &[Picture]) -> Asked {
        let [from, to] = self.span.map_or([None, None], |span| span.map(Some));
        Asked { pictures: pictures.to_vec(), along: Along::default(), deformed: false, from, to }
    }

    /// Draws a history of a problem.
    ///
    /// **Accuracy**: that of the history, and a hundredth of a millimetre.
    ///
    /// **Errors**: those of the history; [`Error::TimeOutside`] for a span that it does not reach.
    pub fn draw<S: Target>(&self, history: &TypedHistory<S>, problem: &Problem, units: Units) -> Result<Drawn, Error> {
        let pictures = match self.canvas {
            Canvas::Page => &Picture::SHEET[..],
            Canvas::Screen { .. } => &[Picture::Along, Picture::Stress, Picture::Energy],
        };
        let asked = self.asked(pictures);
        let scene = asked.gather(String::new(), problem, units, history)?;
        let title = heading(self.title.as_deref(), problem, &scene, &asked);
        let greatest = scene.cells.as_ref().map_or(0.0, |cells| cells.greatest);
        // The units of one scene do not differ.
        let svg = sheet(&asked, &[scene], title).map_or_else(
            |_| String::new(),
            |sheet| match self.canvas {
                Canvas::Page => sheet.svg(Size::Page),
                Canvas::Screen { width, height, letters } => sheet.stacked(width, height, letters),
            },
        );
        Ok(Drawn { svg, greatest })
    }

    /// The first and the last time that are drawn.
    ///
    /// **Errors**: as [`Drawing::draw`].
    pub fn drawn_span<S: Target>(&self, history: &TypedHistory<S>, problem: &Problem) -> Result<[f64; 2], Error> {
        self.asked(&[]).span(history, Parameters::<f64>::of(problem, &())?.round_trip())
    }
}

/// The lines above the pictures of one scene: its title, its values, and what of it is drawn. Times are in the unit of
/// the axis.
pub fn heading(title: Option<&str>, problem: &Problem, scene: &Gathered, asked: &Asked) -> Vec<String> {
    let axis = time_axis(std::slice::from_ref(scene));
    let known = scene.units.parameters(problem, |time| axis.told(time)).join(", ");
    title.map(plain).into_iter().chain([known]).chain(scene.cut(asked, &axis)).collect()
}
