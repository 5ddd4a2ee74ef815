//! A rigid body of a chain in the pictures of the chain.

use dalembert::chain::{ChainColumn, ChainHistory, ChainQuantity};
use dalembert::number::Number;
use dalembert::problem::Parameters;
use dalembert::quantity::{Quantity, Units};
use dalembert::{Error, Side};
use glam::DVec2;

use crate::picture::Picture;
use crate::scene_data::{Curve, Request, SceneData};

/// Evenly spaced points of a curve.
const POINTS: usize = 200;
/// Change between two points, as a share of the greatest change, below which none is put between them.
const SMALL: f64 = 0.01;
/// Number of times that a distance between two evenly spaced points is halved at most.
const HALVINGS: usize = 8;

impl Request {
    /// Asks the history of a chain for all that the pictures show of the rigid body with this index, from the first to
    /// the last time of the request: its motion, and the force on its lower side.
    ///
    /// **Accuracy**: curves are straight between points that differ by a hundredth of the whole change, or by 1/50,000
    /// of the span in time.
    ///
    /// **Errors**: those of the history.
    pub fn gather_rigid(
        &self,
        name: String,
        units: Units,
        history: &ChainHistory,
        body: usize,
    ) -> Result<SceneData, Error> {
        let listing = history.listing()?;
        let end = listing.end.to_f64();
        let span = [self.from.unwrap_or(0.0), self.to.unwrap_or(end).min(end)];
        let own: Vec<[f64; 2]> = listing
            .contacts
            .iter()
            .filter(|contact| contact.node == body)
            .map(|contact| [contact.impact.to_f64(), contact.release.as_ref().map_or(end, |to| to.to_f64())])
            .collect();
        let mut quantities: Vec<(Quantity, Vec<Curve>)> = Vec::new();
        for quantity in self.pictures.iter().flat_map(Picture::quantities) {
            let is_new = quantities.iter().all(|(known, _)| *known != quantity);
            if let (true, Ok(of_chain)) = (is_new, quantity.name().parse::<ChainQuantity>()) {
                let column = ChainColumn { quantity: of_chain, place: body };
                quantities.push((quantity, vec![curve(history, column, span)?]));
            }
        }
        let rod = Parameters { length: 0.0, wave_speed: 1.0, damping: 0.0, gravity: 0.0, speed: 0.0 };
        Ok(SceneData::new((name, units), rod, (span, end), own, quantities))
    }
}

/// Returns the values of a column over a span, with more points where it changes fast.
fn curve(history: &ChainHistory, column: ChainColumn, [from, to]: [f64; 2]) -> Result<Curve, Error> {
    let at = |time: f64| -> Result<Option<DVec2>, Error> {
        let Ok(number) = format!("{time:e}").parse::<Number>() else { return Ok(None) };
        match history.value(column, &number, Side::Right) {
            Ok(value) => Ok(Some(DVec2::new(time, value.to_f64()))),
            // A time that is not told from that of a jump has no point of its own.
            Err(Error::Open(_) | Error::NotDecided { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    };
    let step = (to - from) / POINTS as f64;
    let mut points = Vec::new();
    for k in 0..=POINTS {
        let time = if k == POINTS { to } else { from + step * k as f64 };
        points.extend(at(time)?);
    }
    let [least, most] = points
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], point| [least.min(point.y), most.max(point.y)]);
    for _ in 0..HALVINGS {
        let mut finer = Vec::new();
        for pair in points.windows(2) {
            finer.push(pair[0]);
            if (pair[1].y - pair[0].y).abs() > SMALL * (most - least) {
                finer.extend(at(f64::midpoint(pair[0].x, pair[1].x))?);
            }
        }
        finer.extend(points.last());
        if finer.len() == points.len() {
            break;
        }
        points = finer;
    }
    Ok(points)
}
