//! A history whose answers carry their bounds.

use super::budget::AtEvent;
use crate::error::Error;
use crate::motion::moments::{self, Moments, Node, Sums};
use crate::motion::{Contact, Course, Energy, Event, EventKind, Field, Motion, Scales, Side, StressPiece, Uncertainty};
use crate::number::{Estimate, Rounded, Scalar};

/// A history, each of whose numbers has the bound that follows from [`Motion::uncertainty`] and its natural scale;
/// times of events have their own.
///
/// **Accuracy**: *within its own bound*, away from rays that are themselves off in time. A time that is asked about is
/// taken as it is stored; one within rounding of an event stands for the event, whenever that is.
#[derive(Debug)]
pub struct WithBounds<S, H> {
    history: H,
    scales: Scales<f64>,
    course: Course<Estimate<S>>,
}

/// Two numbers with their bounds.
pub(super) type Pair<S> = Result<(Estimate<S>, Estimate<S>), Error>;

/// The nodes of a quadrature along the rod, from the ground to the first of some points and from each to the next.
#[derive(Debug)]
pub struct Lines<S> {
    pub(super) nodes: Vec<Vec<Node<S>>>,
    /// How many rays cut each of them.
    pub(super) rays: Vec<usize>,
    /// What they leave, relative to the greatest integrand and the length.
    pub(super) left_out: f64,
}

/// A history, parts of which carry their own bounds.
pub trait Bounding<S: Rounded>: Motion<S> {
    /// The nodes at a time for integrals over the cells between `points`, where [`Motion::uncertainty`] bounds them.
    fn lines(&self, time: &S, points: &[S]) -> Result<Lines<S>, Error>;

    /// What answers with bounds of its own at this limit of this time; `None` where [`Motion::uncertainty`] bounds it.
    fn bounded(&self, _time: &S, _side: Side) -> Option<&dyn Motion<Estimate<S>>> {
        None
    }

    /// What values may be off by at an event, whenever it is, where that is followed.
    fn at_event(&self, _event: usize) -> Option<AtEvent> {
        None
    }

    /// `h` and `h′` with their bounds, where they are known better than the rest.
    fn bounded_centre(&self, time: &S) -> Option<Pair<S>> {
        self.bounded(time, Side::Left).map(|form| form.centre(&rounded(time)))
    }
}

/// `value` as it is stored.
fn rounded<S: Rounded>(value: &S) -> Estimate<S> {
    Estimate::rounded(value.clone(), 1.0)
}

/// `value` within `bound`.
fn within<S: Rounded>(value: &S, bound: f64) -> Estimate<S> {
    Estimate::new(value.clone(), bound / value.unit() + value.to_f64().abs())
}

/// `value` with so much more in its bound.
fn wider<S: Rounded>(value: Estimate<S>, bound: f64) -> Estimate<S> {
    Estimate::new(value.value().clone(), value.error() + bound / value.value().unit())
}

/// Bounds near a time, in the units of the problem.
struct Near {
    /// Of displacements, as far as the events are in time.
    rise: f64,
    /// Of `h` likewise.
    centre: f64,
    /// Of velocities.
    speed: f64,
    /// Of that of the end.
    end: f64,
    strain: f64,
    /// Of `h′`.
    rate: f64,
    /// Of the times of events.
    late: f64,
}

impl Near {
    /// The less in all, and the greater lateness.
    fn min(self, other: &Near) -> Near {
        Near {
            rise: self.rise.min(other.rise),
            centre: self.centre.min(other.centre),
            speed: self.speed.min(other.speed),
            end: self.end.min(other.end),
            strain: self.strain.min(other.strain),
            rate: self.rate.min(other.rate),
            late: self.late.max(other.late),
        }
    }
}

