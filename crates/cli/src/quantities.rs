//! Names of quantities and of groups of them, as every subcommand accepts them.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::failure::Failure;
use crate::source::nearest;
use dalembert::Scene;
use dalembert::chain::ChainQuantity;
use dalembert::quantity::{Needs, Quantity, Units};

/// A set of quantities with unique names, and its groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scope {
    /// Quantities over time.
    OverTime,
    /// Quantities along the rod.
    AlongRod,
    /// Quantities that are one number of a run.
    SingleNumber,
}

/// Returns whether a name is that of a quantity of a whole chain, which no rod has: `force.1`, `gap`, `chain_energy`.
pub(crate) fn is_of_chain(name: &str) -> bool {
    let is_of_rod = || Needs::Time.named(name).is_some();
    name.contains('.') || (name.parse::<ChainQuantity>().is_ok() && !is_of_rod())
}

/// Builds the failure for a name that is no quantity of a `place`.
pub(crate) fn unknown(name: &str, place: &str, known: &[impl AsRef<str>]) -> Failure {
    let known: Vec<&str> = known.iter().map(AsRef::as_ref).collect();
    let near = nearest(name, known.iter().copied());
    let near = near.map_or_else(String::new, |near| format!(" (did you mean {near}?)"));
    failure!("found the quantity {name}{place}, expected one of {}{near}", known.join(", "))
}

/// Returns whether stresses and forces of a scene have units.
pub(crate) fn has_material(scene: &Scene) -> bool {
    Units::new(&scene.problem, scene.units).has_material()
}

impl Scope {
    /// Returns the quantities, in the order of a table.
    pub(crate) fn quantities(self) -> Vec<Quantity> {
        match self {
            Scope::OverTime => Needs::Time.quantities().collect(),
            Scope::AlongRod => {
                [Quantity::Time, Quantity::Side].into_iter().chain(Needs::PointAndTime.quantities()).collect()
            }
            Scope::SingleNumber => Quantity::singles().collect(),
        }
    }

    /// Returns the groups, with their names.
    fn groups(self) -> impl Iterator<Item = (&'static str, &'static [Quantity])> {
        let needs = if self == Scope::AlongRod { Needs::PointAndTime } else { Needs::Time };
        Quantity::GROUPS.into_iter().filter(move |(_, group)| group.iter().all(|quantity| quantity.needs() == needs))
    }

    /// Returns the quantities that a name or another spelling of it stands for; none for an unknown name. Of a group,
    /// those of stress and force are there with a material only.
    fn lookup(self, name: &str, has_material: bool) -> Vec<Quantity> {
        let quantities = self.quantities();
        let by_name = || quantities.iter().find(|quantity| quantity.name() == name);
        // Along the rod, the name of a quantity over time is none.
        let is_other = self == Scope::AlongRod && Needs::Time.named(name).is_some();
        let by_alias = || quantities.iter().find(|quantity| !is_other && quantity.also().contains(&name));
        match self.groups().find(|(known, _)| *known == name) {
            Some((_, group)) => group.iter().copied().filter(|quantity| quantity.is_listed(has_material)).collect(),
            None => by_name().or_else(by_alias).copied().into_iter().collect(),
        }
    }

    /// Returns the quantities that `names` stand for, in their order.
    ///
    /// **Errors**: a name that is none in this scope; a quantity that is named twice.
    pub(crate) fn resolve(self, names: &[String], has_material: bool) -> Result<Vec<Quantity>, Failure> {
        let mut all: Vec<Quantity> = Vec::new();
        for name in names {
            let found = self.lookup(name, has_material);
            if found.is_empty() {
                let groups = self.groups().map(|(name, _)| name);
                let known: Vec<_> = groups.chain(self.quantities().into_iter().map(Quantity::name)).collect();
                return Err(unknown(name, if self == Scope::AlongRod { " along the rod" } else { "" }, &known));
            }
            if let Some(twice) = found.iter().find(|quantity| all.contains(quantity)) {
                return Err(failure!("found --quantity {} twice, expected each once", twice.name()));
            }
            all.extend(found);
        }
        Ok(all)
    }

    fn possible_values(self) -> impl Iterator<Item = PossibleValue> {
        let groups = self.groups().map(|(name, group)| {
            let names: Vec<_> = group.iter().map(|quantity| quantity.name()).collect();
            PossibleValue::new(name).help(names.join(", "))
        });
        let quantities = self
            .quantities()
            .into_iter()
            .map(|quantity| PossibleValue::new(quantity.name()).aliases(quantity.also()).help(quantity.meaning()));
        groups.chain(quantities)
    }
}

/// A parser of the names of some scopes. Spaces around a name do not count.
#[derive(Clone)]
pub(crate) struct NameParser {
    values: Vec<PossibleValue>,
    /// Whether every name is accepted: the scene tells which it has, such as `u_top.2` and `gap` of a chain.
    is_open: bool,
}

impl NameParser {
    /// Returns a parser of the names of `scopes`, each name once, and of `others`.
    pub(crate) fn new(scopes: &[Scope], others: impl IntoIterator<Item = PossibleValue>) -> Self {
        let mut values: Vec<PossibleValue> = others.into_iter().collect();
        for value in scopes.iter().flat_map(|scope| scope.possible_values()) {
            if !values.iter().any(|known| known.get_name() == value.get_name()) {
                values.push(value);
            }
        }
        NameParser { values, is_open: false }
    }

    /// Returns a parser that accepts every name, which the scene resolves.
    pub(crate) fn open(self) -> Self {
        NameParser { is_open: true, ..self }
    }
}

impl TypedValueParser for NameParser {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        let trimmed = value.to_str().map_or(value, |text| OsStr::new(text.trim()));
        if let Some(name) = trimmed.to_str().filter(|_| self.is_open) {
            return Ok(name.into());
        }
        PossibleValuesParser::new(self.values.clone()).parse_ref(command, argument, trimmed)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.values.iter().cloned()))
    }
}
