//! Engine of the page: solves the text of a scene, and answers in numbers, texts and pictures.

use std::ops::ControlFlow;
use std::sync::Arc;

use dalembert::number::{Answer, Scalar, bound_of_log2, show_beside};
use dalembert::quantity::{Measure, restitution};
use dalembert::{
    ChainScene, Contact, Ending, Energy, Error, Numbers, Parameters, Plan, Question, Scene, SceneError, Side,
    TypedHistory, Units, Warning,
};
use dalembert_plot::{Canvas, Drawing, DrawnSvg, RodPicture, RunExtremes};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// Milliseconds since the page was opened.
    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// Significant digits of a double, as in the tables of the command.
const DIGITS: u32 = 12;
/// Accuracy that doubles must reach, relative to the natural scales: six digits, more than a picture shows.
const ACCURACY: f64 = 1e-6;
/// Significant digits of `c`, `t₁`, `R` and `M`, as in the tables of the command.
const FEW_DIGITS: u32 = 6;

/// Text in place of a value that is not defined.
const NONE: &str = "–";

/// Builds the error of a scene that is not accepted.
fn refuse(error: impl std::fmt::Display) -> JsError {
    JsError::new(&error.to_string())
}

/// Builds the error of a question that more time or another run can settle. The page recognizes its first words.
fn beyond(error: impl std::fmt::Display) -> JsError {
    JsError::new(&format!("not settled: {error}"))
}

/// Builds the error of a question that a history does not answer.
fn failed(error: Error) -> JsError {
    match error {
        Error::NotDecided { .. } | Error::Open(_) | Error::Unsettled { .. } => beyond(error),
        error => refuse(error),
    }
}

/// Formats a number as in the tables of the command, beside numbers of the size of one.
fn text<S: Scalar>(x: &S) -> String {
    text_beside(x, 1.0)
}

/// Formats a number beside numbers up to `greatest`.
fn text_beside<S: Scalar>(x: &S, greatest: f64) -> String {
    show_beside(x, DIGITS, greatest.max(1.0))
}

fn optional<S: Scalar>(x: Option<&S>) -> String {
    x.map_or(NONE.into(), text)
}

/// A solved scene.
#[wasm_bindgen]
pub struct Run {
    scene: Scene,
    history: TypedHistory<f64>,
    extremes: RunExtremes,
}

#[wasm_bindgen]
impl Run {
    /// Solves the scene of `toml` within a limit of milliseconds: in doubles, or also in `longer` numbers.
    #[wasm_bindgen(constructor)]
    pub fn new(toml: &str, milliseconds: f64, longer: bool) -> Result<Run, JsError> {
        // Line and column are left out: the page does not show the text.
        let found = |error: SceneError| JsError::new(&format!("found {}, expected {}", error.found, error.expected));
        let scene = Scene::parse(toml).map_err(found)?;
        let numbers = Numbers::Double(Some(ACCURACY));
        let plan = Plan::of(&scene.problem, &Question::run(numbers)).map_err(refuse)?;
        let plan = if longer { plan } else { plan.in_doubles() };
        let until = now() + milliseconds;
        let observe = Arc::new(move |_, _| match now() > until {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        });
        match TypedHistory::solve(&scene.problem, &plan, observe) {
            Ok(history) => {
                let extremes = RunExtremes::new(&history).map_err(failed)?;
                Ok(Run { scene, history, extremes })
            }
            Err(Error::Interrupted) => Err(beyond(format!("no answer within {milliseconds} ms"))),
            Err(error) => Err(failed(error)),
        }
    }

    /// Returns `c`, `t₁`, `R` and `M` as the command prints them.
    pub fn parameters(&self) -> Result<Vec<String>, JsError> {
        let rod = Parameters::<f64>::of(&self.scene.problem, &()).map_err(refuse)?;
        let groups = self.scene.problem.dimensionless();
        let ratio = groups.speed_ratio.filter(|ratio| ratio.is_finite());
        let known = [rod.wave_speed, rod.round_trip(), groups.damping_ratio].map(|x| x.decimal(FEW_DIGITS));
        Ok(known.into_iter().chain([ratio.map_or("∞".into(), |ratio| ratio.decimal(FEW_DIGITS))]).collect())
    }

    /// Returns the end of the history.
    pub fn end(&self) -> f64 {
        *self.history.end()
    }

