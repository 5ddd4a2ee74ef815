//! A question about one number of a whole chain.

use super::route::{Question, Route};
use crate::error::VerifyError;
use dalembert::chain::{Chain, ChainColumn, ChainContactQuantity, ChainQuantity, ChainQuery};
use dalembert::number::Number;
use dalembert::quantity::Measure;
use dalembert::solve::Numbers;
use dalembert::{Side, Value};

/// A question about one number of a chain: a quantity at a time, or one of the first contact of a node.
#[derive(Clone, Debug)]
pub struct ChainQuestion {
    pub(crate) chain: Chain,
    pub(crate) query: ChainQuery,
    pub(crate) time: Option<Number>,
}

impl ChainQuestion {
    /// Builds the question for `query` at `time`.
    ///
    /// The default quantity is the release of the first contact that ends or, without one, the displacement of the
    /// upper end of the first body. The default time is the end of the run.
    ///
    /// **Errors**: [`VerifyError::Time`] for a time below zero, or one for a quantity that has no time; those of the
    /// run.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain};
    /// use dalembert_verify::ChainQuestion;
    /// let bar = |velocity: i64| Body::new(1.into(), 1.into(), 1.into()).with_velocity(velocity.into());
    /// let chain = Chain::builder(bar(0)).contact(1.into(), bar(-1)).until(4.into()).build()?;
    /// assert_eq!(ChainQuestion::new(&chain, None, None)?.name(), "release.1");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(chain: &Chain, query: Option<ChainQuery>, time: Option<Number>) -> Result<Self, VerifyError> {
        let query = query.map_or_else(|| default_query(chain), Ok)?;
        if let Some(found) = time.clone() {
            if let ChainQuery::Contact(..) = query {
                let expected = format!("none: {} is not asked at a time", query.name(chain));
                return Err(VerifyError::Time { found, expected });
            }
            if found.to_f64() < 0.0 {
                return Err(VerifyError::Time { found, expected: "one from 0 on".into() });
            }
        }
        let has_time = matches!(query, ChainQuery::Column(_));
        let time = time.or_else(|| Some(chain.until().clone()).filter(|_| has_time));
        let chain = time.as_ref().map_or_else(|| Ok(chain.clone()), |time| chain.reaching(time))?;
        Ok(ChainQuestion { chain, query, time })
    }

    /// Returns the name of the quantity: `release.1`.
    pub fn name(&self) -> String {
        self.query.name(&self.chain)
    }

    /// Returns the measure of the quantity.
    pub fn measure(&self) -> Measure {
        self.query.measure()
    }

    /// Answers in `numbers`.
    fn answer_in(&self, numbers: Numbers) -> Result<Value, VerifyError> {
        let history = self.chain.solve(numbers)?;
        Ok(match (self.query, &self.time) {
            (ChainQuery::Column(column), Some(time)) => history.value(column, time, Side::Right)?,
            (ChainQuery::Column(column), None) => history.value(column, self.chain.until(), Side::Right)?,
            (ChainQuery::Contact(node, quantity), _) => history.contact_value(node, quantity, 0)?,
        })
    }
}

fn default_query(chain: &Chain) -> Result<ChainQuery, VerifyError> {
    let listing = chain.solve(Numbers::default())?.listing()?;
    let is_first = |k: usize| listing.contacts[..k].iter().all(|other| other.node != listing.contacts[k].node);
    let ended = (0..listing.contacts.len()).find(|k| listing.contacts[*k].release.is_some() && is_first(*k));
    let top = ChainColumn { quantity: ChainQuantity::TopDisplacement, place: 0 };
    let release = |k: usize| ChainQuery::Contact(listing.contacts[k].node, ChainContactQuantity::Release);
    Ok(ended.map_or(ChainQuery::Column(top), release))
}

impl Question for ChainQuestion {
    fn answer(&self, route: Route, _: f64) -> Result<Value, VerifyError> {
        match route {
            Route::Planned(numbers) => self.answer_in(numbers),
            _ => Err(VerifyError::NotGiven),
        }
    }

    fn exact_route(&self) -> Option<Route> {
        Some(Route::Planned(Numbers::Exact))
    }
}
