//! The comparison of data with an exact history: options are checked, the run is planned and solved, files are
//! compared.

use schemars::JsonSchema;
use serde::Serialize;

use super::agreement::Agreement;
use super::contacts::{ContactPair, ContactRecord};
use super::data::{DataError, Source};
use super::diagnosis::Diagnosis;
use super::fit::{Fit, FitError};
use super::limit::{Limit, LimitError, Order, Outcome, orders, outcomes};
use super::map::{ColumnMap, Conversions, MapError};
use super::norms::{ComparedColumn, Norm};
use super::options::Options;
use super::reference::Reference;
use super::samples::Samples;
use super::softness::{self, SoftColumn};
use dalembert::Error;
use dalembert::chain::Spring;
use dalembert::number::Number;
use dalembert::problem::{Parameter, Parameters, Problem, Run};
use dalembert::quantity::{Quantity, Units};
use dalembert::reason::Warning;
use dalembert::solve::{Numbers, Observer, Plan, Question, TypedHistory};

/// The reason why data cannot be compared; the message says what was found and what was expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each case is described by its message")]
pub enum CompareError {
    #[error(transparent)]
    Data(#[from] DataError),
    #[error("{file}: {error}")]
    Map { file: String, error: MapError },
    #[error("found {found}, expected {expected}")]
    Option { key: &'static str, found: String, expected: String },
    #[error(
        "{file}: found times up to {last}, expected times of the scene's own run, which ends at t = {end}: are they \
         in {unit}? For a run as long, say so in the scene: time = {last} in [run]"
    )]
    Span { file: String, last: f64, end: f64, unit: &'static str },
    #[error("{file}: {error}")]
    Fit { file: String, error: FitError },
    #[error(transparent)]
    History(#[from] Error),
}

impl CompareError {
    /// Returns the key of [`Options`] that would correct it.
    pub fn key(&self) -> Option<&'static str> {
        match self {
            CompareError::Map { error: MapError::NoTime { .. } | MapError::TwoTimes, .. } => Some("dt"),
            CompareError::Map { .. } => Some("map"),
            CompareError::Option { key, .. } => Some(key),
            CompareError::Fit { .. } => Some("fit"),
            _ => None,
        }
    }
}

impl Options {
    /// Checks the options for `count` sources.
    fn check(&self, count: usize) -> Result<(), CompareError> {
        let refuse = |key, found: String, expected: String| Err(CompareError::Option { key, found, expected });
        if !self.widths.is_empty() && self.widths.len() != count {
            return refuse("widths", format!("{} widths", self.widths.len()), format!("{count}, one for each file"));
        }
        if self.t0.is_some() && self.dt.is_none() {
            return refuse("dt", "t0 without dt".into(), "both, or a column of times".into());
        }
        let named =
            [("dt", &self.dt), ("window", &self.window), ("energy_scale", &self.energy_scale), ("to", &self.to)];
        let lengths = named.into_iter().flat_map(|(name, number)| number.iter().map(move |number| (name, number)));
        for (name, number) in lengths.chain(self.widths.iter().map(|width| ("widths", width))) {
            if number.to_f64() <= 0.0 {
                return refuse(name, format!("{name} {number}"), "more than zero".into());
            }
        }
        Ok(())
    }

    /// Returns the time to which the data should go: `to`, or the end of the run of the scene, where that is a time or
    /// quickly found.
    fn until(&self, problem: &Problem) -> Option<f64> {
        match (&self.to, problem.run()) {
            (Some(to), _) => Some(to.to_f64()),
            (None, Run::Time(time)) => Some(time.to_f64()),
            (None, Run::Impacts(count)) if *count <= MOST_IMPACTS => {
                problem.doubles().ok()?.contacts().last().and_then(|contact| contact.release)
            }
            (None, Run::Impacts(_)) => None,
        }
    }

