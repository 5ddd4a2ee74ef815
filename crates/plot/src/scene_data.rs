//! Answers of a history, in doubles, that its pictures show.

use dalembert::engine::{Motion, RayRegister, WavePiece, straight};
use dalembert::number::Scalar;
use dalembert::problem::{Parameters, Problem};
use dalembert::quantity::{Measure, Quantity, Units};
use dalembert::reason::Warning;
use dalembert::solve::TypedHistory;
use dalembert::{Error, EventKind, Side, StressPiece};
use glam::DVec2;

use crate::draw::{Axis, without_subscripts};
use crate::field::{Double, Extent, FieldMap, MAX_RAYS, Ray, settled};
use crate::picture::{FieldQuantity, Picture};

/// Pictures to be drawn, and their span.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Pictures in the order of the sheet.
    pub pictures: Vec<Picture>,
    /// Quantity that the colours of [`Picture::SpaceTime`] show.
    pub field: FieldQuantity,
    /// Whether [`Picture::SpaceTime`] shows the world lines of points of the rod in place of the field.
    pub deformed: bool,
    /// First time; by default the start, or shortly before a late first impact.
    pub from: Option<f64>,
    /// Last time; by default a time that shows the first contacts.
    pub to: Option<f64>,
    /// Heights at which [`Picture::SpaceTime`] shows the bodies of a chain, in one panel; empty for scenes by
    /// themselves.
    pub heights: Vec<f64>,
}

/// Points of a line in the coordinates of a panel.
pub(crate) type Curve = Vec<DVec2>;

/// Answers of one history for a [`Request`].
#[derive(Clone, Debug)]
pub struct SceneData {
    /// Name in legends and titles.
    pub name: String,
    /// Parameters of the rod; a rigid body of a chain has no length.
    pub rod: Parameters<f64>,
    /// First and last time.
    pub span: [f64; 2],
    /// End of the history, or the time from which its events are not settled.
    pub end: f64,
    pub(crate) units: Units,
    /// Beginning and end of each contact that meets the span.
    pub(crate) contacts: Vec<[f64; 2]>,
    /// Number of contacts of the history.
    pub(crate) all_contacts: usize,
    /// Quantities over time, as curves without jumps.
    pub(crate) quantities: Vec<(Quantity, Vec<Curve>)>,
    /// `v_x(0,·)` in straight pieces.
    pub(crate) stress: Vec<StressPiece<f64>>,
    /// `e_P` and `e_E²` of each contact.
    pub(crate) restitution: Vec<[Option<f64>; 2]>,
    pub(crate) field: Option<FieldMap>,
    /// Points along the rod, each with its displacement over time.
    pub(crate) world_lines: Vec<(f64, Curve)>,
}

/// Round trips of the default span.
const TRIPS: f64 = 12.0;
/// Round trips after the last event of the default span.
const TRIPS_AFTER: f64 = 1.0;
/// Evenly spaced points of a curve, besides those at rays.
const POINTS: usize = 400;
/// Number of rays above which a curve has [`DENSE_POINTS`] and none at rays.
const MAX_RAY_POINTS: usize = 4000;
const DENSE_POINTS: usize = 8000;
/// Smallest jump that is drawn, as a share of the greatest value.
pub(crate) const SMALLEST_JUMP: f64 = 1e-6;
/// Error of the straight pieces of the stress, as a share of the greatest value.
const STRESS_ERROR: f64 = 1e-3;
/// Number of contacts whose restitution is drawn.
const MAX_CONTACTS: usize = 400;
/// Number of points of the rod whose world lines are drawn.
const WORLD_LINES: usize = 5;
/// Share of its jump that a ray of a damped rod still carries when it is drawn no more.
const FADED: f64 = 1e-3;

/// Returns whether a stretch of time has a part in `span`.
fn meets([from, to]: &[f64; 2], span: [f64; 2]) -> bool {
    *to >= span[0] && *from <= span[1]
}

