//! The field along the rod at chosen times: at points, averaged over cells, or projected on linear elements.

use super::column::{check_finite, limit, same};
use super::table::Quantity;
use crate::error::Error;
use crate::motion::moments::Moments;
use crate::motion::{Motion, Side};
use crate::number::Scalar;

/// Form of the field on a grid.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    strum::Display,
    strum::EnumMessage,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Slice {
    /// The values at the points
    #[default]
    Points,
    /// The mean values over the cells between neighbouring points; x is the middle of the cell
    Averages,
    /// The nodal values of the L² projection on the continuous, piecewise linear functions on the grid
    P1,
}

/// Columns of a slice.
pub const SLICE: [Quantity; 6] = [
    Quantity::Time,
    Quantity::Side,
    Quantity::Point,
    Quantity::PointDisplacement,
    Quantity::PointVelocity,
    Quantity::PointStrain,
];

/// Returns the columns `SLICE` for every time of `times` on the grid `points`, column by column, with the sides
/// as in [`columns`](super::columns). Averages and projections do not jump.
///
/// **Source**: the integrals over the cells, [`Motion::moments`]; the mass matrix of linear elements.
///
/// **Accuracy**: *exact* in fractions; otherwise within the bounds that the numbers carry. The inverse of the mass
/// matrix has signs that alternate, and so has the elimination: the bounds of the loads become those of the solution
/// without any loss. Points in doubles are those doubles, whatever they were rounded from: a cell that is a few
/// roundings wide has no other width.
///
/// **Errors**: [`Error::Grid`] for averages and projections on a grid whose points do not increase, and
/// [`Error::PointOutside`].
pub fn slices<S: Scalar>(
    motion: &dyn Motion<S>,
    slice: Slice,
    points: &[S],
    times: &[S],
    side: Option<Side>,
) -> Result<Vec<Vec<S>>, Error> {
    check_finite(&motion.end(), times)?;
    let mut table: Vec<Vec<S>> = (0..6).map(|_| Vec::with_capacity(points.len() * times.len())).collect();
    let mut add = |time: &S, limit: i64, x: &S, values: [S; 3]| {
        let row = [time.clone(), time.int(limit), x.clone()].into_iter().chain(values);
        table.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
    };
    let stored = |point: &S| point.as_double().map_or_else(|| point.clone(), |double| point.double(double));
    let cells: Vec<S> = if slice == Slice::Points { Vec::new() } else { points.iter().map(stored).collect::<Vec<_>>() };
    if slice != Slice::Points {
        check(&cells, &motion.scales().length)?;
    }
    for time in times {
        if slice != Slice::Points {
            let moments = motion.moments(time, &cells)?;
            let (places, values) = match slice {
                Slice::P1 => (points.to_vec(), projection(&moments, &cells)),
                _ => averages(&moments, &cells),
            };
            places.iter().zip(values).for_each(|(x, values)| add(time, 0, x, values));
            continue;
        }
        let ask = |side: Side| {
            let field = |x: &S| motion.field(x, time, side).map(|f| [f.displacement, f.velocity, f.strain]);
            points.iter().map(field).collect::<Result<Vec<_>, _>>()
        };
        let right = ask(side.unwrap_or_default())?;
        let left = if side.is_none() { ask(Side::Left)? } else { Vec::new() };
        let jumps = left.iter().flatten().zip(right.iter().flatten()).any(|(a, b)| !same(a, b));
        let limit = limit(side, jumps);
        if jumps {
            points.iter().zip(left).for_each(|(x, values)| add(time, -1, x, values));
        }
        points.iter().zip(right).for_each(|(x, values)| add(time, limit, x, values));
    }
    Ok(table)
}

/// Refuses points that do not increase or are outside the rod.
fn check<S: Scalar>(points: &[S], length: &S) -> Result<(), Error> {
    let (Some(first), Some(last), true) = (points.first(), points.last(), points.len() > 1) else {
        return Err(Error::Grid { found: "fewer than two points".into() });
    };
    for pair in points.windows(2) {
        if !pair[0].below(&pair[1])? {
            return Err(Error::Grid { found: format!("the point {} after {}", pair[1].text(), pair[0].text()) });
        }
    }
    // An end that is not told from that of the rod is taken for it.
    let outside = match first.negative() == Ok(true) {
        true => Some(first),
        false => Some(last).filter(|last| length.below(last) == Ok(true)),
    };
    outside.map_or(Ok(()), |point| Err(Error::PointOutside { found: point.text(), length: length.text() }))
}

/// Returns the middles of the cells, and the means over them.
fn averages<S: Scalar>(moments: &[Moments<S>], points: &[S]) -> (Vec<S>, Vec<[S; 3]>) {
    let cells = points.windows(2).zip(moments).map(|(pair, moments)| {
        let width = pair[1].clone() - &pair[0];
        let middle = (pair[1].clone() + &pair[0]) / width.int(2);
        (middle, moments.each_ref().map(|[area, _]| area.clone() / &width))
    });
    cells.unzip()
}

/// Returns the nodal values: solves with the mass matrix of linear elements, `h/3` and `h/6` from each cell, by
/// elimination.
fn projection<S: Scalar>(moments: &[Moments<S>], points: &[S]) -> Vec<[S; 3]> {
    let Some(first) = points.first() else { return Vec::new() };
    let zero = || first.zero();
    let mut diagonal: Vec<S> = points.iter().map(|_| zero()).collect();
    let mut loads: Vec<[S; 3]> = points.iter().map(|_| [zero(), zero(), zero()]).collect();
    let mut beside = Vec::with_capacity(moments.len());
    for (k, (pair, moments)) in points.windows(2).zip(moments).enumerate() {
        let width = pair[1].clone() - &pair[0];
        for (j, [area, moment]) in moments.iter().enumerate() {
            let upper = moment.clone() / &width;
            loads[k][j] = loads[k][j].clone() + area - &upper;
            loads[k + 1][j] = loads[k + 1][j].clone() + upper;
        }
        let third = width.clone() / width.int(3);
        diagonal[k] = diagonal[k].clone() + &third;
        diagonal[k + 1] = diagonal[k + 1].clone() + third;
        beside.push(width.clone() / width.int(6));
    }
    for k in 1..points.len() {
        let share = beside[k - 1].clone() / &diagonal[k - 1];
        diagonal[k] = diagonal[k].clone() - share.clone() * &beside[k - 1];
        loads[k] = std::array::from_fn(|j| loads[k][j].clone() - share.clone() * &loads[k - 1][j]);
    }
    for k in (0..points.len()).rev() {
        loads[k] = std::array::from_fn(|j| {
            let known = match beside.get(k) {
                Some(beside) => loads[k][j].clone() - beside.clone() * &loads[k + 1][j],
                None => loads[k][j].clone(),
            };
            known / &diagonal[k]
        });
    }
    loads
}
