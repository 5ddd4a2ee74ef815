//! All that a history says, as numbers with their bounds.

use dalembert::engine::Motion;
use dalembert::number::Scalar;
use dalembert::quantity::{Needs, Slice, Table, rows, slices};
use dalembert::solve::Target;
use dalembert::{
    Ending, Error, Estimate, EventKind, Float, Interval, Number, Numbers, Quantity, Rational, Side, TypedHistory,
    Warning,
};

/// Bits in which numbers are compared.
pub(super) const BITS: u32 = 512;

pub(super) fn float(x: impl Into<f64>) -> Float {
    Float::with_val(BITS, x.into())
}

pub(super) fn exact(number: &Number) -> Float {
    Float::with_val(BITS, number.to_rational())
}

/// A number of an answer and how far it may be off.
#[derive(Clone, Debug)]
pub(super) struct Known(pub(super) Float, pub(super) f64);

impl Known {
    pub(super) fn of(number: &Number) -> Self {
        Known(exact(number), 0.0)
    }

    /// How far it is from another one, where that is more than both bounds. Bounds are sums in doubles, and the numbers
    /// of fractions are rounded to `BITS`.
    pub(super) fn off(&self, other: &Self) -> Option<f64> {
        let off = Float::with_val(BITS, &self.0 - &other.0).to_f64().abs();
        let size = self.0.to_f64().abs().max(other.0.to_f64().abs());
        (off > (self.1 + other.1) * (1.0 + 1e-12) + size * 1e-140).then_some(off)
    }

    /// Zero, within its bound and so much.
    pub(super) fn vanishes(&self, rest: f64) -> bool {
        self.0.to_f64().abs() <= self.1 * (1.0 + 1e-12) + rest
    }
}

/// `Σ aₖ bₖ`, its bound, and the size of its terms.
pub(super) fn sum(terms: &[(&Known, &Known)]) -> (Known, f64) {
    let (mut total, mut bound, mut size) = (float(0.0), 0.0, 0.0);
    for (a, b) in terms {
        total += Float::with_val(BITS, &a.0 * &b.0);
        let (one, other) = (a.0.to_f64().abs(), b.0.to_f64().abs());
        bound += one * b.1 + a.1 * other + a.1 * b.1;
        size += one * other;
    }
    (Known(total, bound), size)
}

/// Number systems, and how their numbers are read.
pub(super) trait Reads: Target {
    fn read(number: &Self::Carried) -> Known;
}

impl Reads for f64 {
    fn read(number: &Estimate<f64>) -> Known {
        Known(float(*number.value()), number.bound())
    }
}

impl Reads for Float {
    fn read(number: &Estimate<Float>) -> Known {
        Known(Float::with_val(BITS, number.value()), number.log2_error().exp2())
    }
}

impl Reads for Interval {
    fn read(number: &Interval) -> Known {
        let half = Float::with_val(BITS, number.hi() - number.lo()) / 2u32;
        // The half is rounded to a double.
        Known(Float::with_val(BITS, number.lo() + &half), half.to_f64() * (1.0 + 1e-15))
    }
}

impl Reads for Rational {
    fn read(number: &Rational) -> Known {
        Known(Float::with_val(BITS, number), 0.0)
    }
}

/// What a history says at a time, from one side.
#[derive(Debug)]
pub(super) struct At {
    pub(super) time: Number,
    pub(super) side: Side,
    /// All quantities over time, in the order of the table.
    pub(super) columns: Vec<Known>,
    /// `v`, `v_t`, `v_x` at the points.
    pub(super) fields: Vec<[Known; 3]>,
    /// Their means between the points.
    pub(super) means: Vec<[Known; 3]>,
}

pub(super) fn is_double(x: &Number) -> bool {
    Rational::from_f64(x.to_f64()).is_some_and(|double| double == x.to_rational())
}