impl SceneData {
    /// Builds the data of a scene with its `quantities` and those of all its `contacts` that meet the span, and nothing
    /// else to show.
    pub(crate) fn new(
        (name, units): (String, Units),
        rod: Parameters<f64>,
        (span, end): ([f64; 2], f64),
        mut contacts: Vec<[f64; 2]>,
        quantities: Vec<(Quantity, Vec<Curve>)>,
    ) -> Self {
        let all_contacts = contacts.len();
        contacts.retain(|contact| meets(contact, span));
        SceneData {
            name,
            rod,
            span,
            end,
            units,
            contacts,
            all_contacts,
            quantities,
            stress: Vec::new(),
            restitution: Vec::new(),
            field: None,
            world_lines: Vec::new(),
        }
    }

    /// Returns whether the scene is a rigid body of a chain, which has no length.
    pub fn is_rigid(&self) -> bool {
        self.rod.length == 0.0
    }

    /// Returns the lines above the pictures of the scene: its title, its values, and what its span leaves out.
    pub fn heading(&self, title: Option<&str>, problem: &Problem, request: &Request) -> Vec<String> {
        let axis = time_axis(std::slice::from_ref(self));
        let values = self.units.parameters(problem, |time| axis.with_unit(time)).join(", ");
        title.map(without_subscripts).into_iter().chain([values]).chain(self.shown_part(request)).collect()
    }

    /// Returns the part of the history that the pictures show, if it is not the whole history and was not asked for.
    pub fn shown_part(&self, request: &Request) -> Option<String> {
        let axis = time_axis(std::slice::from_ref(self));
        let [from, to, end] = [self.span[0], self.span[1], self.end].map(|time| axis.with_unit(time));
        let cut = request.shows_span() && request.from.is_none() && request.to.is_none() && self.span[1] != self.end;
        let (shown, all) = (self.contacts.len(), self.all_contacts);
        cut.then(|| format!("from t = {from} to {to} of {end}, {shown} of {all} contacts"))
    }

    /// Returns the number of columns that the field has for each round trip, if they are too few to show its waves.
    pub fn coarse_columns(&self) -> Option<f64> {
        self.field.as_ref()?.coarse_columns
    }

    /// Returns the curves of a quantity that was asked for.
    pub(crate) fn curves(&self, quantity: Quantity) -> Vec<Curve> {
        self.quantities.iter().find(|found| found.0 == quantity).map_or_else(Vec::new, |found| found.1.clone())
    }
}

impl Request {
    /// Returns whether any picture shows the span. Restitution is that of all contacts.
    pub fn shows_span(&self) -> bool {
        self.pictures.iter().any(|picture| *picture != Picture::Restitution)
    }

    /// Returns the request for the bodies of a chain, which are drawn over one span: that of all of these.
    pub fn over(&self, spans: &[[f64; 2]]) -> Request {
        let from = spans.iter().map(|span| span[0]).reduce(f64::min).or(self.from);
        let to = spans.iter().map(|span| span[1]).reduce(f64::max).or(self.to);
        Request { from, to, ..self.clone() }
    }

    /// Asks a history for all that the pictures show.
    ///
    /// **Errors**: those of the history; [`Error::TimeOutside`] for a span that it does not reach.
    pub fn gather(&self, name: String, units: Units, history: &TypedHistory<f64>) -> Result<SceneData, Error> {
        let rod = Parameters::<f64>::of(history.problem(), &())?;
        let (end, span) = (settled_until(history), self.span(history)?);
        let contacts = history.contacts().iter().map(|contact| [contact.impact, contact.release.unwrap_or(end)]);
        let chain = history.problem().chain();
        let is_soft = chain.as_ref().is_some_and(|(chain, _)| chain.is_soft());
        let has_waves = rod.damping == 0.0 && chain.is_none();
        let extent = Extent { rod: rod.clone(), span, is_soft, has_waves };
        let rays = rays(history, &extent)?;
        let quantities = self.gather_quantities(history, &extent, &rays)?;
        let mut data = SceneData::new((name, units), rod, (span, end), contacts.collect(), quantities);
        if self.pictures.contains(&Picture::Stress) {
            let pieces = history.stress_history()?.pieces.into_iter();
            let inside = pieces.filter(|piece| meets(&[piece.start, piece.end], span));
            data.stress = straight(&inside.collect::<Vec<_>>(), STRESS_ERROR);
        }
        if self.pictures.contains(&Picture::Restitution) {
            let pair = |contact| {
                let found = history.restitution(contact)?;
                Ok([found.e_p.ok(), found.e_e2.ok()])
            };
            data.restitution = (0..data.all_contacts.min(MAX_CONTACTS)).map(pair).collect::<Result<_, Error>>()?;
        }
        if self.pictures.contains(&Picture::SpaceTime) && self.deformed {
            data.world_lines = world_lines(history, &extent, &rays)?;
        } else if self.pictures.contains(&Picture::SpaceTime) {
            let factor = data.units.factor::<f64>(self.field.measure(&data.units), &()).unwrap_or(1.0);
            data.field = Some(FieldMap::new(history, self.field, factor, &extent, rays)?);
        }
        Ok(data)
    }

