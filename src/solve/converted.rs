//! A history in one number system, converted to another.

use std::cmp::Ordering;
use std::sync::Arc;

use super::asked::{Longer, Open, TimeResolver, Windows, not_told};
use super::forwarded::forwarded;
use super::ladder::{Engined, Ladder};
use super::rung::LONG;
use crate::error::Error;
use crate::lattice::Undamped;
use crate::motion::moments::{self, Moments};
use crate::motion::{Course, Field, Motion, Pair, RayRegister, Scales, Side, Stretch, by_time};
use crate::number::{Bounded, Estimate, Reads, Scalar, Spelling};
use crate::problem::Parameters;

/// The history of an engine in numbers `N`, converted to numbers `M`.
pub(super) struct Converted<N: Scalar, M> {
    engine: Arc<dyn Motion<N>>,
    precision: N::Precision,
    rays: RayRegister<N>,
    /// Rays that spelled times may coincide with; `None` for exact numbers and enclosures, which decide this.
    windows: Option<Windows<N>>,
    course: Course<M>,
    scales: Scales<M>,
}

/// Returns the spelling of a time in doubles; a longer number does not record the number that it was rounded from.
fn spelled<M: Scalar>(time: &M) -> Option<Spelling> {
    time.as_double().and_then(|_| time.spelled_as())
}

/// Returns whether numbers are rounded: neither exact nor enclosures.
fn rounds<M: Scalar>(precision: &M::Precision) -> bool {
    M::spelling(&1.into(), precision).spelled_as().is_some()
}

/// Returns whether a time is an enclosure wider than roundings.
fn is_wide<N: Scalar, M: Scalar>(time: &M, given: &N) -> bool {
    spelled(time).is_none() && given.log2_error() > roundings(time).log2()
}

/// Returns the distance within which a computed number counts as that of a ray, or as the length.
fn roundings<M: Scalar>(x: &M) -> f64 {
    8.0 * x.log2_roundoff().exp2() * x.to_f64()
}

impl<N: Scalar, M: Reads<N>> Converted<N, M> {
    pub(super) fn new(engine: Arc<dyn Motion<N>>) -> Self {
        let mut course = engine.course().clone().map(M::read);
        for event in &mut course.events {
            // The conversion has rounded the time once more.
            event.t_error = event.t_error.max(event.t.log2_error().exp2());
        }
        let precision = engine.end().precision();
        let windows = rounds::<N>(&precision).then(|| Windows::of(&*engine));
        let scales = engine.scales().map(M::read);
        Converted { precision, rays: RayRegister::of(&*engine), windows, course, scales, engine }
    }

    /// Replaces the scales of the rod by those of `rod` in numbers `M`.
    pub(super) fn of_rod(self, rod: &Parameters<M>) -> Self {
        let Parameters { length, wave_speed, gravity, .. } = rod.clone();
        let scales = Scales { time: rod.round_trip(), length, wave_speed, gravity, ..self.scales };
        Converted { scales, ..self }
    }

    /// Converts a time to this history. A time to which an event or the end was rounded becomes the time of that event.
    fn time(&self, time: &M) -> Result<N, Error> {
        self.finite(time)?;
        if let Some(known) = self.known(time) {
            return Ok(known);
        }
        let given = self.given(time);
        // The ground affects the whole rod, so its events may change the answer within a wide enclosure.
        let open = |windows: &Windows<N>| !windows.all(&given.zero(), &given).is_empty();
        match &self.windows {
            Some(windows) if is_wide(time, &given) && open(windows) => Err(not_told(given.bits())),
            _ => Ok(given),
        }
    }

    /// Converts a point or a time that is not one of the engine's own.
    fn given(&self, time: &M) -> N {
        let given = time.give(&self.precision);
        // Exact numbers and enclosures are queried around it instead.
        if spelled(time) != Some(Spelling::Near) || self.windows.is_none() {
            return given;
        }
        let roundings = given.double(2.0 * time.log2_roundoff().exp2() * time.to_f64());
        given.widened(&roundings)
    }

    /// Returns twice the rounding of `x`, the possible distance of a spelled point or time from `x`; `None` if `x` was
    /// not rounded, or if [`Converted::given`] is widened by the rounding.
    fn late(&self, x: &M) -> Option<N> {
        let rounded = match x.as_double() {
            Some(_) => x.spelled_as() == Some(Spelling::Near),
            None => x.spelled_as().is_some(),
        };
        let late = || (x.magnitude() * x.roundoff() * x.int(2)).give(&self.precision);
        (rounded && self.windows.is_none()).then(late)
    }