    /// Reads the samples of a source.
    fn samples(&self, source: Source, length: f64, units: &Units) -> Result<Samples, CompareError> {
        let of = |number: &Option<Number>| number.as_ref().map_or(0.0, Number::to_f64);
        let counted = self.dt.is_some();
        let sized = source.head.is_sized;
        let guess = (sized && self.map.is_none() && !counted && source.head.names.is_empty() && source.head.width > 3)
            .then_some(PLAIN);
        let map = ColumnMap::new(guess.or(self.map.as_deref()), &source.head.names, source.head.width, counted)
            .and_then(|map| {
                let names = if self.map.is_none() { source.head.names.as_slice() } else { &[] };
                let conversions = map.conversions(names, units)?;
                Ok((map, conversions))
            });
        let (map, Conversions { of_columns, remark }) = map.map_err(|error| {
            let error = match (error, source.head.misnamed) {
                (MapError::NoNames, Some(found)) => MapError::Names { found, expected: source.head.width },
                (error, _) => error,
            };
            CompareError::Map { file: source.file.clone(), error }
        })?;
        let clock = counted.then(|| (of(&self.t0), of(&self.dt)));
        let places: Vec<usize> = map.columns.iter().map(|(_, place)| *place).collect();
        let mut columns = source.columns(&places, map.place(Quantity::Side))?;
        for (values, conversion) in columns.values.iter_mut().zip(of_columns) {
            values.iter_mut().for_each(|value| *value = conversion.apply(*value));
        }
        let mut samples = Samples::new(columns, &map, clock, of(&self.shift), length)?;
        samples.notes.extend((!remark.is_empty()).then(|| format!("units: {remark}")));
        samples.notes.extend(sized.then(|| "the first line holds the numbers of rows and columns: skipped".into()));
        samples.notes.extend(guess.map(|guess| format!("the columns have no names: taken as {guess}")));
        Ok(samples)
    }
}

/// Data that are read, and the plan of the run that they need.
#[derive(Debug)]
pub struct Prepared {
    problem: Problem,
    units: Units,
    /// The plan of the run.
    pub plan: Plan,
    /// The same problem with rigid contact, where the contact yields.
    rigid: Option<(Plan, Problem)>,
    data: Vec<NamedSamples>,
    /// The time to which the data should go.
    until: Option<f64>,
    options: Options,
}

/// The samples of a source, with its name.
#[derive(Debug)]
struct NamedSamples {
    file: String,
    samples: Samples,
}

/// The result of a comparison, as a table, as JSON, and as samples beside the exact values.
#[derive(Debug)]
pub struct Comparison {
    /// One for each source, in their order.
    pub files: Vec<ComparedFile>,
    pub(crate) orders: Vec<Order>,
    /// The units of all values.
    pub units: Units,
    /// The warnings of the exact run.
    pub warnings: Vec<Warning>,
}

/// A source beside the exact history.
#[derive(Debug, JsonSchema, Serialize)]
#[schemars(rename = "compared")]
pub struct ComparedFile {
    /// The name of the source.
    pub file: String,
    /// The samples beside the exact values.
    #[serde(flatten)]
    pub agreement: Agreement,
    #[serde(flatten)]
    pub(crate) diagnosis: Diagnosis,
    /// The values of the scene that explain the data best, where some are asked for.
    pub(crate) fit: Option<FittedFile>,
    /// The parts of the difference from rigid contact; empty where the exact contact is rigid.
    pub(crate) softness: Vec<SoftColumn>,
}

/// A fit, and the samples beside the history with the fitted values.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct FittedFile {
    #[serde(flatten)]
    pub(crate) fit: Fit,
    #[serde(skip)]
    pub(crate) agreement: Agreement,
    quantities: Vec<FittedQuantity>,
    contacts: Vec<FittedContact>,
}

/// The norm of a column with the fitted values.
#[derive(Debug, JsonSchema, Serialize)]
struct FittedQuantity {
    name: &'static str,
    l2: Norm,
}

/// A contact with the fitted values, and the one of the data.
#[derive(Debug, JsonSchema, Serialize)]
struct FittedContact {
    fitted: Option<ContactRecord>,
    theirs: Option<ContactRecord>,
}