impl<S: Rounded, H: Bounding<S>> WithBounds<S, H> {
    /// `history` with its bounds.
    ///
    /// **Errors**: those of a question at an event.
    pub fn new(history: H) -> Result<Self, Error> {
        let scales = history.scales().map(|scale| scale.to_f64());
        let course = Course::new(within(&history.end(), 0.0), history.ending().clone());
        let bounded = WithBounds { scales, course, history };
        let given = bounded.history.events();
        let event = |(k, event): (usize, &Event<S>)| {
            let form = bounded.history.bounded(&event.time, Side::Left);
            if let Some(own) = form.and_then(|form| form.events().get(k)) {
                return Ok(own.clone());
            }
            let Near { centre, end, rate, late, .. } = bounded.at_event(k);
            let (moves, push) = (event.centre_velocity.to_f64().abs(), bounded.push(&event.time, late)?);
            Ok(Event {
                kind: event.kind,
                time: within(&event.time, event.time_error),
                end_velocity: within(&event.end_velocity, end),
                centre: within(&event.centre, centre + late * (moves + push)),
                centre_velocity: within(&event.centre_velocity, rate + push),
                time_error: event.time_error,
            })
        };
        let events: Vec<_> = given.iter().enumerate().map(event).collect::<Result<_, Error>>()?;
        let time_of = |time: &S| {
            let known = events.iter().find(|event| event.time.value() == time);
            known.map_or_else(|| within(time, 0.0), |event| event.time.clone())
        };
        let contact = |(k, contact): (usize, &Contact<S>)| {
            let form = bounded.history.bounded(&contact.from, Side::Left);
            if let Some(own) = form.and_then(|form| form.contacts().get(k)) {
                // A peak that is only approached has no bound of its own that falls with more bits.
                let Near { strain, .. } = bounded.scaled(bounded.history.uncertainty(&contact.from));
                return Contact { peak_strain: within(&contact.peak_strain, strain), ..own.clone() };
            }
            let (from, to) = (time_of(&contact.from), contact.to.as_ref().map(&time_of));
            let found = bounded.history.uncertainty(&contact.from);
            let Scales { velocity, wave_speed, .. } = bounded.scales;
            // A peak lies next to a ray, or where the slope vanishes.
            let strain = bounded.scaled(found).strain + found.slope * found.rays * velocity / wave_speed;
            let push = bounded.impulse_off(&from, to.as_ref());
            Contact {
                impulse: within(&contact.impulse, push),
                peak_strain: within(&contact.peak_strain, strain),
                from,
                to,
            }
        };
        let contacts = bounded.history.contacts().iter().enumerate().map(contact).collect();
        let (ending, warnings) = (bounded.history.ending().clone(), bounded.history.warnings().to_vec());
        let course = Course { end: bounded.course.end.clone(), ending, events, contacts, warnings };
        Ok(WithBounds { course, ..bounded })
    }

    /// What an impulse may be off by: by the balance of momentum between two events that are followed, or by the
    /// stress, `−c² ∫ v_x dt`, where rays that are off within the contact move the end by their masses.
    fn impulse_off(&self, from: &Estimate<S>, to: Option<&Estimate<S>>) -> f64 {
        let Scales { velocity, wave_speed: c, length, gravity, .. } = self.scales;
        let event = |time: &Estimate<S>| self.history.events().iter().position(|event| event.time == *time.value());
        let momentum = |time: &Estimate<S>| Some(self.history.at_event(event(time)?)?.momentum * velocity);
        let by_momentum = to.and_then(|to| {
            let both = momentum(from)? + momentum(to)?;
            Some(length * (both + gravity * (from.bound() + to.bound())))
        });
        let last = to.map_or_else(|| self.history.end().to_f64(), Estimate::to_f64);
        let Near { rise, speed, .. } = self.scaled(self.history.uncertainty(from.value()));
        by_momentum.unwrap_or((last - from.to_f64()) * speed * c + 2.0 * rise * c)
    }

    /// The bounds near a time; at that of an event, which has the bound of the event, those of the event itself.
    fn near(&self, time: &Estimate<S>) -> Near {
        let event = self.course.events.iter().position(|event| event.time.value() == time.value());
        match event.filter(|_| time.bound() > 0.0) {
            Some(event) => self.at_event(event),
            None => self.scaled(self.history.uncertainty(time.value())),
        }
    }

    /// The bounds at an event: those of the contact that it begins or ends, whenever that is; but its time is rounded.
    /// Where they are those of equal times, the event itself is off.
    fn at_event(&self, event: usize) -> Near {
        let events = self.history.events();
        let contact = event - usize::from(event > 0 && events[event].kind == EventKind::Release);
        let found = self.history.uncertainty(&events[contact].time);
        let Event { time, time_error, .. } = &events[event];
        let rounding = 8.0 * time.unit() * time.to_f64();
        // Where the time may be off without bound, so may all else already.
        let equal_times = found.late == 0.0 && time_error.is_finite();
        let off = if equal_times { *time_error } else { 0.0 };
        let near = self.scaled(Uncertainty { late: (off + rounding) / self.scales.time, ..found });
        let Some(AtEvent { rise, centre, speed, end, rate, .. }) = self.history.at_event(event) else { return near };
        let found = Uncertainty { rise, speed, rate, late: rounding / self.scales.time, ..found };
        let unit = self.scales.velocity * self.scales.time;
        let own = self.scaled(found);
        let own = Near { centre: centre * unit, end: own.speed + (end - speed) * self.scales.velocity, ..own };
        if equal_times { near.min(&own) } else { own }
    }

