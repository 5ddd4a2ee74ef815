//! The first contact as a history in which everything is proved.

use super::closed_form::{ClosedForm, Trips};
use super::root;
use crate::error::Error;
use crate::first_contact::{Bounce, BounceKind, FirstContact, Found, Rebound};
use crate::history::{Contact, Ending, Energy, Event, EventKind, Field, History, Scales, Side, StressPiece};
use crate::number::{Interval, Scalar, decided};
use crate::rod::{Problem, Run};

/// The first contact of a uniform start under a free top, damped or not, from the impact to the bounce, in enclosures.
///
/// **Source**: [`ClosedForm`]; Theorem 1 for its end. The bounce is the first sign change of the stress, with none before it
/// missed: a jump at `k t₁`, whose number k is exact, or a root between proved signs.
///
/// **Units**: those of the problem.
///
/// **Accuracy**: *enclosure*. The history ends with the contact, because the flight that follows is only known as far as no
/// impact ends it: see [`ProvedContact::flight`].
///
/// ```
/// use dalembert::certified::ProvedContact;
/// use dalembert::{History, Number, Problem};
/// // (1.10): g = 0, R = 3: the bounce is a root in the fourth round trip.
/// let mut problem = Problem::uniform("1/2".parse()?, Number::from(1), Number::from(0), Number::from(1));
/// problem.rod.damping = Some(Number::from(3));
/// let contact = ProvedContact::solve(&problem, 256)?.ok_or("more bits")?;
/// let bounce = &contact.events()[1].time;
/// assert!(*bounce.lo() > 3.299026051445772 && *bounce.hi() < 3.299026051445773 && bounce.radius() < 1e-70);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ProvedContact {
    form: ClosedForm,
    release: Option<Release>,
    events: Vec<Event<Interval>>,
    contacts: Vec<Contact<Interval>>,
    end: Interval,
    ending: Ending,
}

/// The bounce.
#[derive(Clone, Debug)]
struct Release {
    trips: Trips,
    kind: BounceKind,
    /// `k` where `t_b = k t₁`.
    lattice: Option<i64>,
    rebound: Rebound<Interval>,
}

/// A time of the history.
enum Place<'a> {
    /// The bounce itself.
    Bounce(&'a Release),
    Contact(Trips),
}

/// A contact without end is followed for so many round trips where no time is asked for, and for so many at most.
const SHOWN_TRIPS: i64 = 8;
const MOST_TRIPS: i64 = 256;

impl ProvedContact {
    /// The first contact of `problem`, in enclosures of `bits` bits; `None` where these do not settle how it ends.
    ///
    /// **Errors**: [`Error::NoClosedForm`].
    pub fn solve(problem: &Problem, bits: u32) -> Result<Option<Self>, Error> {
        let form = ClosedForm::of(problem, bits)?;
        // Without damping the answer compares the speeds, which exact numbers settle.
        let exact = FirstContact::new(&form.exact);
        let searched = if form.exact.damping.lo().is_zero() { &exact } else { &form.contact };
        let Some(found) = decided(|| searched.found()) else { return Ok(None) };
        let one = form.round_trip.one();
        let (trips, time, kind, lattice) = match found {
            Found::Jump(k) => (form.lattice(k), one.int(k) * &form.round_trip, BounceKind::Jump, Some(k)),
            Found::Answer(Bounce::At { time, kind, .. }) => {
                let trips = match form.trips(&time) {
                    Err(Error::NotDecided { .. }) => return Ok(None),
                    trips => trips?,
                };
                let lattice = trips.on_lattice.then_some(trips.passed);
                (trips, time, kind, lattice)
            }
            Found::Root(bracket) => {
                let Some(root) = root::enclose(problem, &form.contact, &bracket)? else { return Ok(None) };
                let time = root.clone() * form.contact.round_trip();
                (form.inside_cell(&root, bracket.cell), time, BounceKind::Root, None)
            }
            Found::Answer(Bounce::Undecided { digits: true, .. }) => return Ok(None),
            Found::Answer(Bounce::Undecided { until, why, .. }) => {
                return Self::without_bounce(form, problem, Ending::Undecided(why), Some(until));
            }
            Found::Answer(Bounce::Never { reason }) => {
                return Self::without_bounce(form, problem, Ending::NoBounce(reason), None);
            }
        };
        if let Run::Time(asked) = &problem.run {
            let asked = form.time(asked);
            match decided(|| asked < time) {
                None => return Ok(None),
                Some(true) => return Self::without_bounce(form, problem, Ending::Time, None),
                Some(false) => (),
            }
        }
        Self::with_bounce(form, trips, time, kind, lattice)
    }

