//! What pictures of a scene are drawn from: answers of its history in doubles, over the span that is drawn.

use super::cells::{self, Break, Cells, MOST_RAYS, Strip, settled};
use super::picture::{Along, Picture};
use crate::draw::Axis;
use dalembert::Error;
use dalembert::engine::{Motion, RayRegister};
use dalembert::engine::{WavePiece, straight};
use dalembert::number::Scalar;
use dalembert::problem::{Parameters, Problem};
use dalembert::quantity::{Quantity, Units};
use dalembert::reason::Warning;
use dalembert::solve::{Target, TypedHistory};
use dalembert::{EventKind, Side, StressPiece};

#[derive(Clone, Debug)]
pub struct Asked {
    pub pictures: Vec<Picture>,
    pub along: Along,
    /// World lines of points in place of the field.
    pub deformed: bool,
    /// The span; by default what shows the first contacts.
    pub from: Option<f64>,
    pub to: Option<f64>,
}

/// Times and values.
pub type Line = Vec<(f64, f64)>;

#[derive(Clone, Debug)]
pub struct Gathered {
    pub name: String,
    pub units: Units,
    pub rod: Parameters<f64>,
    pub span: [f64; 2],
    /// Where the history ends, or what is known of it.
    pub end: f64,
    /// Those that the span meets.
    pub contacts: Vec<[f64; 2]>,
    /// How many the history has.
    pub of_contacts: usize,
    /// The columns asked for: times and values, in stretches without a jump.
    pub columns: Vec<(Quantity, Vec<Line>)>,
    /// `v_x(0,·)` in straight pieces.
    pub stress: Vec<StressPiece<f64>>,
    /// `e_P` and `e_E²` of each contact, where they are defined.
    pub restitution: Vec<[Option<f64>; 2]>,
    pub cells: Option<Cells>,
    /// The world lines of points along the rod: `v(x,t)` of each.
    pub world: Vec<(f64, Line)>,
}

/// Round trips that are drawn where nothing is said: as many as can be told apart.
const TRIPS: f64 = 12.0;
/// After the last event that is drawn.
const TRIPS_AFTER: f64 = 1.0;
/// Points of a line, besides those at rays.
const POINTS: usize = 400;
/// Where rays are more than this, a line is drawn through [`DENSE`] points.
const MOST_BREAKS: usize = 4000;
const DENSE: usize = 8000;
/// A jump below this share of the greatest value is thinner than any line.
pub(super) const UNSEEN: f64 = 1e-6;
/// How far a straight piece of the stress may be off, as a share of the greatest.
const STRAIGHT: f64 = 1e-3;
const MOST_CONTACTS: usize = 400;
/// Points of the rod whose world lines are drawn.
const WORLD: usize = 5;

impl Gathered {
    /// A column that was asked for, in stretches without a jump.
    pub(super) fn lines(&self, column: Quantity) -> Vec<Line> {
        self.columns.iter().find(|found| found.0 == column).map_or_else(Vec::new, |found| found.1.clone())
    }

    /// What of the history is drawn, where that is less than all and no span was asked for.
    pub fn cut(&self, asked: &Asked, axis: &Axis) -> Option<String> {
        let ([from, to], (shown, all)) = (self.span, (self.contacts.len(), self.of_contacts));
        (asked.over_time() && asked.from.is_none() && asked.to.is_none() && to != self.end).then(|| {
            let [from, to, end] = [from, to, self.end].map(|time| axis.told(time));
            format!("from t = {from} to {to} of {end}, {shown} of {all} contacts")
        })
    }

    pub fn coarse(&self) -> Option<f64> {
        self.cells.as_ref()?.coarse()
    }
}

impl Asked {
    fn wants(&self, picture: Picture) -> bool {
        self.pictures.contains(&picture)
    }

    /// Whether any of the pictures shows the span; restitution is that of all contacts.
    pub fn over_time(&self) -> bool {
        self.pictures.iter().any(|picture| *picture != Picture::Restitution)
    }

