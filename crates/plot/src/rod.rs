//! The rod at one time.

use dalembert::engine::Motion;
use dalembert::number::Scalar;
use dalembert::problem::Top;
use dalembert::quantity::flights;
use dalembert::solve::TypedHistory;
use dalembert::{Error, Side};
use glam::DVec2;

use crate::draw::{AREAS, Anchor, Stroke, Svg, diverging};
use crate::field::Double;

/// Number of parts of the rod, each of one colour.
const PARTS: usize = 120;
/// Number of contacts whose energies are asked for.
const CONTACTS: usize = 3;
/// Number of times in each of these contacts, besides its beginning.
const TIMES: usize = 5;
const BLACK: &str = "#000000";

/// Greatest values of a run, which scale the pictures of all its times alike.
#[derive(Clone, Copy, Debug)]
pub struct RunExtremes {
    /// Greatest `|v_x(0,t)|`.
    pub strain: f64,
    /// Greatest height of the centre of mass.
    pub rise: f64,
    /// Least and greatest energy, at some times of the first contacts.
    pub energy: [f64; 2],
}

impl RunExtremes {
    /// Asks a history for its greatest values.
    ///
    /// **Errors**: those of the history.
    pub fn new(history: &TypedHistory<f64>) -> Result<Self, Error> {
        let query = |motion: &dyn Motion<Double>| {
            let strains = motion.contacts().iter().map(|contact| contact.peak_strain.to_f64().abs());
            let mut rise = motion.centre(&motion.end())?.0.to_f64();
            for flight in flights(motion)? {
                rise = flight.top.iter().map(|height| height.to_f64()).fold(rise, f64::max);
            }
            let mut energy = [0.0f64; 2];
            for contact in motion.contacts().iter().take(CONTACTS) {
                let (from, to) = (contact.impact.to_f64(), contact.release.as_ref().unwrap_or(&motion.end()).to_f64());
                let inner = (0..TIMES).map(|k| from + (to - from) * (k as f64 + 0.5) / TIMES as f64);
                for time in [from].into_iter().chain(inner) {
                    let found = motion.energy(&motion.end().double(time))?;
                    for value in [found.total, found.translational, found.vibrational].map(|value| value.to_f64()) {
                        energy = [energy[0].min(value), energy[1].max(value)];
                    }
                }
            }
            Ok(RunExtremes { strain: strains.fold(0.0, f64::max), rise: rise.max(0.0), energy })
        };
        history.ask(query, |_| Vec::new())
    }
}

/// Picture of the rod at one time, with its centre of mass and bars of its energies. Lengths are in mm.
#[derive(Clone, Copy, Debug)]
pub struct RodPicture {
    /// Width of the picture.
    pub width: f64,
    /// Height of the picture.
    pub height: f64,
    /// Height of letters.
    pub letters: f64,
    /// Enlargement of the displacements, relative to the one that fits the picture; `None` draws them to scale.
    pub enlarged: Option<f64>,
    /// Strain at which the colours end.
    pub color_limit: f64,
}

/// State of the rod at one time.
struct State {
    /// `v_x` at the ends of all parts.
    strains: Vec<f64>,
    /// `v(0,t)`.
    end: f64,
    /// `h`.
    centre: f64,
    /// `E_h` and `E_z`.
    energy: [f64; 2],
}

impl RodPicture {
    /// Draws a history at a time as SVG.
    ///
    /// **Accuracy**: that of the history; displacements inside the rod are sums of 120 trapezoids under `v_x`.
    ///
    /// **Errors**: those of the history; [`Error::TimeOutside`] for a time that it does not reach.
    pub fn draw(&self, history: &TypedHistory<f64>, extremes: &RunExtremes, time: f64) -> Result<String, Error> {
        let rod = history.problem();
        let length = rod.length().to_f64();
        let query = |motion: &dyn Motion<Double>| {
            let time = motion.end().double(time);
            let place = |k: usize| (time.double(length * k as f64 / PARTS as f64), time.clone());
            let rates = motion.rates(&(0..=PARTS).map(place).collect::<Vec<_>>())?;
            let energy = motion.energy(&time)?;
            Ok(State {
                strains: rates.into_iter().map(|[_, strain]| strain.to_f64()).collect(),
                end: motion.ground_end(&time, Side::Right)?.0.to_f64(),
                centre: motion.centre(&time)?.0.to_f64(),
                energy: [energy.translational.to_f64(), energy.vibrational.to_f64()],
            })
        };
        let state = history.ask(query, |_| Vec::new())?;
        Ok(self.svg(&state, extremes, length, rod.top() == Top::Fixed))
    }