impl FittedFile {
    fn new(fit: Fit, agreement: Agreement) -> Self {
        let quantity = |column: &ComparedColumn| FittedQuantity { name: column.what.name(), l2: column.norms.l2 };
        let contact = |ContactPair { ours, theirs }: ContactPair| FittedContact { fitted: ours, theirs };
        let quantities = agreement.quantities.iter().map(quantity).collect();
        let contacts = agreement.contacts.iter().cloned().map(contact).collect();
        FittedFile { fit, agreement, quantities, contacts }
    }
}

/// The map of a file without names that begins with the number of its columns, as those of Siconos do.
const PLAIN: &str = "t=0,u=1,v=2,force=3";
/// Largest number of impacts of a run that is solved to find its end.
const MOST_IMPACTS: u32 = 1000;
/// Ratio of the times of data to the run of the scene from which on they are in another unit of time.
const FAR: f64 = 100.0;

/// Returns the end of the run of the scene. A run of impacts is solved for it only where the data go on for more than
/// [`FAR`] round trips for each impact; hops may be shorter than a round trip, and then data that are too long are not
/// refused.
fn own_end(problem: &Problem, trip: f64, last: f64) -> Option<f64> {
    match problem.run() {
        Run::Time(time) => Some(time.to_f64()),
        Run::Impacts(count) if last <= FAR * trip * f64::from(*count) => None,
        Run::Impacts(_) => problem.doubles().ok().map(|history| *history.end()),
    }
}

/// Returns the number that a double spells.
fn written(time: f64) -> Result<Number, Error> {
    format!("{time:e}").parse().map_err(|_| Error::TimeOutside { found: time.to_string(), end: time.to_string() })
}

/// Returns the unit in which times may be that go `times` as far as the run.
fn unit_of_time(times: f64) -> &'static str {
    match (times.log10() / 3.0).round() {
        ..=1.0 => "milliseconds",
        2.0 => "microseconds",
        _ => "another unit of time",
    }
}

impl Prepared {
    /// Reads `sources`, to be compared with `problem` in its `units`, solved in doubles to `accuracy` as far as its own
    /// run and the data go.
    ///
    /// **Errors**: [`CompareError`].
    pub fn new(
        problem: &Problem,
        units: &Units,
        accuracy: Option<f64>,
        sources: Vec<Source>,
        options: &Options,
    ) -> Result<Self, CompareError> {
        options.check(sources.len())?;
        let rod = Parameters::<f64>::of(problem, &())?;
        let read = |source: Source| {
            let file = source.file.clone();
            Ok(NamedSamples { file, samples: options.samples(source, rod.length, units)? })
        };
        let data = sources.into_iter().map(read).collect::<Result<Vec<_>, CompareError>>()?;
        let ends = data.iter().filter_map(|data| data.samples.grid.times.last());
        let last = ends.fold(0.0, |a: f64, b| a.max(*b));
        for NamedSamples { file, samples } in &data {
            let last = samples.grid.times.last().copied().unwrap_or(0.0);
            let end = own_end(problem, rod.round_trip(), last);
            if let Some(end) = end.filter(|end| *end > 0.0 && last > FAR * end) {
                let unit = unit_of_time(last / end);
                return Err(CompareError::Span { file: file.clone(), last, end, unit });
            }
        }
        // A round trip more shows a contact that begins in the data a little too early.
        let last = last + rod.round_trip();
        let until = options.until(problem);
        let problem = match until {
            Some(time) if time >= last => problem.clone(),
            _ => problem.to_builder().time(last).build().map_err(Error::from)?,
        };
        let (problem, rigid) = match &options.contact_stiffness {
            None => {
                let rigid = problem.rigid_contact().map_err(Error::from)?;
                (problem, rigid)
            }
            Some(stiffness) => {
                let spring = Spring { stiffness: stiffness.clone(), damping: 0.into() };
                let end = match problem.run() {
                    Run::Time(end) => end.clone(),
                    Run::Impacts(_) => written(last)?,
                };
                // The speed of a fall is a root, and a comparison is in doubles.
                let problem = match Parameter::DropHeight.given(&problem) {
                    Some(_) => problem.to_builder().impact_speed(written(rod.speed)?).build().map_err(Error::from)?,
                    None => problem,
                };
                (problem.on_spring(spring, end).map_err(Error::from)?, Some(problem))
            }
        };
        let numbers = Numbers::Double(accuracy);
        let plan = Plan::of(&problem, &Question::run(numbers))?;
        let rigid =
            rigid.map(|rigid| Ok::<_, Error>((Plan::of(&rigid, &Question::run(numbers))?, rigid))).transpose()?;
        Ok(Prepared { problem, units: units.clone(), plan, rigid, data, until, options: options.clone() })
    }

