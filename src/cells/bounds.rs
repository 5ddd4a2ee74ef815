//! Values of a damped run, each with the bound that the run has at its time.

use super::budget::AtEvent;
use super::history::Damped;
use super::uncertainty::{Uncertainty, meant, wider, within};
use crate::error::Error;
use crate::motion::moments::{self, Moments, Sums};
use crate::motion::{Contact, Course, Event, EventKind, Field, Motion, Pair, Scales, Side, StressPiece, by_time};
use crate::number::{Answer, Estimate, Rounded, Scalar};
use crate::special::RoundedSpecial;

/// Bounds near a time, in the units of the problem.
struct Bounds {
    /// Bound for displacements, apart from the time error of events.
    rise: f64,
    /// Bound for `h`, apart from the time error of events.
    centre: f64,
    speed: f64,
    /// Bound for the velocity of the end.
    end: f64,
    strain: f64,
    /// Bound for `h′`.
    rate: f64,
    late: f64,
}

impl Bounds {
    /// Returns the smaller bounds of both, but the greater time error.
    fn min(self, other: &Bounds) -> Bounds {
        Bounds {
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

/// Share of the bound of a peak within which the peak is searched.
const PEAK_TOLERANCE: f64 = 1.0 / 16.0;

impl<S: RoundedSpecial> Damped<S> {
    /// Adds the contacts, and the bounds of the events.
    ///
    /// **Errors**: those of a query at an event.
    pub(super) fn with_bounds(mut self) -> Result<Self, Error> {
        let event = |(k, event): (usize, &Event<Estimate<S>>)| {
            let Bounds { centre, end, rate, late, .. } = self.at_event(k);
            // A zero is proved where the rod lies on the ground, and where it leaves without a jump of the stress.
            let known = |value: &Estimate<S>| self.proved && value.value().is_zero();
            let (moves, push) = (event.h_rate.to_f64().abs(), self.push(event.t.value(), late)?);
            let h = within(event.h.value(), if known(&event.h) { 0.0 } else { centre + late * (moves + push) });
            let means = [h, within(event.h_rate.value(), rate + push)];
            let is_start = event.t.value().is_zero() && event.t_error == 0.0;
            let [h, h_rate] = if is_start { self.at_start(means) } else { means };
            Ok(Event {
                kind: event.kind,
                t: within(event.t.value(), event.t_error),
                v_end: within(event.v_end.value(), if known(&event.v_end) { 0.0 } else { end }),
                h,
                h_rate,
                t_error: event.t_error,
            })
        };
        let events: Vec<_> = self.course.events.iter().enumerate().map(event).collect::<Result<_, Error>>()?;
        self.course.events = events;
        let mut pieces = self.contact_pieces();
        let contacts = Contact::between(&self.course.events, |k| {
            let found = self.uncertainty(self.course.events[k].t.value());
            let Scales { velocity, wave_speed, .. } = self.scales;
            // A peak lies next to a ray, or where the slope vanishes.
            let strain = self.scaled(found).strain + found.slope * found.rays * velocity / wave_speed;
            let tolerance = strain * PEAK_TOLERANCE;
            let (impulse, peak) = self.push_of(pieces.next().unwrap_or_default(), tolerance);
            (within(&impulse, self.impulse_off(k)), within(&peak, strain + tolerance))
        });
        drop(pieces);
        self.course.contacts = contacts;
        Ok(self)
    }

    /// Returns whether the end is on the ground only within its bounds: up to the release of a contact that begins
    /// without a force.
    fn may_rise_at(&self, time: &S) -> bool {
        let release = self.course.events.iter().find(|event| event.kind == EventKind::Release);
        self.may_rise && release.is_none_or(|release| time <= release.t.value())
    }

    /// Returns `h` and `h′` at the start: exactly zero where the mean of the given data is zero.
    fn at_start(&self, found: [Estimate<S>; 2]) -> [Estimate<S>; 2] {
        let mut exact = self.data.zero_means.iter();
        found.map(|value| if exact.next() == Some(&true) { Estimate::exact(value.value().zero()) } else { value })
    }

    /// Bounds the error of the impulse of a contact: by the balance of momentum between two followed events, or by the
    /// stress, `−c² ∫ v_x dt`, where displaced rays within the contact move the end by their masses.
    fn impulse_off(&self, impact: usize) -> f64 {
        let Scales { velocity, wave_speed: c, length, gravity, .. } = self.scales;
        let (from, to) = (&self.course.events[impact].t, self.course.events.get(impact + 1).map(|event| &event.t));
        let momentum = |event: usize| Some(self.at_events[event]?.momentum * velocity);
        let by_momentum = to.and_then(|to| {
            let both = momentum(impact)? + momentum(impact + 1)?;
            Some(length * (both + gravity * (from.bound() + to.bound())))
        });
        let last = to.unwrap_or(&self.course.end).to_f64();
        let Bounds { rise, speed, .. } = self.scaled(self.uncertainty(from.value()));
        by_momentum.unwrap_or((last - from.to_f64()) * speed * c + 2.0 * rise * c)
    }

    /// Returns the event at exactly this time, unless the time is given as text.
    fn event_at(&self, time: &Estimate<S>) -> Option<usize> {
        let events = &self.course.events;
        if time.spelled_as().is_some() {
            return None;
        }
        let next = events.partition_point(|event| event.t.value() < time.value());
        events.get(next).filter(|event| event.t.value() == time.value()).map(|_| next)
    }

    /// Returns the error bounds of values near a time.
    fn uncertainty(&self, time: &S) -> Uncertainty {
        let since = self.course.events.partition_point(|event| event.t.value() <= time);
        let lost = since.checked_sub(1).is_some_and(|last| self.course.events[last].t_error.is_infinite());
        let found = self.uncertain[since];
        let none = f64::INFINITY;
        if lost { Uncertainty { rise: none, speed: none, rate: none, ..found } } else { found }
    }

    /// Returns the bounds near a time, or those of an event at its time if that carries the bound of the event.
    fn near(&self, time: &Estimate<S>) -> Bounds {
        match self.event_at(time).filter(|_| time.bound() > 0.0) {
            Some(event) => self.at_event(event),
            None => {
                let (apart, near) = (time.bound(), self.scaled(self.uncertainty(time.value())));
                let moves = self.change(time.value(), apart);
                Bounds {
                    rise: near.rise + apart * moves,
                    speed: near.speed + moves,
                    end: near.end + moves,
                    strain: near.strain + moves / self.scales.wave_speed,
                    rate: near.rate + moves,
                    late: near.late + apart,
                    ..near
                }
            }
        }
    }

    /// Bounds the change of velocities and of `c v_x` between rays during `late`.
    fn change(&self, time: &S, late: f64) -> f64 {
        self.uncertainty(time).slope * late / self.scales.time * self.scales.velocity
    }

    /// Bounds the effect of that distance on `E_z`, and on the kinetic and the strain energy alone, per ρS.
    ///
    /// With M a bound of `|v_t|`, `|c v_x|`, `|h′|`: the ends take at most `c M²`, damping `2rL M²` and gravity `gL M`
    /// from the energy, and `L|h′h″| ≤ M (2cM + 2rLM + gL)`. Each part alone is `½ ∫ f² dx`: between rays f changes at
    /// most at the rate s, and rays, whose jumps have the sum J, move at c: at most `L M s + c M J`. J contains the
    /// jump from `−q` to `q` on the ray of the last event, which is at most 2M. At a misplaced ray `v_t` and `c v_x`
    /// are off by half of its jump, and `|v_t − h′|` is at most 2M: both parts of `E_z` together are off by
    /// `1.5 c M J`.
    fn energies_apart(&self, time: &Estimate<S>) -> [f64; 2] {
        let Scales { time: trip, velocity, length, wave_speed: c, gravity } = self.scales;
        let rays = |apart: f64, Uncertainty { most, jumps, .. }: &Uncertainty| {
            apart * most * velocity * velocity * c * (jumps + 2.0 * most)
        };
        if let Some(event) = self.event_at(time) {
            // An event has bounds of its own, but the rays are where they are at its rounded time.
            let off = |found| rays(self.event_rounding(event), found);
            let off = self.uncertain[event..=event + 1].iter().map(off).fold(0.0, f64::max);
            return [1.5 * off, off];
        }
        let apart = time.bound();
        if apart == 0.0 {
            return [0.0; 2];
        }
        let Uncertainty { most, slope, .. } = self.uncertainty(time.value());
        let by_rays = rays(apart, &self.uncertainty(time.value()));
        let (most, drag) = (most * velocity, 2.0 * self.medium.kappa.to_f64() / trip);
        let whole = most * (3.0 * c * most + length * (4.0 * drag * most + 2.0 * gravity));
        [apart * whole, apart * most * velocity * length * slope / trip + by_rays]
    }

    /// Returns the bounds at an event, whatever its true time: those of the contact that it begins or ends. Its time is
    /// rounded. If the bounds are those at equal times, the time error of the event is added.
    fn at_event(&self, event: usize) -> Bounds {
        let events = &self.course.events;
        let contact = event - usize::from(event > 0 && events[event].kind == EventKind::Release);
        let found = self.uncertainty(events[contact].t.value());
        let (time_error, rounding) = (&events[event].t_error, self.event_rounding(event));
        // If the time error is unbounded, the other bounds already are too.
        let equal_times = found.late == 0.0 && time_error.is_finite();
        let off = if equal_times { *time_error } else { 0.0 };
        let near = self.scaled(Uncertainty { late: (off + rounding) / self.scales.time, ..found });
        let Some(AtEvent { rise, centre, speed, end, rate, .. }) = self.at_events[event] else { return near };
        let found = Uncertainty { rise, speed, rate, late: rounding / self.scales.time, ..found };
        let unit = self.scales.velocity * self.scales.time;
        let own = self.scaled(found);
        let own = Bounds { centre: centre * unit, end: own.speed + (end - speed) * self.scales.velocity, ..own };
        if equal_times { near.min(&own) } else { own }
    }

    fn event_rounding(&self, event: usize) -> f64 {
        let time = &self.course.events[event].t;
        8.0 * time.value().unit() * time.to_f64()
    }

    fn scaled(&self, found: Uncertainty) -> Bounds {
        let Uncertainty { rise, speed, rate, late, slope, .. } = found;
        let Scales { time, velocity, wave_speed, .. } = self.scales;
        let (rise, speed) = (rise * velocity * time, (speed + slope * late) * velocity);
        let (rate, strain) = ((rate + slope * late) * velocity, speed / wave_speed);
        Bounds { rise, centre: rise, speed, end: speed, strain, rate, late: late * time }
    }

    /// Returns whether the rod still moves as a whole, before it touches; a fixed top stops it from the start on.
    fn is_rigid(&self, time: &Estimate<S>) -> bool {
        let touches = self.course.events.first();
        let before = |event: &Event<Estimate<S>>| time.to_f64() + time.bound() < event.t.to_f64() - event.t_error;
        let flies = self.medium.free_top && touches.is_none_or(before);
        self.data.rigid && (time.value().is_zero() || flies)
    }

    /// Bounds the change of `h′` by the force of the ground during the time error `late`: `h″ = −c² v_x(0,t)/L`.
    fn push(&self, time: &S, late: f64) -> Result<f64, Error> {
        let Scales { length, wave_speed, .. } = &self.scales;
        // The last event may be a rounding beyond the end.
        let end = self.course.end.value();
        let time = if time > end { end } else { time };
        let strain = |side| self.strain_of(time, side).map(|strain| strain.to_f64().abs());
        let right = strain(Side::Right)?;
        // The start has no left limit.
        let most = strain(Side::Left).map_or(right, |left| left.max(right));
        Ok(late * wave_speed * (wave_speed * most + self.change(time, late)) / length)
    }

    /// Attaches the bounds near a time to a displacement and its rate of change.
    fn moved(&self, time: &Estimate<S>, place: &S, rate: &S) -> [Estimate<S>; 2] {
        let near = self.near(time);
        [within(place, near.rise + near.late * rate.to_f64().abs()), within(rate, near.speed)]
    }

    /// Bounds the error of the root of a mean square: while contact is in doubt, the vibration may or may not lose what
    /// the ground gives to the centre of mass.
    fn root_off(&self, time: &Estimate<S>) -> Result<f64, Error> {
        let near = self.near(time);
        Ok(near.speed + self.push(time.value(), near.late)?)
    }

    /// Bounds the error of `L s²/2` for the error `off` of a root mean square s: at most `L (2s + off) off`.
    fn square_off(&self, root: f64, off: f64) -> f64 {
        self.scales.length * (2.0 * root + off) * off
    }

    /// Bounds the error of an energy for the error `off` of the root of its mean square between rays, and for displaced
    /// rays: `¼ ∫ |δp| (2|p| + |δp|) + |δq| (2|q| + |δq|) dx ≤ M ∫ |δp| + |δq| dx`, as `|δq|` is at most twice the
    /// greatest `|q|`, M; and half of the integral is at most `rise`.
    fn energy_off(&self, energy: &S, off: f64, by_rays: f64) -> f64 {
        self.square_off((2.0 * energy.to_f64().max(0.0) / self.scales.length).sqrt(), off) + by_rays
    }

    /// Computes the second part of [`Self::energy_off`].
    fn by_rays(&self, time: &Estimate<S>) -> f64 {
        let Uncertainty { peak, .. } = self.uncertainty(time.value());
        2.0 * peak * self.scales.velocity * self.scales.wave_speed * self.near(time).rise
    }
}

/// **Accuracy**: *within its own bound*, away from displaced rays. The bound of a time or a point is included; a time
/// within rounding of an event stands for the event, whatever its true time.
impl<S: RoundedSpecial> Motion<Estimate<S>> for Damped<S> {
    fn course(&self) -> &Course<Estimate<S>> {
        &self.course
    }

    fn scales(&self) -> Scales<Estimate<S>> {
        self.data.units.clone().map(|scale| within(&scale, 0.0))
    }

    fn stress_pieces(&self) -> Vec<StressPiece<Estimate<S>>> {
        let Scales { time: trip, velocity, wave_speed, .. } = self.scales;
        let piece = |piece: StressPiece<S>| {
            let found = self.uncertainty(&piece.start);
            // A piece begins and ends with an event, or with a ray that may be displaced.
            let late = |at: &S| {
                let rounding = 16.0 * at.unit() * (at.to_f64() + trip);
                match self.event_at(&Estimate::exact(at.clone())) {
                    Some(event) => self.course.events[event].t.clone(),
                    None if at.is_zero() => Estimate::exact(at.clone()),
                    None if at == self.course.end.value() => self.course.end.clone(),
                    None => within(at, found.rays * trip + rounding),
                }
            };
            let shifted = found.slope * found.rays * velocity / wave_speed;
            // The strain is zero in flight.
            let known = self.proved && piece.chebyshev.is_empty();
            let off = if known { 0.0 } else { self.scaled(found).strain + shifted };
            let (start, end) = (late(&piece.start), late(&piece.end));
            StressPiece { start, end, ..bounded_piece(piece, off) }
        };
        self.pieces_of_stress().into_iter().map(piece).collect()
    }

    fn strain(&self, time: &Estimate<S>, side: Side) -> Result<Estimate<S>, Error> {
        let time = meant(&self.course.events, time);
        let strain = self.strain_of(time.value(), side)?;
        // A zero strain before the start or in flight is exact.
        let known = self.proved && strain.is_zero() && self.presses(time.value(), side) != Some(true);
        Ok(within(&strain, if known { 0.0 } else { self.near(time).strain }))
    }

    fn pair(&self, pair: Pair, time: &Estimate<S>, side: Side) -> Result<[Estimate<S>; 2], Error> {
        let time = meant(&self.course.events, time);
        Ok(match pair {
            Pair::GroundEnd => {
                let [height, rate] = self.ground_of(time.value(), side)?;
                let known = height.is_zero() && rate.is_zero();
                let lies = self.proved && self.presses(time.value(), side) != Some(false);
                if known && lies && !self.may_rise_at(time.value()) {
                    return Ok([Estimate::exact(height), Estimate::exact(rate)]);
                }
                self.moved(time, &height, &rate)
            }
            Pair::Centre => {
                let [height, rate] = self.centre_of(time.value())?;
                let near = self.near(time);
                let (moves, push) = (rate.to_f64().abs(), self.push(time.value(), near.late)?);
                let moves = moves + self.change(time.value(), near.late) + push;
                let found = [within(&height, near.centre + near.late * moves), within(&rate, near.rate + push)];
                if time.value().is_zero() && time.bound() == 0.0 { self.at_start(found) } else { found }
            }
            Pair::Energy => {
                let (height, rate) = self.centre(time)?;
                let Scales { length, gravity, .. } = &self.data.units;
                let (speed, place) = (rate.value(), height.value());
                let translational = (speed.square() * speed.ratio(1, 2) + gravity.clone() * place) * length;
                let of_height = self.scales.length * self.scales.gravity * height.bound();
                let by_centre = self.square_off(speed.to_f64().abs(), rate.bound()) + of_height;
                if self.proved && self.is_rigid(time) {
                    return Ok([within(&translational, by_centre), Estimate::exact(translational.zero())]);
                }
                let vibration = self.vibration_of(time.value())?;
                let [apart, _] = self.energies_apart(time);
                let off = self.energy_off(&vibration, self.root_off(time)?, self.by_rays(time));
                [within(&translational, by_centre), within(&vibration, off + apart)]
            }
            // Each mean square has the error bound of the vibration.
            Pair::EnergyParts => {
                let [_, apart] = self.energies_apart(time);
                let (off, by_rays) = (self.root_off(time)?, self.by_rays(time));
                self.parts_of(time.value())?.map(|part| within(&part, self.energy_off(&part, off, by_rays) + apart))
            }
        })
    }

    fn field(&self, point: &Estimate<S>, time: &Estimate<S>, side: Side) -> Result<Field<Estimate<S>>, Error> {
        let time = meant(&self.course.events, time);
        let field = self.field_of(point.value(), time.value(), side)?;
        // An error of the point acts as a time error, up to the factor `c` and the integral up to the point.
        let (placed, c) = (point.bound(), self.scales.wave_speed);
        let near = self.near(&wider(time.clone(), placed / c));
        let [displacement, velocity] = self.moved(time, &field.displacement, &field.velocity);
        let strain = within(&field.strain, near.strain);
        let moved = placed * (field.strain.to_f64().abs() + self.change(time.value(), placed / c) / c);
        Ok(Field { displacement: wider(displacement, moved), velocity: within(velocity.value(), near.speed), strain })
    }

    fn corners(&self) -> Vec<Estimate<S>> {
        self.data.given.corners.iter().map(S::carry).collect()
    }

    /// Integrates `v_t` and `v_x` over the cells of a grid, with the weights 1 and `(x − a)/h`, by sums over
    /// Gauss–Legendre nodes between rays and points; the integrals of v follow by parts from `v(0,t)` and `v_x`. `M`
    /// (`most`) is a bound of `|v_t|`, `|c v_x|`.
    ///
    /// **Accuracy**: for `v_t`, and for `c v_x` too, within `h (speed + late · slope + 2^{a+1} M) + c (rise + 2M
    /// late)`. Between rays the integrand has the error of a value, and the rule adds `2^{a+1} M`, as a side is a
    /// polynomial of as many terms as the rule is exact for, and a remainder of `2^a M`. Half of the mass of displaced
    /// rays is at most `rise`. If all events are late by δ, so are all rays: `v_tt = c² v_xx − 2r v_t − g`, integrated
    /// over the cell with its weight φ and over δ, gives `c² [φ v_x]` and `c² ∫ φ′ v_x`, at most `2cMδ`, and the part
    /// counted in `late · slope`; for `v_x` it is `∫ (φ v_t)_x − φ′ v_t`, at most `2Mδ`. A point that is off by `cδ`
    /// adds no more. Displacements are off by `rise + late · M` at every x, and by the error of the rule for `∫ v_x`
    /// below.
    fn moments(&self, time: &Estimate<S>, points: &[Estimate<S>]) -> Result<Vec<Moments<Estimate<S>>>, Error> {
        let time = meant(&self.course.events, time);
        let placed = points.iter().fold(0.0, |most: f64, point| most.max(point.bound()));
        let points: Vec<S> = points.iter().map(|point| point.value().clone()).collect();
        let lines = self.lines(time.value(), &points)?;
        // Error of the rule, relative to the greatest integrand and the length.
        let left_out = 2.0 * self.medium.log2_accuracy.exp2();
        let [height, _] = self.ground_of(time.value(), Side::Left)?;
        let [_, rate] = self.centre_of(time.value())?;
        let Scales { time: trip, velocity, length, wave_speed: c, .. } = self.scales;
        let Bounds { rise, speed, late, .. } = self.near(time);
        let most = self.uncertainty(time.value()).most * velocity + rate.to_f64().abs();
        let between = speed + left_out * most;
        let rounding = 8.0 * time.value().unit() * (time.to_f64() + trip);
        let far = |rays: usize| rise + 2.0 * most * (late + placed / c + (rays + 1) as f64 * rounding);
        let rays: Vec<usize> = lines.iter().map(|(_, rays)| *rays).collect();
        let high = far(rays.iter().sum()) + length * left_out * most / c;

        let starts = std::iter::once(height.zero()).chain(points.iter().cloned()).map(Estimate::exact);
        let exactly = |node: moments::Node<S>| node.map(Estimate::exact);
        let sums =
            lines.into_iter().zip(starts).map(|((nodes, _), from)| Sums::of(&from, nodes.into_iter().map(exactly)));
        let ends: Vec<_> = points.iter().cloned().map(Estimate::exact).collect();
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

    fn rates(&self, places: &[(Estimate<S>, Estimate<S>)]) -> Result<Vec<[Estimate<S>; 2]>, Error> {
        let times = by_time(places, |time| {
            let time = meant(&self.course.events, time);
            let Bounds { speed, strain, .. } = self.near(time);
            Ok((time.value().clone(), [speed, strain]))
        })?;
        let (times, bounds): (Vec<S>, Vec<[f64; 2]>) = times.into_iter().unzip();
        let plain = places.iter().zip(times).map(|((point, _), time)| (point.value().clone(), time));
        let found = self.rates_of(&plain.collect::<Vec<_>>())?.into_iter();
        let bounded =
            found.zip(bounds).map(|([v_t, v_x], [speed, strain])| [within(&v_t, speed), within(&v_x, strain)]);
        Ok(bounded.collect())
    }

    /// Computes the highest point from `h` and `h′` near it. At the release `h′` is known less well, as the ground has
    /// pushed for an uncertain time.
    fn highest(&self, release: usize) -> Option<(Estimate<S>, Estimate<S>)> {
        let events = self.course.events.get(release..)?;
        let Event { t, h, h_rate, .. } = events.first().filter(|event| !event.h_rate.value().is_negative())?;
        let (near, _) = self.turn([t.value(), h.value(), h_rate.value()])?;
        let last = events.get(1).map_or(&self.course.end, |landing| &landing.t).value();
        let near = if last < &near { last.clone() } else { near };
        let [height, rate] = self.pair(Pair::Centre, &Estimate::exact(near.clone()), Side::Left).ok()?;
        let (time, top) = self.turn([&near, height.value(), rate.value()])?;
        // dt*/dh′ = 1/(g + 2rh′) and dh(t*)/dh′ = h′/(g + 2rh′), at most 2/g and 2h′/g while 2rh′ is above −g/2.
        let gravity = self.scales.gravity;
        let (speed, late) = (rate.value().to_f64().abs() + rate.bound(), 2.0 * rate.bound() / gravity);
        let drag = 2.0 * self.data.damping.to_f64() / self.scales.time * speed;
        (drag < gravity / 2.0).then(|| (within(&time, late), within(&top, height.bound() + speed * late)))
    }

    fn error_estimate(&self) -> Estimate<S> {
        let most = self.uncertain.iter().fold(Uncertainty::default(), |most, next| most.max(*next));
        let times = self.course.events.iter().map(|event| event.t_error / self.scales.time);
        let most = times.fold(most.rise.max(most.speed).max(most.late), f64::max);
        Estimate::exact(self.course.end.value().double(most))
    }
}

/// Attaches the bound `strain` to a piece of stress: to its ends, and as a bound of the whole to its first coefficient.
pub(super) fn bounded_piece<S: Rounded>(piece: StressPiece<S>, strain: f64) -> StressPiece<Estimate<S>> {
    let coefficient = |(k, c)| within(c, if k == 0 { strain } else { 0.0 });
    StressPiece {
        start: within(&piece.start, 0.0),
        end: within(&piece.end, 0.0),
        strain_start: within(&piece.strain_start, strain),
        strain_end: within(&piece.strain_end, strain),
        chebyshev: piece.chebyshev.iter().enumerate().map(coefficient).collect(),
    }
}
