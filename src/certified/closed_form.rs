//! The closed forms of the first contact in enclosures, with the rays counted in exact numbers.

use crate::error::Error;
use crate::first_contact::FirstContact;
use crate::history::{Energy, Field, Scales, Side};
use crate::number::{Interval, IntervalPrecision, Scalar, decided, undecided};
use crate::rod::{Parameters, Problem};

/// The first contact of a uniform start under a free top, in enclosures of so many bits, whether or not it still lasts at
/// the time that is asked for.
///
/// **Source**: [`FirstContact`]. Which rays have arrived is decided on exact numbers where the scene has them, so that a time
/// on a ray is told from one beside it.
///
/// **Units**: those of the problem.
///
/// **Accuracy**: *enclosure*. Every sum carries the bound of the terms left out as a width; the energy carries that of its
/// quadrature.
///
/// ```
/// use dalembert::certified::ClosedForm;
/// use dalembert::number::{Interval, IntervalPrecision, Scalar};
/// use dalembert::{Number, Problem, Side};
/// // r = 0: the stress in the first round trip is −(μ + gt)/c.
/// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(3));
/// let form = ClosedForm::of(&problem, 128)?;
/// let stress = form.stress(&form.time(&Number::from(1)), Side::Right)?;
/// assert!(stress.contains(&rug::Rational::from(-4)) && stress.radius() < 1e-35);
/// # Ok::<(), dalembert::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ClosedForm {
    /// With exact numbers inside.
    pub(super) exact: Parameters<Interval>,
    /// `t₁`, with the exact number inside.
    pub(super) round_trip: Interval,
    /// Without.
    pub(super) contact: FirstContact<Interval>,
    bits: u32,
}

/// A time in round trips.
#[derive(Clone, Debug)]
pub(super) struct Trips {
    /// `t/t₁`; with the exact number inside where it is known, otherwise without.
    exact: Interval,
    /// Without.
    pub(super) plain: Interval,
    /// How many round trips have passed.
    pub(super) passed: i64,
    /// Whether the last of them just has.
    pub(super) on_lattice: bool,
}

/// The same ends, without an exact number.
pub(super) fn plain(x: &Interval) -> Interval {
    Interval::between(x.lo().clone(), x.hi().clone())
}

impl ClosedForm {
    /// The closed forms for `problem`, in enclosures of `bits` bits, 128 at least.
    ///
    /// **Errors**: [`Error::NoClosedForm`].
    pub fn of(problem: &Problem, bits: u32) -> Result<Self, Error> {
        if !problem.has_closed_form() {
            return Err(Error::NoClosedForm);
        }
        // The doubles in the search for the bounce want no less.
        let bits = bits.max(128);
        let exact = Parameters::<Interval>::of(problem, &IntervalPrecision::with_exact(bits))?;
        let rod = Parameters {
            length: plain(&exact.length),
            wave_speed: plain(&exact.wave_speed),
            damping: plain(&exact.damping),
            gravity: plain(&exact.gravity),
            speed: plain(&exact.speed),
        };
        Ok(ClosedForm { round_trip: exact.round_trip(), exact, contact: FirstContact::new(&rod), bits })
    }

    /// A time or a point as a person wrote it.
    pub fn time(&self, number: &crate::Number) -> Interval {
        Interval::from_number(number, &IntervalPrecision::with_exact(self.bits))
    }

    /// Bits of the enclosures.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// What `compute` finds, if all of its comparisons are settled.
    pub(super) fn settled<T>(&self, what: &'static str, compute: impl FnOnce() -> Option<T>) -> Result<T, Error> {
        decided(compute).flatten().ok_or_else(|| {
            // Whoever listens farther out is to know as well.
            undecided();
            Error::NotDecided { what, bits: self.bits }
        })
    }

    /// `t/t₁`.
    pub(super) fn trips(&self, time: &Interval) -> Result<Trips, Error> {
        let exact = time.clone() / &self.round_trip;
        let (passed, on_lattice) = self.settled("how many rays have returned by that time", || {
            let passed = exact.floor_int()?;
            Some((passed, exact == exact.int(passed)))
        })?;
        let plain = if on_lattice { self.contact.round_trip().int(passed) } else { plain(&exact) };
        Ok(Trips { exact, plain, passed, on_lattice })
    }