/// All that a history says.
#[derive(Debug)]
pub(super) struct Account {
    pub(super) events: Vec<(EventKind, [Known; 4], f64)>,
    pub(super) tables: Vec<(&'static str, Vec<Option<Known>>)>,
    pub(super) at: Vec<At>,
    pub(super) ending: Ending,
    warnings: Vec<Warning>,
}

impl Account {
    pub(super) fn of<S: Reads>(
        history: &TypedHistory<S>,
        times: &[Number],
        points: &[Number],
    ) -> Result<Self, (String, Error)> {
        let quantities: Vec<Quantity> = Needs::Time.quantities().collect();
        let at = |what: &str| {
            let what = what.to_string();
            move |error| (what, error)
        };
        let events = history
            .ask(|run| Ok(run.events().to_vec()), |_| Vec::new())
            .map_err(at("events"))?
            .into_iter()
            .map(|e| {
                let numbers = [&e.t, &e.v_end, &e.h, &e.h_rate].map(S::read);
                (e.kind, numbers, e.t_error)
            })
            .collect();
        let mut tables = Vec::new();
        for table in [Table::Contacts, Table::Flights] {
            let quantities = table.quantities();
            let doubles = matches!(history.plan().numbers, Numbers::Double(_));
            let rows = history
                .ask(
                    |run| rows(run, quantities),
                    |rows| {
                        // A ratio in doubles is as accurate as its parts.
                        let numbers = rows.iter().flat_map(|row| row.iter().zip(quantities));
                        let settled = numbers.filter(|(_, quantity)| !doubles || quantity.measure().is_some());
                        settled.filter_map(|(number, _)| number.as_ref().ok()).collect()
                    },
                )
                .map_err(at("table"))?;
            for (k, quantity) in quantities.iter().enumerate() {
                let number = |row: &Vec<Result<_, _>>| row[k].as_ref().ok().map(S::read);
                tables.push((quantity.name(), rows.iter().map(number).collect()));
            }
        }
        let mut found = Vec::new();
        for time in times {
            let means = history
                .ask(
                    |run| {
                        let lift = |x: &Number| S::Carried::spelling(x, &run.end().precision());
                        let grid: Vec<_> = points.iter().map(lift).collect();
                        let mut table = slices(run, Slice::Averages, &grid, &[lift(time)], None)?;
                        Ok(table.split_off(3))
                    },
                    |table| table.iter().flatten().collect(),
                )
                .map_err(at(&format!("means at {time}")))?;
            let means: Vec<[Known; 3]> =
                (0..points.len() - 1).map(|k| std::array::from_fn(|j| S::read(&means[j][k]))).collect();
            for side in [Side::Left, Side::Right] {
                let lift = |run: &dyn Motion<S::Carried>, x| S::Carried::spelling(x, &run.end().precision());
                let columns = history
                    .ask_columns(&quantities, Some(side), |run| Ok(vec![lift(run, time)]))
                    .map_err(at(&format!("columns at {time}")))?;
                let mut fields = Vec::new();
                for point in points {
                    let field = history.ask(
                        |run| run.field(&lift(run, point), &lift(run, time), side),
                        |field| vec![&field.displacement, &field.velocity, &field.strain],
                    );
                    let field = field.map_err(at(&format!("field at {time}")))?;
                    fields.push([&field.displacement, &field.velocity, &field.strain].map(S::read));
                }
                let columns = columns.iter().map(|column| S::read(&column[0])).collect();
                found.push(At { time: time.clone(), side, columns, fields, means: means.clone() });
            }
        }
        Ok(Account { events, tables, at: found, ending: history.ending().clone(), warnings: history.warnings() })
    }

    /// Whether it says that events are not told, or where it ends.
    pub(super) fn warned(&self) -> bool {
        let untold = |warning: &Warning| {
            matches!(
                warning,
                Warning::NotTold { .. }
                    | Warning::HopsUnresolved { .. }
                    | Warning::EventsOverlap { .. }
                    | Warning::NotDetermined { .. }
                    | Warning::Coincidence { .. }
            )
        };
        self.warnings.iter().any(untold)
    }

    pub(super) fn column(&self, at: usize, quantity: Quantity) -> &Known {
        let place = Needs::Time.quantities().position(|other| other == quantity).unwrap();
        &self.at[at].columns[place]
    }
}