    /// Returns [`Converted::late`] of a time that is not one of the engine's own.
    fn late_time(&self, time: &M) -> Option<N> {
        self.late(time).filter(|_| self.known(time).is_none())
    }

    /// Returns [`Converted::late`] of a time for a query at a point; `None` if a long number counts as the time of a
    /// ray at the point, which is known.
    fn late_at(&self, point: &N, time: &M, given: &N) -> Option<N> {
        let late = self.late_time(time)?;
        let ray = time.as_double().is_none() && {
            let own = time.give(&self.precision);
            own.compare(given) != Ok(Ordering::Equal) || !self.rays.near(point, given).is_empty()
        };
        (!ray).then_some(late)
    }

    /// Returns the numbers of `ask` at `time`, widened by their change if the time is off by up to `late`.
    ///
    /// **Source**: between events and rays all numbers are polynomials in t of degree at most four. Such a polynomial
    /// is `f(t) + Σ ℓₖ(s) (f(t + sₖ late) − f(t))` for `sₖ` = −1, −½, ½, 1, with `|ℓₖ| < 2` on all of −1 … 1. If a
    /// number jumps within `late`, the values on both sides are among these.
    fn around<X: Scalar>(
        &self,
        time: &N,
        late: Option<N>,
        read: fn(X) -> M,
        ask: &dyn Fn(&N) -> Result<Vec<X>, Error>,
    ) -> Result<Vec<M>, Error> {
        let nodes = late.into_iter().flat_map(|late| [-2, -1, 1, 2].map(|s| time.clone() + late.ratio(s, 2) * &late));
        covering(ask(time)?, read, nodes.map(|time| ask(&time)))
    }

    /// Rejects NaN and infinities, which have no counterpart in the other system.
    fn finite(&self, time: &M) -> Result<(), Error> {
        let outside = || Error::TimeOutside { found: time.text(), end: self.engine.end().text() };
        if time.is_finite() { Ok(()) } else { Err(outside()) }
    }

    /// Returns the time of an event, or the end, that `time` was rounded from.
    fn known(&self, time: &M) -> Option<N> {
        let end = self.engine.end();
        // A spelled number represents itself, except for the end, at which a run to that time stops.
        if spelled(time).is_some() {
            return M::read(end.clone()).alike(time).then_some(end);
        }
        // Events are in order: those that doubles tell from the time are not compared.
        let (events, at) = (self.engine.events(), time.to_f64());
        let apart = at.abs() * (1e-12 + 4.0 * (end.log2_roundoff().exp2() + time.log2_roundoff().exp2()));
        let from = events.partition_point(|event| event.t.to_f64() < at - apart);
        let near = events[from..].iter().take_while(|event| event.t.to_f64() <= at + apart);
        let mut known = near.map(|event| &event.t).chain([&end]);
        // Both numbers are rounded, each to its own bits.
        let same = |known: &&N| {
            let known = M::read((*known).clone());
            let rounding = time.magnitude() * (known.roundoff() + time.roundoff());
            rounding.below(&(known - time).magnitude()) == Ok(false)
        };
        let exactly = |known: &&N| M::read((*known).clone()).alike(time);
        known.clone().find(exactly).or_else(|| known.find(same)).cloned()
    }

    /// Converts a point of this rod. A point to which the length was rounded becomes the top.
    fn point(&self, point: &M) -> Result<N, Error> {
        let length = self.engine.scales().length;
        if !point.is_finite() {
            return Err(Error::PointOutside { found: point.text(), length: length.text() });
        }
        // The length in other bits, or an enclosure of it, also counts as the length.
        let rounded = point.log2_error() <= roundings(point).log2()
            && (self.scales.length.clone() - point).vanishes() != Ok(false);
        if rounded || self.scales.length.alike(point) {
            return Ok(length);
        }
        // Other points are widened like times.
        Ok(self.given(point))
    }

    /// Returns [`Converted::late`] of a point; `None` for the top, which is exact.
    fn late_point(&self, point: &M, given: &N) -> Option<N> {
        if self.engine.scales().length.alike(given) { None } else { self.late(point) }
    }

