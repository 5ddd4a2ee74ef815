//! What is printed, as plain data: gathered once from the history, formatted in several ways.

use crate::error::Error;
use crate::history::{Contact, Ending, Energy, Event, History, Side, StressPiece};
use crate::number::{Number, Scalar};
use crate::quantity::{Flight, Restitution, flights, restitution};

/// A number as it is printed. Rounded once, here.
pub trait Show: Scalar {
    /// The text: shortest for doubles, `3/2` for fractions, `digits` significant digits for a `Float`.
    fn show(&self, digits: u32) -> String;

    /// The JSON value: a number for doubles (null if not finite), a string otherwise.
    fn json(&self, digits: u32) -> serde_json::Value {
        self.show(digits).into()
    }
}

impl Show for f64 {
    fn show(&self, _: u32) -> String {
        self.text()
    }

    fn json(&self, _: u32) -> serde_json::Value {
        serde_json::Number::from_f64(*self).map_or(serde_json::Value::Null, Into::into)
    }
}

#[cfg(feature = "mp")]
impl Show for rug::Rational {
    fn show(&self, _: u32) -> String {
        self.to_string()
    }
}

#[cfg(feature = "mp")]
impl Show for crate::number::Interval {
    /// Digits that are proved, see [`crate::solve::proved_digits`].
    fn show(&self, digits: u32) -> String {
        crate::solve::proved_digits(self, digits)
    }

    /// `{"value": …, "lo": …, "hi": …}` with `lo ≤ truth ≤ hi`.
    fn json(&self, digits: u32) -> serde_json::Value {
        let [lo, hi] = crate::solve::proved_ends(self, digits);
        serde_json::json!({"value": self.show(digits), "lo": lo, "hi": hi})
    }
}

#[cfg(feature = "mp")]
impl Show for rug::Float {
    fn show(&self, digits: u32) -> String {
        self.to_rational().map_or_else(|| self.to_string(), |value| crate::number::decimal(&value, digits))
    }
}

/// What stands above the numbers.
#[derive(Clone, Debug, Default)]
pub struct Head {
    /// The title of the scene.
    pub title: Option<String>,
    /// The number system in words.
    pub number: String,
    /// The effects that the scene calls for.
    pub effects: Vec<&'static str>,
    /// Digits that a `Float` shows.
    pub digits: u32,
    /// `ρS` where the scene gives it: what turns strains into newtons.
    pub line_density: Option<(Number, Number)>,
    /// Where an exact run ended, if a run in digits stands in for it.
    pub exact_until: Option<Ending>,
}

/// A contact, its coefficients, and the energies at its end if it has one.
pub type Finished<S> = (Contact<S>, Restitution<S>, Option<Energy<S>>);

/// A history, ready to be printed.
#[derive(Clone, Debug)]
pub struct Record<S> {
    /// Impacts and releases.
    pub events: Vec<Event<S>>,
    /// Contacts with their coefficients and the energies at their ends.
    pub contacts: Vec<Finished<S>>,
    /// Flights with their tops.
    pub flights: Vec<Flight<S>>,
    /// The stress at the ground, where it is asked for.
    pub stress: Vec<StressPiece<S>>,
    /// The last time that is known, and why.
    pub end: (S, Ending),
    /// `ρS c²` and `ρS`: newtons per unit strain, kilograms per metre.
    pub forces: Option<(S, S)>,
    /// Bound on the error relative to the natural scales; `None` where all is exact.
    pub error: Option<S>,
    /// Impacts, and the digits that rounding may have taken over them; `None` where that is not followed.
    pub lost: Option<(u32, f64)>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

impl<S> Record<S> {
    /// Every number that is printed.
    pub fn numbers(&self) -> Vec<&S> {
        let mut all = vec![&self.end.0];
        for event in &self.events {
            all.extend([&event.time, &event.end_velocity, &event.centre, &event.centre_velocity]);
        }
        for (contact, restitution, energy) in &self.contacts {
            all.extend([&contact.from, &contact.impulse, &contact.peak_stress]);
            all.extend(&contact.to);
            all.extend(restitution.momentum.iter().chain(&restitution.energy_squared));
            all.extend(restitution.translational_part.iter().chain(&restitution.energy_kept));
            all.extend(energy.iter().flat_map(|e| [&e.total, &e.translational, &e.vibrational]));
        }
        for flight in &self.flights {
            all.push(&flight.from);
            all.extend(&flight.to);
            all.extend(flight.highest.iter().flat_map(|(time, centre)| [time, centre]));
        }
        all.extend(self.stress.iter().flat_map(|piece| [&piece.from, &piece.to, &piece.left, &piece.right]));
        all
    }
}

/// Gathers what is printed of `history`; the stress at the ground only if asked for, as it can cost more than all the rest.
pub fn record<S: Scalar>(history: &dyn History<S>, head: &Head, stress: bool) -> Result<Record<S>, Error> {
    let end = history.end();
    let lift = |number: &Number| S::from_number(number, &end.precision());
    let scales = history.scales();
    let error = (!S::RIGOROUS).then(|| history.error_estimate());
    let mut contacts = Vec::with_capacity(history.contacts().len());
    for contact in history.contacts() {
        let energy = match &contact.to {
            Some(to) => Some(history.energy(to)?),
            None => None,
        };
        contacts.push((contact.clone(), restitution(history, contact)?, energy));
    }
    let forces = head.line_density.as_ref().map(|(density, area)| {
        let line = lift(density) * lift(area);
        (scales.wave_speed.square() * &line, line)
    });
    let mut record = Record {
        events: history.events().to_vec(),
        contacts,
        flights: flights(history),
        stress: if stress { history.stress_pieces() } else { Vec::new() },
        end: (end, history.ending().clone()),
        forces,
        error,
        lost: history.digits_lost(),
        warnings: history.warnings().to_vec(),
    };
    if let Some(Bounds { rise: of_rise, speed: of_speed, strain: of_strain, energy: of_energy, ratio }) =
        Bounds::of(history)
    {
        for event in &mut record.events {
            vanish(&mut event.centre, &of_rise);
            vanish(&mut event.centre_velocity, &of_speed);
            vanish(&mut event.end_velocity, &of_speed);
        }
        for piece in &mut record.stress {
            vanish(&mut piece.left, &of_strain);
            vanish(&mut piece.right, &of_strain);
        }
        for (_, restitution, energy) in &mut record.contacts {
            if let Ok(momentum) = &mut restitution.momentum {
                vanish(momentum, &ratio);
            }
            if let Some(energy) = energy {
                vanish(&mut energy.vibrational, &of_energy);
                vanish(&mut energy.translational, &of_energy);
            }
        }
    }
    Ok(record)
}

/// What lies below the error bound of a long-digit run is a zero whose digits nobody can give.
struct Bounds<S> {
    rise: S,
    speed: S,
    strain: S,
    energy: S,
    ratio: S,
}

impl<S: Scalar> Bounds<S> {
    /// `None` for doubles, which are printed as they are, and for fractions.
    fn of(history: &dyn History<S>) -> Option<Self> {
        let (scales, error) = (history.scales(), history.error_estimate());
        if S::RIGOROUS || error.bits()? <= f64::MANTISSA_DIGITS {
            return None;
        }
        let ratio = error.int(16) * &error;
        let speed = ratio.clone() * &scales.velocity;
        Some(Bounds {
            rise: speed.clone() * &scales.time,
            strain: speed.clone() / &scales.wave_speed,
            energy: speed.clone() * &scales.velocity * &scales.length,
            speed,
            ratio,
        })
    }

