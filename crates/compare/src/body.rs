//! Data of several bodies of a chain, taken apart into those of each bar.

use dalembert::chain::{Chain, ChainColumn, ChainQuantity};

use super::data::Source;
use super::limit::Limit;
use super::map::{compared, name_and_unit};
use super::options::Options;

/// A bar of a chain, which picks its columns out of data with columns of several bodies.
///
/// A column has the number of its body, `u_end.2`, and a force the name of its joint, as those of
/// [`ChainColumn`]: `force.1` is the force below the second body, and `force.top`, or that of a joint below a rigid
/// mass, the force above a bar, `force_top`.
///
/// ```
/// use dalembert::chain::{Body, Chain};
/// use dalembert_compare::Bar;
/// let bar = || Body::new(1.into(), 1.into(), 1.into());
/// let chain = Chain::builder(bar()).contact(1.into(), bar()).until(4.into()).build()?;
/// let [lower, upper] = [0, 1].map(|body| Bar { chain: &chain, body });
/// assert_eq!(upper.column("force.1 [N]").as_deref(), Some("force [N]"));
/// assert_eq!((lower.column("force.1"), lower.column("t")), (None, Some("t".to_string())));
/// # Ok::<(), dalembert::problem::ProblemError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Bar<'a> {
    /// The chain.
    pub chain: &'a Chain,
    /// The index of the bar among the bodies, from 0 at the bottom.
    pub body: usize,
}

impl<'a> Bar<'a> {
    /// Returns the bars with columns in `names`, from the bottom up.
    fn named(chain: &'a Chain, names: &[String]) -> Vec<Self> {
        let owned = |bar: &Bar<'_>| names.iter().any(|name| bar.own(name).is_some());
        (0..chain.bodies().len()).map(|body| Bar { chain, body }).filter(owned).collect()
    }

    /// Returns the bars with columns in the map of `options`, or in the source where there is none.
    pub fn of(chain: &'a Chain, source: &Source, options: &Options) -> Vec<Self> {
        match &options.map {
            Some(map) => {
                let names = map.split(',').filter_map(|entry| entry.split_once('='));
                Self::named(chain, &names.map(|(name, _)| name.trim().to_string()).collect::<Vec<_>>())
            }
            None => Self::named(chain, &source.head.names),
        }
    }

    /// Returns the columns with the number of a body or the name of a joint that belong to no bar: those of rigid
    /// masses, and gaps and energies of joints.
    pub fn of_none<'n>(chain: &Chain, source: &'n Source) -> Vec<&'n str> {
        let is_of_none =
            |name: &&String| (0..chain.bodies().len()).all(|body| Bar { chain, body }.column(name).is_none());
        source.head.names.iter().filter(is_of_none).map(String::as_str).collect()
    }

    /// Returns the columns of quantities without the number of a body or the name of a joint, which may belong to any
    /// of several bars.
    pub fn of_any(source: &Source) -> Vec<&str> {
        let is_of_any = |name: &&String| compared(name_and_unit(name).0, false).is_some();
        source.head.names.iter().filter(is_of_any).map(String::as_str).collect()
    }

    /// Returns the name for this bar of a column with the number of a body or the name of a joint.
    fn own(&self, header: &str) -> Option<String> {
        let (name, _) = name_and_unit(header);
        let (quantity, place) = name.rsplit_once('.')?;
        let place = |quantity: &str| Some(ChainColumn::read(&format!("{quantity}.{place}"), self.chain)?.place);
        let bodies = self.chain.bodies();
        let is_bar = |body: usize| bodies.get(body).is_some_and(|body| body.rigid_mass().is_none());
        let (body, quantity) = match quantity {
            "force" => match place("force")? {
                node if is_bar(node) => (node, "force"),
                node => (node.checked_sub(1)?, "force_top"),
            },
            "gap" | "spring_energy" | "dissipated" => return None,
            quantity => (place("u_end")?, quantity),
        };
        let is_own = body == self.body && is_bar(body);
        is_own.then(|| format!("{quantity}{}", &header[name.len()..]))
    }

    /// Returns the name of a column among those of a rod; `None` for a column of another body or joint.
    pub fn column(&self, header: &str) -> Option<String> {
        let (name, _) = name_and_unit(header);
        let place = name.rsplit_once('.').map(|(_, place)| place);
        let is_numbered = place.is_some_and(|place| {
            ["u_end", "force"].iter().any(|name| ChainColumn::read(&format!("{name}.{place}"), self.chain).is_some())
        });
        if is_numbered { self.own(header) } else { Some(header.to_string()) }
    }

    /// Returns the name among the columns of the chain of a quantity of this bar, the inverse of [`Bar::column`].
    pub fn header(&self, quantity: &str) -> String {
        let force = |place: usize| ChainColumn { quantity: ChainQuantity::Force, place }.name(self.chain);
        match quantity {
            "force" => force(self.body),
            "force_top" => force(self.body + 1),
            quantity => format!("{quantity}.{}", self.body + 1),
        }
    }

    /// Returns the source with the names of a rod, where no map in `options` chooses among its own; columns of other
    /// bodies and joints have none.
    pub fn source(&self, mut source: Source, options: &Options) -> Source {
        for name in source.head.names.iter_mut().filter(|_| options.map.is_none()) {
            *name = self.column(name).unwrap_or_default();
        }
        source
    }

    /// Returns the options with the map of this bar.
    pub fn options(&self, options: &Options) -> Options {
        let entry = |entry: &str| match entry.split_once('=') {
            Some((name, column)) => Some(format!("{}={column}", self.column(name.trim())?)),
            None => Some(entry.to_string()),
        };
        let map = |map: &String| map.split(',').filter_map(entry).collect::<Vec<_>>().join(",");
        Options { map: options.map.as_ref().map(map), ..options.clone() }
    }

    /// Returns the bound with the name of a rod's quantity; `None` if it bounds another body or joint.
    pub fn limit(&self, limit: &Limit) -> Option<Limit> {
        limit.renamed(|quantity| self.column(quantity))
    }
}

#[cfg(test)]
#[path = "tests/body.rs"]
mod tests;
