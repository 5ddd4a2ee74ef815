//! From data to a report: what may be said of them, the run that they call for, and what comes of it.

use super::agree::{Agreement, Settings};
use super::conventions::{Axis, Compression, Conventions, Origin};
use super::data::{DataError, Source};
use super::fit::{Fit, FitError};
use super::limit::{Limit, Order, Outcome, orders, outcomes};
use super::map::{Map, MapError};
use super::samples::{Clock, Samples};
use crate::error::Error;
use crate::number::Number;
use crate::problem::{Parameter, Parameters, Problem, Run};
use crate::quantity::Units;
use crate::reason::Warning;
use crate::solve::{Numbers, Observer, Plan, Question, Solution};

/// What is said of data besides themselves; messages call it by these names.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Which column is what: `t=0,u=1,force=f_n`; by default the names of the columns.
    pub map: Option<String>,
    /// The step between rows, where no column holds the time.
    pub dt: Option<Number>,
    /// The time of the first row, with `dt`.
    pub t0: Option<Number>,
    /// Added to the times of the data.
    pub shift: Option<Number>,
    /// The sign of forces, stresses and strains in compression; by default forces are +, stresses and strains −.
    pub compression: Option<Compression>,
    /// Where displacements are zero.
    pub origin: Origin,
    /// Which way displacements and velocities count.
    pub axis: Axis,
    /// The factor that brings the energies of the data to those of the rod; 1 where nothing is said.
    pub energy_scale: Option<Number>,
    /// Round trips from a jump where `L∞ off jumps` begins.
    pub window: Option<Number>,
    /// The width of the mesh of each source, for the order of convergence; by default the step of its times.
    pub widths: Vec<Number>,
    /// How far the data are to go; by default as far as the run of the scene.
    pub to: Option<Number>,
    /// The values of the scene that are fitted to the data.
    pub fit: Vec<Parameter>,
}

/// Why data cannot be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CompareError {
    /// The data.
    #[error(transparent)]
    Data(#[from] DataError),
    /// Their columns.
    #[error("{file}: {error}")]
    Map {
        /// The source.
        file: String,
        /// What is wrong with them.
        error: MapError,
    },
    /// What is said of them.
    #[error("found {found}, expected {expected}")]
    Option {
        /// Which of [`Options`] it is said by.
        key: &'static str,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// Their times, against the scene's own run.
    #[error(
        "{file}: found times up to {last}, expected times of the scene's own run, which ends at t = {end}: are they \
         in {unit}? For a run as long, say so in the scene: time = {last} in [run]"
    )]
    Span {
        /// The source.
        file: String,
        /// Its last time.
        last: f64,
        /// The end of the run.
        end: f64,
        /// What the times may be in.
        unit: &'static str,
    },
    /// What is to be fitted.
    #[error("{file}: {error}")]
    Fit {
        /// The source.
        file: String,
        /// What is wrong with it.
        error: FitError,
    },
    /// The history.
    #[error(transparent)]
    History(#[from] Error),
}

impl CompareError {
    /// The key of [`Options`] that mends it.
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
    /// Refuses what cannot be meant of `count` sources.
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

    fn settings(&self, problem: &Problem) -> Settings {
        let conventions = Conventions {
            compression: self.compression,
            origin: self.origin,
            axis: self.axis,
            energy_scale: self.energy_scale.as_ref().map_or(1.0, Number::to_f64),
        };
        let last = |history: crate::solve::History<f64>| history.contacts().last().and_then(|contact| contact.to);
        let until = match (&self.to, &problem.run) {
            (Some(to), _) => Some(to.to_f64()),
            (None, Run::Time(time)) => Some(time.to_f64()),
            (None, Run::Impacts(count)) if *count <= MOST_IMPACTS => problem.solve().ok().and_then(last),
            (None, Run::Impacts(_)) => None,
        };
        Settings { conventions, until, judge: true, window: self.window.as_ref().map(Number::to_f64) }
    }

    fn samples(&self, source: Source, length: f64, units: &Units) -> Result<Samples, CompareError> {
        let of = |number: &Option<Number>| number.as_ref().map_or(0.0, Number::to_f64);
        let counted = self.dt.is_some();
        let sized = source.is_sized();
        let guess = (sized && self.map.is_none() && !counted && source.names().is_empty() && source.width() > 3)
            .then_some(PLAIN);
        let map = Map::of(guess.or(self.map.as_deref()), source.names(), source.width(), counted).and_then(|map| {
            let names = if self.map.is_none() { source.names() } else { &[] };
            let (conversions, converted) = map.conversions(names, units)?;
            Ok((map, conversions, converted))
        });
        let map = map.map_err(|error| match (error, source.misnamed()) {
            (MapError::NoNames, Some(found)) => MapError::Names { found, expected: source.width() },
            (error, _) => error,
        });
        let (map, conversions, converted) =
            map.map_err(|error| CompareError::Map { file: source.file().into(), error })?;
        let clock = counted.then(|| Clock { start: of(&self.t0), step: of(&self.dt) });
        let mut columns = source.columns(&map.places(), map.side)?;
        for (values, conversion) in columns.values.iter_mut().zip(conversions) {
            values.iter_mut().for_each(|value| *value = conversion.apply(*value));
        }
        let mut samples = Samples::of(columns, &map, clock, of(&self.shift), length)?;
        samples.notes.extend((!converted.is_empty()).then(|| format!("units: {converted}")));
        samples.notes.extend(sized.then(|| "the first line holds the numbers of rows and columns: skipped".into()));
        samples.notes.extend(guess.map(|guess| format!("the columns have no names: taken as {guess}")));
        Ok(samples)
    }
}