    /// Asks a history for all that the pictures show.
    ///
    /// **Errors**: those of the history; [`Error::TimeOutside`] for a span that it does not reach.
    pub fn gather<S: Target>(
        &self,
        name: String,
        problem: &Problem,
        units: Units,
        history: &TypedHistory<S>,
    ) -> Result<Gathered, Error> {
        let rod = Parameters::<f64>::of(problem, &())?;
        let end = known_until(history);
        let span = self.span(history, rod.round_trip())?;
        let contacts = history.contacts().iter();
        let contacts = contacts
            .map(|contact| [contact.impact.to_f64(), contact.release.as_ref().map_or(end, Scalar::to_f64)])
            .filter(|[from, to]| *to >= span[0] && *from <= span[1]);
        let strip = Strip { trip: rod.round_trip(), rod, span };
        let breaks = breaks(history, &strip)?;
        let columns = self.gather_columns(history, &strip, &breaks)?;
        let (mut stress, mut restitution, mut cells, mut world) = (Vec::new(), Vec::new(), None, Vec::new());
        if self.wants(Picture::Stress) {
            let pieces = history.stress_history()?.pieces.into_iter().map(|piece| piece.map(|x| x.to_f64()));
            let inside = pieces.filter(|piece| piece.end >= span[0] && piece.start <= span[1]);
            stress = straight(&inside.collect::<Vec<_>>(), STRAIGHT);
        }
        if self.wants(Picture::Restitution) {
            for contact in 0..history.contacts().len().min(MOST_CONTACTS) {
                let found = history.restitution(contact)?;
                let value = |x: &Result<S, _>| x.as_ref().ok().map(Scalar::to_f64);
                restitution.push([value(&found.e_p), value(&found.e_e2)]);
            }
        }
        if self.wants(Picture::Along) && self.deformed {
            world = world_lines(history, &strip, &breaks)?;
        } else if self.wants(Picture::Along) {
            let factor = units.factor::<f64>(self.along.told(&units).0, &()).unwrap_or(1.0);
            cells = Some(cells::of(history, (self.along, factor), &strip, breaks)?);
        }
        let (contacts, of_contacts) = (contacts.collect(), history.contacts().len());
        let Strip { rod, span, .. } = strip;
        Ok(Gathered { name, units, rod, span, end, contacts, of_contacts, columns, stress, restitution, cells, world })
    }

    /// The span to be drawn: what is asked for, or so much of the history as shows its first contacts.
    pub(super) fn span<S: Target>(&self, history: &TypedHistory<S>, trip: f64) -> Result<[f64; 2], Error> {
        let end = known_until(history);
        let events: Vec<_> = history.events().iter().map(|event| (event.t.to_f64(), event.kind)).collect();
        let first = events.first().map(|first| first.0).filter(|first| *first > TRIPS * trip && self.to.is_none());
        let from = self.from.or(first.map(|first| first - TRIPS_AFTER * trip)).unwrap_or(0.0);
        if from >= end {
            return Err(history.explained(Error::TimeOutside { found: from.to_string(), end: end.to_string() }));
        }
        let to = self.to.unwrap_or_else(|| {
            let last = from + (TRIPS + 2.0 * TRIPS_AFTER) * trip;
            match events.iter().rfind(|event| event.0 > from && event.0 <= last) {
                _ if end <= from + TRIPS * trip => end,
                // A long flight is cut; a rod that stays on the ground is seen to come to rest.
                Some((last, EventKind::Release)) => last + TRIPS_AFTER * trip,
                _ => from + TRIPS * trip,
            }
        });
        Ok([from, to.min(end)])
    }

    fn gather_columns<S: Target>(
        &self,
        history: &TypedHistory<S>,
        strip: &Strip,
        breaks: &[Break],
    ) -> Result<Vec<(Quantity, Vec<Line>)>, Error> {
        let mut columns = vec![Quantity::Time, Quantity::Side];
        for column in self.pictures.iter().flat_map(Picture::columns) {
            if !columns.contains(&column) {
                columns.push(column);
            }
        }
        if columns.len() == 2 {
            return Ok(Vec::new());
        }
        let table = history.ask_columns(&columns, None, |motion| times(motion, strip, breaks))?;
        let table: Vec<Vec<f64>> = table.iter().map(|column| column.iter().map(settled).collect()).collect();
        let (times, sides) = (&table[0], &table[1]);
        // A time at which a value is open, as beside a ray in enclosures, is left out of all lines.
        let rows: Vec<usize> = (0..times.len()).filter(|k| table.iter().all(|column| column[*k].is_finite())).collect();
        let of = |(column, values): (Quantity, &Vec<f64>)| {
            // A jump lies between two rows of one time; one that is not seen is none.
            let seen = UNSEEN * rows.iter().map(|k| values[*k].abs()).fold(0.0, f64::max);
            let jumps =
                |a: usize, b: usize| sides[a] < 0.0 && times[a] == times[b] && (values[a] - values[b]).abs() > seen;
            let stretches = rows.chunk_by(|a, b| !jumps(*a, *b));
            let lines = stretches.map(|rows| rows.iter().map(|k| (times[*k], values[*k])).collect());
            (column, lines.collect())
        };
        Ok(columns.into_iter().zip(&table).skip(2).map(of).collect())
    }
}

/// Up to where values are settled: the end, or where the events are no longer told apart.
fn known_until<S: Target>(history: &TypedHistory<S>) -> f64 {
    let open = history.warnings().into_iter().filter_map(|warning| match warning {
        Warning::EventsOverlap { from } | Warning::NotDetermined { from } => Some(from),
        _ => None,
    });
    open.fold(history.end().to_f64(), f64::min)
}

