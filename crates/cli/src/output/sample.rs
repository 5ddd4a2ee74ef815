//! Values of a quantity at chosen times.

use clap::ValueEnum;

use super::dataset::{Cell, Column, Dataset, Shared};
use super::derivatives;
use super::record::Head;
use super::solve::{listed, named_units, units_json};
use super::table::table_digits;
use dalembert::Error;
use dalembert::Side;
use dalembert::engine::Motion;
use dalembert::number::Scalar;
use dalembert::problem::Parameter;
use dalembert::quantity::Quantity::*;
use dalembert::quantity::{self, Measure};
use dalembert::solve::Derivatives;

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
    /// What is printed of it, each with the place of its number in what the history answers.
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

    /// The name that stands for it on the command line.
    pub(crate) fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().into())
    }

    /// What the history answers; the field needs a point.
    fn at<S: Scalar>(self, history: &dyn Motion<S>, time: &S, point: Option<&S>, side: Side) -> Result<Vec<S>, Error> {
        let pair = |(value, rate): (S, S)| vec![value, rate];
        Ok(match (self, point) {
            (Quantity::Stress, _) => vec![history.strain(time, side)?],
            (Quantity::End, _) => pair(history.ground_end(time, side)?),
            (Quantity::Top, _) => pair(history.top_end(time, side)?),
            (Quantity::Centre, _) => pair(history.centre(time)?),
            (Quantity::Energy, _) => history.energy(time)?.numbers().into_iter().cloned().collect(),
            (Quantity::Field, Some(point)) => {
                history.field(point, time, side)?.numbers().into_iter().cloned().collect()
            }
            (Quantity::Field, None) => Vec::new(),
        })
    }
}

pub(crate) struct Samples {
    wanted: Vec<Quantity>,
    pub(crate) quantities: Vec<quantity::Quantity>,
    data: Dataset,
    pub(crate) derivatives: Vec<(Parameter, Derivatives<Shared>)>,
}

/// The values of all that is wanted at every time or, of the field, which stands alone, at every point then; and every
/// number among them.
pub(crate) fn samples<S: Scalar>(
    history: &dyn Motion<S>,
    wanted: &[Quantity],
    (times, points): (&[S], &[S]),
    side: Side,
    head: &Head,
) -> Result<(Samples, Vec<S>), Error> {
    let mut found: Vec<(&S, Option<&S>, Vec<S>)> = Vec::new();
    let of_field = wanted.contains(&Quantity::Field);
    for time in times {
        let points = if of_field { points.iter().map(Some).collect() } else { vec![None] };
        for point in points {
            let mut values = Vec::new();
            for quantity in wanted {
                let answer = quantity.at(history, time, point, side)?;
                values.extend(quantity.columns().iter().filter_map(|(_, place)| answer.get(*place).cloned()));
            }
            found.push((time, point, values));
        }
    }
    let units = &head.units;
    let has_points = of_field && !found.is_empty();
    let asked = wanted.iter().flat_map(|quantity| quantity.columns()).map(|column| column.0).collect::<Vec<_>>();
    let values = found.iter().map(|(.., values)| values.iter().map(Some).collect::<Vec<_>>()).collect::<Vec<_>>();
    let column = |quantity: quantity::Quantity| Column::new(quantity.name()).keyed(format!("values/{quantity}"));
    let mut data = listed(history, &asked, &column, head, &values);
    let point = if has_points { Column::new("x") } else { Column::data("x") };
    let time = Column::new("t").with_unit(units.name(Measure::Time));
    data.columns.splice(0..0, [time, point.with_unit(units.name(Measure::Length)), Column::new("side")]);
    data.keys = data.keys.map(|_| 2 + usize::from(has_points));
    let mut numbers = Vec::new();
    for ((time, point, values), row) in found.into_iter().zip(&mut data.rows) {
        row.splice(0..0, [Cell::number(time), Cell::optional(point), side.to_string().into()]);
        numbers.extend(values.into_iter().chain(point.cloned()).chain([time.clone()]));
    }
    let quantities = asked.into_iter().filter(|quantity| quantity.is_listed(units.has_material())).collect::<Vec<_>>();
    Ok((Samples { wanted: wanted.to_vec(), quantities, data, derivatives: Vec::new() }, numbers))
}

pub(crate) fn samples_data(samples: Samples, head: &Head) -> Dataset {
    let units = &head.units;
    let Samples { wanted, quantities, data, derivatives } = samples;
    let place = |row: &Vec<Cell>| {
        let places = ["t = ", "x = "].into_iter().zip(row).filter(|(_, cell)| !cell.is_empty());
        let texts = places.map(|(name, cell)| format!("{name}{}", cell.text(table_digits(head.digits), "")));
        texts.collect::<Vec<_>>().join("   ")
    };
    let keys = data.rows.iter().map(place).collect::<Vec<_>>();
    let symbols = quantities.iter().map(|quantity| quantity.symbol()).enumerate().collect::<Vec<_>>();
    let tables = derivatives.iter().map(|by| derivatives::table(("at", keys.clone()), &symbols, (by.0, &by.1), head));
    let tables = tables.collect::<Vec<_>>().concat();
    let end = head.exact_until.as_ref().map_or_else(String::new, |end| format!("{end}; these are {}\n", head.number));
    let columns = wanted.iter().flat_map(|quantity| quantity.columns());
    let measures = columns.filter_map(|(quantity, _)| quantity.measure()).collect::<Vec<_>>();
    let below = end + &named_units(&measures, units) + &head.warning_lines();
    let space = if below.is_empty() { "" } else { "\n" };
    let mut data = Dataset {
        header: vec![
            ("schema", 1.into()),
            ("title", head.title.clone().into()),
            ("number", head.number.clone().into()),
            ("quantity", wanted.iter().map(|quantity| quantity.name()).collect::<Vec<_>>().join(",").into()),
            ("units", units_json(units)),
            ("exact_until", head.exact_until_json()),
            ("warnings", head.warning_texts().into()),
        ],
        list: "rows",
        around: [String::new(), format!("\n{tables}{space}{below}")],
        notes: head.notes(),
        ..data
    };
    for (by, rows) in &derivatives {
        derivatives::add_columns(&mut data, &quantities, (*by, rows));
    }
    data
}
