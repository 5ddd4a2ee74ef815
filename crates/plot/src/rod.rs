//! The rod at one time.

use glam::DVec2;

use crate::draw::{AREAS, Anchor, Stroke, Svg, diverging};
use dalembert::Error;
use dalembert::Side;
use dalembert::engine::Motion;
use dalembert::number::Scalar;
use dalembert::problem::{Problem, Top};
use dalembert::quantity::flights;
use dalembert::solve::{Target, TypedHistory};

/// Parts of the rod, each of one colour.
const PARTS: usize = 120;
/// Times of a contact at which energies are asked for.
const MIDDLES: usize = 5;
/// Contacts whose energies are asked for.
const CONTACTS: usize = 3;

/// The greatest sizes of a run, by which all its times are drawn alike.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// `|v_x(0,t)|`.
    pub strain: f64,
    /// The height of the centre of mass.
    pub rise: f64,
    /// The least and the greatest energy, at some times of the first contacts.
    pub energy: [f64; 2],
}

impl Sizes {
    /// Those of a history.
    ///
    /// **Errors**: those of the history.
    pub fn of<S: Target>(history: &TypedHistory<S>) -> Result<Self, Error> {
        let query = |motion: &dyn Motion<S::Carried>| {
            let strains = motion.contacts().iter().map(|contact| contact.peak_strain.to_f64().abs());
            let mut rise = motion.centre(&motion.end())?.0.to_f64();
            for flight in flights(motion)? {
                rise = flight.top.iter().map(|height| height.to_f64()).fold(rise, f64::max);
            }
            let mut energy = [0.0f64; 2];
            for contact in motion.contacts().iter().take(CONTACTS) {
                let (from, to) = (contact.impact.to_f64(), contact.release.as_ref().unwrap_or(&motion.end()).to_f64());
                let middles = (0..MIDDLES).map(|k| from + (to - from) * (k as f64 + 0.5) / MIDDLES as f64);
                for time in [from].into_iter().chain(middles) {
                    let found = motion.energy(&motion.end().double(time))?;
                    for size in [found.total, found.translational, found.vibrational] {
                        energy = [energy[0].min(size.to_f64()), energy[1].max(size.to_f64())];
                    }
                }
            }
            Ok(Sizes { strain: strains.fold(0.0, f64::max), rise: rise.max(0.0), energy })
        };
        history.ask(query, |_| Vec::new())
    }
}

/// The rod at one time on a part of a screen, with its centre of mass and its energies as bars; lengths in mm.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// From left to right.
    pub width: f64,
    /// From top to bottom.
    pub height: f64,
    /// The height of letters.
    pub letters: f64,
    /// How many times what fits displacements are enlarged; by default they are as they are.
    pub enlarged: Option<f64>,
    /// The strain at which the colours end.
    pub greatest: f64,
}

impl Pose {
    /// Draws a history at a time as SVG.
    ///
    /// **Accuracy**: that of the history; `v` between its ends by trapezoids under `v_x`, a hundred and twenty.
    ///
    /// **Errors**: those of the history; [`Error::TimeOutside`] for a time that it does not reach.
    pub fn draw<S: Target>(
        &self,
        history: &TypedHistory<S>,
        problem: &Problem,
        sizes: &Sizes,
        time: f64,
    ) -> Result<String, Error> {
        let length = problem.rod.length.to_f64();
        let query = |motion: &dyn Motion<S::Carried>| {
            let time = motion.end().double(time);
            let points = (0..=PARTS).map(|k| time.double(length * k as f64 / PARTS as f64)).collect::<Vec<_>>();
            let rates = motion.rates(&points, std::slice::from_ref(&time))?;
            let energy = motion.energy(&time)?;
            Ok(Found {
                strains: rates.into_iter().map(|[_, strain]| strain.to_f64()).collect::<Vec<_>>(),
                end: motion.ground_end(&time, Side::Right)?.0.to_f64(),
                centre: motion.centre(&time)?.0.to_f64(),
                energy: [energy.translational.to_f64(), energy.vibrational.to_f64()],
            })
        };
        let found = history.ask(query, |_| Vec::new())?;
        Ok(self.svg(&found, sizes, length, problem.rod.top == Top::Fixed))
    }

