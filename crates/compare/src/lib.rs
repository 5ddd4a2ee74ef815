//! Comparison of data from other programs with the exact history of a rod.
//!
//! [`Prepared`] reads [`data::Source`]s and plans the run that they need, [`Prepared::compare`] solves it, and a
//! [`Comparison`] reports norms, contacts, an audit by the laws of motion and the causes of what differs, as a table or
//! as JSON. A [`Limit`] bounds any of these in a test.
//!
//! ```
//! use dalembert_compare::data::Source;
//! use dalembert_compare::{Limit, Options, Prepared};
//! use dalembert::quantity::UnitSystem;
//! use dalembert::{Problem, Units, engine};
//!
//! let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).time(1.5).build()?;
//! // Corollary 1 has the strain −(3 + t) until t = 2; these are one percent more.
//! let times = vec![0.5, 1.0, 1.5];
//! let strain = times.iter().map(|t| -1.01 * (3.0 + t)).collect();
//! let names = vec!["t".to_string(), "strain".to_string()];
//! let source = Source::from_columns("mine", names, vec![Ok(times), Ok(strain)]);
//! let units = Units::new(&rod, UnitSystem::Si);
//! let prepared = Prepared::new(&rod, &units, None, vec![source], &Options::default())?;
//! let found = prepared.compare(std::sync::Arc::new(engine::unobserved))?;
//! let limits: Vec<Limit> = vec!["strain.linf=0.0101".parse()?, "strain.linf=0.0099".parse()?];
//! let failed = found.outcomes(&limits)?.into_iter().filter(|outcome| outcome.failure.is_some());
//! assert_eq!(failed.map(|outcome| outcome.expected).collect::<Vec<_>>(), ["strain.linf ≤ 9.9e-3"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod agreement;
pub mod aligned;
mod audit;
mod body;
mod cause;
mod cause_fits;
mod comparison;
mod contacts;
pub mod data;
mod diagnosis;
mod fit;
mod hint;
mod least_squares;
mod limit;
mod map;
mod model;
mod norms;
mod options;
mod reference;
mod report;
mod samples;
mod softness;
mod spring;
mod symptoms;
mod wording;

pub use agreement::Agreement;
pub use body::Bar;
pub use comparison::{CompareError, ComparedFile, Comparison, Prepared};
pub use fit::FitError;
pub use limit::{Limit, LimitError, Outcome};
pub use map::MapError;
pub use norms::{ComparedColumn, Grid};
pub use options::{Axis, Compression, Options, Origin};
pub use report::{BodiesReport, BodyReport, FileReport, LEGEND, SchemaVersion, SeriesReport};