    /// The time after `trips` round trips that lie in this cell.
    pub(super) fn inside_cell(&self, trips: &Interval, cell: i64) -> Trips {
        Trips { exact: trips.clone(), plain: trips.clone(), passed: cell, on_lattice: false }
    }

    /// The k-th lattice time.
    pub(super) fn lattice(&self, k: i64) -> Trips {
        let exact = self.round_trip.int(k);
        Trips { plain: plain(&exact), exact, passed: k, on_lattice: true }
    }

    /// `v_x(0,t) = e^{−rt} Ψ_r(t)`: the stress at the ground divided by the modulus.
    ///
    /// **Source**: (2.28). **Accuracy**: *enclosure*. **Errors**: [`Error::NotDecided`].
    pub fn stress(&self, time: &Interval, side: Side) -> Result<Interval, Error> {
        self.stress_at(&self.trips(time)?, side)
    }

    pub(super) fn stress_at(&self, trips: &Trips, side: Side) -> Result<Interval, Error> {
        let before = trips.on_lattice && side == Side::Left;
        let rays = (trips.passed - i64::from(before)).max(0);
        self.settled("what the stress is", || (rays <= MOST_RAYS).then(|| self.contact.stress_at(&trips.plain, rays)))
    }

    /// `h(t)` and `h′(t) = P/L`: the centre of mass.
    ///
    /// **Source**: (3.38), (3.39). **Accuracy**: *enclosure*. **Errors**: [`Error::NotDecided`].
    pub fn centre(&self, time: &Interval) -> Result<(Interval, Interval), Error> {
        self.centre_at(&self.trips(time)?)
    }

    pub(super) fn centre_at(&self, trips: &Trips) -> Result<(Interval, Interval), Error> {
        self.settled("where the centre of mass is", || self.contact.motion_at(&trips.plain))
    }

    /// `E`, `E_h`, `E_z`.
    ///
    /// **Source**: (3.54), (3.61)–(3.63), with `E_z` as a sum of squares. **Accuracy**: *enclosure*. **Errors**:
    /// [`Error::NotDecided`].
    pub fn energy(&self, time: &Interval) -> Result<Energy<Interval>, Error> {
        self.energy_at(&self.trips(time)?)
    }

    pub(super) fn energy_at(&self, trips: &Trips) -> Result<Energy<Interval>, Error> {
        self.settled("what the energy is", || self.contact.energy_at(&trips.plain))
    }

    /// `v`, `v_t`, `v_x` at `(x,t)`.
    ///
    /// **Source**: (2.22)–(2.24). **Accuracy**: *enclosure*. **Errors**: [`Error::PointOutside`], [`Error::NotDecided`].
    pub fn field(&self, point: &Interval, time: &Interval, side: Side) -> Result<Field<Interval>, Error> {
        self.field_at(point, &self.trips(time)?, side)
    }

    pub(super) fn field_at(&self, point: &Interval, trips: &Trips, side: Side) -> Result<Field<Interval>, Error> {
        let length = &self.exact.length;
        let outside =
            self.settled("whether the point is in the rod", || Some(point.is_negative() || point > length))?;
        if outside {
            return Err(Error::PointOutside { found: point.text(), length: length.text() });
        }
        let a = point.clone() / length / length.int(2);
        // The j-th ray upwards arrives after j + a round trips, the j-th downwards after j + 1 − a.
        let count = |reach: Interval| {
            let whole = reach.floor_int()?;
            let just = side == Side::Left && reach == reach.int(whole);
            Some(whole + i64::from(!just))
        };
        let arrived = self.settled("which rays have arrived", || {
            Some([count(trips.exact.clone() - &a)?, count(trips.exact.clone() + &a - &a.one())?])
        })?;
        self.settled("what the field is", || self.contact.field_at(&plain(&a), &trips.plain, arrived))
    }

    /// The natural scales.
    pub(super) fn scales(&self) -> Scales<Interval> {
        let (speed, critical) = (&self.exact.speed, self.exact.critical_speed());
        // Either is a scale where it cannot be told which is greater.
        let velocity = if speed.mid() >= critical.mid() { speed.clone() } else { critical };
        Scales {
            time: self.round_trip.clone(),
            velocity,
            length: self.exact.length.clone(),
            wave_speed: self.exact.wave_speed.clone(),
            gravity: self.exact.gravity.clone(),
        }
    }
}

/// More rays than this are not summed.
const MOST_RAYS: i64 = 1 << 16;