    /// Returns the time for a query at `point`: the time of a ray there if only roundings of `M` separate a computed
    /// time from it. With more digits than a double, the point is only `near` the spelled one.
    ///
    /// **Errors**: the time is indistinguishable from another event or ray.
    fn time_at(&self, point: &N, near: bool, time: &M) -> Result<N, Error> {
        self.finite(time)?;
        if let Some(known) = self.known(time) {
            return Ok(known);
        }
        let mut given = self.given(time);
        // No ray precedes the start.
        if given.vanishes() == Ok(true) && given.log2_error() == f64::NEG_INFINITY {
            return Ok(given);
        }
        // A wide enclosure does not count as the time of a ray.
        let wide = is_wide(time, &given);
        if spelled(time).is_none() && !wide {
            let met = self.rays.meant(point, given.clone(), roundings(time));
            if met.compare(&given).is_ok_and(Ordering::is_ne) {
                return Ok(met);
            }
            given = met;
        }
        let Some(windows) = &self.windows else { return Ok(given) };
        let near = match spelled(time) {
            // A number with more digits than a double is known only within its rounding.
            Some(Spelling::Near) => windows.all(point, &given),
            Some(_) if near => windows.all(point, &given),
            None if wide => windows.all(point, &given),
            _ => windows.displaced(point, &given),
        };
        if near.is_empty() { Ok(given) } else { Err(not_told(given.bits())) }
    }

    fn time_at_ground(&self, time: &M) -> Result<N, Error> {
        self.time_at(&self.engine.end().zero(), false, time)
    }

    /// Returns the numbers of `ask` for the ground at a time, or at that of an event or ray within roundings of it.
    fn at_ground<const K: usize>(&self, time: &M, ask: impl Fn(&N) -> Result<[N; K], Error>) -> Result<[M; K], Error> {
        let (ground, given) = (self.engine.end().zero(), self.time_at_ground(time)?);
        let late = self.late_at(&ground, time, &given);
        self.around(&given, late, M::read, &|time| ask(time).map(Vec::from)).map(array)
    }
}

/// Widens each number of `found` by twice the sum of the distances of the same number in `others`. Members of `others`
/// outside the run or the rod are skipped.
fn covering<X: Scalar, M: Scalar>(
    found: Vec<X>,
    read: fn(X) -> M,
    others: impl Iterator<Item = Result<Vec<X>, Error>>,
) -> Result<Vec<M>, Error> {
    let mut off: Option<Vec<X>> = None;
    for other in others {
        let other = match other {
            Err(Error::TimeOutside { .. } | Error::PointOutside { .. }) => continue,
            other => other?,
        };
        let sums = off.get_or_insert_with(|| found.iter().map(Scalar::zero).collect());
        for ((sum, other), found) in sums.iter_mut().zip(other).zip(&found) {
            *sum = sum.clone() + (other - found).magnitude();
        }
    }
    let Some(off) = off else { return Ok(found.into_iter().map(read).collect()) };
    let widened = |(found, off): (X, X)| {
        let off = read(off);
        read(found).widened(&(off.clone() + off))
    };
    Ok(found.into_iter().zip(off).map(widened).collect())
}

/// Converts a list of exactly `K` numbers to an array.
fn array<S, const K: usize>(list: Vec<S>) -> [S; K] {
    list.try_into().unwrap_or_else(|_| unreachable!("as many numbers as were put in"))
}

impl<N: Scalar, M: Reads<N>> Motion<M> for Converted<N, M> {
    forwarded!(M, M::read);

    fn course(&self) -> &Course<M> {
        &self.course
    }

    fn strain(&self, time: &M, side: Side) -> Result<M, Error> {
        self.at_ground(time, |time| Ok([self.engine.strain(time, side)?])).map(|[strain]| strain)
    }

    fn pair(&self, pair: Pair, time: &M, side: Side) -> Result<[M; 2], Error> {
        let ask = |time: &N| self.engine.pair(pair, time, side);
        if pair == Pair::GroundEnd {
            return self.at_ground(time, ask);
        }
        let (given, late) = (self.time(time)?, self.late_time(time));
        self.around(&given, late, M::read, &|time| ask(time).map(Vec::from)).map(array)
    }

