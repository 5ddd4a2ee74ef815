//! Quantities over time, as columns: what contact codes are compared in.

use super::table::{Needs, Quantity, Source};
use super::unit::Units;
use crate::error::Error;
use crate::motion::{Motion, Pair, Side, StressPiece};
use crate::number::Scalar;
use crate::threads::Threads;

/// Returns the values of `columns` at every time of `times`, column by column. Where `side` is `None` and the two
/// limits of any of them differ, a time has two rows, the limit from earlier times first.
///
/// **Accuracy**: that of the history's answers, and one rounding for each factor.
///
/// **Errors**: those of the history; [`Error::NotOverTime`].
pub fn columns<S: Scalar>(
    motion: &dyn Motion<S>,
    units: &Units,
    columns: &[Quantity],
    times: &[S],
    side: Option<Side>,
) -> Result<Vec<Vec<S>>, Error> {
    if let Some(other) = columns.iter().find(|quantity| quantity.needs() != Needs::Time) {
        return Err(Error::NotOverTime { quantity: other.name() });
    }
    check_finite(&motion.end(), times)?;
    let ColumnSources { sided, plain, places, count } = ColumnSources::new(columns);
    let factors = columns.iter().map(|column| column.factor(&motion.scales(), units)).collect::<Vec<_>>();
    let impulse = if plain.contains(&Source::Impulse) { Some(ImpulseCurve::new(motion)) } else { None };
    in_threads(times, |times| {
        let mut table: Vec<Vec<S>> = columns.iter().map(|_| Vec::with_capacity(times.len())).collect();
        let (mut left, mut right) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for time in times {
            let ask = |sources: &[Source], side: Side, limit: i64, row: &mut Vec<S>| {
                for source in sources {
                    match (source, &impulse) {
                        (Source::Side, _) => row.push(time.int(limit)),
                        (Source::Impulse, Some(impulse)) => row.push(impulse.at(time)),
                        (source, _) => source.ask(motion, time, side, row)?,
                    }
                }
                Ok::<(), Error>(())
            };
            left.clear();
            right.clear();
            let asked = side.unwrap_or_default();
            ask(&sided, asked, 0, &mut right)?;
            if side.is_none() && !sided.is_empty() && motion.may_jump(time)? {
                ask(&sided, Side::Left, 0, &mut left)?;
            }
            let jumps = !left.is_empty() && !left.iter().zip(&right).all(|(a, b)| same(a, b));
            let limit = limit(side, jumps);
            ask(&plain, asked, limit, &mut right)?;
            if jumps {
                ask(&plain, Side::Left, -1, &mut left)?;
            }
            let rows = [&left, &right];
            for row in &rows[usize::from(!jumps)..] {
                for (k, values) in table.iter_mut().enumerate() {
                    let value = row[places[k]].clone();
                    values.push(match &factors[k] {
                        Some(factor) => value * factor,
                        None => value,
                    });
                }
            }
        }
        Ok(table)
    })
}

/// Returns the values of `quantities` along the rod: for every time a row for each point, empty where the point is
/// outside the rod or the time after the end.
pub(crate) fn columns_along<S: Scalar>(
    motion: &dyn Motion<S>,
    units: &Units,
    quantities: &[Quantity],
    (points, times): (&[S], &[S]),
    side: Side,
) -> Result<Vec<Vec<Option<S>>>, Error> {
    if let Some(other) = quantities.iter().find(|quantity| quantity.needs() != Needs::PointAndTime) {
        return Err(Error::NotAlong { quantity: other.name() });
    }
    let mut rows = Vec::with_capacity(points.len() * times.len());
    for time in times {
        for point in points {
            rows.push(match values_at(motion, units, quantities, (point, time), side) {
                Err(Error::PointOutside { .. } | Error::TimeOutside { .. }) => {
                    quantities.iter().map(|_| None).collect()
                }
                row => row?.into_iter().map(Some).collect(),
            });
        }
    }
    Ok(rows)
}

pub(super) fn values_at<S: Scalar>(
    motion: &dyn Motion<S>,
    units: &Units,
    quantities: &[Quantity],
    (point, time): (&S, &S),
    side: Side,
) -> Result<Vec<S>, Error> {
    let field = motion.field(point, time, side)?;
    let [displacement, velocity, strain] = field.numbers();
    let numbers = [point, displacement, velocity, strain];
    Ok(quantities
        .iter()
        .map(|quantity| quantity.in_unit(numbers[quantity.source().1].clone(), &motion.scales(), units))
        .collect())
}

pub(crate) fn check_finite<S: Scalar>(end: &S, times: &[S]) -> Result<(), Error> {
    let outside = |time: &S| Error::TimeOutside { found: time.text(), end: end.text() };
    times.iter().find(|time| !time.is_finite()).map_or(Ok(()), |time| Err(outside(time)))
}

/// Sources of columns, and the places of their answers in a row.
struct ColumnSources {
    /// Sources with two limits, which stand first.
    sided: Vec<Source>,
    plain: Vec<Source>,
    /// Place of each column in a row.
    places: Vec<usize>,
    /// Length of a row.
    count: usize,
}

impl ColumnSources {
    fn new(columns: &[Quantity]) -> Self {
        let mut sources: Vec<Source> = columns.iter().map(|column| column.source().0).collect();
        sources.sort_unstable();
        sources.dedup();
        let (sided, plain): (Vec<Source>, Vec<Source>) = sources.into_iter().partition(|source| source.has_sides());
        let asked = [&sided[..], &plain[..]].concat();
        let before = |end: usize| asked[..end].iter().map(|source| source.answers()).sum::<usize>();
        let place = |(source, index)| index + before(asked.iter().position(|known| *known == source).unwrap_or(0));
        let places = columns.iter().map(|column| place(column.source())).collect();
        ColumnSources { places, count: before(asked.len()), sided, plain }
    }
}

