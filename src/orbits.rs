//! Periodic orbits of the undamped rod: motions with one contact in each period that repeat themselves for ever.
//!
//! Let `q(t)` be the wave `v_t + c v_x` that arrives at the ground. It leaves as `q` in flight and as `−q` in contact,
//! and a round trip `t₁ = 2L/c` later arrives again: under a free top `q(t + t₁) = s q(t) − g t₁`, under a fixed one
//! `q(t + t₁) = −s q(t)`, with `s = 1` in flight and `s = −1` in contact. With the period `T = (m/n) t₁` this joins the
//! `m` cells of width `t₁/n` of a period into a single cycle, where a contact begins and ends between two cells:
//!
//! - Under a **free top** the lower end returns to the ground by itself, because the energy does:
//!   `∫ (q + g t₁)² = ∫ q²` over a period. A contact of an odd number of cells leaves one solution, constant in each
//!   cell. One of an even number leaves none, or solutions that differ by `±w`, with any function `w` of the place in a
//!   cell.
//! - Under a **fixed top** a cycle with an even number of cells of flight has solutions `±w`. The gap below the rod at
//!   rest determines the mean of `w`, and the lower end has to return.
//!
//! Where `w` is free, the constant one of least energy is taken. (Its double is whole, in units of `g t₁`: the reversal
//! of time maps the cycle to itself, and no cell of an even contact to itself.)
//!
//! A solution is an orbit if the ground pushes throughout the contact and the lower end is above it throughout the
//! flight.
//!
//! ```
//! use dalembert::{Numbers, Problem, Top, Units, orbits::Orbit};
//! // Two and a half round trips, one and a half of them in contact.
//! let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(1).build()?;
//! let orbits = Orbit::of_period(Top::Free, 5, 2)?;
//! assert_eq!(orbits.len(), 1);
//! let values = orbits[0].values(&rod, &Units::default(), &1.into(), Numbers::Exact)?.expect("a free rod has no gap");
//! assert_eq!([values.period, values.contact, values.impact_speed].map(|value| value.to_string()), ["5", "3", "1"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::cmp::Ordering;

use thiserror::Error;

use crate::error::Error;
use crate::motion::AtStart;
use crate::number::{
    Estimate, Float, Interval, IntervalPrecision, IntoValue, Number, Rational, Scalar, Value, bits_for_digits,
};
use crate::problem::{Material, Parameter, Parameters, Problem, Top};
use crate::quantity::{Measure, Quantity, Units};
use crate::solve::Numbers;

/// Greatest number of cells of a period: the search takes the square of it.
pub const MOST_CELLS: u32 = 20_000;
/// Greatest number of cells of the periods of [`Orbit::up_to`], which takes the fourth power of it.
pub const MOST_LISTED: u32 = 400;
/// Bits that are computed beyond the digits that were asked for.
const SPARE_BITS: u32 = 32;

/// The reason why a rod has no orbits that can be listed.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum OrbitError {
    /// The rod loses energy.
    #[error("found the damping {0}, expected an undamped rod: a damped one comes to rest")]
    Damped(String),
    /// A free rod without gravity, which flies away.
    #[error("found a free rod without gravity, expected gravity or a fixed top: it flies away for ever")]
    Away,
    /// The rod is a body of a chain.
    #[error("found a body of a chain, expected a single rod")]
    InChain,
    /// An impact speed that is not above zero.
    #[error("found the impact speed {0}, expected one above zero")]
    Speed(String),
    /// A period without cells, or with too many.
    #[error("found a period of {0}/{1} round trips, expected both numbers from 1 to {MOST_CELLS}")]
    Cells(u32, u32),
    /// Periods that are too many to be listed.
    #[error("found periods of up to {1} round trips in parts of 1/{0}, expected at most {MOST_LISTED} parts")]
    Listed(u32, u32),
    /// The rod has numbers that an orbit cannot be computed in.
    #[error(transparent)]
    Numbers(#[from] Box<Error>),
}

/// A periodic motion with one contact in each period, up to its scale.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Orbit {
    top: Top,
    /// Cells of a round trip.
    round_trip: usize,
    /// Cells of the contact, which begins with the period.
    contact: usize,
    /// Twice the arriving wave `q` in each cell of a period, in the unit of speed.
    waves: Vec<i64>,
}