/// The rays of a history, by the time at which each leaves the ground: every ray that is in the rod during the span.
fn breaks<S: Target>(history: &TypedHistory<S>, strip: &Strip) -> Result<Vec<Break>, Error> {
    let Strip { span: [from, to], trip, .. } = *strip;
    let inside = |time: &f64| *time >= from - 1.001 * trip && *time <= to;
    let mut breaks: Vec<Break> = Vec::new();
    if strip.rod.damping == 0.0 {
        let waves = history.waves()?.map(|x| x.to_f64());
        let greatest = waves.pieces.iter().map(|piece| piece.rate.abs()).fold(f64::MIN_POSITIVE, f64::max);
        let of = |pair: &[WavePiece<f64>]| {
            let jump = (pair[1].rate - pair[0].at(&pair[1].from).1).abs();
            Break { time: pair[1].from, jump: jump > 1e-9 * greatest, share: jump / greatest }
        };
        return Ok(waves.pieces.windows(2).filter(|pair| inside(&pair[1].from)).map(of).collect());
    }
    // A ray of a damped rod comes back for ever, and fades.
    let faded = strip.rod.damping.recip() * -FADED.ln();
    let jumps = |motion: &dyn Motion<S::Carried>| {
        let (end, scales) = (motion.end(), motion.scales());
        let mut rays = RayRegister::of(motion).passing(&end.zero(), from - trip, to);
        rays.retain(|ray| ray.age <= faded);
        // Across a ray in the middle of the rod, a quarter of a round trip after it has left the ground.
        let (middle, late) = (scales.length / end.int(2), scales.time / end.int(4));
        let few = rays.len() <= MOST_RAYS;
        let mut found = Vec::with_capacity(rays.len());
        for ray in rays {
            let time = ray.time.clone() + &late;
            let mut jump = None;
            if ray.jump && few && time.to_f64() > 0.0 && time.to_f64() < end.to_f64() {
                let [left, right] = [Side::Left, Side::Right].map(|side| motion.field(&middle, &time, side));
                jump = Some((right?.strain.to_f64() - left?.strain.to_f64()).abs());
            }
            found.push((ray, jump));
        }
        Ok(found)
    };
    let rays = history.ask(jumps, |_| Vec::new())?;
    let greatest = rays.iter().filter_map(|ray| ray.1).fold(f64::MIN_POSITIVE, f64::max);
    // One that the end cuts carries about what the one before it did.
    let mut before = 1.0;
    for (ray, jump) in &rays {
        before = jump.map_or(before, |jump| jump / greatest);
        breaks.push(Break { time: ray.time.to_f64(), jump: ray.jump, share: before });
    }
    Ok(breaks)
}

/// What is left of a ray that is drawn no more.
const FADED: f64 = 1e-3;

/// Times at which lines are drawn: evenly spaced, at events, and where rays are at the ends.
fn times<S: Scalar>(motion: &dyn Motion<S>, strip: &Strip, breaks: &[Break]) -> Result<Vec<S>, Error> {
    let (end, [from, to], trip) = (motion.end(), strip.span, strip.trip);
    let count = if breaks.len() > MOST_BREAKS { DENSE } else { POINTS };
    let even = (0..=count).map(|k| from + (to - from) * k as f64 / count as f64);
    // The numbers of the engine itself where two limits may differ: they meet the rays.
    let mut times: Vec<(f64, S)> = motion.events().iter().map(|event| (event.t.to_f64(), event.t.clone())).collect();
    if breaks.len() <= MOST_BREAKS {
        match motion.waves() {
            Ok(waves) => {
                let late = motion.scales().time / end.int(2);
                for piece in waves.pieces {
                    let top = piece.from.clone() + &late;
                    times.extend([piece.from, top].map(|time| (time.to_f64(), time)));
                }
            }
            Err(Error::NoWaves) => {
                let (rays, scales) = (RayRegister::of(motion), motion.scales());
                for point in [scales.length.zero(), scales.length] {
                    let passing = rays.passing(&point, from, to).into_iter();
                    times.extend(passing.map(|ray| (ray.time.to_f64(), ray.time)));
                }
            }
            Err(error) => return Err(error),
        }
    }
    times.extend(even.map(|time| (time, end.double(time))));
    times.retain(|(time, _)| *time >= from && *time <= to);
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Of neighbours within rounding the one from the engine, which comes first where they are equal.
    times.dedup_by(|b, a| b.0 - a.0 <= 1e-12 * to.abs().max(trip));
    if let Some(last) = times.last_mut().filter(|(time, _)| *time >= end.to_f64()) {
        last.1 = end;
    }
    Ok(times.into_iter().map(|(_, time)| time).collect())
}

/// `v(x,t)` of points along the rod.
fn world_lines<S: Target>(
    history: &TypedHistory<S>,
    strip: &Strip,
    breaks: &[Break],
) -> Result<Vec<(f64, Line)>, Error> {
    let inner: Vec<f64> = (0..WORLD).map(|k| k as f64 / (WORLD - 1) as f64).collect();
    let found = history.ask(
        |motion| {
            let length = motion.scales().length;
            let mut rows = Vec::new();
            for time in times(motion, strip, breaks)? {
                for share in &inner {
                    let point = length.double(*share) * &length;
                    rows.push((time.clone(), motion.field(&point, &time, Side::Right)?.displacement));
                }
            }
            Ok(rows)
        },
        |rows| rows.iter().map(|row| &row.1).collect(),
    )?;
    let line = |k: usize| found.iter().skip(k).step_by(WORLD).map(|(t, v)| (t.to_f64(), v.to_f64())).collect();
    Ok(inner.iter().enumerate().map(|(k, share)| (share * strip.rod.length, line(k))).collect())
}