    /// Returns a sentence with the end of the history, the reason and the error bound.
    pub fn ending(&self) -> String {
        let (end, why) = (self.history.end().decimal(DIGITS), self.history.ending());
        let bound = bound_of_log2(self.history.error_estimate().log2());
        let meets = |warning: &Warning| matches!(warning, Warning::Coincidence { .. });
        let meeting = match self.history.warnings().iter().any(meets) {
            true => "; an event and a ray that coincide within it are taken for one",
            false => "",
        };
        format!("ends at t = {end}: {why}; error at most {bound} of the natural scales{meeting}")
    }

    /// Returns a sentence for each thing that is not settled.
    pub fn doubts(&self) -> Vec<String> {
        let bound = self.history.error_estimate();
        let wide = (bound > ACCURACY || bound.is_nan())
            .then(|| format!("the bound of the error is {} of the natural scales", bound_of_log2(bound.log2())));
        let undecided =
            matches!(self.history.ending(), Ending::Undecided(_)).then(|| self.history.ending().to_string());
        // These are about the problem, and not about the accuracy of its answer.
        let settled = |warning: &Warning| {
            matches!(
                warning,
                Warning::DragNeglected { .. }
                    | Warning::DragDominates { .. }
                    | Warning::StrainAboveOne { .. }
                    | Warning::Coincidence { .. }
            )
        };
        let warnings = self.history.warnings().into_iter().filter(|warning| !settled(warning));
        wide.into_iter().chain(undecided).chain(warnings.map(|warning| warning.to_string())).collect()
    }

    /// Returns the times of impacts and releases in turns, an impact first.
    pub fn events(&self) -> Vec<f64> {
        self.history.events().iter().map(|event| event.t).collect()
    }

    /// Returns for each contact its beginning, end, duration, `e_P` and `e_E²`, and `E`, `E_h`, `E_z` at its end.
    pub fn contacts(&self) -> Result<Vec<String>, JsError> {
        let rows = self.history.ask(
            |motion| {
                let row = |contact: &Contact<_>| {
                    let e = restitution(motion, contact.times())?;
                    let energy = contact.release.as_ref().map(|to| motion.energy(to)).transpose()?;
                    let time = contact.release.clone().map(|to| to - &contact.impact);
                    let mut row = vec![Some(contact.impact.clone()), contact.release.clone(), time];
                    row.extend([e.e_p.ok(), e.e_e2.ok()]);
                    row.extend(energy.map_or([None, None, None], |e| numbers(e).map(Some)));
                    Ok(row)
                };
                motion.contacts().iter().map(row).collect::<Result<Vec<_>, Error>>()
            },
            |rows| rows.iter().flatten().flatten().collect(),
        );
        Ok(rows.map_err(failed)?.iter().flatten().map(|x| optional(x.as_ref())).collect())
    }

    /// Returns `h`, `E`, `E_h`, `E_z`, `v(0,t)` and `v_x(0,t)` at a time.
    pub fn at(&self, time: f64) -> Result<Vec<String>, JsError> {
        let time = time.carry();
        let found = self.history.ask(
            |motion| {
                let [total, translational, vibrational] = numbers(motion.energy(&time)?);
                let (end, _) = motion.ground_end(&time, Side::Right)?;
                let strain = motion.strain(&time, Side::Right)?;
                Ok([motion.centre(&time)?.0, total, translational, vibrational, end, strain])
            },
            |found| found.iter().collect(),
        );
        let found = found.map_err(failed)?;
        let energy = found[1].to_f64().abs();
        let beside = [1.0, energy, energy, energy, 1.0, self.extremes.strain];
        Ok(found.iter().zip(beside).map(|(x, greatest)| text_beside(x, greatest)).collect())
    }

    /// Returns the picture of the rod at a time; lengths are in mm. `enlarged` and `color_limit` are those of
    /// [`RodPicture`].
    pub fn rod(
        &self,
        time: f64,
        width: f64,
        height: f64,
        letters: f64,
        enlarged: Option<f64>,
        color_limit: f64,
    ) -> Result<String, JsError> {
        let picture = RodPicture { width, height, letters, enlarged, color_limit };
        picture.draw(&self.history, &self.extremes, time).map_err(failed)
    }

    /// Returns the greatest `|v_x(0,t)|`.
    pub fn strain(&self) -> f64 {
        self.extremes.strain
    }

    /// Returns the first and the last time of a span that shows the first contacts.
    pub fn span(&self) -> Result<Vec<f64>, JsError> {
        let found = Drawing::default().drawn_span(&self.history);
        Ok(found.map_err(failed)?.to_vec())
    }

    /// Returns field, stress and energy between two times, for a part of the screen; lengths are in mm.
    pub fn screen(&self, from: f64, to: f64, width: f64, height: f64, letters: f64) -> Result<Picture, JsError> {
        self.picture(Some([from, to]), Canvas::Screen { width, height, letters })
    }

