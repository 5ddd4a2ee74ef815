//! Names of quantities and of groups of them.

use std::fmt;
use std::str::FromStr;

use super::table::{Needs, Quantity};
use crate::names::UnknownName;
use Quantity::*;

impl Quantity {
    /// Quantities that are asked for together, by the name of the group.
    pub const GROUPS: [(&'static str, &'static [Quantity]); 5] = [
        ("end", &[EndDisplacement, EndVelocity]),
        ("top", &[TopDisplacement, TopVelocity]),
        ("centre", &[Centre, CentreVelocity]),
        ("energy", &[Energy, TranslationalEnergy, VibrationalEnergy]),
        ("field", &[PointDisplacement, PointVelocity, PointStrain, PointStress]),
    ];

    /// Returns the quantities of the group of this name: `end`, `top`, `centre`, `energy` or `field`.
    ///
    /// ```
    /// use dalembert::Quantity;
    /// let end = Quantity::group("end").unwrap_or_default();
    /// assert_eq!(end, [Quantity::EndDisplacement, Quantity::EndVelocity]);
    /// ```
    pub fn group(name: &str) -> Option<&'static [Quantity]> {
        Quantity::GROUPS.iter().find(|(known, _)| *known == name).map(|(_, quantities)| *quantities)
    }
}

impl Needs {
    /// Returns the quantities of a list of names and groups with commas between them, in the order of the list.
    ///
    /// **Errors**: [`UnknownName`] for a name that is neither that of a group nor one that is understood among the
    /// quantities that need this.
    ///
    /// ```
    /// use dalembert::{Quantity, quantity::Needs};
    /// let list = [Quantity::Force, Quantity::EndDisplacement, Quantity::EndVelocity];
    /// assert_eq!(Needs::Time.list("force, end")?, list);
    /// let error = Needs::Time.list("forec").unwrap_err().to_string();
    /// assert!(error.ends_with("end, top, centre, energy (did you mean force?)"));
    /// # Ok::<(), dalembert::UnknownName>(())
    /// ```
    pub fn list(self, names: &str) -> Result<Vec<Quantity>, UnknownName> {
        let is_group = |quantities: &[Quantity]| quantities.iter().all(|quantity| quantity.needs() == self);
        let groups = || Quantity::GROUPS.iter().filter(|(_, quantities)| is_group(quantities));
        let mut list = Vec::new();
        for name in names.split(',').map(str::trim) {
            match groups().find(|(known, _)| *known == name) {
                Some((_, quantities)) => list.extend_from_slice(quantities),
                None => list.push(self.called(name).ok_or_else(|| {
                    let known = self.quantities().map(Quantity::name).chain(groups().map(|(known, _)| *known));
                    UnknownName::new("quantity", name, known)
                })?),
            }
        }
        Ok(list)
    }
}

/// The [name](Quantity::name).
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The first quantity in the order of [`Quantity::ALL`] that has this name, or else the first that is also called so:
/// `impulse` is that over time. [`Needs::named`] and [`Needs::called`] tell quantities of one name apart.
impl FromStr for Quantity {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let mut all = Quantity::ALL.iter().copied();
        let named = all.clone().find(|quantity| quantity.name() == name);
        named.or_else(|| all.find(|quantity| quantity.also().contains(&name))).ok_or_else(|| {
            let is_first = |place: usize| {
                let name = Quantity::ALL[place].name();
                Quantity::ALL[..place].iter().all(|before| before.name() != name)
            };
            let known =
                (0..Quantity::ALL.len()).filter(|place| is_first(*place)).map(|place| Quantity::ALL[place].name());
            UnknownName::new("quantity", name, known)
        })
    }
}