/// Least number of times for which a thread is started.
const TIMES_PER_THREAD: usize = 2048;

/// Returns the table of `times`, computed in as many parts as there are cores.
fn in_threads<S: Scalar>(
    times: &[S],
    rows: impl Fn(&[S]) -> Result<Vec<Vec<S>>, Error> + Sync,
) -> Result<Vec<Vec<S>>, Error> {
    let threads = Threads::default();
    let size = times.len().div_ceil(threads.count()).max(TIMES_PER_THREAD);
    if times.len() <= size {
        return rows(times);
    }
    let parts: Vec<&[S]> = times.chunks(size).collect();
    let mut tables = threads.all(parts.len(), |k| rows(parts[k]))?.into_iter();
    let mut all = tables.next().unwrap_or_default();
    for table in tables {
        for (column, mut values) in all.iter_mut().zip(table) {
            column.append(&mut values);
        }
    }
    Ok(all)
}

/// Scales each column of a table to about 1 by a power of two, so that one accuracy holds for columns of different
/// size: 1 is its natural scale, or its greatest value where that is more.
pub(crate) fn scaled<S: Scalar>(
    motion: &dyn Motion<S>,
    units: &Units,
    columns: &[Quantity],
    table: &[Vec<S>],
) -> Vec<S> {
    let mut all = Vec::with_capacity(table.len() * table.first().map_or(0, Vec::len) + 1);
    // Zeros are held to the natural scale.
    all.extend(table.iter().find_map(|values| values.first()).map(S::one));
    for (values, quantity) in table.iter().zip(columns) {
        let (Some(natural), Some(first)) = (quantity.natural_scale(motion, units), values.first()) else { continue };
        let greatest = values.iter().map(|value| value.to_f64().abs()).fold(natural, f64::max);
        let unit = first.double((-greatest.log2().round()).clamp(-1000.0, 1000.0).exp2());
        all.extend(values.iter().map(|value| value.clone() * &unit));
    }
    all
}

/// Returns the number of the limit at a time: −1 from the left, 1 from the right, 0 if both were asked for and agree.
pub(super) fn limit(side: Option<Side>, jumps: bool) -> i64 {
    match side {
        Some(Side::Left) => -1,
        None if !jumps => 0,
        _ => 1,
    }
}

/// Returns whether two limits are surely the same. Two enclosures that were computed alike are, although their
/// difference does not show it.
pub(super) fn same<S: Scalar>(a: &S, b: &S) -> bool {
    a.compare(b).is_ok_and(std::cmp::Ordering::is_eq) || (a.ends(0).is_some() && a.alike(b))
}

impl Source {
    fn ask<S: Scalar>(self, motion: &dyn Motion<S>, time: &S, side: Side, row: &mut Vec<S>) -> Result<(), Error> {
        match self {
            Source::Time => row.push(time.clone()),
            Source::End => row.extend(motion.pair(Pair::GroundEnd, time, side)?),
            Source::Strain => row.push(motion.strain(time, side)?),
            Source::Top => row.extend(motion.field(&motion.scales().length, time, side)?.numbers().map(S::clone)),
            Source::Contact => row.push(motion.in_contact(time, side)?),
            Source::Centre => row.extend(motion.pair(Pair::Centre, time, Side::Left)?),
            Source::Energy => row.extend(motion.energy(time)?.numbers().map(S::clone)),
            Source::Parts => row.extend(motion.energy_parts(time)?),
            // The caller adds side and impulse; no other source is one of a time.
            _ => (),
        }
        Ok(())
    }
}

/// `−c² ∫₀ᵗ v_x(0,s) ds` as a function of time: pieces of the stress, each with the integral before it.
struct ImpulseCurve<S> {
    pieces: Vec<(StressPiece<S>, S)>,
    stiffness: S,
    /// Bound of `|v_x(0,·)|`.
    most: f64,
}

impl<S: Scalar> ImpulseCurve<S> {
    fn new(motion: &dyn Motion<S>) -> Self {
        let stiffness = -motion.scales().wave_speed.square();
        let mut sum = stiffness.zero();
        let with_sum = |piece: StressPiece<S>| {
            let before = sum.clone();
            sum = sum.clone() + piece.integral(&piece.end);
            (piece, before)
        };
        let pieces = motion.stress_pieces().into_iter().map(with_sum).collect::<Vec<_>>();
        let size = |value: &S| 2.0 * value.to_f64().abs() + value.width().to_f64();
        let of = |(piece, _): &(StressPiece<S>, S)| {
            size(&piece.strain_start).max(size(&piece.strain_end)).max(piece.chebyshev.iter().map(size).sum())
        };
        let most = pieces.iter().map(of).fold(0.0, f64::max);
        ImpulseCurve { pieces, stiffness, most }
    }

    /// Returns the impulse up to `time`. Near a break of two pieces that the bound of `time` covers, it is widened by
    /// the distance from the break times the greatest stress.
    fn at(&self, time: &S) -> S {
        // A time in fewer bits than the pieces have.
        let longer = (time.log2_roundoff() > self.stiffness.log2_roundoff()).then(|| self.stiffness.zero() + time);
        let time = longer.as_ref().unwrap_or(time);
        let begun = self.pieces.partition_point(|(piece, _)| !time.below(&piece.start).unwrap_or(false));
        let Some((piece, before)) = begun.checked_sub(1).map(|last| &self.pieces[last]) else { return time.zero() };
        let pushed = match time.below(&piece.start) {
            Ok(_) => piece.integral(time) + before,
            Err(_) => before.clone().widened(&((time.clone() - &piece.start) * &time.double(self.most))),
        };
        pushed * &self.stiffness
    }
}