    /// Returns the span that is drawn of a history: the one asked for, or a part that shows its first contacts.
    ///
    /// **Errors**: those of the history; [`Error::TimeOutside`] for a span that it does not reach.
    pub fn span(&self, history: &TypedHistory<f64>) -> Result<[f64; 2], Error> {
        let trip = Parameters::<f64>::of(history.problem(), &())?.round_trip();
        let end = settled_until(history);
        let events: Vec<_> = history.events().iter().map(|event| (event.t, event.kind)).collect();
        let first = events.first().map(|first| first.0).filter(|first| *first > TRIPS * trip && self.to.is_none());
        let from = self.from.or(first.map(|first| first - TRIPS_AFTER * trip)).unwrap_or(0.0);
        if from >= end {
            return Err(history.explained(Error::TimeOutside { found: from.to_string(), end: end.to_string() }));
        }
        let to = self.to.unwrap_or_else(|| {
            let last = from + (TRIPS + 2.0 * TRIPS_AFTER) * trip;
            match events.iter().rfind(|event| event.0 > from && event.0 <= last) {
                _ if end <= from + TRIPS * trip => end,
                // A long flight is cut; a rod that stays on the ground is shown until it is almost at rest.
                Some((last, EventKind::Release)) => last + TRIPS_AFTER * trip,
                _ => from + TRIPS * trip,
            }
        });
        Ok([from, to.min(end)])
    }

    fn gather_quantities(
        &self,
        history: &TypedHistory<f64>,
        extent: &Extent,
        rays: &[Ray],
    ) -> Result<Vec<(Quantity, Vec<Curve>)>, Error> {
        let mut quantities = vec![Quantity::Time, Quantity::Side];
        for quantity in self.pictures.iter().flat_map(Picture::quantities) {
            if !quantities.contains(&quantity) {
                quantities.push(quantity);
            }
        }
        if quantities.len() == 2 {
            return Ok(Vec::new());
        }
        let table = history.ask_columns(&quantities, None, |motion| times(motion, extent, rays))?;
        let table: Vec<Vec<f64>> = table.iter().map(|column| column.iter().map(settled).collect()).collect();
        let (times, sides) = (&table[0], &table[1]);
        // Times at which a value is not settled, as beside a ray in enclosures, are left out of all curves.
        let rows: Vec<usize> = (0..times.len()).filter(|k| table.iter().all(|column| column[*k].is_finite())).collect();
        let curves = |(quantity, values): (Quantity, &Vec<f64>)| {
            // A jump is between two rows of one time.
            let smallest = SMALLEST_JUMP * rows.iter().map(|k| values[*k].abs()).fold(0.0, f64::max);
            let jumps =
                |a: usize, b: usize| sides[a] < 0.0 && times[a] == times[b] && (values[a] - values[b]).abs() > smallest;
            let curves = rows.chunk_by(|a, b| !jumps(*a, *b));
            (quantity, curves.map(|rows| rows.iter().map(|k| DVec2::new(times[*k], values[*k])).collect()).collect())
        };
        Ok(quantities.into_iter().zip(&table).skip(2).map(curves).collect())
    }
}

