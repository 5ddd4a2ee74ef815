//! Names of the numbers of a chain: quantities over time, and those of contacts.

use std::str::FromStr;

use super::body::Body;
use super::definition::Chain;
use super::run::ChainContact;
use crate::error::{Error, ProblemError, ProblemErrorKind as Kind};
use crate::quantity::Measure;

/// Returns the index of the node with this name: `bottom`, the number of a joint, from 1, or `top`.
fn node(name: &str, chain: &Chain) -> Option<usize> {
    match (name, chain.bodies().len()) {
        ("bottom", _) => Some(0),
        ("top", bodies) => Some(bodies),
        (number, bodies) => number.parse().ok().filter(|n| (1..bodies).contains(n)),
    }
}

fn node_name(node: usize, chain: &Chain) -> String {
    match node {
        0 => "bottom".into(),
        node if node == chain.bodies().len() => "top".into(),
        node => node.to_string(),
    }
}

/// The owner of a quantity.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Owner {
    Body,
    Node,
    Chain,
}

/// Defines the quantities over time, each with its name, owner, measure and meaning.
macro_rules! quantities {
    ($($quantity:ident, $name:literal, $owner:ident, $measure:ident, $meaning:literal;)*) => {
        /// A quantity of a chain over time.
        #[derive(
            Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::EnumString, strum::IntoStaticStr,
            strum::VariantArray,
        )]
        pub enum ChainQuantity {
            $(
                #[doc = $meaning]
                #[strum(serialize = $name)]
                $quantity,
            )*
        }

        impl ChainQuantity {
            fn owner(self) -> Owner {
                match self {
                    $(ChainQuantity::$quantity => Owner::$owner,)*
                }
            }

            /// Returns the measure of the quantity.
            pub fn measure(self) -> Measure {
                match self {
                    $(ChainQuantity::$quantity => Measure::$measure,)*
                }
            }

            /// Returns the meaning of the quantity, without its body or node.
            pub fn meaning(self) -> &'static str {
                match self {
                    $(ChainQuantity::$quantity => $meaning,)*
                }
            }
        }
    };
}

quantities! {
    EndDisplacement, "u_end", Body, Length, "displacement of the lower end, upwards";
    EndVelocity, "v_end", Body, Velocity, "velocity of the lower end, upwards";
    TopDisplacement, "u_top", Body, Length, "displacement of the upper end, upwards";
    TopVelocity, "v_top", Body, Velocity, "velocity of the upper end, upwards";
    Centre, "h", Body, Length, "displacement of the centre of mass, upwards";
    CentreVelocity, "h_rate", Body, Velocity, "velocity of the centre of mass, upwards";
    Kinetic, "kinetic", Body, Energy, "kinetic energy";
    StrainEnergy, "strain_energy", Body, Energy, "strain energy";
    Energy, "E_total", Body, Energy, "kinetic and strain energy, and weight times the displacement of the centre";
    Force, "force", Node, Force, "force, positive in compression";
    Gap, "gap", Node, Length, "gap; negative is the depth of a spring";
    SpringEnergy, "spring_energy", Node, Energy, "energy that the spring holds";
    Dissipated, "dissipated", Node, Energy, "energy that the dashpot, or a spring let go at a depth, has taken up";
    ChainEnergy, "chain_energy", Chain, Energy, "energy of all bodies and springs, and that dashpots have taken up";
    ChainMomentum, "chain_momentum", Chain, Impulse, "momentum of all bodies, upwards";
}

impl ChainQuantity {
    /// Quantities that are asked for together, by the name of the group.
    pub const GROUPS: [(&'static str, &'static [ChainQuantity]); 4] = [
        ("end", &[ChainQuantity::EndDisplacement, ChainQuantity::EndVelocity]),
        ("top", &[ChainQuantity::TopDisplacement, ChainQuantity::TopVelocity]),
        ("centre", &[ChainQuantity::Centre, ChainQuantity::CentreVelocity]),
        ("energy", &[ChainQuantity::Kinetic, ChainQuantity::StrainEnergy, ChainQuantity::Energy]),
    ];

    /// Returns the quantities of a group, or the one of this name; none for an unknown name.
    fn group(name: &str) -> Vec<Self> {
        match Self::GROUPS.iter().find(|(known, _)| *known == name) {
            Some((_, quantities)) => quantities.to_vec(),
            None => ChainQuantity::from_str(name).into_iter().collect(),
        }
    }

    /// Returns whether the quantity belongs to a node, and not to a body.
    pub fn is_of_node(self) -> bool {
        self.owner() == Owner::Node
    }

    /// Returns whether the quantity belongs to the chain as a whole, and to no body or node.
    pub fn is_of_chain(self) -> bool {
        self.owner() == Owner::Chain
    }
}