/// The numbers of an orbit.
#[derive(Clone, Debug)]
pub struct OrbitValues {
    /// `T`.
    pub period: Value,
    /// Duration of the contact.
    pub contact: Value,
    /// `−v_t(0,t)` when the contact begins, positive, and `v_t(0,t)` when it ends: played backwards, an orbit is the
    /// same.
    pub impact_speed: Value,
    /// Greatest height of the lower end.
    pub height: Value,
    /// Energy, with the weight: `E_total` of a history.
    pub energy: Value,
    /// Energy above that of the rod at rest, which stands on the ground or hangs.
    pub excess: Value,
}

impl Orbit {
    /// Returns the orbits of the period `T = (cells/round_trip) t₁`, in order of the duration of their contact.
    ///
    /// **Accuracy**: *exact*.
    ///
    /// **Errors**: [`OrbitError::Cells`] for no cells, or for too many.
    ///
    /// ```
    /// use dalembert::{Top, orbits::Orbit};
    /// // The first nonsmooth mode: contact and period together take two round trips.
    /// let modes = Orbit::of_period(Top::Fixed, 67, 40)?;
    /// assert_eq!((modes.len(), modes[0].contact_ratio()), (1, "13/40".parse()?));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_period(top: Top, cells: u32, round_trip: u32) -> Result<Vec<Orbit>, OrbitError> {
        let shared = gcd(cells, round_trip).max(1);
        let (cells, round_trip) = (cells / shared, round_trip / shared);
        if cells == 0 || round_trip == 0 || cells.max(round_trip) > MOST_CELLS {
            return Err(OrbitError::Cells(cells, round_trip));
        }
        let (cells, round_trip) = (cells as usize, round_trip as usize);
        Ok((1..cells).filter_map(|contact| Orbit::new(top, cells, round_trip, contact)).collect())
    }

    /// Returns the orbits of at most `finest` cells in a round trip whose periods are at most `longest` round trips, in
    /// order of their periods.
    ///
    /// **Errors**: [`OrbitError::Listed`] where the greatest of these periods has more than [`MOST_LISTED`] cells.
    pub fn up_to(top: Top, finest: u32, longest: u32) -> Result<Vec<Orbit>, OrbitError> {
        if finest.saturating_mul(longest) > MOST_LISTED {
            return Err(OrbitError::Listed(finest, longest));
        }
        let mut orbits = Vec::new();
        for round_trip in 1..=finest {
            for cells in (1..=longest * round_trip).filter(|cells| gcd(*cells, round_trip) == 1) {
                orbits.extend(Orbit::of_period(top, cells, round_trip)?);
            }
        }
        orbits.sort_by_cached_key(|orbit| (orbit.period_ratio(), orbit.contact_ratio()));
        Ok(orbits)
    }

    fn new(top: Top, cells: usize, round_trip: usize, contact: usize) -> Option<Self> {
        let waves = waves(top, cells, round_trip, contact)?;
        let (pressed, flight) = waves.split_at(contact);
        // A cell without force at an end of the contact could as well be one of the flight.
        let pushes = pressed.iter().all(|wave| *wave <= 0) && pressed[0] < 0 && pressed[pressed.len() - 1] < 0;
        let heights: Vec<i64> = flight
            .iter()
            .scan(0, |height, wave| {
                *height += wave;
                Some(*height)
            })
            .collect();
        let (landing, above) = heights.split_last()?;
        let flies = !above.is_empty() && above.iter().all(|height| *height > 0) && *landing == 0;
        (pushes && flies).then_some(Orbit { top, round_trip, contact, waves })
    }

    /// Returns `T/t₁`.
    pub fn period_ratio(&self) -> Rational {
        self.in_round_trips(self.waves.len())
    }

    /// Returns the duration of the contact over `t₁`.
    pub fn contact_ratio(&self) -> Rational {
        self.in_round_trips(self.contact)
    }

    /// Returns whether period and contact together take `4 t₁` under a free top, `2 t₁` under a fixed one: the orbits
    /// that begin with the gentlest touch and the period `4L/c` of the rod that is held at one end.
    pub fn is_of_first_branch(&self) -> bool {
        let round_trips = if self.top == Top::Free { 4 } else { 2 };
        self.waves.len() + self.contact == round_trips * self.round_trip
    }

    fn in_round_trips(&self, cells: usize) -> Rational {
        Rational::from(cells as i64) / Rational::from(self.round_trip as i64)
    }

    /// Returns twice the wave that leaves the ground in a cell.
    fn leaving(&self, cell: usize) -> i64 {
        if cell < self.contact { -self.waves[cell] } else { self.waves[cell] }
    }

    /// Returns the pieces of the rod at the landing, from the ground up: the width in `L/n`, and twice the waves
    /// downwards and upwards, without what gravity adds.
    fn pieces(&self) -> impl Iterator<Item = (i64, i64, i64)> + '_ {
        let (cells, n) = (self.waves.len(), self.round_trip);
        (0..n.div_ceil(2)).map(move |k| {
            let width = if 2 * k + 1 == n { 1 } else { 2 };
            (width, self.waves[k % cells], self.leaving(cells - 1 - k % cells))
        })
    }

    /// Returns four times the mean of the waves downwards less those upwards, times `n`, and sixteen times that of the
    /// sum of their squares.
    fn sums(&self) -> [i64; 2] {
        self.pieces().fold([0, 0], |[difference, squares], (width, down, up)| {
            [difference + width * (down - up), squares + width * (down * down + up * up)]
        })
    }

    /// Returns the unit of speed in `problem`: `g t₁` under a free top; under a fixed one that which the gap
    /// determines, `free` where it determines none. `None` where the rod has no such orbit: it hangs clear of the
    /// ground, and the orbit presses it down, or the other way round.
    fn unit<S: Scalar>(&self, problem: &Problem, rod: &Parameters<S>, free: &Number) -> Option<S> {
        if self.top == Top::Free {
            return Some(rod.critical_speed());
        }
        let [difference, _] = self.sums();
        match (difference.cmp(&0), clearance(problem).cmp(&Rational::default())) {
            (Ordering::Equal, Ordering::Equal) => Some(S::from_number(free, &rod.length.precision())),
            (a, b) if a == b => {
                let mean = rod.length.ratio(difference, 4 * self.round_trip as i64);
                Some(reach(problem, rod) / mean)
            }
            _ => None,
        }
    }

    /// Returns the numbers of the orbit of the rod of `problem`, whose numbers have the `units`; `free` is the impact
    /// speed where the rod hangs exactly to the ground and any speed will do. `None` where the rod has no such orbit,
    /// because of its gap.
    ///
    /// **Accuracy**: *exact* in fractions, *within its bound* otherwise.
    ///
    /// **Errors**: [`OrbitError`], also for fractions where the wave speed is a root.
    pub fn values(
        &self,
        problem: &Problem,
        units: &Units,
        free: &Number,
        numbers: Numbers,
    ) -> Result<Option<OrbitValues>, OrbitError> {
        checked(problem, free)?;
        match numbers {
            Numbers::Double(_) => self.values_in::<Estimate<f64>>(problem, units, free, (&(), 0)),
            Numbers::Exact | Numbers::ExactThenDigits(_) => self.values_in::<Rational>(problem, units, free, (&(), 0)),
            Numbers::Digits(digits) => {
                let bits = bits_for_digits(digits) + SPARE_BITS;
                self.values_in::<Estimate<Float>>(problem, units, free, (&bits, digits))
            }
            Numbers::Certified(digits) => {
                let precision = IntervalPrecision::with_exact(bits_for_digits(digits) + SPARE_BITS);
                self.values_in::<Interval>(problem, units, free, (&precision, digits))
            }
        }
    }

    fn values_in<S: Scalar + IntoValue>(
        &self,
        problem: &Problem,
        units: &Units,
        free: &Number,
        (precision, digits): (&S::Precision, u32),
    ) -> Result<Option<OrbitValues>, OrbitError> {
        let rod = Parameters::<S>::of(problem, precision).map_err(Box::new)?;
        let Some(unit) = self.unit(problem, &rod, free) else { return Ok(None) };
        let Parameters { length, wave_speed, gravity, .. } = &rod;
        let n = self.round_trip as i64;
        let cell = rod.round_trip() / length.int(n);
        let [difference, squares] = self.sums();
        // g L/c.
        let weight = gravity.clone() * length / wave_speed;
        let vibration = unit.square() * length.ratio(squares, 16 * n);
        let energy = vibration.clone()
            + weight.clone() * &unit * length.ratio(difference, 4 * n)
            + weight.square() / length.int(3);
        let excess = match self.top {
            Top::Free => energy.clone() + weight.square() / length.int(6),
            // A rod that hangs clear of the ground, and one that stands pressed on it.
            Top::Fixed if difference >= 0 => vibration,
            Top::Fixed => vibration - reach(problem, &rod).square() / length.int(2),
        };
        let factor = units.factor::<S>(Measure::Energy, precision).unwrap_or_else(|| length.one());
        let factor = factor * length;
        let wave = |wave: i64| unit.clone() * length.ratio(wave, 2);
        let (mut height, mut highest) = (0, 0);
        for wave in &self.waves[self.contact..] {
            height += wave;
            highest = highest.max(height);
        }
        let value = |number: S, measure: Measure| number.into().printed_in(digits, units.name(measure));
        Ok(Some(OrbitValues {
            period: value(cell.clone() * length.int(self.waves.len() as i64), Measure::Time),
            contact: value(cell.clone() * length.int(self.contact as i64), Measure::Time),
            impact_speed: value(wave(-self.waves[self.waves.len() - 1]), Measure::Velocity),
            height: value(wave(highest) * cell, Measure::Length),
            energy: value(energy * &factor, Measure::Energy),
            excess: value(excess * factor, Measure::Energy),
        }))
    }

    /// Returns the problem that starts with the impact of the orbit and runs through `periods` of it: its strain and
    /// its velocity at t = 0. `None` as in [`Orbit::values`].
    ///
    /// **Accuracy**: *exact*.
    ///
    /// **Errors**: [`OrbitError`], also where the wave speed is no fraction.
    pub fn start(&self, problem: &Problem, free: &Number, periods: u32) -> Result<Option<Problem>, OrbitError> {
        checked(problem, free)?;
        let rod = Parameters::<Rational>::of(problem, &()).map_err(Box::new)?;
        let Some(unit) = self.unit(problem, &rod, free) else { return Ok(None) };
        let Parameters { length, wave_speed, gravity, .. } = &rod;
        let bend = gravity.clone() / wave_speed / wave_speed;
        let (mut strain, mut velocity) = (Vec::new(), Vec::new());
        let (mut x, mut cells) = (length.zero(), 0);
        for (width, down, up) in self.pieces() {
            cells += width;
            let next = length.clone() * length.ratio(cells, self.round_trip as i64);
            let half = |twice: i64| unit.clone() * length.ratio(twice, 4);
            for x in [&x, &next] {
                strain.push((x.clone(), half(down - up) / wave_speed + bend.clone() * x));
                velocity.push((x.clone(), half(down + up)));
            }
            x = next;
        }
        let time = rod.round_trip() * self.period_ratio() * length.int(i64::from(periods));
        let builder = problem.to_builder().strain(merged(strain)).velocity(merged(velocity)).time(time);
        Ok(Some(builder.build().map_err(|error| Box::new(error.into()))?))
    }

    /// Estimates the factor by which a small disturbance of the orbit grows in each period: 1 where it does not, above
    /// 1 where the orbit is unstable. The disturbance makes all velocities of the start greater, or smaller, by the
    /// same part. The factor is that of the derivative of the energy of the centre of mass after each contact, from the
    /// first half of `periods` periods to the second. `None` where first order does not decide the order of events, on
    /// either side.
    ///
    /// **Accuracy**: an estimate, by exact derivatives. One disturbance does not see every direction, and a derivative
    /// that grows like the number of periods gives a factor a little above 1.
    ///
    /// **Errors**: [`OrbitError`], also where the wave speed is no fraction.
    ///
    /// ```
    /// use dalembert::{Problem, Top, orbits::Orbit};
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(1).build()?;
    /// let growth = |cells, round_trip, place: usize| {
    ///     Orbit::of_period(Top::Free, cells, round_trip).ok()?[place].growth(&rod, &1.into(), 16).ok()?
    /// };
    /// assert!(growth(5, 2, 0).is_some_and(|factor| factor == 1.0));
    /// assert!(growth(10, 3, 0).is_some_and(|factor| (factor - 2.893).abs() < 0.001));
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn growth(&self, problem: &Problem, free: &Number, periods: u32) -> Result<Option<f64>, OrbitError> {
        let Some(start) = self.start(problem, free, periods)? else { return Ok(None) };
        let quantities = [Quantity::TranslationalAfter];
        let rows = start.exact().and_then(|history| history.derivatives(Parameter::Velocity(None), &quantities));
        let sizes: Vec<[Option<f64>; 2]> = rows
            .map_err(Box::new)?
            .iter()
            .filter_map(|row| row[0].as_ref())
            .map(|found| found.sides().map(|side| side.ok().map(|rate| Scalar::to_f64(rate).abs())))
            .collect();
        // Disturbances that come and go are compared at their greatest.
        let part = sizes.len() / 2;
        let greatest = |side: usize, from: usize| {
            let rates = sizes.get(from..from + part)?.iter().map(|sides| sides[side]);
            rates.flatten().reduce(f64::max).filter(|rate| *rate > 0.0)
        };
        let factor = |side: usize| {
            let growth = greatest(side, part)? / greatest(side, 0)?;
            Some(growth.powf((part as f64).recip()))
        };
        Ok([0, 1].into_iter().filter_map(factor).reduce(f64::max))
    }
}