/// Returns the end of the history, or the time from which its events are not settled.
fn settled_until(history: &TypedHistory<f64>) -> f64 {
    let unsettled = history.warnings().into_iter().filter_map(|warning| match warning {
        Warning::EventsOverlap { from } | Warning::NotDetermined { from } => Some(from),
        _ => None,
    });
    unsettled.fold(*history.end(), f64::min)
}

/// Returns every ray that is in the rod during the span, in the order in which they leave the ground.
fn rays(history: &TypedHistory<f64>, extent: &Extent) -> Result<Vec<Ray>, Error> {
    let ([from, to], trip, damping) = (extent.span, extent.trip(), extent.rod.damping);
    if history.problem().chain().is_some() {
        return rays_in_chain(history, extent);
    }
    if damping == 0.0 {
        let waves = history.waves()?;
        let greatest = waves.pieces.iter().map(|piece| piece.rate.abs()).fold(f64::MIN_POSITIVE, f64::max);
        let ray = |pair: &[WavePiece<f64>]| {
            let jump = (pair[1].rate - pair[0].at(&pair[1].from).1).abs();
            Ray { departure: pair[1].from, jump: jump > 1e-9 * greatest, share: jump / greatest, legs: [true; 2] }
        };
        let rays = waves.pieces.windows(2).map(ray);
        return Ok(rays.filter(|ray| ray.departure >= from - 1.001 * trip && ray.departure <= to).collect());
    }
    // A ray of a damped rod is reflected for ever, and fades.
    let faded = damping.recip() * -FADED.ln();
    let jumps = |motion: &dyn Motion<Double>| {
        let (end, scales) = (motion.end(), motion.scales());
        let mut rays = RayRegister::of(motion).passing(&end.zero(), from - trip, to);
        rays.retain(|ray| ray.age <= faded);
        // The jump is measured in the middle of the rod, a quarter of a round trip after the departure.
        let (middle, late) = (scales.length / end.int(2), scales.time / end.int(4));
        let few = rays.len() <= MAX_RAYS;
        let mut found = Vec::with_capacity(rays.len());
        for ray in rays {
            let time = ray.time.clone() + &late;
            let measured = ray.jump && few && time.to_f64() > 0.0 && time.to_f64() < end.to_f64();
            let strain = |side| motion.field(&middle, &time, side).map(|field| field.strain.to_f64());
            let jump = if measured { Some((strain(Side::Right)? - strain(Side::Left)?).abs()) } else { None };
            let ray = Ray { departure: ray.time.to_f64(), jump: ray.jump, share: 1.0, legs: [true; 2] };
            found.push((ray, jump));
        }
        Ok(found)
    };
    let rays = history.ask(jumps, |_| Vec::new())?;
    let greatest = rays.iter().filter_map(|ray| ray.1).fold(f64::MIN_POSITIVE, f64::max);
    // A ray whose jump is not measured is taken to carry as much as the one before it.
    let mut share = 1.0;
    let with_share = |(ray, jump): (Ray, Option<f64>)| {
        share = jump.map_or(share, |jump| jump / greatest);
        Ray { share, ..ray }
    };
    Ok(rays.into_iter().map(with_share).collect())
}

/// Returns the rays of a body of a chain, each of which is in the body once: upward or downward.
fn rays_in_chain(history: &TypedHistory<f64>, extent: &Extent) -> Result<Vec<Ray>, Error> {
    let ([from, to], trip) = (extent.span, extent.trip());
    let departures = history.ask(|motion| motion.departures(), |_| Vec::new())?;
    let jumps = departures.iter().flatten().map(|(_, jump)| jump.to_f64().abs());
    let greatest = jumps.fold(f64::MIN_POSITIVE, f64::max);
    let mut rays = Vec::new();
    for (leaving, legs) in departures.iter().zip([[true, false], [false, true]]) {
        for (time, jump) in leaving {
            // A ray from the top would have left the lower end half a round trip before.
            let departure = time.to_f64() - if legs[0] { 0.0 } else { 0.5 * trip };
            let share = jump.to_f64().abs() / greatest;
            rays.push(Ray { departure, jump: share > 1e-9, share, legs });
        }
    }
    rays.retain(|ray| ray.departure >= from - 1.001 * trip && ray.departure <= to);
    rays.sort_by(|a, b| a.departure.total_cmp(&b.departure));
    Ok(rays)
}

