//! The assignment of the columns of a file to quantities.

use dalembert::quantity::{Conversion, Measure, Needs, Quantity, Units};

/// Returns the quantity of this name that can be compared, along the rod for a `field`, otherwise over time.
pub(crate) fn compared(name: &str, field: bool) -> Option<Quantity> {
    let needs = if field { Needs::PointAndTime } else { Needs::Time };
    let plain = || name.to_lowercase().replace([' ', '-'], "_");
    let found = needs.called(name).or_else(|| needs.called(&plain()));
    found.filter(|quantity| !matches!(quantity, Quantity::Time | Quantity::Side | Quantity::Point))
}

/// The columns of a source by their quantities.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ColumnMap {
    /// The columns that are read: first those of [`PLACES`], but for times that are counted, then those compared.
    pub(crate) columns: Vec<(Quantity, usize)>,
    /// The names of columns that are not used.
    pub(crate) unused: Vec<String>,
}

/// The conversions of columns to the units of a scene.
#[derive(Debug)]
pub(crate) struct Conversions {
    /// One for each column that is read.
    pub(crate) of_columns: Vec<Conversion>,
    /// The remark on them in the report.
    pub(crate) remark: String,
}

/// The reason why the columns of a source cannot be assigned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each case is described by its message")]
pub enum MapError {
    #[error("found no quantity in the columns {found}, expected some of {}, or a map such as t=0,u=1", known(*field))]
    Nothing { found: String, field: bool },
    #[error("found no names of columns, expected a map such as t=0,u=1,v=2,force=3 with their numbers, counted from 0")]
    NoNames,
    #[error("found `{found}` in the map, expected NAME=COLUMN as in t=0,u=1,force=3")]
    Form { found: String },
    #[error(
        "found {found} names above rows of {expected} columns, expected as many, or a map such as t=0,u=1,v=2,force=3"
    )]
    Names { found: usize, expected: usize },
    #[error("found the name `{found}` in the map, expected t, x, side, or one of {}", known(*field))]
    Name { found: String, field: bool },
    #[error("found `{found}` twice, expected each quantity once, as a map such as t=0,u=1 can say it")]
    Twice { found: String },
    #[error(
        "found the column `{found}`, expected it {expected} as in the scene, or in a unit that can be brought to it; a \
         map such as t=0,u=1 takes it as it is"
    )]
    Unit { found: String, expected: String },
    #[error("found column `{found}` in the map, expected {expected}")]
    Column { found: String, expected: String },
    #[error("found no column of times{found}, expected one called t, t=… in the map, or a step dt")]
    NoTime { found: String },
    #[error("found dt and a column of times, expected one of them")]
    TwoTimes,
}

fn known(field: bool) -> String {
    if field {
        return "u, v, strain, stress at the points x".into();
    }
    let names = Needs::Time.quantities().map(Quantity::name).filter(|name| compared(name, false).is_some());
    format!("{} (u and v for short)", names.collect::<Vec<_>>().join(", "))
}

/// The names of the columns that give the time, point and side of a row.
const PLACES: [(Quantity, &[&str]); 3] =
    [(Quantity::Time, &["t", "time"]), (Quantity::Point, &["x", "point"]), (Quantity::Side, &["side"])];

/// Returns the name and the unit of `force [N]` or `t (s)`; `u[0]` is a name.
pub(crate) fn name_and_unit(header: &str) -> (&str, Option<&str>) {
    let bracketed = [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| {
        let (name, unit) = header.strip_suffix(close)?.rsplit_once(open)?;
        Some((name.trim(), unit.trim())).filter(|(name, unit)| !name.is_empty() && unit.parse::<usize>().is_err())
    });
    bracketed.map_or((header, None), |(name, unit)| (name, Some(unit)))
}