    /// A contact that does not end before `until`, or the time that is asked for.
    fn without_bounce(
        form: ClosedForm,
        problem: &Problem,
        ending: Ending,
        until: Option<Interval>,
    ) -> Result<Option<Self>, Error> {
        let asked = match &problem.run {
            Run::Time(asked) => Some(form.time(asked)),
            Run::Impacts(_) => None,
        };
        let trips = |k: i64| form.round_trip.int(k) * &form.round_trip;
        let most = until.clone().unwrap_or_else(|| trips(MOST_TRIPS));
        let (end, ending) = match asked {
            None => (until.unwrap_or_else(|| trips(SHOWN_TRIPS)), ending),
            Some(asked) => match decided(|| asked <= most) {
                None => return Ok(None),
                Some(true) => (asked, Ending::Time),
                Some(false) => (most, ending),
            },
        };
        let mut history =
            ProvedContact { events: vec![form.impact()], contacts: Vec::new(), release: None, form, end, ending };
        history.measure()
    }

    fn with_bounce(
        form: ClosedForm,
        trips: Trips,
        time: Interval,
        kind: BounceKind,
        lattice: Option<i64>,
    ) -> Result<Option<Self>, Error> {
        let motion = match form.centre_at(&trips) {
            Err(Error::NotDecided { .. }) => return Ok(None),
            motion => motion?,
        };
        let end_velocity = match kind {
            // The rod that were glued on would be pulled: that stress is what the end leaves with.
            BounceKind::Jump => form.stress_at(&trips, Side::Right)? * &form.exact.wave_speed,
            BounceKind::Root => time.zero(),
        };
        let release = Event {
            kind: EventKind::Release,
            time: time.clone(),
            end_velocity,
            centre: motion.0.clone(),
            centre_velocity: motion.1.clone(),
            time_error: time.width().to_f64(),
        };
        let rebound = form.contact.flight_from(&super::closed_form::plain(&time), motion);
        let mut history = ProvedContact {
            events: vec![form.impact(), release],
            contacts: Vec::new(),
            release: Some(Release { trips, kind, lattice, rebound }),
            end: time,
            ending: Ending::Bounce,
            form,
        };
        history.measure()
    }

    /// Impulse and peak: `−c² ∫ v_x dt = P(t) − P(0) + 2rL h(t) + gLt`, (3.36) integrated.
    fn measure(&mut self) -> Result<Option<Self>, Error> {
        let until = self.end.clone();
        let measured = (|| {
            let (centre, velocity) = self.centre(&until)?;
            let rod = &self.form.exact;
            let drag = centre * &rod.damping * &until.int(2);
            let gained = velocity + &rod.speed + drag + rod.gravity.clone() * &until;
            let end = self.end_trips()?;
            let peak = self.form.settled("which stress is the greatest", || Some(self.form.peak(&end)))??;
            Ok((gained * &rod.length, peak))
        })();
        let (impulse, peak_stress) = match measured {
            Err(Error::NotDecided { .. }) => return Ok(None),
            measured => measured?,
        };
        let to = self.release.as_ref().map(|_| until.clone());
        self.contacts.push(Contact { from: until.zero(), to, impulse, peak_stress });
        Ok(Some(self.clone()))
    }

    /// The end, in round trips.
    fn end_trips(&self) -> Result<Trips, Error> {
        match &self.release {
            Some(release) => Ok(release.trips.clone()),
            None => self.form.trips(&self.end),
        }
    }

    /// The closed forms behind it.
    pub fn form(&self) -> &ClosedForm {
        &self.form
    }

    /// What the stress does at the bounce, and k where that is at `k t₁`; `None` where there is none.
    pub fn bounce(&self) -> Option<(BounceKind, Option<i64>)> {
        self.release.as_ref().map(|release| (release.kind, release.lattice))
    }

    /// `h(t)` and `h′(t)` in the flight after the bounce, provided that no impact has come before.
    ///
    /// **Source**: (3.43), (3.44). **Accuracy**: *enclosure*. **Errors**: [`Error::TimeOutside`] before the bounce or where there
    /// is none.
    pub fn flight(&self, time: &Interval) -> Result<(Interval, Interval), Error> {
        let outside = || Error::TimeOutside { found: time.text(), end: self.end.text() };
        let release = self.release.as_ref().ok_or_else(outside)?;
        if same(time, &self.end) {
            return Ok((release.rebound.centre.value.clone(), release.rebound.velocity.value.clone()));
        }
        if !self.form.settled("whether that time is in the flight", || Some(*time > self.end))? {
            return Err(outside());
        }
        self.form
            .settled("where the centre of mass is", || Some(release.rebound.flight(&super::closed_form::plain(time))))
    }