/// Returns the times at which curves have points: evenly spaced, at events, and where rays are at the ends of the rod.
fn times(motion: &dyn Motion<Double>, extent: &Extent, rays: &[Ray]) -> Result<Vec<Double>, Error> {
    let (end, [from, to]) = (motion.end(), extent.span);
    let count = if rays.len() > MAX_RAY_POINTS { DENSE_POINTS } else { POINTS };
    let even = (0..=count).map(|k| from + (to - from) * k as f64 / count as f64);
    // The engine's own numbers meet the rays, at which values from the left and from the right may differ.
    let mut exact: Vec<Double> = motion.events().iter().map(|event| event.t.clone()).collect();
    if rays.len() <= MAX_RAY_POINTS {
        let scales = motion.scales();
        match motion.waves() {
            Ok(waves) => {
                let half_trip = scales.time / end.int(2);
                exact.extend(waves.pieces.into_iter().flat_map(|piece| [piece.from.clone(), piece.from + &half_trip]));
            }
            Err(Error::NoWaves) if motion.departures().is_ok() => {
                let half_trip = scales.time / end.int(2);
                let times = motion.departures()?.into_iter().flatten().map(|(time, _)| time);
                exact.extend(times.flat_map(|time| [time.clone(), time + &half_trip]));
            }
            Err(Error::NoWaves) => {
                let register = RayRegister::of(motion);
                let passages = |point| register.passing(&point, from, to).into_iter().map(|ray| ray.time);
                exact.extend([scales.length.zero(), scales.length].into_iter().flat_map(passages));
            }
            Err(error) => return Err(error),
        }
    }
    let mut times: Vec<(f64, Double)> = exact.into_iter().map(|time| (time.to_f64(), time)).collect();
    times.extend(even.map(|time| (time, end.double(time))));
    times.retain(|(time, _)| *time >= from && *time <= to);
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The engine's own number is kept, which is the first of equal ones.
    times.dedup_by(|b, a| b.0 - a.0 <= 1e-12 * to.abs().max(extent.trip()));
    if let Some(last) = times.last_mut().filter(|(time, _)| *time >= end.to_f64()) {
        last.1 = end;
    }
    Ok(times.into_iter().map(|(_, time)| time).collect())
}

/// Returns points along the rod, each with its displacement over time.
fn world_lines(history: &TypedHistory<f64>, extent: &Extent, rays: &[Ray]) -> Result<Vec<(f64, Curve)>, Error> {
    let shares: Vec<f64> = (0..WORLD_LINES).map(|k| k as f64 / (WORLD_LINES - 1) as f64).collect();
    let found = history.ask(
        |motion| {
            let length = motion.scales().length;
            let mut rows = Vec::new();
            for time in times(motion, extent, rays)? {
                for share in &shares {
                    let point = length.double(*share) * &length;
                    rows.push((time.clone(), motion.field(&point, &time, Side::Right)?.displacement));
                }
            }
            Ok(rows)
        },
        |rows| rows.iter().map(|row| &row.1).collect(),
    )?;
    let point = |(t, v): &(Double, Double)| DVec2::new(t.to_f64(), v.to_f64());
    let curve = |k: usize| found.iter().skip(k).step_by(WORLD_LINES).map(point).collect();
    Ok(shares.iter().enumerate().map(|(k, share)| (share * extent.rod.length, curve(k))).collect())
}

/// Returns the axis of times that holds the spans of all scenes.
pub(crate) fn time_axis(scenes: &[SceneData]) -> Axis {
    let from = scenes.iter().map(|scene| scene.span[0]).fold(f64::INFINITY, f64::min);
    let to = scenes.iter().map(|scene| scene.span[1]).fold(0.0, f64::max);
    Axis::new("t", scenes.first().map_or("", |scene| scene.units.name(Measure::Time)), [from, to])
}