    fn svg(&self, found: &Found, sizes: &Sizes, length: f64, fixed: bool) -> String {
        let Pose { width, height, letters, greatest, .. } = *self;
        let unit = letters / 13.0;
        let fit = f64::min(0.6 / sizes.strain, 0.9 * length / sizes.rise);
        let factor = self.enlarged.map_or(1.0, |times| if fit.is_finite() { times * fit } else { times });
        let (ground, top) = (height - 46.0 * unit, 14.0 * unit);
        // The upper end swings about the centre of mass.
        let reach = 1.12 * length + factor * sizes.rise;
        let place = |y: f64| ground - y / reach * (ground - top);
        let narrow = width < 120.0 * unit;
        let [left, thick, tick, beside] =
            if narrow { [4.0, 18.0, 4.0, 1.5] } else { [22.0, 44.0, 6.0, 3.0] }.map(|size| size * unit);
        let line = |width: f64| Stroke::new(INK, width * unit);

        let mut svg = Svg::new(width, height, letters);
        let part = length / PARTS as f64;
        let (mut shift, foot) = (found.end, place(factor * found.end));
        let mut low = foot;
        let shown = found
            .strains
            .windows(2)
            .enumerate()
            .map(|(k, ends)| {
                let strain = (ends[0] + ends[1]) / 2.0;
                shift += strain * part;
                low = place(part * (k + 1) as f64 + factor * shift);
                (low, diverging(if greatest > 0.0 { strain / greatest } else { 0.0 }))
            })
            .collect::<Vec<_>>();
        // Each reaches to the foot, and the next one covers it: neighbours leave no seam.
        for (high, color) in shown.chunk_by(|a, b| a.1 == b.1).rev().filter_map(<[_]>::last) {
            svg.rectangles(&[[DVec2::new(left, *high), DVec2::new(left + thick, foot)]], color);
        }
        svg.frame([DVec2::new(left, low), DVec2::new(left + thick, foot)], line(1.2));
        let middle = place(length / 2.0 + factor * found.centre);
        let mut level = |from: f64, to: f64, y: f64, stroke: Stroke| {
            svg.line(&[DVec2::new(from, y), DVec2::new(to, y)], stroke);
        };
        level(left - tick, left, middle, line(2.0));
        level(left + thick, left + thick + tick, middle, line(2.0));
        // The colours of the rod are the same where those of lines are not.
        level(left, left + thick, middle, Stroke::new("#000001", 2.0 * unit));
        let edge = left + thick + if narrow { 4.0 } else { 16.0 } * unit;
        hatched(&mut svg, edge, ground, unit);
        if fixed {
            hatched(&mut svg, edge, low, -unit);
        }

        // E_h is below zero where the centre of mass is deeper than its speed can lift it.
        let [bar, apart, margin, over] =
            if narrow { [12.0, 6.0, 3.0, 1.0] } else { [22.0, 4.0, 10.0, 3.0] }.map(|size| size * unit);
        let from = width - 2.0 * bar - apart - margin;
        let [least, most] = sizes.energy;
        let scale = (ground - top) / if most > least { most - least } else { 1.0 };
        let zero = ground + scale * least;
        for (k, (size, name)) in found.energy.into_iter().zip(["E_h", "E_z"]).enumerate() {
            let x = from + k as f64 * (bar + apart);
            let end = (zero - size * scale).clamp(2.0 * unit, ground + 12.0 * unit);
            let corners = [DVec2::new(x, end.min(zero)), DVec2::new(x + bar, end.max(zero))];
            svg.rectangles(&[corners], AREAS[k + 1]);
            svg.text(DVec2::new(x + bar / 2.0, height - 8.0 * unit), Anchor::Middle, name);
        }
        svg.line(&[DVec2::new(from - over, zero), DVec2::new(width - 2.0 * unit, zero)], line(1.0));
        svg.text(DVec2::new(left + thick + tick + beside, middle + 4.0 * unit), Anchor::Start, "h");
        svg.finish()
    }
}

const INK: &str = "#000000";

/// What is drawn of a time: `v_x` along the rod, `v(0,t)`, `h`, `E_h` and `E_z`.
struct Found {
    strains: Vec<f64>,
    end: f64,
    centre: f64,
    energy: [f64; 2],
}

/// What does not move: a line, hatched below, or above it where `unit` is negative.
fn hatched(svg: &mut Svg, to: f64, y: f64, unit: f64) {
    let wide = 8.0 * unit.abs();
    svg.line(&[DVec2::new(0.0, y), DVec2::new(to, y)], Stroke::new(INK, wide / 5.0));
    let mut x = wide / 2.0;
    while x < to + wide / 2.0 {
        let ends = [DVec2::new(x.min(to), y), DVec2::new((x - wide).max(0.0), y + 8.0 * unit)];
        svg.line(&ends, Stroke::new(INK, wide / 8.0));
        x += wide;
    }
}

#[cfg(test)]
#[path = "tests/rod.rs"]
mod tests;