    fn scaled(&self, found: Uncertainty) -> Near {
        let Uncertainty { rise, speed, rate, late, slope, .. } = found;
        let Scales { time, velocity, wave_speed, .. } = self.scales;
        let (rise, speed) = (rise * velocity * time, (speed + slope * late) * velocity);
        let (rate, strain) = ((rate + slope * late) * velocity, speed / wave_speed);
        Near { rise, centre: rise, speed, end: speed, strain, rate, late: late * time }
    }

    /// What the force of the ground makes of `h′` while events are `late`: `h″ = −c² v_x(0,t)/L`.
    fn push(&self, time: &S, late: f64) -> Result<f64, Error> {
        let Scales { length, wave_speed, .. } = &self.scales;
        // The last event may be a rounding beyond the end.
        let end = self.history.end();
        let time = if *time > end { &end } else { time };
        let strain = |side| self.history.strain(time, side).map(|strain| strain.to_f64().abs());
        let right = strain(Side::Right)?;
        // Before the start there is nothing.
        let most = strain(Side::Left).map_or(right, |left| left.max(right));
        Ok(late * wave_speed * wave_speed * most / length)
    }

    /// A displacement and its rate of change.
    fn moved(&self, time: &Estimate<S>, (place, rate): (S, S)) -> (Estimate<S>, Estimate<S>) {
        let near = self.near(time);
        (within(&place, near.rise + near.late * rate.to_f64().abs()), within(&rate, near.speed))
    }

    /// How far the root of a mean square may be off: what the ground gives to the centre of mass it takes from the
    /// vibration, or not, while contact is in doubt.
    fn root_off(&self, time: &Estimate<S>) -> Result<f64, Error> {
        let near = self.near(time);
        Ok(near.speed + self.push(time.value(), near.late)?)
    }

    /// `L s²/2` of a root mean square s that is `off` by so much: at most `L (2s + off) off`.
    fn square_off(&self, root: f64, off: f64) -> f64 {
        self.scales.length * (2.0 * root + off) * off
    }

    /// What an energy is off by where the root of the mean square is `off` between rays, and where rays are off in
    /// time: `¼ ∫ |δp| (2|p| + |δp|) + |δq| (2|q| + |δq|) dx ≤ M ∫ |δp| + |δq| dx`, as `|δq|` is at most twice the
    /// greatest `|q|`, M; and half of the integral is at most `rise`.
    fn energy_off(&self, energy: &S, off: f64, by_rays: f64) -> f64 {
        self.square_off((2.0 * energy.to_f64().max(0.0) / self.scales.length).sqrt(), off) + by_rays
    }

    /// The second part of [`Self::energy_off`].
    fn by_rays(&self, time: &Estimate<S>) -> f64 {
        let Uncertainty { peak, .. } = self.history.uncertainty(time.value());
        2.0 * peak * self.scales.velocity * self.scales.wave_speed * self.near(time).rise
    }

    /// The time that is asked about: that of the nearest event, where roundings alone set it apart.
    fn meant<'a>(&'a self, time: &'a Estimate<S>) -> &'a Estimate<S> {
        let next = self.course.events.partition_point(|event| event.time.value() < time.value());
        let near = self.course.events[next.saturating_sub(1)..].iter().take(2).map(|event| &event.time);
        let roundings = 4.0 * time.value().unit() * time.value().to_f64().abs();
        let apart = |event: &&Estimate<S>| (event.value().clone() - time.value()).to_f64().abs();
        let nearest = near.min_by(|a, b| apart(a).total_cmp(&apart(b)));
        nearest.filter(|event| apart(event) <= time.bound() + event.bound().min(roundings)).unwrap_or(time)
    }

    /// The history without its bounds.
    pub fn plain(&self) -> &H {
        &self.history
    }
}

impl<S: Rounded, H: Bounding<S>> Motion<Estimate<S>> for WithBounds<S, H> {
    fn course(&self) -> &Course<Estimate<S>> {
        &self.course
    }