/// Returns the points without those that repeat one, or that lie on the line between their neighbours.
fn merged(points: Vec<(Rational, Rational)>) -> Vec<(Rational, Rational)> {
    let mut kept: Vec<(Rational, Rational)> = Vec::new();
    for point in points {
        let slope = |a: &(Rational, Rational), b: &(Rational, Rational)| {
            (a.0 < b.0).then(|| (b.1.clone() - &a.1) / (b.0.clone() - &a.0))
        };
        match kept.as_slice() {
            [.., last] if *last == point => continue,
            [.., first, last] if slope(first, last).is_some() && slope(first, last) == slope(last, &point) => {
                kept.pop();
            }
            _ => {}
        }
        kept.push(point);
    }
    kept
}

/// Refuses a rod that has no orbits to be listed, and an impact speed that is not above zero.
fn checked(problem: &Problem, free: &Number) -> Result<(), OrbitError> {
    if free.to_f64() <= 0.0 {
        return Err(OrbitError::Speed(free.to_string()));
    }
    if problem.in_chain.is_some() {
        return Err(OrbitError::InChain);
    }
    if let Some(damping) = problem.damping() {
        return Err(OrbitError::Damped(damping.to_string()));
    }
    if problem.top() == Top::Free && problem.gravity().is_none() {
        return Err(OrbitError::Away);
    }
    Ok(())
}