/// A quantity of one body or node: `u_top.2` for the second body, `force.bottom`, `force.1` for the joint above the
/// first body, `force.top`; or one of the chain, `chain_energy`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChainColumn {
    /// The quantity.
    pub quantity: ChainQuantity,
    /// The index of the body, from 0, or of the node, 0 at the bottom; 0 for a quantity of the chain.
    pub place: usize,
}

impl ChainColumn {
    /// Reads the column `name` of `chain`; `None` if the chain has no such quantity or place.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain, ChainColumn};
    /// let bar = || Body::new(1.into(), 1.into(), 1.into());
    /// let chain = Chain::builder(bar()).contact(1.into(), bar()).until(4.into()).build()?;
    /// assert_eq!(ChainColumn::read("u_top.2", &chain).map(|column| column.place), Some(1));
    /// assert_eq!(ChainColumn::read("force.top", &chain).map(|column| column.place), Some(2));
    /// assert_eq!(ChainColumn::read("u_top.3", &chain), None);
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn read(name: &str, chain: &Chain) -> Option<Self> {
        let Some((quantity, place)) = name.split_once('.') else {
            let quantity = ChainQuantity::from_str(name).ok().filter(|quantity| quantity.is_of_chain())?;
            return Some(ChainColumn { quantity, place: 0 });
        };
        let quantity = ChainQuantity::from_str(quantity).ok().filter(|quantity| !quantity.is_of_chain())?;
        let body = || place.parse::<usize>().ok().filter(|n| (1..=chain.bodies().len()).contains(n));
        let place = if quantity.is_of_node() { node(place, chain)? } else { body()? - 1 };
        Some(ChainColumn { quantity, place })
    }

    /// Refuses a column of a body or node that `chain` does not have.
    pub(crate) fn check(self, chain: &Chain) -> Result<(), Error> {
        match self.quantity.owner() {
            Owner::Body => chain.check_body(self.place),
            Owner::Node if self.place > chain.bodies().len() => {
                let (found, most) = (format!("node {}", self.place), chain.bodies().len());
                Err(ProblemError::new(Kind::OutOfRange, "", found, format!("one from 0 to {most}")).into())
            }
            Owner::Node | Owner::Chain => Ok(()),
        }
    }

    /// Returns the columns that a name stands for: one of [`ChainColumn::read`], or those of a quantity or a group, as
    /// `force`, `end` or `energy`, of all places or of one (`end.2`). None for an unknown name.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain, ChainColumn};
    /// let bar = || Body::new(1.into(), 1.into(), 1.into());
    /// let chain = Chain::builder(bar()).contact(1.into(), bar()).until(4.into()).build()?;
    /// let names = |list: &str| ChainColumn::list(list, &chain).into_iter().map(|column| column.name(&chain));
    /// assert_eq!(names("gap").collect::<Vec<_>>(), ["gap.bottom", "gap.1", "gap.top"]);
    /// assert_eq!(names("end.2").collect::<Vec<_>>(), ["u_end.2", "v_end.2"]);
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn list(name: &str, chain: &Chain) -> Vec<Self> {
        let (group, place) = name.split_once('.').map_or((name, None), |(group, place)| (group, Some(place)));
        let quantities = ChainQuantity::group(group);
        let is_asked = |column: &Self| {
            let at = |place: &str| column.name(chain) == format!("{}.{place}", column.quantity);
            quantities.contains(&column.quantity) && place.is_none_or(at)
        };
        let listed: Vec<Self> = ChainColumn::all(chain).into_iter().filter(is_asked).collect();
        if listed.is_empty() { ChainColumn::read(name, chain).into_iter().collect() } else { listed }
    }

    /// Returns every name that [`ChainColumn::list`] reads, but those of groups at one place.
    pub fn names(chain: &Chain) -> Vec<String> {
        let groups = ChainQuantity::GROUPS.iter().map(|(name, _)| name.to_string());
        groups.chain(ChainColumn::all(chain).into_iter().map(|column| column.name(chain))).collect()
    }

    /// Returns the name of the column, which [`ChainColumn::read`] reads.
    pub fn name(self, chain: &Chain) -> String {
        match self.quantity.owner() {
            Owner::Chain => self.quantity.to_string(),
            Owner::Node => format!("{}.{}", self.quantity, node_name(self.place, chain)),
            Owner::Body => format!("{}.{}", self.quantity, self.place + 1),
        }
    }

    /// Returns the meaning of the column: `velocity of the upper end, upwards, of body 2 (target)`.
    pub fn meaning(self, chain: &Chain) -> String {
        let Self { quantity, place } = self;
        let meaning = quantity.meaning();
        match quantity.owner() {
            Owner::Chain => meaning.into(),
            Owner::Node if place == 0 => format!("{meaning}, at the bottom"),
            Owner::Node if place == chain.bodies().len() => format!("{meaning}, at the top"),
            Owner::Node => format!("{meaning}, at the joint above body {place}"),
            Owner::Body => match chain.bodies().get(place).and_then(Body::name) {
                Some(name) => format!("{meaning}, of body {} ({name})", place + 1),
                None => format!("{meaning}, of body {}", place + 1),
            },
        }
    }