/// Data that are read, and the run that they call for.
#[derive(Debug)]
pub struct Prepared {
    problem: Problem,
    /// How the run is to be solved.
    pub plan: Plan,
    data: Vec<(String, Samples)>,
    settings: Settings,
    widths: Vec<f64>,
    fit: Vec<Parameter>,
}

/// Data beside the exact history: what is reported.
#[derive(Debug)]
pub struct Comparison {
    /// One for each source.
    pub files: Vec<ComparedFile>,
    /// The orders of convergence that several show.
    pub(crate) orders: Vec<Order>,
    /// What a user should know of the history.
    pub warnings: Vec<Warning>,
}

/// One source that was compared.
#[derive(Debug)]
pub struct ComparedFile {
    /// Its name.
    pub(crate) file: String,
    /// What came of it.
    pub(crate) agreement: Agreement,
    /// The values that explain it best, and what comes of it with them.
    pub(crate) fit: Option<(Fit, Agreement)>,
}

/// What the columns of a file without names are taken for that begins with their number, as Siconos' own are.
const PLAIN: &str = "t=0,u=1,v=2,force=3";
/// A run of more impacts is not solved to see whether data break off before its end.
const MOST_IMPACTS: u32 = 1000;
/// Data that go so many times as far as the scene's own run are in another unit of time.
const FAR: f64 = 100.0;

/// Where the scene's own run ends. A run of impacts is solved for that only where the data go on for more than [`FAR`]
/// round trips for each of them; hops may be shorter than a round trip, and then data that are too long are not
/// refused.
fn own_end(problem: &Problem, trip: f64, last: f64) -> Option<f64> {
    match &problem.run {
        Run::Time(time) => Some(time.to_f64()),
        Run::Impacts(count) if last <= FAR * trip * f64::from(*count) => None,
        Run::Impacts(_) => problem.solve().ok().map(|history| *history.end()),
    }
}

/// What times may be in that go so many times as far as the run.
fn unit_of_time(times: f64) -> &'static str {
    match (times.log10() / 3.0).round() {
        ..=1.0 => "milliseconds",
        2.0 => "microseconds",
        _ => "another unit of time",
    }
}

impl Prepared {
    /// Reads `sources`, which are to be compared with `problem` in its `units`, solved in doubles to `accuracy`. It is
    /// followed as far as its own run and the data go.
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
        let read = |source: Source| Ok((source.file().to_string(), options.samples(source, rod.length, units)?));
        let data = sources.into_iter().map(read).collect::<Result<Vec<_>, CompareError>>()?;
        let last = data.iter().filter_map(|(_, samples)| samples.grid.times.last()).fold(0.0, |a: f64, b| a.max(*b));
        for (file, samples) in &data {
            let last = samples.grid.times.last().copied().unwrap_or(0.0);
            let end = own_end(problem, rod.round_trip(), last);
            if let Some(end) = end.filter(|end| *end > 0.0 && last > FAR * end) {
                let unit = unit_of_time(last / end);
                return Err(CompareError::Span { file: file.clone(), last, end, unit });
            }
        }
        // A round trip more shows a contact that begins in the data a little too early.
        let last = last + rod.round_trip();
        let settings = options.settings(problem);
        let problem = match settings.until {
            Some(time) if time >= last => problem.clone(),
            _ => problem.to_builder().time(last).build().map_err(Error::from)?,
        };
        let plan = Plan::of(&problem, &Question::run(Numbers::Double(accuracy)))?;
        let widths = options.widths.iter().map(Number::to_f64).collect();
        Ok(Prepared { problem, plan, data, settings, widths, fit: options.fit.clone() })
    }

    /// Solves the run and compares.
    ///
    /// **Errors**: those of the history, and of a fit.
    pub fn compare(self, observer: Observer) -> Result<Comparison, CompareError> {
        let Prepared { problem, plan, data, settings, widths, fit } = self;
        let Solution::Double(history) = plan.solve(&problem, observer)? else {
            return Err(Error::NoMultiprecision.into());
        };
        let mut files = Vec::new();
        for (file, samples) in data {
            let again = (!fit.is_empty()).then(|| samples.clone());
            let agreement = Agreement::of(&problem, &history, samples, &settings)?;
            let mut fitted = None;
            if let Some(samples) = again {
                let found = Fit::of(&problem, &history, &agreement, &fit)?;
                let found = found.map_err(|error| CompareError::Fit { file: file.clone(), error })?;
                let settings = Settings { judge: false, ..settings.clone() };
                let then = Agreement::of(&found.problem, &found.history, samples, &settings)?;
                fitted = Some((found, then));
            }
            files.push(ComparedFile { file, agreement, fit: fitted });
        }
        let compared: Vec<&Agreement> = files.iter().map(|file| &file.agreement).collect();
        let widths = if widths.is_empty() { compared.iter().map(|file| file.step).collect() } else { widths };
        let orders = orders(&compared, &widths);
        Ok(Comparison { orders, warnings: history.warnings(), files })
    }
}

impl Comparison {
    /// What comes of `limits`, for each source. A run that breaks off before the end of that of the scene fails.
    ///
    /// **Errors**: what the data do not have.
    pub fn outcomes(&self, limits: &[Limit]) -> Result<Vec<Outcome>, String> {
        let files: Vec<_> = self.files.iter().map(|file| (file.file.as_str(), &file.agreement)).collect();
        outcomes(&files, &self.orders, limits)
    }
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: expected {}", self.file, self.expected)?;
        self.failure.iter().try_for_each(|found| write!(f, ", found {found}"))
    }
}

impl ComparedFile {
    /// Every sample, by name: `t`, `x` of a field, and for each quantity ours and theirs.
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
