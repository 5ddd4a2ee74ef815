//! The coefficients of restitution of a contact.

use crate::error::Error;
use crate::history::{Contact, History};
use crate::number::Scalar;

/// The coefficients of restitution `e_P` and `e_E²` of one contact, its end compared with its own beginning, and the factors
/// of `e_E²`.
#[derive(Clone, Debug, PartialEq)]
pub struct Restitution<S> {
    /// `e_P = −P(to)/P(from)`.
    pub momentum: Result<S, Undefined>,
    /// `e_E² = E_h(to)/E_h(from)`.
    pub energy_squared: Result<S, Undefined>,
    /// The first factor of (4.73), `E_h(to)/E(to)`: what part of the energy that is left moves the centre of mass. `None`
    /// where the contact does not end or no energy is left.
    pub translational_part: Option<S>,
    /// The second factor, `E(to)/E(from)`: what part of the energy damping leaves.
    pub energy_kept: Option<S>,
}

/// Why a coefficient of restitution is not defined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Undefined {
    /// The contact has no end.
    #[error("the contact does not end within this history")]
    Unfinished,
    /// The centre of mass stands still where the contact begins.
    #[error("the centre of mass has no momentum where the contact begins")]
    NoMomentum,
    /// The centre of mass can never come back to the height of an undeformed rod on the ground.
    #[error("E_h < 0 where the contact ends: the centre of mass never comes back to h = 0")]
    NegativeAfter,
    /// The energy ratio would compare with nothing, or with less.
    #[error("E_h ≤ 0 where the contact begins: nothing to compare with")]
    NotPositiveBefore,
}

/// The coefficients of restitution of `contact`.
///
/// **Source**: section 4.1, (4.71) and (4.73), with the state at the beginning of the contact for that at `t = 0`: the same for the
/// first contact. The datum of `E_h` is `h = 0`, the undeformed rod on the ground.
///
/// **Accuracy**: *exact* for exact histories; otherwise that of `h′` and `E_h`.
///
/// **Errors**: what the history cannot answer; coefficients that are not defined are said to be so, with the reason.
///
/// ```
/// use dalembert::{Number, Problem, History, quantity::restitution, solve::undamped};
/// let problem = Problem::uniform(Number::from(1), Number::from(1), Number::from(1), Number::from(4));
/// let history = undamped::<f64>(&problem, &())?;
/// let e = restitution(&history, &history.contacts()[0])?;
/// // (4.72): 1 − μ₀²/3μ² = 1 − 4/48.
/// assert!((e.energy_squared.unwrap() - 11.0 / 12.0).abs() < 1e-15);
/// # Ok::<(), dalembert::Error>(())
/// ```
pub fn restitution<S: Scalar>(history: &dyn History<S>, contact: &Contact<S>) -> Result<Restitution<S>, Error> {
    let Some(to) = &contact.to else {
        return Ok(Restitution {
            momentum: Err(Undefined::Unfinished),
            energy_squared: Err(Undefined::Unfinished),
            translational_part: None,
            energy_kept: None,
        });
    };
    let (_, before) = history.centre(&contact.from)?;
    let (_, after) = history.centre(to)?;
    // Below its error bound the momentum is a zero whose digits nobody can give. That bound is of the whole history, whose
    // late events may be far less certain than this contact: half of the digits at least are its own.
    let error = history.error_estimate();
    let half = error.roundoff().try_sqrt().unwrap_or_else(|| error.zero());
    let error = if error < half { error } else { half };
    let bound = before.int(16) * error * history.scales().velocity;
    let momentum = if before.magnitude() <= bound { Err(Undefined::NoMomentum) } else { Ok(-(after / &before)) };
    let before = history.energy(&contact.from)?;
    let after = history.energy(to)?;
    let ratio = |part: &S, whole: &S| (!whole.is_zero()).then(|| part.clone() / whole);
    let (translational_part, energy_kept) =
        (ratio(&after.translational, &after.total), ratio(&after.total, &before.total));
    let energy_squared = if !before.translational.is_positive() {
        Err(Undefined::NotPositiveBefore)
    } else if after.translational.is_negative() {
        Err(Undefined::NegativeAfter)
    } else {
        Ok(after.translational / before.translational)
    };
    Ok(Restitution { momentum, energy_squared, translational_part, energy_kept })
}
