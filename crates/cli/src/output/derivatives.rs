//! Derivatives of events, contacts and values: columns beside them in data, tables of their own for a person.

use std::fmt::Display;

use super::column::Column;
use super::dataset::{Cell, Dataset};
use super::table::{TextTable, table_digits};
use dalembert::Value;
use dalembert::problem::Parameter;
use dalembert::solve::{Derivative, Derivatives};

/// Adds columns of derivatives of the numbers of these names to `data`, whose rows are of the same list.
pub(crate) fn add_derivatives(
    data: &mut Dataset,
    names: impl IntoIterator<Item = impl Display>,
    (by, rows): (Parameter, &Derivatives<Value>),
) {
    for (k, quantity) in names.into_iter().enumerate() {
        let cells = || rows.iter().map(|row| row.get(k).and_then(Option::as_ref));
        let (name, key) = (format!("{quantity}_by_{by}"), format!("derivatives/{quantity}/{by}"));
        let column = Column::data(name.clone()).keyed(key.clone());
        data.columns.push(column.bounded().optional());
        for (row, cell) in data.rows.iter_mut().zip(cells()) {
            row.push(Cell::number(cell.and_then(Derivative::value).cloned()));
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
                row.push(Cell::number(one.and_then(Result::ok).cloned()));
                row.push(one.and_then(Result::err).map(|why| why.to_string()).into());
            }
        }
    }
}

/// Returns the columns of the derivatives by one value of numbers with these names and symbols, with their cells.
pub(crate) fn derivative_rows(
    by: Parameter,
    numbers: impl IntoIterator<Item = (impl Display, impl Display)>,
    rows: &Derivatives<Value>,
) -> Vec<(Column, Vec<Cell>)> {
    let mut columns = Vec::new();
    for (k, (quantity, symbol)) in numbers.into_iter().enumerate() {
        let cells = || rows.iter().map(|row| row.get(k).and_then(Option::as_ref));
        // Most derivatives are the same from both sides.
        let differ = cells().flatten().any(|cell| cell.value().is_none());
        let sides = [("", None), ("_left", Some(0)), ("_right", Some(1))];
        for (suffix, side) in sides.into_iter().take(if differ { 3 } else { 1 }) {
            let cell = |cell: Option<&Derivative<Value>>| match (cell, side) {
                (Some(Derivative::One(value)), None) => Cell::Number(value.clone()),
                (Some(cell @ Derivative::Sides { .. }), Some(side)) => match cell.sides()[side] {
                    Ok(value) => Cell::Number(value.clone()),
                    Err(why) => why.name().into(),
                },
                (_, _) => Cell::number(None::<Value>),
            };
            let (symbol, meaning) = (format!("∂ {symbol}"), format!("derivative of {quantity} by {by}"));
            let name = Column::new(format!("{quantity}_by_{by}{suffix}"));
            let column = Column { symbol: symbol.into(), meaning: meaning.into(), ..name };
            columns.push((column, cells().map(cell).collect()));
        }
    }
    columns
}

/// Returns a table of the derivatives by one value. Each label names a row, which is two rows where the sides differ;
/// `quantities` are places in a row with their symbols. `wide` keeps each row on one line.
pub(crate) fn derivative_table(
    (head, labels): (&str, Vec<String>),
    quantities: &[(usize, impl Display)],
    (by, rows): (Parameter, &Derivatives<Value>),
    (digits, wide): (u32, bool),
) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let symbols: Vec<String> = quantities.iter().map(|(_, symbol)| format!("∂ {symbol}")).collect();
    let head: Vec<&str> = [head, "side"].into_iter().chain(symbols.iter().map(String::as_str)).collect();
    let sizes = |cell: &Derivative<Value>| cell.sides().map(|side| side.map_or(0.0, |value| value.to_f64().abs()));
    let column = |place: usize| rows.iter().filter_map(move |row| row.get(place)?.as_ref()).flat_map(sizes);
    let greatest: Vec<f64> = quantities.iter().map(|(place, _)| column(*place).fold(0.0, f64::max)).collect();
    let mut lines = Vec::new();
    for (label, row) in labels.into_iter().zip(rows) {
        let cells: Vec<_> = quantities.iter().map(|(k, _)| row.get(*k).and_then(Option::as_ref)).collect();
        let is_same = cells.iter().flatten().all(|cell| cell.value().is_some());
        let sides: &[(usize, &str)] = if is_same { &[(0, "both")] } else { &[(0, "left"), (1, "right")] };
        for (side, word) in sides {
            let mut line = vec![label.clone(), (*word).into()];
            line.extend(cells.iter().zip(&greatest).map(
                |(cell, greatest)| match cell.map(|cell| cell.sides()[*side]) {
                    Some(Ok(value)) => value.to_digits_beside(table_digits(digits), *greatest),
                    Some(Err(why)) => why.to_string(),
                    None => "–".into(),
                },
            ));
            lines.push(line);
        }
    }
    let table = TextTable { head: &head, rows: lines, words: 2, keys: (!wide).then_some(2) };
    format!("\nby {by}:\n{}\n", table.format())
}