    fn stress_pieces(&self) -> Vec<StressPiece<Estimate<S>>> {
        let own = |time: &S, side| {
            let strain = self.history.bounded(time, side)?.strain(&rounded(time), side).ok()?;
            Some(strain.bound())
        };
        let piece = |piece: StressPiece<S>| {
            let strain = self.scaled(self.history.uncertainty(&piece.from)).strain;
            // Between the rays those of a closed form hardly change.
            let ends = [own(&piece.from, Side::Right), own(&piece.to, Side::Left)];
            let strain = ends.into_iter().flatten().fold(strain, f64::max);
            // The bound is that of the whole; the first coefficient carries it.
            let coefficient = |(k, c)| within(c, if k == 0 { strain } else { 0.0 });
            StressPiece {
                from: within(&piece.from, 0.0),
                to: within(&piece.to, 0.0),
                left: within(&piece.left, strain),
                right: within(&piece.right, strain),
                chebyshev: piece.chebyshev.iter().enumerate().map(coefficient).collect(),
            }
        };
        self.history.stress_pieces().into_iter().map(piece).collect()
    }

    fn strain(&self, time: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        let time = self.meant(time);
        if let Some(form) = self.history.bounded(time.value(), side) {
            return form.strain(&rounded(time.value()), side);
        }
        Ok(within(&self.history.strain(time.value(), side)?, self.near(time).strain))
    }

    fn ground_end(&self, time: &Estimate<S>, side: Side) -> Result<(Estimate<S>, Estimate<S>), Error> {
        let time = self.meant(time);
        if let Some(form) = self.history.bounded(time.value(), side) {
            return form.ground_end(&rounded(time.value()), side);
        }
        Ok(self.moved(time, self.history.ground_end(time.value(), side)?))
    }

    fn top_end(&self, time: &Estimate<S>, side: Side) -> Result<(Estimate<S>, Estimate<S>), Error> {
        let time = self.meant(time);
        if let Some(form) = self.history.bounded(time.value(), side) {
            return form.top_end(&rounded(time.value()), side);
        }
        Ok(self.moved(time, self.history.top_end(time.value(), side)?))
    }

    fn centre(&self, time: &Estimate<S>) -> Result<(Estimate<S>, Estimate<S>), Error> {
        let time = self.meant(time);
        if let Some(centre) = self.history.bounded_centre(time.value()) {
            return centre;
        }
        let centre = self.history.centre(time.value())?;
        let near = self.near(time);
        let (moves, push) = (centre.1.to_f64().abs(), self.push(time.value(), near.late)?);
        Ok((within(&centre.0, near.centre + near.late * (moves + push)), within(&centre.1, near.rate + push)))
    }

    /// `L g h` is off by that of h.
    fn energy(&self, time: &Estimate<S>) -> Result<Energy<Estimate<S>>, Error> {
        let time = self.meant(time);
        if let Some(form) = self.history.bounded(time.value(), Side::Left) {
            return form.energy(&rounded(time.value()));
        }
        let energy = self.history.energy(time.value())?;
        let (height, rate) = self.centre(time)?;
        let Scales { length, gravity, .. } = &self.scales;
        let vibration = self.energy_off(&energy.vibrational, self.root_off(time)?, self.by_rays(time));
        let translational = self.square_off(rate.to_f64().abs(), rate.bound()) + length * gravity * height.bound();
        Ok(Energy {
            total: within(&energy.total, translational + vibration),
            translational: within(&energy.translational, translational),
            vibrational: within(&energy.vibrational, vibration),
        })
    }

    /// Of each mean square as in [`Motion::energy`].
    fn energy_parts(&self, time: &Estimate<S>) -> Result<[Estimate<S>; 2], Error> {
        let time = self.meant(time);
        if let Some(form) = self.history.bounded(time.value(), Side::Left) {
            return form.energy_parts(&rounded(time.value()));
        }
        let (off, by_rays) = (self.root_off(time)?, self.by_rays(time));
        Ok(self.history.energy_parts(time.value())?.map(|part| within(&part, self.energy_off(&part, off, by_rays))))
    }

    fn field(&self, point: &Estimate<S>, time: &Estimate<S>, side: Side) -> Result<Field<Estimate<S>>, Error> {
        let time = self.meant(time);
        if let Some(form) = self.history.bounded(time.value(), side) {
            return form.field(&rounded(point.value()), &rounded(time.value()), side);
        }
        let field = self.history.field(point.value(), time.value(), side)?;
        let strain = within(&field.strain, self.near(time).strain);
        let (displacement, velocity) = self.moved(time, (field.displacement, field.velocity));
        Ok(Field { displacement, velocity, strain })
    }

