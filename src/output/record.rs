//! What is printed, as plain data: gathered once from the history, formatted in several ways.

use crate::error::Error;
use crate::motion::{Contact, Ending, Energy, Event, Motion, Side, StressPiece};
use crate::number::{DOUBLE_DIGITS, Number, Scalar, double_bound_text, show, shown_bound_text};
use crate::quantity::{EnergyShares, Flight, Restitution, energy_shares, flights, restitution};

/// A number that carries its bound as a JSON value: a number for a double (null if not finite),
/// `{"value": …, "lo": …, "hi": …}` with `lo ≤ truth ≤ hi` for an enclosure, a string otherwise.
pub(crate) fn json<S: Scalar>(x: &S, digits: u32) -> serde_json::Value {
    let text = show(x, if digits == 0 { DOUBLE_DIGITS } else { digits });
    match (x.as_double(), x.ends(digits)) {
        (Some(value), _) if !value.is_finite() => serde_json::Value::Null,
        (Some(_), _) if text == "0" => 0.0.into(),
        (Some(value), _) => value.into(),
        (None, Some([lo, hi])) => serde_json::json!({"value": text, "lo": lo, "hi": hi}),
        (None, None) => text.into(),
    }
}

/// The bound of the error of a number as it is printed, as a JSON value: a number where a double holds it, a string
/// otherwise; `null` for an enclosure, which has it in itself.
pub(crate) fn bound_json<S: Scalar>(x: &S, digits: u32) -> serde_json::Value {
    if x.ends(1).is_some() {
        return serde_json::Value::Null;
    }
    let text = match x.as_double() {
        Some(_) if show(x, DOUBLE_DIGITS) != "0" => double_bound_text(x),
        _ => shown_bound_text(x, if digits == 0 { DOUBLE_DIGITS } else { digits }),
    };
    match text.parse::<f64>() {
        Ok(bound) if bound > 0.0 || text == "0" => bound.into(),
        _ => text.into(),
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
    /// `c`, `t₁`, `R` and `M`.
    pub parameters: String,
    /// Whether a table may be wider than 80 characters.
    pub wide: bool,
    /// Whether the symbols of a table are explained below it.
    pub legend: bool,
    /// `ρS` where the scene gives it: what turns strains into newtons.
    pub line_density: Option<(Number, Number)>,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// Where an exact run ended, if a run in digits stands in for it.
    pub exact_until: Option<Ending>,
}

/// A contact, its coefficients, and the energies at its end if it has one.
#[derive(Clone, Debug)]
pub struct Finished<S> {
    /// The contact.
    pub contact: Contact<S>,
    /// `e_P` and `e_E²`.
    pub restitution: Restitution<S>,
    /// The factors of `e_E²`.
    pub shares: EnergyShares<S>,
    /// The energies at its end.
    pub energy: Option<Energy<S>>,
}

impl<S> Finished<S> {
    /// `from`, `to`, impulse, peak strain, `e_P`, `e_E²`, `E`, `E_h`, `E_z`: the columns of a table of contacts.
    pub(super) fn columns(&self) -> [Option<&S>; 9] {
        let Finished { contact, restitution, energy, .. } = self;
        let energy = energy.as_ref();
        [
            Some(&contact.from),
            contact.to.as_ref(),
            Some(&contact.impulse),
            Some(&contact.peak_stress),
            restitution.momentum.as_ref().ok(),
            restitution.energy_squared.as_ref().ok(),
            energy.map(|e| &e.total),
            energy.map(|e| &e.translational),
            energy.map(|e| &e.vibrational),
        ]
    }
}

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
    /// Bound on the error relative to the natural scales; zero where all is exact.
    pub error: f64,
    /// Impacts, and the digits that rounding may have taken over them; `None` where that is not followed.
    pub lost: Option<(u32, f64)>,
}

impl<S> Record<S> {
    /// Every number that is printed.
    pub fn numbers(&self) -> Vec<&S> {
        let mut all = vec![&self.end.0];
        all.extend(self.events.iter().flat_map(Event::numbers));
        for Finished { contact, restitution, shares, energy } in &self.contacts {
            all.extend(contact.numbers());
            all.extend(restitution.numbers());
            all.extend(shares.numbers());
            all.extend(energy.iter().flat_map(Energy::numbers));
        }
        all.extend(self.flights.iter().flat_map(Flight::numbers));
        all.extend(self.stress.iter().flat_map(|piece| [&piece.from, &piece.to, &piece.left, &piece.right]));
        all
    }
}

/// Gathers what is printed of `history`; the stress at the ground only if asked for, as it can cost more than all the
/// rest.
pub fn record<S: Scalar>(history: &dyn Motion<S>, head: &Head, stress: bool) -> Result<Record<S>, Error> {
    let end = history.end();
    let lift = |number: &Number| S::from_number(number, &end.precision());
    let scales = history.scales();
    let mut contacts = Vec::with_capacity(history.contacts().len());
    for contact in history.contacts() {
        contacts.push(Finished {
            energy: contact.to.as_ref().map(|to| history.energy(to)).transpose()?,
            restitution: restitution(history, contact)?,
            shares: energy_shares(history, contact)?,
            contact: contact.clone(),
        });
    }
    let forces = head.line_density.as_ref().map(|(density, area)| {
        let line = lift(density) * lift(area);
        (scales.wave_speed.square() * &line, line)
    });
    Ok(Record {
        events: history.events().to_vec(),
        contacts,
        flights: flights(history)?,
        stress: if stress { history.stress_pieces() } else { Vec::new() },
        end: (end, history.ending().clone()),
        forces,
        error: history.error_estimate().to_f64(),
        lost: history.digits_lost(),
    })
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
    history: &dyn Motion<S>,
    quantity: Quantity,
    times: &[S],
    points: &[S],
    side: Side,
) -> Result<Vec<Sample<S>>, Error> {
    let mut rows = Vec::new();
    for time in times {
        let mut row = |point, values| rows.push(Sample { time: time.clone(), point, side, values });
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