    /// In the order of [`Quantity::names`].
    fn of_values(&self, quantity: Quantity) -> [&S; 3] {
        let Bounds { rise, speed, strain, energy, .. } = self;
        match quantity {
            Quantity::Stress => [strain; 3],
            Quantity::End | Quantity::Top | Quantity::Centre | Quantity::Field => [rise, speed, strain],
            Quantity::Energy => [energy; 3],
        }
    }
}

fn vanish<S: Scalar>(value: &mut S, bound: &S) {
    if value.magnitude() <= *bound {
        *value = value.zero();
    }
}

/// What `sample` can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Quantity {
    /// `v_x(0,t)`.
    Stress,
    /// `v(0,t)`, `v_t(0,t)`.
    End,
    /// `v(L,t)`, `v_t(L,t)`.
    Top,
    /// `h`, `h′`.
    Centre,
    /// `E`, `E_h`, `E_z`.
    Energy,
    /// `v`, `v_t`, `v_x` at points.
    Field,
}

impl Quantity {
    /// The name of the quantity itself.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Stress => "stress",
            Quantity::End => "end",
            Quantity::Top => "top",
            Quantity::Centre => "centre",
            Quantity::Energy => "energy",
            Quantity::Field => "field",
        }
    }

    /// The names of its values.
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Quantity::Stress => &["v_x"],
            Quantity::End | Quantity::Top => &["v", "v_t"],
            Quantity::Centre => &["h", "h_rate"],
            Quantity::Energy => &["total", "translational", "vibrational"],
            Quantity::Field => &["v", "v_t", "v_x"],
        }
    }
}

/// A value of a quantity, or several.
#[derive(Clone, Debug)]
pub struct Sample<S> {
    /// `t`.
    pub time: S,
    /// `x`, for the field.
    pub point: Option<S>,
    /// Which limit.
    pub side: Side,
    /// In the order of [`Quantity::names`].
    pub values: Vec<S>,
}

/// The values of `quantity` at every time and, for the field, at every point.
pub fn sample<S: Scalar>(
    history: &dyn History<S>,
    quantity: Quantity,
    times: &[S],
    points: &[S],
    side: Side,
) -> Result<Vec<Sample<S>>, Error> {
    let mut rows = Vec::new();
    let bounds = Bounds::of(history);
    for time in times {
        let mut row = |point: Option<S>, mut values: Vec<S>| {
            if let Some(bounds) = &bounds {
                for (value, bound) in values.iter_mut().zip(bounds.of_values(quantity)) {
                    vanish(value, bound);
                }
            }
            rows.push(Sample { time: time.clone(), point, side, values });
        };
        match quantity {
            Quantity::Stress => row(None, vec![history.stress(time, side)?]),
            Quantity::End => row(None, history.ground_end(time, side).map(|(v, rate)| vec![v, rate])?),
            Quantity::Top => row(None, history.top_end(time, side).map(|(v, rate)| vec![v, rate])?),
            Quantity::Centre => row(None, history.centre(time).map(|(h, rate)| vec![h, rate])?),
            Quantity::Energy => {
                row(None, history.energy(time).map(|e| vec![e.total, e.translational, e.vibrational])?);
            }
            Quantity::Field => {
                for point in points {
                    let field = history.field(point, time, side)?;
                    row(Some(point.clone()), vec![field.displacement, field.velocity, field.strain]);
                }
            }
        }
    }
    Ok(rows)
}
