//! Derivatives of events and contacts: columns beside them in data, tables of their own for a person.

use std::rc::Rc;

use super::dataset::{Cell, Column, Dataset, Shared};
use super::record::Head;
use dalembert::number::Scalar;
use dalembert::problem::Parameter;
use dalembert::quantity::Quantity;
use dalembert::solve::{Derivative, Derivatives};

/// Derivatives in numbers that every writer takes.
pub(crate) fn shared<S: Scalar>(found: Derivatives<S>) -> Derivatives<Shared> {
    let share = |cell: Option<Derivative<S>>| cell.map(|cell| cell.map(|x| Rc::new(x) as Shared));
    found.into_iter().map(|row| row.into_iter().map(share).collect()).collect()
}

/// Adds columns of derivatives of `quantities` to `data`, whose rows are of the same list.
pub(super) fn add_columns(data: &mut Dataset, quantities: &[Quantity], (by, rows): (Parameter, &Derivatives<Shared>)) {
    for (k, quantity) in quantities.iter().enumerate() {
        let cells = || rows.iter().map(|row| row.get(k).and_then(Option::as_ref));
        let (name, key) = (format!("{quantity}_by_{by}"), format!("derivatives/{quantity}/{by}"));
        let column = Column::data(name.clone()).keyed(key.clone());
        data.columns.push(column.bounded().optional());
        for (row, cell) in data.rows.iter_mut().zip(cells()) {
            row.push(Cell::shared(cell.and_then(Derivative::value)));
        }
        // Most derivatives are the same from both sides.
        if !cells().flatten().any(|cell| cell.value().is_none()) {
            continue;
        }
        for (side, word) in ["left", "right"].into_iter().enumerate() {
            let column = Column::data(format!("{name}_{word}")).keyed(format!("{key}/{word}"));
            data.columns.push(column.bounded().optional());
            data.columns.push(Column::json(format!("{key}/undefined/{word}")).optional());
            for (row, cell) in data.rows.iter_mut().zip(cells()) {
                let one = cell.filter(|cell| cell.value().is_none()).map(|cell| cell.sides()[side]);
                row.push(Cell::shared(one.and_then(Result::ok)));
                row.push(one.and_then(Result::err).map(|why| why.to_string()).into());
            }
        }
    }
}

/// A table of the derivatives by one value: `keys` say of what each row is, which is two where the sides differ.
pub(super) fn table(
    (what, keys): (&str, Vec<String>),
    quantities: &[(usize, &str)],
    (by, rows): (Parameter, &Derivatives<Shared>),
    head: &Head,
) -> String {
    let mut data = Dataset { digits: head.digits, keys: (!head.wide).then_some(2), ..Dataset::default() };
    data.columns = vec![Column::table(what.to_string()).text(), Column::table("side").text()];
    data.columns.extend(quantities.iter().map(|(_, symbol)| Column::table(format!("∂ {symbol}"))));
    for (key, row) in keys.into_iter().zip(rows) {
        let cells: Vec<_> = quantities.iter().map(|(k, _)| row.get(*k).and_then(Option::as_ref)).collect();
        let both = cells.iter().flatten().all(|cell| cell.value().is_some());
        let sides: &[(usize, &str)] = if both { &[(0, "both")] } else { &[(0, "left"), (1, "right")] };
        for (side, word) in sides {
            let mut line: Vec<Cell> = vec![key.clone().into(), (*word).into()];
            line.extend(cells.iter().map(|cell| match cell.map(|cell| cell.sides()[*side]) {
                Some(Ok(value)) => Cell::shared(Some(value)),
                Some(Err(why)) => why.to_string().into(),
                None => Cell::EMPTY,
            }));
            data.rows.push(line);
        }
    }
    format!("\nby {by}:\n{}\n", data.table())
}