    /// Solves the run and compares.
    ///
    /// **Errors**: those of the history, and of a fit.
    pub fn compare(self, observer: Observer) -> Result<Comparison, CompareError> {
        let Prepared { problem, units, plan, rigid, data, until, options } = self;
        let history = TypedHistory::<f64>::solve(&problem, &plan, observer.clone())?;
        let solve = |(plan, problem): (Plan, Problem)| TypedHistory::<f64>::solve(&problem, &plan, observer);
        let rigid = rigid.map(solve).transpose()?;
        let mut files = Vec::new();
        for NamedSamples { file, samples } in data {
            let reference = Reference::new(&history)?;
            let again = (!options.fit.is_empty()).then(|| samples.clone());
            let beside_rigid = rigid.as_ref().map(|rigid| (rigid, samples.clone()));
            let agreement = Agreement::new(&reference, &units, samples, &options, until)?;
            let softness = match beside_rigid {
                None => Vec::new(),
                Some((rigid, samples)) => {
                    let rigid = Agreement::new(&Reference::new(rigid)?, &units, samples, &options, until)?;
                    softness::parts(&agreement, &rigid)
                }
            };
            let diagnosis = Diagnosis::new(&reference, &agreement)?;
            let mut fit = None;
            if let Some(samples) = again {
                let found = Fit::new(&reference, &agreement, &options.fit)?;
                let found = found.map_err(|error| CompareError::Fit { file: file.clone(), error })?;
                let reference = Reference::new(&found.history)?;
                let agreement = Agreement::new(&reference, &units, samples, &options, until)?;
                fit = Some(FittedFile::new(found, agreement));
            }
            files.push(ComparedFile { file, agreement, diagnosis, fit, softness });
        }
        let compared: Vec<&Agreement> = files.iter().map(|file| &file.agreement).collect();
        let widths: Vec<f64> = match options.widths.as_slice() {
            [] => compared.iter().map(|file| file.step).collect(),
            widths => widths.iter().map(Number::to_f64).collect(),
        };
        let orders = orders(&compared, &widths);
        Ok(Comparison { orders, units, warnings: history.warnings(), files })
    }
}

impl Comparison {
    /// Checks `limits` for each source. A run that breaks off before the end of the run of the scene fails.
    ///
    /// **Errors**: [`LimitError`] for a bound of something that the data do not have.
    pub fn outcomes(&self, limits: &[Limit]) -> Result<Vec<Outcome>, LimitError> {
        let files: Vec<_> = self.files.iter().map(|file| (file.file.as_str(), &file.agreement)).collect();
        outcomes(&files, &self.orders, limits)
    }
}

impl ComparedFile {
    /// Returns every column by name: `t`, `x` of a field, and for each quantity the exact values and the data.
    pub fn columns(&self) -> impl Iterator<Item = (String, &[f64])> {
        let Agreement { grid, quantities, .. } = &self.agreement;
        let own = [("t", Some(&grid.times)), ("x", grid.points.as_ref())];
        let own = own.into_iter().filter_map(|(name, values)| Some((name.to_string(), values?.as_slice())));
        own.chain(quantities.iter().flat_map(|compared| {
            let name = |whose: &str| format!("{}_{whose}", compared.what.name());
            [(name("ours"), compared.ours.as_slice()), (name("theirs"), compared.theirs.as_slice())]
        }))
    }
}