    /// Computes the field, widened over the rectangle of possible points and times. There v is a quadratic function,
    /// which the values at the corners, the midpoints of the sides and the centre interpolate with coefficients of at
    /// most 1.
    fn field(&self, point: &M, time: &M, side: Side) -> Result<Field<M>, Error> {
        let mut given = self.point(point)?;
        let near = point.spelled_as() == Some(Spelling::Near);
        let at = self.time_at(&given, near, time)?;
        // The engine knows the time of its own event or end, while the point was rounded: it is moved onto the ray that
        // passes it. The page, which has no long numbers, has no room for this.
        let is_end = |point: &N| point.vanishes() == Ok(true) || self.engine.scales().length.alike(point);
        let is_rounded = LONG && rounds::<M>(&point.precision()) && spelled(time).is_none();
        if is_rounded && self.known(time).is_some() && !is_end(&given) {
            given = self.rays.reached(given, &at, roundings(time));
        }
        let ask = |point: &N, time: &N| {
            let Field { displacement, velocity, strain } = self.engine.field(point, time, side)?;
            Ok(vec![displacement, velocity, strain])
        };
        let late = self.late_at(&given, time, &at);
        // The point and the time of a ray count as exact together.
        let on_ray = late.is_none() && time.as_double().is_none();
        let aside = if on_ray { None } else { self.late_point(point, &given) };
        let around = |x: &N, late: &Option<N>| match late {
            Some(late) => vec![x.clone(), x.clone() - late, x.clone() + late],
            None => vec![x.clone()],
        };
        let times = around(&at, &late);
        let nodes = around(&given, &aside).into_iter().flat_map(|x| times.iter().map(move |t| (x.clone(), t))).skip(1);
        let found = covering(ask(&given, &at)?, M::read, nodes.map(|(x, t)| ask(&x, t)))?;
        let [displacement, velocity, strain] = array(found);
        Ok(Field { displacement, velocity, strain })
    }

    fn in_contact(&self, time: &M, side: Side) -> Result<M, Error> {
        self.at_ground(time, |time| Ok([self.engine.in_contact(time, side)?])).map(|[contact]| contact)
    }

    /// Computes all rates in one march, with times that are not matched to events or rays at each point.
    fn rates(&self, places: &[(M, M)]) -> Result<Vec<[M; 2]>, Error> {
        let times = by_time(places, |time| self.time(time))?;
        let place = |((point, _), time): (&(M, M), N)| Ok((self.point(point)?, time));
        let places = places.iter().zip(times).map(place).collect::<Result<Vec<_>, Error>>()?;
        Ok(self.engine.rates(&places)?.into_iter().map(|pair| pair.map(M::read)).collect())
    }

    fn may_jump(&self, time: &M) -> Result<bool, Error> {
        let [ground, top] = [self.time_at_ground(time)?, self.time_at(&self.engine.scales().length, false, time)?];
        // If an enclosure leaves this undecided, both sides are queried.
        Ok([ground, top].iter().any(|time| self.engine.may_jump(time).unwrap_or(true)))
    }

    fn stretches(&self, time: &M) -> Result<Vec<Stretch<M>>, Error> {
        Ok(self.engine.stretches(&self.time(time)?)?.into_iter().map(|stretch| stretch.map(M::read)).collect())
    }

    fn moments(&self, time: &M, points: &[M]) -> Result<Vec<Moments<M>>, Error> {
        let (given, late) = (self.time(time)?, self.late_time(time));
        if late.is_none() {
            match self.engine.stretches(&given) {
                Err(Error::NoWaves) => {}
                stretches => {
                    let stretches = stretches?.into_iter().map(|stretch| stretch.map(M::read)).collect::<Vec<_>>();
                    return moments::of_stretches(&stretches, points);
                }
            }
        }
        let points = points.iter().map(|point| self.point(point)).collect::<Result<Vec<_>, _>>()?;
        let ask = |time: &N| {
            let cells = self.engine.moments(time, &points)?;
            Ok(cells.into_iter().flatten().flatten().collect())
        };
        let mut numbers = self.around(&given, late, M::read, &ask)?.into_iter();
        let mut cell = || {
            let [a, b, c, d, e, f] = array(numbers.by_ref().take(6).collect());
            [[a, b], [c, d], [e, f]]
        };
        Ok((1..points.len()).map(|_| cell()).collect())
    }

    fn scales(&self) -> Scales<M> {
        self.scales.clone()
    }
}

/// Returns the history in doubles, which answers faster than exact numbers, if all its coincidences are exact: then its
/// answers are within their bounds. Otherwise returns the exact history.
pub(super) fn confirmed<N: Bounded>(
    ladder: Ladder<'_>,
    exact: Undamped<N>,
    longer: Longer<f64>,
) -> Result<Engined<f64>, Error>
where
    Estimate<f64>: Reads<N>,
{
    let mut doubles = ladder.lattice::<Estimate<f64>>(&())?;
    Ok(if doubles.confirm(&exact) {
        TimeResolver::of(Arc::new(doubles), ladder.problem, Open::Ask(longer))
    } else {
        Arc::new(Converted::new(Arc::new(exact)))
    })
}

#[cfg(all(test, feature = "mp"))]
#[path = "tests/converted.rs"]
#[allow(clippy::unwrap_used)]
mod tests;