    /// **Accuracy**: as `docs/bounds.md` derives under "What a mean may be off by".
    fn moments(&self, time: &Estimate<S>, points: &[Estimate<S>]) -> Result<Vec<Moments<Estimate<S>>>, Error> {
        let time = self.meant(time);
        let placed = points.iter().fold(0.0, |most: f64, point| most.max(point.bound()));
        let points: Vec<S> = points.iter().map(|point| point.value().clone()).collect();
        if let Some(form) = self.history.bounded(time.value(), Side::Left) {
            return form.moments(&rounded(time.value()), &points.iter().map(rounded).collect::<Vec<_>>());
        }
        let Lines { nodes, rays, left_out } = self.history.lines(time.value(), &points)?;
        let (height, _) = self.history.ground_end(time.value(), Side::Left)?;
        let (_, rate) = self.history.centre(time.value())?;
        let Scales { time: trip, velocity, length, wave_speed: c, .. } = self.scales;
        let Near { rise, speed, late, .. } = self.near(time);
        let most = self.history.uncertainty(time.value()).most * velocity + rate.to_f64().abs();
        let between = speed + left_out * most;
        let rounding = 8.0 * time.value().unit() * (time.to_f64() + trip);
        let far = |rays: usize| rise + 2.0 * most * (late + placed / c + (rays + 1) as f64 * rounding);
        let high = far(rays.iter().sum()) + length * left_out * most / c;

        let known = |x: &S| Estimate::exact(x.clone());
        let starts = std::iter::once(height.zero()).chain(points.iter().cloned()).map(Estimate::exact);
        let sums = nodes.iter().zip(starts).map(|(nodes, from)| Sums::of(&from, nodes.iter().map(|n| n.map(known))));
        let ends: Vec<_> = points.iter().map(known).collect();
        let cells = moments::of_sums(sums.collect(), &ends, Estimate::exact(height)).into_iter();
        let cells = cells.zip(points.windows(2)).zip(&rays[1..]).map(|(([v, v_t, v_x], pair), rays)| {
            let width = (pair[1].clone() - &pair[0]).to_f64();
            let share = [width, width * width / 2.0];
            let bounds = [share[0] * between + c * far(*rays), share[1] * between + width * c * far(*rays)];
            let widen = |[area, moment]: [Estimate<S>; 2], [by_area, by_moment]: [f64; 2]| {
                [wider(area, by_area), wider(moment, by_moment)]
            };
            [widen(v, share.map(|share| share * high)), widen(v_t, bounds), widen(v_x, bounds.map(|bound| bound / c))]
        });
        Ok(cells.collect())
    }

    fn rates(&self, points: &[Estimate<S>], times: &[Estimate<S>]) -> Result<Vec<[Estimate<S>; 2]>, Error> {
        let times: Vec<&Estimate<S>> = times.iter().map(|time| self.meant(time)).collect();
        let own = |time: &&Estimate<S>| self.history.bounded(time.value(), Side::Right);
        let (first, later) = times.split_at(times.partition_point(|time| own(time).is_some()));
        let mut rates = match first.first().and_then(own) {
            Some(form) => form.rates(points, &first.iter().map(|time| rounded(time.value())).collect::<Vec<_>>())?,
            None => Vec::new(),
        };
        let plain: Vec<S> = points.iter().map(|x| x.value().clone()).collect();
        let found = self.history.rates(&plain, &later.iter().map(|time| time.value().clone()).collect::<Vec<_>>())?;
        for (time, of_time) in later.iter().zip(found.chunks(plain.len().max(1))) {
            let Near { speed, strain, .. } = self.near(time);
            rates.extend(of_time.iter().map(|[v_t, v_x]| [within(v_t, speed), within(v_x, strain)]));
        }
        Ok(rates)
    }

    fn highest(&self, release: &Event<Estimate<S>>) -> Option<(Estimate<S>, Estimate<S>)> {
        if let Some(form) = self.history.bounded(release.time.value(), Side::Left) {
            return form.highest(release);
        }
        let known = self.course.events.iter().position(|event| event.time.value() == release.time.value())?;
        let (time, height) = self.history.highest(self.history.events().get(known)?)?;
        // dt*/dh′ = 1/(g + 2rh′); and what the height loses there is of second order.
        let (Near { rise, rate, .. }, gravity) = (self.near(&within(&time, 0.0)), self.scales.gravity);
        let late = release.time_error + rate / gravity;
        Some((within(&time, late), within(&height, rise + gravity * late * late)))
    }

    fn scales(&self) -> Scales<Estimate<S>> {
        self.history.scales().map(|scale| within(&scale, 0.0))
    }

    fn error_estimate(&self) -> Estimate<S> {
        Estimate::exact(self.history.error_estimate())
    }

    fn digits_lost(&self) -> Option<(u32, f64)> {
        self.history.digits_lost()
    }
}