/// Returns `G c/L − g L/2c` with the displacement `G` of the top: `c/L` times the height of the lower end of the rod at
/// rest, which hangs from its top; negative for a rod that stands on the ground.
fn reach<S: Scalar>(problem: &Problem, rod: &Parameters<S>) -> S {
    let Parameters { length, wave_speed, gravity, .. } = rod;
    let gap = AtStart::of(problem, rod).top();
    gap * wave_speed / length - gravity.clone() * length / wave_speed / length.int(2)
}

/// Returns a number of the sign of [`reach`], `2 G c² − g L²`, which needs no square root.
fn clearance(problem: &Problem) -> Rational {
    let square = match problem.material() {
        Material::WaveSpeed(speed) => speed.to_rational() * speed.to_rational(),
        Material::Elastic { modulus, density, .. } => modulus.to_rational() / density.to_rational(),
    };
    let (length, zero) = (problem.length().to_rational(), Rational::default());
    let gravity = problem.gravity().map_or_else(Rational::default, Number::to_rational);
    let weight = gravity.clone() * &length * &length;
    // The start needs the length alone.
    let rod = Parameters { length, wave_speed: square.clone(), damping: zero.clone(), gravity, speed: zero };
    AtStart::of(problem, &rod).top() * square * Rational::from(2) - weight
}

/// Returns twice the arriving wave in each cell, in the unit of speed; `None` where there is no solution.
fn waves(top: Top, cells: usize, round_trip: usize, contact: usize) -> Option<Vec<i64>> {
    // The wave in a cell is `factor` times that of the first one and `twice/2`.
    let (mut factor, mut twice) = (1_i64, 0_i64);
    let mut found = vec![(0, 0); cells];
    let mut cell = 0;
    for _ in 0..cells {
        found[cell] = (factor, twice);
        let sign = if cell < contact { -1 } else { 1 };
        (factor, twice) = match top {
            Top::Free => (sign * factor, sign * twice - 2),
            Top::Fixed => (-sign * factor, 0),
        };
        cell = (cell + round_trip) % cells;
    }
    let first = match (top, factor) {
        (Top::Free, -1) => twice / 2,
        (Top::Free, _) if twice == 0 => -found.iter().map(|(factor, twice)| factor * twice).sum::<i64>() / cells as i64,
        // Compressed at the beginning of the contact.
        (Top::Fixed, 1) => -2,
        _ => return None,
    };
    Some(found.into_iter().map(|(factor, twice)| factor * first + twice).collect())
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
#[path = "tests/orbits.rs"]
mod tests;
