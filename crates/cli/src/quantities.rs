//! Names of quantities and of groups of them, as every subcommand accepts them.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::failure::Failure;
use dalembert::Scene;
use dalembert::quantity::{Needs, Quantity, Units};

/// A name that stands for several quantities.
struct Group {
    name: &'static str,
    meaning: &'static str,
    quantities: &'static [Quantity],
}

const OVER_TIME: [Group; 5] = [
    Group {
        name: "ground",
        meaning: "strain at the ground, and with a material stress and force there",
        quantities: &[Quantity::Strain, Quantity::Stress, Quantity::Force],
    },
    Group {
        name: "end",
        meaning: "u_end and v_end: the end at the ground",
        quantities: &[Quantity::EndDisplacement, Quantity::EndVelocity],
    },
    Group {
        name: "top",
        meaning: "u_top and v_top: the upper end",
        quantities: &[Quantity::TopDisplacement, Quantity::TopVelocity],
    },
    Group {
        name: "centre",
        meaning: "h and h_rate: the centre of mass",
        quantities: &[Quantity::Centre, Quantity::CentreVelocity],
    },
    Group {
        name: "energy",
        meaning: "E_total, E_h and E_z",
        quantities: &[Quantity::Energy, Quantity::TranslationalEnergy, Quantity::VibrationalEnergy],
    },
];
const ALONG_ROD: [Group; 1] = [Group {
    name: "field",
    meaning: "u, v, strain, and with a material stress, at points of the rod",
    quantities: &[Quantity::PointDisplacement, Quantity::PointVelocity, Quantity::PointStrain, Quantity::PointStress],
}];

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

/// Returns whether stresses and forces of a scene have units.
pub(crate) fn has_material(scene: &Scene) -> bool {
    Units::of(&scene.problem, scene.units).has_material()
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

    fn groups(self) -> &'static [Group] {
        match self {
            Scope::OverTime | Scope::SingleNumber => &OVER_TIME,
            Scope::AlongRod => &ALONG_ROD,
        }
    }

    /// Returns the quantities that a name or another spelling of it stands for; none for an unknown name. Of a group,
    /// those of stress and force are there with a material only.
    fn lookup(self, name: &str, has_material: bool) -> Vec<Quantity> {
        let quantities = self.quantities();
        let by_name = || quantities.iter().find(|quantity| quantity.name() == name);
        let by_alias = || quantities.iter().find(|quantity| quantity.also().contains(&name));
        match self.groups().iter().find(|group| group.name == name) {
            Some(group) => {
                group.quantities.iter().copied().filter(|quantity| quantity.is_listed(has_material)).collect()
            }
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
                let groups = self.groups().iter().map(|group| group.name);
                let known: Vec<_> = groups.chain(self.quantities().into_iter().map(Quantity::name)).collect();
                let place = if self == Scope::AlongRod { " along the rod" } else { "" };
                return Err(failure!("found the quantity {name}{place}, expected some of {}", known.join(", ")));
            }
            if let Some(twice) = found.iter().find(|quantity| all.contains(quantity)) {
                return Err(failure!("found --quantity {} twice, expected each once", twice.name()));
            }
            all.extend(found);
        }
        Ok(all)
    }

    fn possible_values(self) -> impl Iterator<Item = PossibleValue> {
        let groups = self.groups().iter().map(|group| PossibleValue::new(group.name).help(group.meaning));
        let quantities = self
            .quantities()
            .into_iter()
            .map(|quantity| PossibleValue::new(quantity.name()).aliases(quantity.also()).help(quantity.meaning()));
        groups.chain(quantities)
    }
}

/// A parser of the names of some scopes. Spaces around a name do not count.
#[derive(Clone)]
pub(crate) struct NameParser(Vec<PossibleValue>);

impl NameParser {
    /// Returns a parser of the names of `scopes`, each name once, and of `others`.
    pub(crate) fn new(scopes: &[Scope], others: impl IntoIterator<Item = PossibleValue>) -> Self {
        let mut values: Vec<PossibleValue> = others.into_iter().collect();
        for value in scopes.iter().flat_map(|scope| scope.possible_values()) {
            if !values.iter().any(|known| known.get_name() == value.get_name()) {
                values.push(value);
            }
        }
        NameParser(values)
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
        PossibleValuesParser::new(self.0.clone()).parse_ref(command, argument, trimmed)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.0.iter().cloned()))
    }
}
