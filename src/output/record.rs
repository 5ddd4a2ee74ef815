//! What is printed, as plain data: gathered once from the history, formatted in several ways.

use crate::error::Error;
use crate::motion::{Contact, Ending, Energy, Event, Motion, Side, StressPiece};
use crate::number::Scalar;
use crate::quantity::{EnergyShares, Flight, Measure, Restitution, Units, energy_shares, flights, restitution};
use crate::reason::Warning;
use crate::solve::ExactnessEnd;

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
    /// What gives strains and values per `ρS` a unit.
    pub units: Units,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    /// What fractions could not hold, if a run in digits stands in for them.
    pub exact_until: Option<ExactnessEnd>,
}

/// A column of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Column {
    /// The head in a table.
    pub(super) head: &'static str,
    /// The name in CSV and JSON.
    pub(super) name: &'static str,
    /// What it measures; `None` for a ratio.
    pub(super) measure: Option<Measure>,
}

/// A column whose head is its name.
pub(super) const fn column(name: &'static str, measure: Measure) -> Column {
    headed(name, name, measure)
}

const fn headed(head: &'static str, name: &'static str, measure: Measure) -> Column {
    Column { head, name, measure: Some(measure) }
}

impl Column {
    /// Whether it is there: stress and force are with a material only.
    pub(super) fn is_present(&self, units: &Units) -> bool {
        units.has_material() || !matches!(self.measure, Some(Measure::Stress | Measure::Force))
    }

    /// The name with its unit where one is known: `impulse [N s]`.
    pub(super) fn with_unit(&self, units: &Units) -> String {
        self.with_suffix("", units)
    }

    /// The name with something after it, and its unit.
    pub(super) fn with_suffix(&self, suffix: &str, units: &Units) -> String {
        match self.measure.map_or("", |measure| units.name(measure)) {
            "" => format!("{}{suffix}", self.name),
            unit => format!("{}{suffix} [{unit}]", self.name),
        }
    }
}

/// What turns the numbers of a history into those of columns, where they are not the same.
pub(super) struct Factors<S>(Vec<Option<S>>);

impl<S: Scalar> Factors<S> {
    /// One for each column, in the precision of `number`.
    pub(super) fn new<'a>(columns: impl Iterator<Item = &'a Column>, units: &Units, number: &S) -> Self {
        let scaled = |measure: &Measure| {
            let kept = matches!(measure, Measure::Time | Measure::Length | Measure::Velocity | Measure::Strain);
            units.has_material() && !kept
        };
        let factor = |column: &Column| units.factor(column.measure.filter(scaled)?, &number.precision());
        Factors(columns.map(factor).collect())
    }

    pub(super) fn scale(&self, column: usize, value: &S) -> S {
        match self.0.get(column) {
            Some(Some(factor)) => value.clone() * factor,
            _ => value.clone(),
        }
    }
}

/// The columns of a table of contacts.
pub(super) const CONTACT: [Column; 11] = [
    headed("contact from", "from", Measure::Time),
    column("to", Measure::Time),
    column("impulse", Measure::Impulse),
    headed("peak v_x(0,t)", "peak_strain", Measure::Strain),
    headed("peak stress", "peak_stress", Measure::Stress),
    headed("peak force", "peak_force", Measure::Force),
    Column { head: "e_P", name: "restitution_momentum", measure: None },
    Column { head: "e_E²", name: "restitution_energy_squared", measure: None },
    headed("E", "total", Measure::Energy),
    headed("E_h", "translational", Measure::Energy),
    headed("E_z", "vibrational", Measure::Energy),
];

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