    /// Returns the pictures of a page between two times, by default of the first contacts.
    pub fn page(&self, from: Option<f64>, to: Option<f64>) -> Result<Picture, JsError> {
        self.picture(from.zip(to).map(|(from, to)| [from, to]), Canvas::Page)
    }

    /// Returns a picture as `dalembert plot` draws it.
    fn picture(&self, span: Option<[f64; 2]>, canvas: Canvas) -> Result<Picture, JsError> {
        let drawing = Drawing { title: self.scene.title.clone(), span, canvas };
        let units = Units::new(&self.scene.problem, self.scene.units);
        let DrawnSvg { svg, color_limit } = drawing.draw(&self.history, units).map_err(failed)?;
        Ok(Picture { svg, color_limit })
    }
}

/// A chain of bars, solved in doubles.
#[wasm_bindgen]
pub struct Stack {
    scene: ChainScene,
    bodies: Vec<(String, Units, TypedHistory<f64>)>,
}

#[wasm_bindgen]
impl Stack {
    /// Solves the chain of `toml`.
    #[wasm_bindgen(constructor)]
    pub fn new(toml: &str) -> Result<Stack, JsError> {
        let scene = ChainScene::parse(toml).map_err(refuse)?;
        let name = |k: usize| scene.chain.bodies()[k].name().map_or_else(|| format!("body {}", k + 1), str::to_string);
        let solve = |(k, body): (usize, Scene)| {
            let plan = Plan::of(&body.problem, &Question::run(Numbers::Double(Some(ACCURACY)))).map_err(refuse)?;
            let observe = Arc::new(|_, _| ControlFlow::Continue(()));
            let history = TypedHistory::solve(&body.problem, &plan, observe).map_err(failed)?;
            Ok((name(k), Units::new(&body.problem, body.units), history))
        };
        let bodies: Option<Vec<Scene>> = scene.bodies().map_err(refuse)?.into_iter().collect();
        let bars = || JsError::new("found a rigid mass, expected bars: `dalembert plot` draws both");
        let bodies = bodies.ok_or_else(bars)?.into_iter().enumerate().map(solve);
        let bodies = bodies.collect::<Result<_, JsError>>()?;
        Ok(Stack { scene, bodies })
    }

    /// Returns for each contact below a body its joint, beginning, end, duration, impulse and greatest force.
    pub fn contacts(&self) -> Vec<String> {
        let mut rows = Vec::new();
        for (node, (_, units, history)) in self.bodies.iter().enumerate() {
            let factor = |measure| units.factor::<f64>(measure, &()).unwrap_or(1.0);
            for contact in history.contacts() {
                let duration = contact.release.map(|to| to - contact.impact);
                let impulse = contact.impulse * factor(Measure::Impulse);
                let peak = contact.peak_strain * factor(Measure::Force);
                rows.extend([self.scene.chain.node_name(node), text(&contact.impact)]);
                rows.extend([
                    optional(contact.release.as_ref()),
                    optional(duration.as_ref()),
                    text(&impulse),
                    text(&peak),
                ]);
            }
        }
        rows
    }

    /// Returns the last time.
    pub fn end(&self) -> f64 {
        self.scene.chain.until().to_f64()
    }

    /// Returns the fields of all bodies and the forces at the joints, for a part of the screen; lengths are in mm.
    pub fn screen(&self, width: f64, height: f64, letters: f64) -> Result<String, JsError> {
        self.picture(Canvas::Screen { width, height, letters })
    }

    /// Returns the pictures of a page.
    pub fn page(&self) -> Result<String, JsError> {
        self.picture(Canvas::Page)
    }

    /// Returns the picture of a chain as `dalembert plot` draws it.
    fn picture(&self, canvas: Canvas) -> Result<String, JsError> {
        let drawing = Drawing { title: self.scene.title.clone(), span: None, canvas };
        Ok(drawing.draw_chain(&self.scene.chain, &self.bodies).map_err(failed)?.svg)
    }
}

/// Picture of a span.
#[wasm_bindgen(getter_with_clone)]
pub struct Picture {
    /// The SVG.
    pub svg: String,
    /// Strain at which the colours of the field end.
    #[wasm_bindgen(js_name = "colorLimit")]
    pub color_limit: f64,
}

/// Returns `E`, `E_h` and `E_z`.
fn numbers<S>(energy: Energy<S>) -> [S; 3] {
    [energy.total, energy.translational, energy.vibrational]
}