    /// Returns every column of `chain`; those of springs at nodes that have one.
    pub fn all(chain: &Chain) -> Vec<Self> {
        let bodies = chain.bodies().len();
        let places = |quantity: ChainQuantity| match quantity.owner() {
            Owner::Chain => 0..1,
            Owner::Node => 0..bodies + 1,
            Owner::Body => 0..bodies,
        };
        let quantities = <ChainQuantity as strum::VariantArray>::VARIANTS.iter().copied();
        let columns =
            quantities.flat_map(|quantity| places(quantity).map(move |place| ChainColumn { quantity, place }));
        let is_of_spring =
            |column: &Self| matches!(column.quantity, ChainQuantity::SpringEnergy | ChainQuantity::Dissipated);
        columns.filter(|column| !is_of_spring(column) || chain.spring(column.place).is_some()).collect()
    }
}

/// A number of a contact at a node of a chain.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray,
)]
#[strum(serialize_all = "snake_case")]
pub enum ChainContactQuantity {
    /// Its beginning.
    Impact,
    /// Its end.
    Release,
    /// Integral of the force.
    Impulse,
    /// Greatest force.
    PeakForce,
}

impl ChainContactQuantity {
    /// Reads `release.1` or `impulse.top`; `None` if the chain has no such quantity or node.
    pub fn read(name: &str, chain: &Chain) -> Option<(usize, Self)> {
        let (quantity, place) = name.split_once('.')?;
        Some((node(place, chain)?, ChainContactQuantity::from_str(quantity).ok()?))
    }

    /// Returns the names of all numbers of the contacts of `chain`.
    pub fn names(chain: &Chain) -> impl Iterator<Item = String> {
        let contacts = (0..=chain.bodies().len()).filter(|node| chain.is_contact(*node));
        contacts.flat_map(move |node| {
            let all = <Self as strum::VariantArray>::VARIANTS.iter();
            all.map(move |quantity| format!("{quantity}.{}", node_name(node, chain)))
        })
    }

    /// Returns the measure of the number.
    pub fn measure(self) -> Measure {
        match self {
            ChainContactQuantity::Impact | ChainContactQuantity::Release => Measure::Time,
            ChainContactQuantity::Impulse => Measure::Impulse,
            ChainContactQuantity::PeakForce => Measure::Force,
        }
    }

    /// Returns the number of a contact; `None` for the end of one that lasts.
    pub fn of<N>(self, contact: &ChainContact<N>) -> Option<&N> {
        match self {
            ChainContactQuantity::Impact => Some(&contact.impact),
            ChainContactQuantity::Release => contact.release.as_ref(),
            ChainContactQuantity::Impulse => Some(&contact.impulse),
            ChainContactQuantity::PeakForce => Some(&contact.peak),
        }
    }
}

/// A quantity of a chain by itself: one over time, or that of a contact.
///
/// ```
/// use dalembert::chain::{Body, Chain, ChainQuery};
/// let bar = || Body::new(1.into(), 1.into(), 1.into());
/// let chain = Chain::builder(bar()).contact(1.into(), bar()).until(4.into()).build()?;
/// assert!(matches!(ChainQuery::read("u_top.2", &chain), Some(ChainQuery::Column(_))));
/// assert!(matches!(ChainQuery::read("release.1", &chain), Some(ChainQuery::Contact(1, _))));
/// # Ok::<(), dalembert::problem::ProblemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChainQuery {
    /// A quantity over time.
    Column(ChainColumn),
    /// A quantity of a contact of the node with this index, 0 at the bottom.
    Contact(usize, ChainContactQuantity),
}

impl ChainQuery {
    /// Reads `force.1` or `release.1`; `None` if the chain has no such quantity or place.
    pub fn read(name: &str, chain: &Chain) -> Option<Self> {
        let column = ChainColumn::read(name, chain).map(ChainQuery::Column);
        let contact =
            || ChainContactQuantity::read(name, chain).map(|(node, number)| ChainQuery::Contact(node, number));
        column.or_else(contact)
    }

    /// Returns the name of the quantity, which [`ChainQuery::read`] reads.
    pub fn name(self, chain: &Chain) -> String {
        match self {
            ChainQuery::Column(column) => column.name(chain),
            ChainQuery::Contact(node, quantity) => format!("{quantity}.{}", node_name(node, chain)),
        }
    }

    /// Returns the names of all quantities of `chain`.
    pub fn names(chain: &Chain) -> Vec<String> {
        let columns = ChainColumn::all(chain).into_iter().map(|column| column.name(chain));
        columns.chain(ChainContactQuantity::names(chain)).collect()
    }

    /// Returns the measure of the quantity.
    pub fn measure(self) -> Measure {
        match self {
            ChainQuery::Column(column) => column.quantity.measure(),
            ChainQuery::Contact(_, quantity) => quantity.measure(),
        }
    }
}
