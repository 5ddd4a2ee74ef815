//! Values of a quantity at chosen times.

use clap::ValueEnum;

use super::dataset::{Cell, Column, Dataset, Shared};
use super::derivatives;
use super::record::{Head, Listed};
use super::solve::{listed, named_units, units_json};
use super::writer::table_digits;
use crate::error::Error;
use crate::mapped::{CollectVec, mapped};
use crate::motion::{Motion, Side};
use crate::number::Scalar;
use crate::problem::Parameter;
use crate::quantity::Quantity::*;
use crate::quantity::{self, Measure, Units};
use crate::solve::Derivatives;

/// What `sample` can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Quantity {
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
    /// What is printed of it, each with the place of its number in [`Sample::values`].
    fn columns(self) -> &'static [(quantity::Quantity, usize)] {
        match self {
            Quantity::Stress => &[(Strain, 0), (Stress, 0), (Force, 0)],
            Quantity::End => &[(EndDisplacement, 0), (EndVelocity, 1)],
            Quantity::Top => &[(TopDisplacement, 0), (TopVelocity, 1)],
            Quantity::Centre => &[(Centre, 0), (CentreVelocity, 1)],
            Quantity::Energy => &[(Energy, 0), (TranslationalEnergy, 1), (VibrationalEnergy, 2)],
            Quantity::Field => &[(PointDisplacement, 0), (PointVelocity, 1), (PointStrain, 2), (PointStress, 2)],
        }
    }
}

/// A value of a quantity, or several.
#[derive(Clone, Debug)]
pub(crate) struct Sample<S> {
    /// `t`.
    pub time: S,
    /// `x`, for the field.
    pub point: Option<S>,
    /// Which limit.
    pub side: Side,
    /// As the history answers them: see [`Motion`].
    pub values: Vec<S>,
}

/// The values of `quantity` at every time and, for the field, at every point.
pub(crate) fn sample<S: Scalar>(
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

/// The columns of samples of a quantity, and a row for each of them.
pub(crate) struct Samples {
    quantity: Quantity,
    has_points: bool,
    listed: Listed,
    /// Derivatives of the values, where they are asked for.
    pub(crate) derivatives: Vec<(Parameter, Derivatives<Shared>)>,
    has_material: bool,
}

impl Samples {
    /// Those of `quantity`.
    pub(crate) fn of<S: Scalar>(samples: &[Sample<S>], quantity: Quantity, units: &Units) -> Self {
        let quantities = mapped(quantity.columns(), |column| column.0);
        let values = mapped(samples, |sample| mapped(quantity.columns(), |(_, place)| sample.values.get(*place)));
        let column = |quantity: quantity::Quantity| {
            let key = quantity.key();
            Column::new(key).keyed(format!("values/{key}"))
        };
        let (values, rows) = listed(&quantities, column, units, values);
        let point = Column::new("point").headed("x").with_unit(units.name(Measure::Length));
        let has_points = samples.iter().any(|sample| sample.point.is_some());
        let mut columns = vec![
            Column::new("time").headed("t").with_unit(units.name(Measure::Time)),
            if has_points { point } else { point.untabled() },
            Column::new("side"),
        ];
        columns.extend(values);
        let mut all = Vec::with_capacity(rows.len());
        for (sample, values) in samples.iter().zip(rows) {
            let (time, point) = (Cell::number(&sample.time), Cell::optional(sample.point.as_ref()));
            let mut row = vec![time, point, sample.side.to_string().into()];
            row.extend(values);
            all.push(row);
        }
        let has_material = units.has_material();
        Samples { quantity, has_points, listed: (columns, all), derivatives: Vec::new(), has_material }
    }

    /// What is printed of each.
    pub(crate) fn quantities(&self) -> Vec<quantity::Quantity> {
        let all = self.quantity.columns().iter().map(|column| column.0);
        all.filter(|quantity| quantity.is_listed(self.has_material)).collect_vec()
    }
}

/// A row for each sample.
pub(crate) fn samples_data(samples: Samples, head: &Head) -> Dataset {
    let (units, quantities) = (&head.units, samples.quantities());
    let Samples { quantity, has_points, listed: (columns, rows), derivatives, .. } = samples;
    let key = |row: &Vec<Cell>| {
        let places = ["t = ", "x = "].into_iter().zip(row);
        places
            .filter(|(_, cell)| !cell.is_empty())
            .map(|(name, cell)| format!("{name}{}", cell.text(table_digits(head.digits), "")))
            .collect_vec()
    };
    let keys = mapped(&rows, |row| key(row).join("   "));
    let symbols = quantities.iter().map(|quantity| quantity.symbol()).enumerate().collect_vec();
    let tables = derivatives.iter().map(|by| derivatives::table(("at", keys.clone()), &symbols, (by.0, &by.1), head));
    let tables = tables.collect_vec().concat();
    let end = head.exact_until.as_ref().map_or_else(String::new, |end| format!("{end}; these are {}\n", head.number));
    let measures = quantity.columns().iter().filter_map(|(quantity, _)| quantity.measure()).collect_vec();
    let below = end + &named_units(&measures, units) + &head.warning_lines();
    let space = if below.is_empty() { "" } else { "\n" };
    let mut data = Dataset {
        header: vec![
            ("schema", 1.into()),
            ("title", head.title.clone().into()),
            ("number", head.number.clone().into()),
            ("quantity", quantity.to_possible_value().map(|value| value.get_name().to_string()).into()),
            ("units", units_json(units)),
            ("exact_until", head.exact_until_json()),
            ("warnings", head.warning_texts().into()),
        ],
        list: "rows",
        columns,
        rows,
        around: [String::new(), format!("\n{tables}{space}{below}")],
        notes: head.notes(),
        digits: head.digits,
        keys: (!head.wide).then_some(2 + usize::from(has_points)),
        ..Dataset::default()
    };
    for (by, rows) in &derivatives {
        derivatives::add_columns(&mut data, &quantities, (*by, rows), |quantity| quantity.key().into());
    }
    data
}