    fn svg(&self, state: &State, extremes: &RunExtremes, length: f64, fixed: bool) -> String {
        let RodPicture { width, height, letters, color_limit, .. } = *self;
        let unit = letters / 13.0;
        let fit = f64::min(0.6 / extremes.strain, 0.9 * length / extremes.rise);
        let factor = self.enlarged.map_or(1.0, |times| if fit.is_finite() { times * fit } else { times });
        let (ground, top) = (height - 46.0 * unit, 14.0 * unit);
        // The upper end swings about the centre of mass.
        let reach = 1.12 * length + factor * extremes.rise;
        let place = |y: f64| ground - y / reach * (ground - top);
        let narrow = width < 120.0 * unit;
        let scaled =
            |narrow_sizes: [f64; 4], sizes: [f64; 4]| if narrow { narrow_sizes } else { sizes }.map(|size| size * unit);
        let mut svg = Svg::new(width, height, letters);

        let [left, thickness, tick, gap] = scaled([4.0, 18.0, 4.0, 1.5], [22.0, 44.0, 6.0, 3.0]);
        let right = left + thickness;
        let part = length / PARTS as f64;
        let (mut displacement, foot) = (state.end, place(factor * state.end));
        let shade = |(k, ends): (usize, &[f64])| {
            let strain = (ends[0] + ends[1]) / 2.0;
            displacement += strain * part;
            let upper = place(part * (k + 1) as f64 + factor * displacement);
            (upper, diverging(if color_limit > 0.0 { strain / color_limit } else { 0.0 }))
        };
        let parts: Vec<_> = state.strains.windows(2).enumerate().map(shade).collect();
        let head = parts.last().map_or(foot, |part| part.0);
        // Each rectangle reaches down to the foot and is covered by the next one, so that there are no seams.
        for (upper, color) in parts.chunk_by(|a, b| a.1 == b.1).rev().filter_map(<[_]>::last) {
            svg.rectangles(&[[DVec2::new(left, *upper), DVec2::new(right, foot)]], color);
        }
        svg.outline([DVec2::new(left, head), DVec2::new(right, foot)], Stroke::new(BLACK, 1.2 * unit));
        let middle = place(length / 2.0 + factor * state.centre);
        // A dark theme inverts black outside the rod; inside, where the colours stay, the line is almost black.
        for (from, to, color) in [(left - tick, left, BLACK), (right, right + tick, BLACK), (left, right, "#000001")] {
            svg.line(&[DVec2::new(from, middle), DVec2::new(to, middle)], Stroke::new(color, 2.0 * unit));
        }
        let edge = right + if narrow { 4.0 } else { 16.0 } * unit;
        draw_support(&mut svg, edge, ground, unit);
        if fixed {
            draw_support(&mut svg, edge, head, -unit);
        }

        let [bar, apart, margin, overhang] = scaled([12.0, 6.0, 3.0, 1.0], [22.0, 4.0, 10.0, 3.0]);
        let from = width - 2.0 * bar - apart - margin;
        let [least, greatest] = extremes.energy;
        let scale = (ground - top) / if greatest > least { greatest - least } else { 1.0 };
        // E_h is negative if the centre of mass is so low that its speed cannot lift it to zero.
        let zero = ground + scale * least;
        for (k, (value, name)) in state.energy.into_iter().zip(["E_h", "E_z"]).enumerate() {
            let x = from + k as f64 * (bar + apart);
            let end = (zero - value * scale).clamp(2.0 * unit, ground + 12.0 * unit);
            let corners = [DVec2::new(x, end.min(zero)), DVec2::new(x + bar, end.max(zero))];
            svg.rectangles(&[corners], AREAS[k + 1]);
            svg.text(DVec2::new(x + bar / 2.0, height - 8.0 * unit), Anchor::Middle, name);
        }
        let ends = [DVec2::new(from - overhang, zero), DVec2::new(width - 2.0 * unit, zero)];
        svg.line(&ends, Stroke::new(BLACK, unit));
        svg.text(DVec2::new(right + tick + gap, middle + 4.0 * unit), Anchor::Start, "h");
        svg.finish()
    }
}

/// Draws a fixed support from the left edge: a line, hatched below, or above if `unit` is negative.
fn draw_support(svg: &mut Svg, right: f64, y: f64, unit: f64) {
    let step = 8.0 * unit.abs();
    svg.line(&[DVec2::new(0.0, y), DVec2::new(right, y)], Stroke::new(BLACK, step / 5.0));
    let mut x = step / 2.0;
    while x < right + step / 2.0 {
        let ends = [DVec2::new(x.min(right), y), DVec2::new((x - step).max(0.0), y + 8.0 * unit)];
        svg.line(&ends, Stroke::new(BLACK, step / 8.0));
        x += step;
    }
}

#[cfg(test)]
#[path = "tests/rod.rs"]
mod tests;
