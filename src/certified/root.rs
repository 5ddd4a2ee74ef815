//! The bounce at a root: one bracket without another root, cut down to the last digits by proved signs.

use rug::Float;

use crate::error::Error;
use crate::first_contact::{Bounce, Bracket, FirstContact};
use crate::number::{Interval, Scalar, decided};
use crate::rod::{Parameters, Problem};

/// Encloses the root in `bracket`, in round trips; `None` where these bits do not show the signs beside it.
///
/// In the bracket the force `f` falls at least as fast as its `slope`, and it holds exactly one root. An approximation τ, from
/// ordinary arithmetic, is off by at most `|f(τ)|/slope`; at twice that distance to either side the signs of f are evaluated in
/// enclosures, and they must be + and −.
pub(super) fn enclose(
    problem: &Problem,
    contact: &FirstContact<Interval>,
    bracket: &Bracket<Interval>,
) -> Result<Option<Interval>, Error> {
    let bits = bracket.from.lo().prec();
    let rod = Parameters::<Float>::of(problem, &bits)?;
    let near = FirstContact::new(&rod);
    let from = bracket.from.mid();
    let start = Bracket { cell: bracket.cell, from, to: bracket.to.mid(), slope: bracket.slope.mid() };
    let Bounce::At { time, .. } = near.root_in(start) else { return Ok(None) };
    let middle = time / near.round_trip();
    let point = |x: &Float| Interval::between(x.clone(), x.clone());
    let inside = |x: &Float| x >= bracket.from.hi() && x <= bracket.to.lo();
    let force = |x: &Float| contact.force_at(&point(x), bracket.cell);
    let off = force(&middle).magnitude() * &bracket.slope.int(2) / &bracket.slope;
    let off = off.hi().clone() + (middle.roundoff() * &middle);
    if !off.is_finite() {
        return Ok(None);
    }
    let (lo, hi) = (Float::with_val(bits, &middle - &off), Float::with_val(bits, &middle + &off));
    if !(inside(&lo) && inside(&hi)) {
        return Ok(None);
    }
    let proved = decided(|| force(&lo).is_positive() && force(&hi).is_negative()) == Some(true);
    Ok(proved.then(|| Interval::between(lo, hi)))
}