impl ColumnMap {
    /// Builds the map that `text` describes, `NAME=COLUMN` separated by commas, or that of the names of the columns.
    /// `counted` says that times come from `dt`.
    pub(crate) fn new(text: Option<&str>, names: &[String], width: usize, counted: bool) -> Result<Self, MapError> {
        let entries: Vec<(String, usize)> = match text {
            Some(text) => text.split(',').map(|entry| entry_of(entry, names, width)).collect::<Result<_, _>>()?,
            None => names.iter().map(|name| name_and_unit(name).0.to_string()).zip(0..).collect(),
        };
        let is = |name: &str, known: &[&str]| known.contains(&name.to_lowercase().as_str());
        let mut map = ColumnMap { columns: Vec::new(), unused: Vec::new() };
        for (what, known) in PLACES {
            let mut found = entries.iter().filter(|(name, _)| is(name, known));
            map.columns.extend(found.next().map(|(_, place)| (what, *place)));
            if let Some((name, _)) = found.next() {
                return Err(MapError::Twice { found: name.clone() });
            }
        }
        let is_same = |(other, at): &(String, usize), name: &str, taken: Option<usize>| {
            Some(*at) == taken && other.eq_ignore_ascii_case(name)
        };
        let (field, places) = (map.place(Quantity::Point).is_some(), map.columns.len());
        let is_place = |name: &str| PLACES.into_iter().any(|(_, known)| is(name, known));
        for (name, place) in entries.iter().filter(|(name, _)| !is_place(name)) {
            let found = compared(name, field);
            let twice = found.is_some_and(|found| map.place(found).is_some());
            match found {
                Some(quantity) if !twice => map.columns.push((quantity, *place)),
                // Of columns with different names of one quantity the first is taken, but none of two with one name.
                Some(quantity)
                    if text.is_none() && entries.iter().any(|other| is_same(other, name, map.place(quantity))) =>
                {
                    return Err(MapError::Twice { found: name.clone() });
                }
                _ if text.is_none() => map.unused.extend(Some(name.clone()).filter(|name| !name.is_empty())),
                Some(_) => return Err(MapError::Twice { found: name.clone() }),
                None => return Err(MapError::Name { found: name.clone(), field }),
            }
        }
        let is_empty = map.columns.len() == places;
        match (map.place(Quantity::Time), counted) {
            (Some(_), true) if text.is_some() => return Err(MapError::TwoTimes),
            (None, false) if names.is_empty() && text.is_none() => return Err(MapError::NoNames),
            (None, false) if names.is_empty() => return Err(MapError::NoTime { found: String::new() }),
            (None, false) => return Err(MapError::NoTime { found: format!(" in {}", names.join(", ")) }),
            _ if is_empty && names.is_empty() => return Err(MapError::NoNames),
            _ if is_empty => return Err(MapError::Nothing { found: names.join(", "), field }),
            _ => map.columns.retain(|(what, _)| !(counted && *what == Quantity::Time)),
        }
        Ok(map)
    }

    pub(crate) fn place(&self, what: Quantity) -> Option<usize> {
        self.columns.iter().find(|(other, _)| *other == what).map(|(_, place)| *place)
    }

    /// Returns the conversion of each column to the unit of the scene, by the unit in its name. Numbers of a scene
    /// without units stay as they are.
    pub(crate) fn conversions(&self, names: &[String], units: &Units) -> Result<Conversions, MapError> {
        let (mut all, mut remarks) = (Vec::new(), Vec::new());
        for (quantity, place) in &self.columns {
            let header = names.get(*place).map_or("", String::as_str);
            let (Some(unit), Some(measure)) = (name_and_unit(header).1, quantity.measure()) else {
                all.push(Conversion::NONE);
                continue;
            };
            let expected = quantity.unit(units);
            let is_number = measure == Measure::Strain;
            if expected.is_empty() && !is_number {
                remarks.push(format!("{header} as it is, the scene having no units"));
                all.push(Conversion::NONE);
                continue;
            }
            let same = unit.replace([' ', '·', '*', '.'], "") == expected.replace(' ', "");
            let conversion = if same { Some(Conversion::NONE) } else { Conversion::between(unit, expected) };
            let conversion = conversion.ok_or_else(|| MapError::Unit {
                found: header.into(),
                expected: match expected {
                    "" => "without a unit".into(),
                    per if per.starts_with("per") => per.into(),
                    unit => format!("in {unit}"),
                },
            })?;
            if conversion != Conversion::NONE {
                remarks.push(format!("{header} in {}", if is_number { "1" } else { expected }));
            }
            all.push(conversion);
        }
        Ok(Conversions { of_columns: all, remark: remarks.join(", ") })
    }
}

/// Returns the name and the place of an entry `NAME=COLUMN` of a map.
fn entry_of(entry: &str, names: &[String], width: usize) -> Result<(String, usize), MapError> {
    let (name, column) = entry.split_once('=').ok_or_else(|| MapError::Form { found: entry.trim().into() })?;
    let (name, column) = (name.trim(), column.trim());
    let named = |known: &String| known == column || name_and_unit(known).0 == column;
    let place = names.iter().position(named).or_else(|| column.parse().ok());
    match place.filter(|place| *place < width) {
        Some(place) => Ok((name.into(), place)),
        None => {
            let known = if names.is_empty() { String::new() } else { format!(" or one of {}", names.join(", ")) };
            Err(MapError::Column { found: column.into(), expected: format!("0 to {}{known}", width.saturating_sub(1)) })
        }
    }
}

#[cfg(test)]
#[path = "tests/map.rs"]
mod tests;