impl<S: Scalar> Finished<S> {
    /// The numbers of the columns [`CONTACT`] that these units have.
    pub(super) fn columns(&self, units: &Units) -> Vec<Option<S>> {
        let Finished { contact, restitution, energy, .. } = self;
        let (energy, peak) = (energy.as_ref(), Some(&contact.peak_strain));
        let values = [
            Some(&contact.from),
            contact.to.as_ref(),
            Some(&contact.impulse),
            peak,
            peak,
            peak,
            restitution.momentum.as_ref().ok(),
            restitution.energy_squared.as_ref().ok(),
            energy.map(|e| &e.total),
            energy.map(|e| &e.translational),
            energy.map(|e| &e.vibrational),
        ];
        let factors = Factors::new(CONTACT.iter(), units, &contact.from);
        let scaled = values.iter().enumerate().map(|(k, value)| value.map(|value| factors.scale(k, value)));
        let present = scaled.zip(&CONTACT).filter(|(_, column)| column.is_present(units));
        present.map(|(value, _)| value).collect()
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
    /// The stress at the ground in equal parts of the history, where a line of blocks shows it.
    pub outline: Vec<f64>,
    /// The last time that is known, and why.
    pub end: (S, Ending),
    /// Bound on the error relative to the natural scales; zero where all is exact.
    pub error: f64,
    /// Impacts, and the digits that rounding may have taken over them; `None` where that is not followed.
    pub lost: Option<(u32, f64)>,
}

impl<S> Record<S> {
    /// Every number that is printed, with or without those that are ratios of others.
    pub fn numbers(&self, ratios: bool) -> Vec<&S> {
        let mut all = vec![&self.end.0];
        all.extend(self.events.iter().flat_map(Event::numbers));
        for Finished { contact, restitution, shares, energy } in &self.contacts {
            all.extend(contact.numbers());
            if ratios {
                all.extend(restitution.numbers());
                all.extend(shares.numbers());
            }
            all.extend(energy.iter().flat_map(Energy::numbers));
        }
        all.extend(self.flights.iter().flat_map(Flight::numbers));
        all.extend(self.stress.iter().flat_map(|piece| [&piece.from, &piece.to, &piece.left, &piece.right]));
        all
    }
}

/// Gathers what is printed of `history`; the stress at the ground only if asked for, as it can cost more than all the
/// rest.
pub fn record<S: Scalar>(history: &dyn Motion<S>, stress: bool) -> Result<Record<S>, Error> {
    let end = history.end();
    let mut contacts = Vec::with_capacity(history.contacts().len());
    for contact in history.contacts() {
        contacts.push(Finished {
            energy: contact.to.as_ref().map(|to| history.energy(to)).transpose()?,
            restitution: restitution(history, contact.times())?,
            shares: energy_shares(history, contact.times())?,
            contact: contact.clone(),
        });
    }
    Ok(Record {
        events: history.events().to_vec(),
        contacts,
        flights: flights(history)?,
        stress: if stress { history.stress_pieces() } else { Vec::new() },
        outline: Vec::new(),
        end: (end, history.ending().clone()),
        error: history.error_estimate().to_f64(),
        lost: history.digits_lost(),
    })
}

/// What `sample` can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Quantity {
    /// The strain at the ground `v_x(0,t)`, and with a material the stress and the force there
    Stress,
    /// The end at the ground: `v(0,t)`, `v_t(0,t)`
    End,
    /// The upper end: `v(L,t)`, `v_t(L,t)`
    Top,
    /// The centre of mass: `h`, `h′`
    Centre,
    /// The energies `E`, `E_h`, `E_z`
    Energy,
    /// `v`, `v_t`, `v_x` at points
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

    /// What is printed of it, each with the place of its number in [`Sample::values`].
    pub(super) fn columns(self, units: &Units) -> Vec<(Column, usize)> {
        const STRAIN: Column = column("v_x", Measure::Strain);
        const STRESS: Column = column("stress", Measure::Stress);
        const V: Column = column("v", Measure::Length);
        const V_T: Column = column("v_t", Measure::Velocity);
        let all: &[(Column, usize)] = match self {
            Quantity::Stress => &[(STRAIN, 0), (STRESS, 0), (column("force", Measure::Force), 0)],
            Quantity::End | Quantity::Top => &[(V, 0), (V_T, 1)],
            Quantity::Centre => &[(column("h", Measure::Length), 0), (column("h_rate", Measure::Velocity), 1)],
            Quantity::Energy => &[
                (column("total", Measure::Energy), 0),
                (column("translational", Measure::Energy), 1),
                (column("vibrational", Measure::Energy), 2),
            ],
            Quantity::Field => &[(V, 0), (V_T, 1), (STRAIN, 2), (STRESS, 2)],
        };
        all.iter().filter(|(column, _)| column.is_present(units)).copied().collect()
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
    /// As the history answers them: see [`Motion`].
    pub values: Vec<S>,
}

/// The columns of `quantity`, and their numbers for every sample.
pub(super) fn sampled<S: Scalar>(
    samples: &[Sample<S>],
    quantity: Quantity,
    units: &Units,
) -> (Vec<Column>, Vec<Vec<S>>) {
    let (columns, places): (Vec<Column>, Vec<usize>) = quantity.columns(units).into_iter().unzip();
    let factors = samples.first().map(|sample| Factors::new(columns.iter(), units, &sample.time));
    let row = |sample: &Sample<S>| {
        let values = places.iter().enumerate();
        let scaled = |(k, place): (usize, &usize)| Some(factors.as_ref()?.scale(k, sample.values.get(*place)?));
        values.filter_map(scaled).collect()
    };
    let rows = samples.iter().map(row).collect();
    (columns, rows)
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
            Quantity::Stress => row(None, vec![history.strain(time, side)?]),
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