    fn place(&self, time: &Interval) -> Result<Place<'_>, Error> {
        if same(time, &self.end)
            && let Some(release) = &self.release
        {
            return Ok(Place::Bounce(release));
        }
        let outside = self.form.settled("whether that time is before the end", || {
            Some(time.is_negative() || (!same(time, &self.end) && *time > self.end))
        })?;
        if outside || !time.is_finite() {
            return Err(Error::TimeOutside { found: time.text(), end: self.end.text() });
        }
        Ok(Place::Contact(self.form.trips(time)?))
    }
}

/// Whether one is a copy of the other, and not another exact number between the same ends.
fn same(a: &Interval, b: &Interval) -> bool {
    a.lo() == b.lo() && a.hi() == b.hi() && decided(|| a == b) != Some(false)
}

impl ClosedForm {
    /// The impact at `t = 0`.
    fn impact(&self) -> Event<Interval> {
        let zero = self.round_trip.zero();
        Event {
            kind: EventKind::Impact,
            end_velocity: -self.exact.speed.clone(),
            centre: zero.clone(),
            centre_velocity: -self.exact.speed.clone(),
            time: zero,
            time_error: 0.0,
        }
    }
}

impl History<Interval> for ProvedContact {
    fn end(&self) -> Interval {
        self.end.clone()
    }

    fn ending(&self) -> &Ending {
        &self.ending
    }

    fn events(&self) -> &[Event<Interval>] {
        &self.events
    }

    fn contacts(&self) -> &[Contact<Interval>] {
        &self.contacts
    }

    /// **Errors**: none where these bits do not settle one of them.
    fn stress_pieces(&self) -> Vec<StressPiece<Interval>> {
        let pieces = self.end_trips().and_then(|end| self.form.pieces(&end));
        let mut pieces = pieces.unwrap_or_default();
        if let Some(last) = pieces.last_mut() {
            last.to = self.end.clone();
            if self.release.as_ref().is_some_and(|release| release.kind == BounceKind::Root) {
                last.right = self.end.zero();
            }
        }
        pieces
    }

    fn stress(&self, time: &Interval, side: Side) -> Result<Interval, Error> {
        match self.place(time)? {
            Place::Bounce(_) if side == Side::Right => Ok(time.zero()),
            // A root, or the limit before the jump.
            Place::Bounce(release) if release.kind == BounceKind::Root => Ok(time.zero()),
            Place::Bounce(release) => self.form.stress_at(&release.trips, Side::Left),
            Place::Contact(trips) => self.form.stress_at(&trips, side),
        }
    }

    fn ground_end(&self, time: &Interval, side: Side) -> Result<(Interval, Interval), Error> {
        match (self.place(time)?, self.events.last()) {
            (Place::Bounce(_), Some(event)) if side == Side::Right => Ok((time.zero(), event.end_velocity.clone())),
            _ => Ok((time.zero(), time.zero())),
        }
    }

    fn top_end(&self, time: &Interval, side: Side) -> Result<(Interval, Interval), Error> {
        let field = self.field(&self.form.exact.length, time, side)?;
        Ok((field.displacement, field.velocity))
    }

    fn centre(&self, time: &Interval) -> Result<(Interval, Interval), Error> {
        match self.place(time)? {
            Place::Bounce(release) => {
                Ok((release.rebound.centre.value.clone(), release.rebound.velocity.value.clone()))
            }
            Place::Contact(trips) => self.form.centre_at(&trips),
        }
    }

    fn energy(&self, time: &Interval) -> Result<Energy<Interval>, Error> {
        match self.place(time)? {
            Place::Bounce(release) => self.form.energy_at(&release.trips),
            Place::Contact(trips) => self.form.energy_at(&trips),
        }
    }

    fn field(&self, point: &Interval, time: &Interval, side: Side) -> Result<Field<Interval>, Error> {
        match self.place(time)? {
            Place::Bounce(release) if side == Side::Right => {
                let ground = self.form.settled("whether the point is at the ground", || Some(point.is_zero()))?;
                if ground {
                    let (displacement, velocity) = self.ground_end(time, side)?;
                    return Ok(Field { displacement, velocity, strain: time.zero() });
                }
                self.form.field_at(point, &release.trips, side)
            }
            Place::Bounce(release) => self.form.field_at(point, &release.trips, side),
            Place::Contact(trips) => self.form.field_at(point, &trips, side),
        }
    }

    /// **Errors**: `None` also where these bits do not tell whether the centre of mass rises.
    fn highest(&self, release: &Event<Interval>) -> Option<(Interval, Interval)> {
        if release.kind != EventKind::Release || !same(&release.time, &self.end) {
            return None;
        }
        let rebound = &self.release.as_ref()?.rebound;
        rebound.velocity.value.is_positive().then(|| rebound.highest()).flatten()
    }

    fn scales(&self) -> Scales<Interval> {
        self.form.scales()
    }

    /// Zero: every number holds its own.
    fn error_estimate(&self) -> Interval {
        self.end.zero()
    }

    fn warnings(&self) -> &[String] {
        &[]
    }
}
